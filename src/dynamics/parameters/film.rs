//! The oil films of a model: how much of the clearance they take, and what resists before contacts begin.
//!
//! Films follow the speed at which the rings turn against each other. They are worked out where a communication step
//! begins and stay as they are within it. Their thickness on both raceways is taken off the clearance, so that paths of
//! elements count from the film on the outer raceway; how it yields to the changing force, 0.35 % of a contact's own
//! compliance, is left out.

use crate::contact::law::SqueezeFilm;
use crate::geometry::film_thickness::{LubricatedContact, SPEED_EXPONENT, rolling_speed_ratio};
use crate::scene::{Remark, Scene};
use std::cell::Cell;

/// Force on the most loaded of Z elements over the whole load, times Z: Stribeck's 5.
const MOST_LOADED: f64 = crate::geometry::STRIBECK;

/// Share of the clearance that films may take without a remark.
const UNREMARKED: f64 = 0.5;

/// What is remarked upon films that take much of the clearance at the speed of the start.
pub fn remark(scene: &Scene) -> Option<Remark> {
    let films = Films::of(scene)?;
    films.begin(scene.shaft_speed - scene.housing_speed.unwrap_or(0.0));
    let (together, clearance) = (films.together(), scene.bearing.radial_clearance);
    let thick = clearance > 0.0 && together > UNREMARKED * clearance;
    thick.then_some(Remark::ThickFilms { together_um: together * 1e6, clearance_um: clearance * 1e6 })
}

/// The films of both raceways.
#[derive(Debug, Clone)]
pub struct Films {
    contacts: [LubricatedContact; 2],
    layer: Option<f64>,
    /// ū per speed of one ring against the other.
    ratio: f64,
    now: Cell<Now>,
}

/// Films at one speed.
#[derive(Debug, Clone, Copy)]
struct Now {
    /// Speed of the inner ring against the outer (rad/s).
    speed: f64,
    /// Thickness of both films together (m).
    together: f64,
    squeeze: [SqueezeFilm; 2],
}

impl Films {
    /// The films of a scene; `None` for dry contacts.
    pub fn of(scene: &Scene) -> Option<Self> {
        let film = scene.film.as_ref()?;
        let load = [scene.shaft.load, scene.housing.load].map(|[x, y]| (x * x + y * y).sqrt());
        let force = MOST_LOADED * load[0].max(load[1]) / scene.bearing.element_count as f64;
        let contacts = LubricatedContact::of(&scene.bearing, film, force);
        let now = Cell::new(Now::at(0.0, &contacts, film.layer, 0.0));
        Some(Self { contacts, layer: film.layer, ratio: rolling_speed_ratio(&scene.bearing), now })
    }

    /// Tells them how fast the inner ring turned against the outer (rad/s) where the communication step began.
    #[inline(always)]
    pub fn begin(&self, speed: f64) {
        if self.now.get().speed.to_bits() != speed.to_bits() {
            self.now.set(Now::at(speed, &self.contacts, self.layer, self.ratio * speed.abs()));
        }
    }

    /// Thickness of both films together (m).
    pub fn together(&self) -> f64 {
        self.now.get().together
    }

    /// Its change with the speed of the inner ring against the outer (m s/rad); 0 where nothing turns.
    pub fn together_by_speed(&self) -> f64 {
        let Now { speed, together, .. } = self.now.get();
        if speed == 0.0 { 0.0 } else { SPEED_EXPONENT * together / speed }
    }

    /// What resists on the inner and on the outer raceway.
    #[inline(always)]
    pub fn squeeze(&self) -> [SqueezeFilm; 2] {
        self.now.get().squeeze
    }
}

impl Now {
    fn at(speed: f64, contacts: &[LubricatedContact; 2], layer: Option<f64>, rolling: f64) -> Self {
        let thickness = contacts.map(|contact| contact.thickness(rolling));
        let squeeze = [0, 1].map(|side: usize| SqueezeFilm::new(contacts[side].squeeze, thickness[side], layer));
        Self { speed, together: thickness[0] + thickness[1], squeeze }
    }
}
