//! A bearing in space in static balance: where its inner ring stands under its load, and its tangent stiffness there.
//!
//! As in the plane the outer ring is held, nothing moves, neither gravity nor centrifugal force acts on the balls, and
//! supports are left out. With three degrees of freedom K = −∂F/∂x is 3 × 3; with five, forces and moments by x, y, z
//! and the tilts about x and y make it 5 × 5. It is symmetric up to the product of tilt and moment, as moments are
//! about axes that stand.

use super::{InBalance, StaticError, evenly_spaced, in_balance, surfaces_and_map};
use brinell::dynamics::parameters::{COORDINATES, Excitation, Layout, Model, Quadratic, WholeAngle};
use brinell::numerics::wrap;
use brinell::scene::{AxialSupport, DegreesOfFreedom, ElementInertia, Motion, Ring, Scene, TiltSupport};
use brinell::simulation::setup::{build_model, largest_force};
use std::f64::consts::TAU;

/// A ball in balance.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct LoadedBall {
    /// Its angle (rad), counter-clockwise from +x, in [−π, π].
    pub angle: f64,
    /// Forces of the inner and of the outer contact (N).
    pub forces: [f64; 2],
    /// Contact angles (rad); 0 of a contact without force.
    pub contact_angles: [f64; 2],
}

/// The balance at one cage angle.
#[derive(Debug, Clone, PartialEq)]
pub struct BalanceInSpace {
    /// Angle of element 1 (rad).
    pub cage_angle: f64,
    /// x, y, z (m) and tilt about x and y (rad) of the inner ring.
    pub position: [f64; COORDINATES],
    /// K (N/m, N/rad, N m/m, N m/rad); rows and columns of the tilt are 0 with three degrees of freedom.
    pub stiffness: [[f64; COORDINATES]; COORDINATES],
    /// All balls, from element 1.
    pub balls: Vec<LoadedBall>,
}

/// A bearing in space under static load, its outer ring held.
#[derive(Debug, Clone)]
pub struct BearingInSpace {
    model: Model,
    scene: Scene,
}

impl BearingInSpace {
    /// Sets up the bearing of a scene under the load on its shaft, preload of a spring and moments included.
    /// `profiles` are the texts of the files that its defects name; `map` the bytes of the contact map stored for it.
    ///
    /// # Errors
    /// Whatever is wrong with scene or profile; rings in their plane; a shaft without load.
    pub fn new<'p>(
        scene: &Scene,
        profiles: impl IntoIterator<Item = &'p str>,
        map: Option<&[u8]>,
    ) -> Result<Self, StaticError> {
        scene.check()?;
        let of = &scene.shaft;
        if of.load == [0.0; 2] && of.axial.load == 0.0 && of.axial.preload == 0.0 {
            return Err(StaticError::NoLoad { load: of.load });
        }
        let (surfaces, map) = surfaces_and_map(scene, profiles, map)?;
        let mut held = scene.clone();
        held.contact.largest_force = Some(largest_force(scene));
        (held.gravity, held.axial_gravity) = ([0.0; 2], 0.0);
        let (load, preload) = (of.axial.load, of.axial.preload);
        held.shaft = Ring {
            motion: Motion::Internal,
            load: of.load,
            mass: 1.0,
            axial: AxialSupport { load, preload, ..AxialSupport::NONE },
            tilt: TiltSupport { load_moment: of.tilt.load_moment, damping: 0.0, stiffness: 0.0, ..of.tilt },
            ..Ring::fixed()
        };
        if held.bearing.degrees_of_freedom == DegreesOfFreedom::Five && held.shaft.tilt.transverse_inertia <= 0.0 {
            held.shaft.tilt = TiltSupport { load_moment: of.tilt.load_moment, damping: 0.0, ..TiltSupport::ASSUMED };
        }
        held.housing = Ring::fixed();
        held.sensors.clear();
        held.bearing.element_inertia = ElementInertia::Full;
        Ok(Self { model: build_model(&held, &surfaces, map.as_ref())?, scene: held })
    }

    /// Rows of K: three or five.
    pub fn order(&self) -> usize {
        self.scene.bearing.degrees_of_freedom.count()
    }

    /// Cage angle with which everything repeats (rad).
    pub fn period(&self) -> f64 {
        if self.model.is_even() { TAU / self.model.element_count as f64 } else { TAU }
    }

    /// `count` balances at evenly spaced cage angles over the spacing of the balls, from `first` (rad) on, and at its
    /// end.
    ///
    /// # Errors
    /// No balance.
    pub fn sweep(&self, first: f64, count: usize) -> Result<Vec<BalanceInSpace>, StaticError> {
        evenly_spaced(first, self.period(), count).into_iter().map(|angle| self.balance(angle)).collect()
    }

    /// The balance with element 1 at `cage_angle` (rad).
    ///
    /// # Errors
    /// No balance.
    pub fn balance(&self, cage_angle: f64) -> Result<BalanceInSpace, StaticError> {
        let (model, shaft) = (&self.model, &self.scene.shaft);
        let spin = model.spin_with_cage(cage_angle - self.scene.cage.initial_angle);
        let frames = [self.scene.shaft_initial_angle, self.scene.housing_initial_angle, spin];
        let load = [shaft.loads().map(Quadratic::constant), Default::default()];
        let excitation = Excitation { load, ..Excitation::standing(cage_angle, frames) };
        let InBalance { cells, state, mut forces } = in_balance(model, &excitation)?;
        let found = model.stiffness_in_space(&excitation, (&cells, &state), &forces.contacts, &mut forces.shortcuts);
        let (Some(space), Some(mut stiffness), Some(start)) = (&model.space, found, model.layout.shaft) else {
            return Err(StaticError::InThePlane);
        };
        for (i, row) in stiffness.iter_mut().enumerate() {
            for (k, entry) in row.iter_mut().enumerate() {
                if i.max(k) >= self.order() {
                    *entry = 0.0;
                }
            }
        }
        let cage = WholeAngle::in_first_turn(cage_angle);
        let ball = |j: usize| LoadedBall {
            angle: wrap(model.element_angle(j, cage)),
            forces: [forces.contacts.inner[j], forces.contacts.outer[j]],
            contact_angles: [0, 1].map(|side| forces.contacts.contact_angle(space, j, side)),
        };
        let position = Layout::POSITIONS.map(|slot| state[start + slot]);
        Ok(BalanceInSpace { cage_angle, position, stiffness, balls: (0..model.element_count).map(ball).collect() })
    }
}
