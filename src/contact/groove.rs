//! A ball in the groove of a ring that is shifted and tilted anyhow: where the two touch, and how they move there.
//!
//! The groove's cross-section is a circle, whose centres form a circle of radius C about the ring's axis, at the axial
//! place ζ of the ring. With the ball's centre q seen from the ring's and the ring's axis a = (φ_y, −φ_x, 1)/|…|,
//! ```text
//! h = q·a   q_⊥ = q − h a   g = |q_⊥|   e = q_⊥/g   t_φ = a × e
//! d = √((C − g)² + (ζ − h)²)   δ = d − l   n = [(C − g) e + (ζ − h) a]/d   t = [(C − g) a − (ζ − h) e]/d
//! v = q̇ − (a × ȧ) × q          δ̇ = −n·v
//! ```
//! l is the distance of ball and groove centres where they just touch, r_g − r. This is exact for any displacement and
//! tilt: the nearest point of a circle. The force of the contact on the ball is along +n on both raceways, as inside
//! g < C and outside g > C; t is the direction across the groove, t_φ that around it. The contact angle is the one of
//! −n outside and of n inside, from e towards a. What is lost to rounding is that of distances of some 20 mm, 4e-18 m.
//!
//! The groove is taken as a circle up to 90°: where it ends, at the shoulder, nothing here knows. The other half of the
//! circle, on the far side of its centre, is no steel. A ball with cos α ≤ 0 touches nothing: with c = ±(C − g),
//! positive inside for g < C and outside for g > C, its approach is c − l < 0.

use crate::contact::rolling::RacewaySide;
use crate::numerics::number::{Number, Scalar};
use crate::scene::Bearing;

/// A vector by its parts along three axes at right angles, the third of which is the bearing's.
pub type Spatial<T> = [T; 3];

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

/// Direction of a ring's axis, and the velocity with which it turns (rad/s).
#[derive(Debug, Clone, Copy)]
pub struct Axis<T> {
    /// a
    pub direction: Spatial<T>,
    /// a × ȧ (rad/s)
    pub turning: Spatial<T>,
}

/// Where a ball meets a groove.
#[derive(Debug, Clone, Copy)]
pub struct GrooveContact<T> {
    /// Approach δ to the smooth groove (m).
    pub approach: T,
    /// Direction n of the contact's force on the ball.
    pub normal: Spatial<T>,
    /// Direction t across the groove.
    pub across: Spatial<T>,
    /// Direction t_φ around it.
    pub around: Spatial<T>,
    /// Direction e from the ring's axis to the ball.
    pub outwards: Spatial<T>,
    /// Distance g of the ball from the ring's axis (m).
    pub distance: T,
    /// Parts of n along e and a.
    pub meridian: [T; 2],
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

impl<T: Number> Axis<T> {
    /// Of a ring that is tilted (rad) about the first two axes, and tilts further (rad/s).
    #[inline(always)]
    pub fn tilted([x, y]: [T; 2], [rate_x, rate_y]: [T; 2]) -> Self {
        let square = x * x + y * y + x.plain(1.0);
        let per_length = x.all(1.0) / square.sqrt();
        Self {
            direction: [y * per_length, -x * per_length, per_length],
            turning: [rate_x / square, rate_y / square, (x * rate_y - y * rate_x) / square],
        }
    }

    /// Part h of q along the axis, distance g from it (m), and direction e in which q is away from it.
    #[inline(always)]
    fn split(&self, q: Spatial<T>) -> (T, T, Spatial<T>) {
        let height = dot(q, self.direction);
        let radial = minus(q, times(self.direction, height));
        let distance = dot(radial, radial).sqrt();
        (height, distance, times(radial, q[0].all(1.0) / distance))
    }

    /// n_e e + n_a a
    #[inline(always)]
    fn in_meridian(&self, e: Spatial<T>, [n_e, n_a]: [T; 2]) -> Spatial<T> {
        plus(times(e, n_e), times(self.direction, n_a))
    }

    /// Velocity (m/s) against the ring of what is at q and moves at `rate` (m/s).
    #[inline(always)]
    pub fn velocity(&self, q: Spatial<T>, rate: Spatial<T>) -> Spatial<T> {
        minus(rate, cross(self.turning, q))
    }

    /// The same by axes of which the first two are turned by `turned`.
    #[inline(always)]
    pub fn seen(&self, turned: impl Fn(T, T) -> [T; 2]) -> Self {
        let ([a_x, a_y, a_z], [t_x, t_y, t_z]) = (self.direction, self.turning);
        let ([a_x, a_y], [t_x, t_y]) = (turned(a_x, a_y), turned(t_x, t_y));
        Self { direction: [a_x, a_y, a_z], turning: [t_x, t_y, t_z] }
    }
}

impl<T: Number> GrooveContact<T> {
    /// Of a ball whose centre is at `q` (m) from the ring's, whose axis is `axis`.
    #[inline(always)]
    pub fn of(groove: &Groove, q: Spatial<T>, axis: &Axis<T>) -> Self {
        let (constant, (height, distance, outwards)) = (|value: f64| q[0].all(value), axis.split(q));
        let (in_radius, along) = (constant(groove.centre_radius) - distance, constant(groove.shift) - height);
        let (approach, [n_e, n_a]) = groove.touch([in_radius, along]);
        Self {
            approach,
            normal: axis.in_meridian(outwards, [n_e, n_a]),
            across: axis.in_meridian(outwards, [-n_a, n_e]),
            around: cross(axis.direction, outwards),
            outwards,
            distance,
            meridian: [n_e, n_a],
        }
    }

    /// Rate δ̇ (m/s) at which the ball moves into the smooth groove with this velocity.
    #[inline(always)]
    pub fn closing(&self, velocity: Spatial<T>) -> T {
        -dot(self.normal, velocity)
    }

    /// Rate (rad/s) at which it goes around the ring with this velocity.
    #[inline(always)]
    pub fn turning(&self, velocity: Spatial<T>) -> T {
        dot(self.around, velocity) / self.distance
    }

    /// Force on the ball (N) of a contact that exerts `force` (N) along the normal, its `magnitude` damped across the
    /// groove with `damping` χ_a (s/m): F_t = −χ_a Q (t·v) t.
    #[inline(always)]
    pub fn force(&self, force: T, magnitude: T, damping: T::Plain, velocity: Spatial<T>) -> Spatial<T> {
        let creep = magnitude * dot(self.across, velocity) * damping;
        minus(times(self.normal, force), times(self.across, creep))
    }
}

/// a·b
#[inline(always)]
pub fn dot<T: Number>(a: Spatial<T>, b: Spatial<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b
#[inline(always)]
pub fn cross<T: Number>(a: Spatial<T>, b: Spatial<T>) -> Spatial<T> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a + b
#[inline(always)]
pub fn plus<T: Number>(a: Spatial<T>, b: Spatial<T>) -> Spatial<T> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
fn minus<T: Number>(a: Spatial<T>, b: Spatial<T>) -> Spatial<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a times a number.
#[inline(always)]
pub fn times<T: Number>(a: Spatial<T>, by: T) -> Spatial<T> {
    [a[0] * by, a[1] * by, a[2] * by]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::number::Dual;
    use proptest::prelude::*;

    /// Grooves of an angular contact bearing with 25° (12 balls of 7.938 on 38.5 mm).
    fn grooves() -> [Groove; 2] {
        let mut bearing = Bearing::steel_balls(12, 7.938e-3, 38.5e-3);
        (bearing.conformity_inner, bearing.conformity_outer) = (0.515, 0.525);
        bearing.set_contact_angle(25f64.to_radians());
        Groove::of(&bearing)
    }

    fn upright() -> Axis<f64> {
        Axis::tilted([0.0; 2], [0.0; 2])
    }

    #[test]
    fn a_bearing_just_closed_touches_without_force_at_its_free_contact_angle() {
        for groove in grooves() {
            // Its balls' centres are in z = 0 on the pitch circle except for half of (f_i − f_o) D (1 − cos α°).
            let free = 25f64.to_radians();
            let radius = match groove.side {
                RacewaySide::Inner => groove.centre_radius - groove.reach * free.cos(),
                RacewaySide::Outer => groove.centre_radius + groove.reach * free.cos(),
            };
            let found = GrooveContact::of(&groove, [0.0, radius, 0.0], &upright());
            // Rounding of distances of 20 mm.
            assert!(found.approach.abs() < 1e-17, "{:e}", found.approach);
            assert!((groove.angle(found.meridian) - free).abs() < 1e-13);
        }
    }

    proptest! {
        #[test]
        fn a_ring_turned_with_all_around_it_changes_nothing(
            q in prop::array::uniform3(-1e-4..1e-4f64), tilt in prop::array::uniform2(-0.05..0.05f64),
        ) {
            // The ball where it would be, seen by the tilted ring: R q with R ẑ = a.
            let axis = Axis::tilted(tilt, [0.0; 2]);
            let a = axis.direction;
            let rotated = |v: [f64; 3]| {
                // Rodrigues about ẑ × a.
                let k = [-a[1], a[0], 0.0];
                let once = cross(k, v);
                let twice = cross(k, once);
                std::array::from_fn::<f64, 3, _>(|i| v[i] + once[i] + twice[i] / (1.0 + a[2]))
            };
            for groove in grooves() {
                let at = [0.012 + q[0], 0.0145 + q[1], q[2]];
                let still = GrooveContact::of(&groove, at, &upright());
                let found = GrooveContact::of(&groove, rotated(at), &axis);
                prop_assert!((found.approach - still.approach).abs() < 2e-17);
                for (one, other) in found.normal.iter().zip(rotated(still.normal)) {
                    // Rounding of 20 mm over the 120 µm of d.
                    prop_assert!((one - other).abs() < 1e-12);
                }
            }
        }

        #[test]
        fn the_approach_changes_as_the_ball_closes(
            q in prop::array::uniform3(-1e-4..1e-4f64), tilt in prop::array::uniform2(-0.05..0.05f64),
            rate in prop::array::uniform3(-1.0..1.0f64), tilt_rate in prop::array::uniform2(-1.0..1.0f64),
        ) {
            type Changing = Dual<f64, 1>;
            let changing = |value: f64, by: f64| Changing { value, by: [by] };
            for groove in grooves() {
                let at = [0.012 + q[0], 0.0145 + q[1], q[2]];
                let axis = Axis::tilted(tilt, tilt_rate);
                let contact = GrooveContact::of(&groove, at, &axis);
                let velocity = axis.velocity(at, rate);
                let moved: [Changing; 3] = std::array::from_fn(|i| changing(at[i], rate[i]));
                let tilted: [Changing; 2] = std::array::from_fn(|i| changing(tilt[i], tilt_rate[i]));
                let found = GrooveContact::of(&groove, moved, &Axis::tilted(tilted, [Changing::constant(0.0); 2]));
                // On the far side of the circle's centre nothing touches, and no force asks for the rate.
                let touches = groove.cosine(contact.meridian) > 0.0;
                prop_assert!(!touches || (found.approach.by[0] - contact.closing(velocity)).abs() < 1e-12);
            }
        }
    }
}
