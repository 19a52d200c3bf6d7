//! A groove in its ring's meridian plane: a circle, whose centres form a circle of radius C about the ring's axis, at
//! the axial place ζ of the ring.
//!
//! With a ball's centre g from the axis and h along it,
//! ```text
//! d = √((C − g)² + (ζ − h)²)   δ = d − l   n = (C − g, ζ − h)/d
//! ```
//! l is the distance of ball and groove centres where they just touch, r_g − r. This is exact for any displacement and
//! tilt: the nearest point of a circle. The force of the contact on the ball is along +n on both raceways, as inside
//! g < C and outside g > C. The contact angle is the one of −n outside and of n inside, from the direction away from
//! the axis towards the axis.
//!
//! The groove is taken as a circle up to 90°: where it ends, at the shoulder, nothing here knows. The other half of the
//! circle, on the far side of its centre, is no steel. A ball with cos α ≤ 0 touches nothing: with c = ±(C − g),
//! positive inside for g < C and outside for g > C, its approach is c − l < 0.

use crate::contact::rolling::RacewaySide;
use crate::numerics::number::{Number, Scalar};
use crate::scene::Bearing;

/// The groove of one ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Groove {
    /// Radius C of the circle of groove centres (m).
    pub centre_radius: f64,
    /// The same beyond R_o − r (m), where balls' centres are that touch the bottom of the outer groove.
    pub beyond: f64,
    /// Its axial place ζ on the ring (m).
    pub shift: f64,
    /// Distance l of ball and groove centres that just touch (m).
    pub reach: f64,
    /// Radius r_g of the groove (m).
    pub radius: f64,
    /// The ring.
    pub side: RacewaySide,
}

impl Groove {
    /// Those of the inner and of the outer ring.
    pub fn of(bearing: &Bearing) -> [Self; 2] {
        let (shifts, reaches, radii) = (bearing.groove_shifts(), bearing.groove_offsets(), bearing.groove_radii());
        [RacewaySide::Inner, RacewaySide::Outer].map(|side| {
            let (i, bottom) = (side as usize, side.radius(bearing));
            let (centre_radius, beyond) = match side {
                RacewaySide::Inner => (bottom + radii[i], reaches[i] - bearing.radial_clearance),
                RacewaySide::Outer => (bottom - radii[i], -reaches[i]),
            };
            Self { centre_radius, beyond, shift: shifts[i], reach: reaches[i], radius: radii[i], side }
        })
    }

    /// Contact angle (rad) of a contact whose normal has these parts along e and a.
    pub fn angle<T: Scalar>(&self, meridian: [T; 2]) -> T {
        T::angle_of(meridian.map(|part| self.bottomwards(part)))
    }

    /// cos α of a contact whose normal has these parts along e and a; not above 0 where the ball is on the far side of
    /// the circle's centre.
    #[inline(always)]
    pub fn cosine<T: Number>(&self, [along_e, _]: [T; 2]) -> T {
        self.bottomwards(along_e)
    }

    /// Approach (m) of a ball from whose centre the circle of groove centres is this far away from the ring's axis and
    /// along it (m), and the direction n of the force on it.
    #[inline(always)]
    pub fn touch<T: Number>(&self, [outwards, along]: [T; 2]) -> (T, [T; 2]) {
        let length = (outwards * outwards + along * along).sqrt();
        let per_length = outwards.all(1.0) / length;
        let (near_side, reach) = (self.bottomwards(outwards), outwards.plain(self.reach));
        let approach = outwards.all(0.0).if_less(near_side, length - reach, near_side - reach);
        (approach, [outwards * per_length, along * per_length])
    }

    /// A part of what points at the circle's centre inside and away from it outside, counted from the groove's centre
    /// to the point where the ball touches.
    #[inline(always)]
    fn bottomwards<T: Number>(&self, part: T) -> T {
        match self.side {
            RacewaySide::Inner => part,
            RacewaySide::Outer => -part,
        }
    }

    /// Place η (m) across the groove of a contact at the angle α (rad): the arc from the groove's bottom, which grows
    /// with z, −r_gi α_i inside and r_go α_o outside.
    pub fn place_across<T: Scalar>(&self, angle: T) -> T {
        angle * T::Plain::from(-self.run())
    }

    /// How far that place goes as a ball at this `approach` (m) moves along t, ±r_g/d.
    pub fn run_across<T: Scalar>(&self, approach: T) -> T {
        T::from(self.run()) / (approach + T::Plain::from(self.reach))
    }

    /// r_g (m), counted as the place across grows along t: negative outside.
    fn run(&self) -> f64 {
        match self.side {
            RacewaySide::Inner => self.radius,
            RacewaySide::Outer => -self.radius,
        }
    }
}
