//! The whole assembly of a scene at rest, linearised at one cage angle: bearing, rings on their supports, sensor.
//!
//! The cage stands still, so no centrifugal force acts on the elements. Loads, gravity on the elements, supports and
//! all damping are the scene's. A ring that a host moves, or that is fixed, holds still at its origin; a held shaft
//! with a load holds still where it carries that load, which is worked out in the plane only.
//!
//! In space balls move along the axis too, and rings along it and about x and y. The rotor stands as well: nothing of
//! its gyroscopic couple is in the modes.

use super::defect_edge_angles;
use super::defect_edge_angles::Edge;
use crate::statics::{InBalance, StaticError, in_balance, surfaces_and_map};
use brinell::dynamics::derivatives::Jacobian;
use brinell::dynamics::parameters::{COORDINATES, Cubic, Excitation, Layout, Model, Quadratic, WholeAngle};
use brinell::numerics::wrap;
use brinell::scene::{DegreesOfFreedom, Motion, Ring, Scene};
use brinell::simulation::setup::{build_model, largest_force};
use brinell::surface::with_roller_profile;
use std::f64::consts::TAU;

/// An assembly that stands still.
#[derive(Debug, Clone)]
pub struct Assembly {
    model: Model,
    /// The same with a shaft that moves under its load, where a held shaft has one: says where it is held.
    seat: Option<Model>,
    /// Loads on both rings along x, y and z (N), about x and y (N m).
    loads: [[f64; COORDINATES]; 2],
    /// Angles of cage, inner and outer ring at the start of the scene (rad).
    angles: [f64; 3],
    /// Of the first defect.
    defect: Option<DefectPosition>,
    edges: Vec<Edge>,
}

/// Where a defect is on its body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DefectPosition {
    /// Length along the body (rad).
    pub length: f64,
    /// Angle of the centre (rad).
    pub centre: f64,
}

/// What holds an element between the raceways.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Hold {
    /// Both raceways press on it.
    Pressed,
    /// It rests on one raceway under its own weight. Its contact is linear for motions of some nanometres only.
    Resting,
    /// No raceway presses on it: it has no natural frequency.
    Loose,
}

/// A degree of freedom of the assembly, and where its position and its velocity stand in the state.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Freedom {
    pub(crate) name: String,
    pub(crate) body: Body,
    /// Mass (kg), or moment of inertia (kg m²) of a tilt.
    pub(crate) mass: f64,
    pub(crate) position: usize,
    pub(super) velocity: usize,
}

/// What a degree of freedom belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Body {
    /// An element, by its number from 0.
    Element(usize),
    /// The inner ring.
    Shaft,
    /// The outer ring.
    Housing,
    /// The accelerometer.
    Sensor,
}

/// The assembly at rest at one cage angle, and ∂(state')/∂(state) there.
#[derive(Debug, Clone)]
pub(crate) struct AtRest {
    pub(crate) matrix: Vec<Vec<f64>>,
    /// Angle of each element (rad), counter-clockwise from +x, in [−π, π].
    pub(crate) angles: Vec<f64>,
    pub(crate) holds: Vec<Hold>,
    /// Whether the inner and the outer raceway press on each element.
    pub(crate) carried: Vec<[bool; 2]>,
}

/// Share of the largest contact force below which a force is the rounding of a position.
const CARRIES: f64 = 1e-15;
/// Share of its weight below which an element does not rest: where it goes from one raceway to the other, at the height
/// of the rings' centres, the frequency of its contact goes to 0.
const RESTS: f64 = 1e-3;

/// The scene with another amount of load (N): all its loads in proportion, that on the shaft, or else that on the
/// housing, becoming the amount; moments follow, preloads stay. A scene without load gets it on the shaft, downwards,
/// also where the shaft is held.
pub fn loaded(scene: &Scene, amount: f64) -> Scene {
    let mut scene = scene.clone();
    let length = |ring: &Ring| libm::hypot(libm::hypot(ring.load[0], ring.load[1]), ring.axial.load);
    let present = [&scene.shaft, &scene.housing].map(length).into_iter().find(|&load| load > 0.0);
    match present {
        Some(present) => {
            for ring in [&mut scene.shaft, &mut scene.housing] {
                let by = |load: f64| load * (amount / present);
                (ring.load, ring.axial.load) = (ring.load.map(by), by(ring.axial.load));
                ring.tilt.load_moment = ring.tilt.load_moment.map(by);
            }
        }
        None => scene.shaft.load = [0.0, -amount],
    }
    scene
}

impl Assembly {
    /// Sets up the assembly of a scene, with or without [`loaded`]. `profiles` are the texts of the files that its
    /// defects name, in the order of [`Scene::profile_names`]; `map` the bytes of the contact map stored for this
    /// scene, without which law `map` computes it.
    ///
    /// # Errors
    /// Whatever is wrong with scene or profile; a map that is damaged or belongs to something else.
    pub fn new<'p>(
        scene: &Scene,
        profiles: impl IntoIterator<Item = &'p str>,
        map: Option<&[u8]>,
    ) -> Result<Self, StaticError> {
        let in_space = scene.bearing.degrees_of_freedom != DegreesOfFreedom::Two;
        let profiles: Vec<&str> = profiles.into_iter().collect();
        let scene = &with_roller_profile(scene, profiles.iter().copied())?;
        let held = scene.shaft.motion != Motion::Internal;
        if held && in_space {
            return Err(StaticError::HeldInSpace { given: scene.bearing.degrees_of_freedom.count() });
        }
        let mut still = scene.clone();
        if held {
            still.shaft.load = [0.0; 2];
        }
        still.check()?;
        if held {
            // Prescribed, at the position that is found for it.
            still.shaft.motion = Motion::Host;
        }
        let (surfaces, map) = surfaces_and_map(scene, profiles, map)?;
        // The map is to reach as far as the scene's loads, that on a held shaft included.
        still.contact.largest_force = Some(largest_force(scene));
        let model = build_model(&still, &surfaces, map.as_ref())?;
        let seat = (held && scene.shaft.load != [0.0; 2]).then(|| {
            let mut seat = still.clone();
            (seat.shaft.motion, seat.shaft.mass) = (Motion::Internal, 1.0);
            (seat.shaft.stiffness, seat.shaft.damping) = (0.0, 0.0);
            build_model(&seat, &surfaces, map.as_ref())
        });
        let of_first = scene.defects.first().zip(surfaces.first()).map(|(defect, surface)| {
            let (first, last) = surface.extent();
            DefectPosition { length: (last - first) / defect.on.radius(&scene.bearing), centre: defect.angle }
        });
        Ok(Self {
            model,
            seat: seat.transpose()?,
            loads: [scene.shaft.loads(), scene.housing.loads()],
            angles: [scene.cage.initial_angle, scene.shaft_initial_angle, scene.housing_initial_angle],
            defect: of_first,
            edges: Edge::all(scene, &surfaces),
        })
    }

    /// Number of elements Z.
    pub fn element_count(&self) -> usize {
        self.model.element_count
    }

    /// Cage angle with which everything repeats (rad): the spacing of the elements, which are alike, their numbers
    /// exchanged; or a whole turn of a cage whose elements are unevenly spaced. A defect of a ring changes nothing in
    /// that, however long it is. A cage that jitters or wanders repeats with no angle; a turn is taken there as well.
    pub fn period(&self) -> f64 {
        if self.model.is_even() { TAU / self.model.element_count as f64 } else { TAU }
    }

    /// Loads on the inner and on the outer ring in the plane (N).
    pub fn loads(&self) -> [[f64; 2]; 2] {
        self.loads.map(|[x, y, ..]| [x, y])
    }

    /// Where the scene's first defect is; `None` without one.
    pub fn defect(&self) -> Option<DefectPosition> {
        self.defect
    }

    /// `count` evenly spaced cage angles from `first` (rad) on over one period, its end, and those at which a contact
    /// crosses an edge of a ring's defect, some across its length; ascending.
    pub(super) fn telling_angles(&self, first: f64, count: usize) -> Vec<f64> {
        defect_edge_angles::angles(&self.model, &self.edges, first, self.period(), count)
    }

    /// Angle of each element (rad), counter-clockwise from +x, in [−π, π], with the cage at rest at an angle (rad).
    pub(super) fn element_angles(&self, cage_angle: f64) -> Vec<f64> {
        let cage = WholeAngle::in_first_turn(cage_angle);
        (0..self.model.element_count).map(|j| wrap(self.model.element_angle(j, cage))).collect()
    }

    /// All degrees of freedom: every element, then rings and sensor as far as they move.
    pub(super) fn freedoms(&self) -> Vec<Freedom> {
        let Self { model, .. } = self;
        let layout = &model.layout;
        // An element in balance at every instant moves as the rings do.
        let elements = if model.elements_in_balance() { 0 } else { model.element_count };
        let of_elements = |name: &'static str, position: usize, velocity: usize| {
            (0..elements).map(move |j| Freedom {
                name: format!("element[{}].{name}", j + 1),
                body: Body::Element(j),
                mass: model.mass_of(j),
                position: position + j,
                velocity: velocity + j,
            })
        };
        let mut freedoms: Vec<Freedom> = of_elements("path", 0, layout.radial_velocity).collect();
        if let Some([v, w_z]) = layout.axial() {
            freedoms.extend(of_elements("axial", v, w_z));
        }
        let rings = [
            ("shaft", Body::Shaft, &model.shaft, layout.shaft),
            ("housing", Body::Housing, &model.housing, layout.housing),
        ];
        for (i, (name, body, ring, start)) in rings.into_iter().enumerate() {
            let Some(start) = start else { continue };
            for (k, coordinate) in ["x", "y", "z", "tilt.x", "tilt.y"].into_iter().enumerate() {
                let mass = match &model.space {
                    None if k < 2 => Some(ring.mass),
                    None => None,
                    Some(space) => space.inertia(COORDINATES * i + k),
                };
                let (position, velocity) = (start + Layout::POSITIONS[k], start + Layout::VELOCITIES[k]);
                let name = format!("{name}.{coordinate}");
                freedoms.extend(mass.map(|mass| Freedom { name, body, mass, position, velocity }));
            }
        }
        let sensors = &model.supports.sensors;
        for (k, (sensor, start)) in sensors.iter().zip(layout.sensor_indices()).enumerate() {
            let name = match (sensors.len(), sensor.direction.x == 0.0 && model.space.is_none()) {
                (1, true) => "sensor.y".to_owned(),
                (1, false) => "sensor".to_owned(),
                _ => format!("sensor[{}]", k + 1),
            };
            freedoms.push(Freedom {
                name,
                body: Body::Sensor,
                mass: 1.0 / sensor.support.inverse_mass,
                position: start,
                velocity: start + 1,
            });
        }
        freedoms
    }

    /// The static equilibrium with element 1 at `cage_angle` (rad), and the Jacobian there.
    ///
    /// # Errors
    /// No equilibrium.
    pub(crate) fn at_rest(&self, cage_angle: f64) -> Result<AtRest, StaticError> {
        let model = &self.model;
        let count = model.element_count;
        let frames = [self.angles[1], self.angles[2], model.spin_with_cage(cage_angle - self.angles[0])];
        let load = self.loads.map(|ring| ring.map(Quadratic::constant));
        let mut excitation = Excitation { load, ..Excitation::standing(cage_angle, frames) };
        if let Some(seat) = &self.seat {
            let state = in_balance(seat, &excitation)?.state;
            let position = seat.shaft_state(&excitation, 0.0, &state).position;
            for (motion, &x) in excitation.motion[0].iter_mut().zip(&position) {
                *motion = Cubic([x, 0.0, 0.0, 0.0]);
            }
        }
        let InBalance { cells, state, mut forces } = in_balance(model, &excitation)?;
        let mut jacobian = Jacobian::new(model);
        model.linearize(&excitation, 0.0, &cells, &state, &mut jacobian, &mut forces.shortcuts);
        let contacts = &forces.contacts;
        let largest = contacts.inner.iter().chain(&*contacts.outer).fold(0.0f64, |most, &force| most.max(force));
        let carried = |j: usize| {
            let weight = model.mass_of(j) * model.gravity.norm();
            let forces = [contacts.inner[j], contacts.outer[j]];
            let is_pressed = forces.iter().all(|&force| force > CARRIES * largest);
            forces.map(|force| force > CARRIES * largest && (is_pressed || force > RESTS * weight))
        };
        let carried: Vec<[bool; 2]> = (0..count).map(carried).collect();
        let hold = |carried: &[bool; 2]| match carried {
            [true, true] => Hold::Pressed,
            [false, false] => Hold::Loose,
            _ => Hold::Resting,
        };
        Ok(AtRest {
            matrix: jacobian.matrix(state.len()),
            angles: self.element_angles(cage_angle),
            holds: carried.iter().map(hold).collect(),
            carried,
        })
    }
}
