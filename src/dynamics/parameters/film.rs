//! The oil films of a model: how much of the clearance they take, and what resists before contacts begin.
//!
//! Films follow the speed at which the rings turn against each other at the same instant. Their thickness on both
//! raceways is taken off the clearance, so that paths of elements count from the film on the outer raceway; how it
//! yields to the changing force, 0.35 % of a contact's own compliance, is left out.
//!
//! A thickness h that changes enters positions and no rate. With the approach Δ and the gap g = h − Δ between the
//! surfaces, g' = h' − Δ': what a closing gap resists with follows −g', the rate of the surfaces, of which h' is no
//! part. To the contact's own damper h' would add χ h' of its force: 3e-7 of it where h grows by 0.3 µm in half a
//! second, which is left out.

use crate::contact::law::SqueezeFilm;
use crate::geometry::film_thickness::{LubricatedContact, SPEED_EXPONENT, rolling_speed_ratio, speed_factor};
use crate::numerics::number::Scalar;
use crate::scene::{Remark, Scene};

/// Force on the most loaded of Z elements over the whole load, times Z: Stribeck's 5.
const MOST_LOADED: f64 = crate::geometry::STRIBECK;

/// Share of the clearance that films may take without a remark.
const UNREMARKED: f64 = 0.5;

/// What is remarked upon films that take much of the clearance at the speed of the start.
pub fn remark(scene: &Scene) -> Option<Remark> {
    let films = Films::of(scene)?.at(scene.shaft_speed - scene.housing_speed.unwrap_or(0.0));
    let (together, clearance) = (films.together(), scene.bearing.radial_clearance);
    let thick = clearance > 0.0 && together > UNREMARKED * clearance;
    thick.then_some(Remark::ThickFilms { together_um: together * 1e6, clearance_um: clearance * 1e6 })
}

/// The films of both raceways.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Films {
    contacts: [LubricatedContact; 2],
    layer: Option<f64>,
    /// ū per speed of one ring against the other.
    ratio: f64,
}

/// The films of both raceways as contacts see them.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct OilFilms<T> {
    /// What resists on the inner and on the outer raceway.
    pub(in crate::dynamics) squeeze: [SqueezeFilm<T>; 2],
    /// What both take of the clearance (m).
    pub(in crate::dynamics) together: T,
}

/// The films of the inner and of the outer raceway at one speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmsNow {
    /// What they are the films of.
    of: Films,
    /// What resists.
    pub squeeze: [SqueezeFilm; 2],
    /// Thickness (m), which is 0 where nothing turns.
    thickness: [f64; 2],
    /// Speed of the inner ring against the outer (rad/s).
    speed: f64,
}

impl Films {
    /// The films of a scene; `None` for dry contacts.
    pub fn of(scene: &Scene) -> Option<Self> {
        let film = scene.film.as_ref()?;
        let load = [scene.shaft.load, scene.housing.load].map(|[x, y]| (x * x + y * y).sqrt());
        let force = MOST_LOADED * load[0].max(load[1]) / scene.bearing.element_count as f64;
        let contacts = LubricatedContact::of(&scene.bearing, film, force);
        Some(Self { contacts, layer: film.layer, ratio: rolling_speed_ratio(&scene.bearing) })
    }

    /// Those while the inner ring turns at this speed against the outer (rad/s).
    #[inline(always)]
    pub fn at(&self, speed: f64) -> FilmsNow {
        let grown = speed_factor(self.ratio * speed.abs());
        let thickness = [0, 1].map(|side: usize| self.contacts[side].thickness(grown));
        FilmsNow {
            of: *self,
            squeeze: [0, 1].map(|side| SqueezeFilm::new(self.contacts[side].squeeze, thickness[side], self.layer)),
            thickness,
            speed,
        }
    }

    /// Makes `now` the films at this speed. What is that already stays: the power in it costs as much as some elements.
    #[inline(always)]
    pub(in crate::dynamics) fn renew(&self, now: &mut Option<FilmsNow>, speed: f64) {
        if now.is_none_or(|now| now.of != *self || now.speed.to_bits() != speed.to_bits()) {
            *now = Some(self.at(speed));
        }
    }
}

impl FilmsNow {
    /// Speed of the inner ring against the outer that they follow (rad/s).
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Thickness of both films together (m).
    #[inline(always)]
    pub fn together(&self) -> f64 {
        self.thickness[0] + self.thickness[1]
    }

    /// These films with the derivatives of the speed that they follow, whose value is theirs (rad/s): what resists on
    /// either raceway, and the thickness of both together (m). Where nothing turns they have none.
    pub(in crate::dynamics) fn following<T: Scalar>(&self, speed: T) -> OilFilms<T> {
        let change = speed - T::from(self.speed);
        let [inner, outer] = self.thickness.map(|thickness| {
            // h grows with the power of the speed; its slope is a number however small both are.
            let slope = if self.speed == 0.0 { 0.0 } else { SPEED_EXPONENT * (thickness / self.speed) };
            change * T::Plain::from(slope) + T::from(thickness)
        });
        let [on_inner, on_outer] = self.squeeze;
        OilFilms { squeeze: [on_inner.of_thickness(inner), on_outer.of_thickness(outer)], together: inner + outer }
    }
}
