//! A bearing in static balance: load distribution and tangent stiffness at one cage angle, the outer ring held.
//!
//! The inner ring takes a given load; rings translate, nothing moves, and neither gravity nor centrifugal force acts on
//! the elements, so that what comes out belongs to the bearing and its load alone. Supports of the rings are left out
//! for the same reason. Elements are in balance between the rings and answer when the inner ring is displaced:
//! ```text
//! K = −dF/dx,   F the elements' force on the inner ring at the position x          (2 × 2, symmetric)
//! along the load e:   held  e·K e          transverse position held
//!                     free  1/(e·K⁻¹ e)    no transverse force
//! ```
//! Both agree where the loaded elements lie symmetrically about the load. K is a tangent: it belongs to small changes
//! of load, and jumps where an element begins to carry.
//!
//! The load zone is the arc of smooth raceway on which the displaced inner ring squeezes: |ψ| < ψ_l from the direction
//! of its displacement, cos ψ_l = G_r/|x|. It says where a healthy bearing's elements carry, with any number of them.

use super::study::{InBalance, StaticError, in_balance, surfaces_and_map};
use brinell::contact::map::ContactMaps;
use brinell::dynamics::parameters::{Excitation, Model, Quadratic, WholeAngle};
use brinell::numerics::wrap;
use brinell::scene::{DefectOn, DegreesOfFreedom, ElementInertia, Motion, Ring, Scene};
use brinell::simulation::setup::{build_model, largest_force};
use brinell::surface::{Surface, with_roller_profile};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Refuses rings that move along the axis or tilt.
fn in_the_plane(scene: &Scene) -> Result<(), StaticError> {
    match scene.bearing.degrees_of_freedom {
        DegreesOfFreedom::Two => Ok(()),
        more => Err(StaticError::InSpace { given: more.count() }),
    }
}

/// A bearing under static load, its outer ring held.
#[derive(Debug, Clone)]
pub struct StaticBearing {
    pub(crate) model: Model,
    /// The scene without what does not act here.
    scene: Scene,
    /// Of its defects, in their order.
    surfaces: Vec<Surface>,
    load: [f64; 2],
}

/// One element in balance.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LoadedElement {
    /// Its angle (rad), counter-clockwise from +x, in [−π, π].
    pub angle: f64,
    /// Its path u (m).
    pub path: f64,
    /// Force of the inner contact (N).
    pub inner_force: f64,
    /// Force of the outer contact (N).
    pub outer_force: f64,
    /// Approach of the inner contact (m); of an element without load, minus its gap.
    pub inner_approach: f64,
    /// Whether its centre is within the length of the defect.
    pub in_defect: bool,
}

/// The balance at one cage angle.
#[derive(Debug, Clone, PartialEq)]
pub struct Balance {
    /// Angle of element 1 (rad).
    pub cage_angle: f64,
    /// Load on the inner ring (N).
    pub load: [f64; 2],
    /// Position of the inner ring (m).
    pub displacement: [f64; 2],
    /// K (N/m).
    pub stiffness: [[f64; 2]; 2],
    /// Half-angle of the load zone ψ_l (rad).
    pub load_zone: f64,
    /// All elements, from element 1.
    pub elements: Vec<LoadedElement>,
}

impl StaticBearing {
    /// Sets up the bearing of a scene. `profiles` are the texts of the files that its defects name, in the order of
    /// [`Scene::profile_names`].
    ///
    /// ```
    /// use brinell::scene::{Bearing, Scene};
    /// use brinell_analysis::statics::StaticBearing;
    ///
    /// let load = [0.0, -1500.0];
    /// let scene = Scene::builder(Bearing::steel_balls(9, 7.94e-3, 39.04e-3)).shaft_load(load).build()?;
    /// // With an element right under the load it carries some 5 F/Z (Stribeck).
    /// let balance = StaticBearing::new(&scene, None)?.balance(-std::f64::consts::FRAC_PI_2, load)?;
    /// assert!((balance.elements[0].outer_force / (5.0 * 1500.0 / 9.0) - 1.0).abs() < 0.1);
    /// assert!(balance.stiffness[1][1] > 1e7);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Whatever is wrong with scene or profile, or a contact law that this defect cannot have.
    pub fn new<'p>(scene: &Scene, profiles: impl IntoIterator<Item = &'p str>) -> Result<Self, StaticError> {
        Self::with_map(scene, profiles, None)
    }

    /// As [`new`](Self::new), with the bytes of the contact map that was stored for the scene. Without it, law `map`
    /// computes the map on one core.
    ///
    /// # Errors
    /// Those of `new`; a map that is damaged or belongs to something else.
    pub fn with_map<'p>(
        scene: &Scene,
        profiles: impl IntoIterator<Item = &'p str>,
        map: Option<&[u8]>,
    ) -> Result<Self, StaticError> {
        scene.check()?;
        in_the_plane(scene)?;
        let profiles: Vec<&str> = profiles.into_iter().collect();
        let scene = &with_roller_profile(scene, profiles.iter().copied())?;
        let (surfaces, map) = surfaces_and_map(scene, profiles, map)?;
        let load = load_on_bearing(scene);
        let still = Ring::fixed();
        let mut held = scene.clone();
        // The load goes another way; the map is to reach as far as the scene's.
        held.contact.largest_force = Some(largest_force(scene));
        held.gravity = [0.0; 2];
        held.shaft = Ring { motion: Motion::Internal, mass: 1.0, ..still };
        held.housing = still;
        held.sensors.clear();
        // At rest elements are in balance whether they have inertia or not.
        held.bearing.element_inertia = ElementInertia::Full;
        Ok(Self { load, ..Self::with_surfaces(held, surfaces, map.as_ref())? })
    }

    fn with_surfaces(
        scene: Scene,
        surfaces: Vec<Surface>,
        map: Option<&Arc<ContactMaps>>,
    ) -> Result<Self, StaticError> {
        let model = build_model(&scene, &surfaces, map)?;
        Ok(Self { model, surfaces, scene, load: [0.0; 2] })
    }

    /// The scene's load on the bearing (N): that on the inner ring, or, where there is none, against that on the outer.
    pub fn load(&self) -> [f64; 2] {
        self.load
    }

    /// Number of elements Z.
    pub fn element_count(&self) -> usize {
        self.model.element_count
    }

    /// The spacing of the elements in an even cage (rad).
    pub fn spacing(&self) -> f64 {
        TAU / self.model.element_count as f64
    }

    /// Cage angle with which everything repeats (rad): the spacing of the elements, which are alike, or a whole turn of
    /// an irregular cage.
    pub fn period(&self) -> f64 {
        if self.model.is_even() { self.spacing() } else { TAU }
    }

    /// The same bearing with the inner ring at another angle (rad).
    pub fn with_shaft_angle(&self, angle: f64) -> Self {
        let mut other = self.clone();
        other.scene.shaft_initial_angle = angle;
        other
    }

    /// How far (m) element `j` (from 0) goes down in the defects of the rings before it touches both, with element 1 at
    /// `cage_angle` (rad).
    pub(crate) fn sunk(&self, j: usize, cage_angle: f64) -> f64 {
        let inside = self.model.resting_opening(j, cage_angle, self.scene.shaft_initial_angle);
        self.model.resting_path(j, cage_angle) + inside
    }

    /// The balance with element 1 at `cage_angle` (rad) under `load` (N) on the inner ring.
    ///
    /// # Errors
    /// A load that is 0 or not finite; no equilibrium found.
    pub fn balance(&self, cage_angle: f64, load: [f64; 2]) -> Result<Balance, StaticError> {
        if !(load.iter().all(|f| f.is_finite()) && load != [0.0; 2]) {
            return Err(StaticError::NoLoad { load });
        }
        let model = &self.model;
        let spin = model.spin_with_cage(cage_angle - self.scene.cage.initial_angle);
        let frames = [self.scene.shaft_initial_angle, self.scene.housing_initial_angle, spin];
        let [x, y] = load;
        let on_shaft = [x, y, 0.0, 0.0, 0.0].map(Quadratic::constant);
        let excitation =
            Excitation { load: [on_shaft, Default::default()], ..Excitation::standing(cage_angle, frames) };
        let InBalance { cells, state, mut forces } = in_balance(model, &excitation)?;
        let displacement = model.shaft_state(&excitation, 0.0, &state).position;
        let paths = &state[..model.element_count];
        let jacobian =
            model.ring_jacobian(paths, &cells, &model.kinematics(&excitation, 0.0, &state), &mut forces.shortcuts);
        let cage = WholeAngle::in_first_turn(cage_angle);
        let elements = (0..model.element_count).map(|j| LoadedElement {
            angle: wrap(model.element_angle(j, cage)),
            path: paths[j],
            inner_force: forces.contacts.inner[j],
            outer_force: forces.contacts.outer[j],
            inner_approach: forces.contacts.inner_approach[j],
            in_defect: self.is_in_defect(model.element_angle(j, cage)),
        });
        Ok(Balance {
            cage_angle,
            load,
            displacement: displacement.into(),
            stiffness: [0, 1].map(|a| [0, 1].map(|b| -jacobian[(a, b)])),
            load_zone: load_zone(model.radial_clearance, displacement.into()),
            elements: elements.collect(),
        })
    }

    /// The same bearing under another load on the inner ring (N).
    pub fn with_load(&self, load: [f64; 2]) -> Self {
        Self { load, ..self.clone() }
    }

    /// The same bearing with another radial clearance (m); the raceways' radii, and with them the Hertz constants,
    /// stay: they would change by as little as the clearance is against them.
    pub fn with_clearance(&self, clearance: f64) -> Self {
        let mut other = self.clone();
        other.model.radial_clearance = clearance;
        other
    }

    /// The same bearing with another compliance in series with each outer contact (m/N).
    pub fn with_outer_compliance(&self, compliance: f64) -> Self {
        let mut other = self.clone();
        other.model.set_outer_compliance(compliance);
        other
    }

    /// The same bearing with every depth of its defects multiplied by a factor.
    ///
    /// # Errors
    /// No defect; a defect that becomes deeper than an element's radius.
    pub fn with_depth_times(&self, factor: f64) -> Result<Self, StaticError> {
        if self.surfaces.is_empty() {
            return Err(StaticError::NoDefect);
        }
        let scaled = self.surfaces.iter().zip(&self.scene.defects);
        let scaled = scaled.map(|(surface, defect)| surface.scaled(factor, defect.on, &self.scene.bearing));
        let mut other = Self::with_surfaces(self.scene.clone(), scaled.collect::<Result<_, _>>()?, None)?;
        other.load = self.load;
        Ok(other.with_clearance(self.model.radial_clearance).with_outer_compliance(self.model.outer.contact.compliance))
    }

    /// The defects of a ring: first and last angle (rad) from the centre of each, and the angle of its centre against
    /// the axes while the ring is at its angle of the start.
    pub(crate) fn extents(&self, on: DefectOn) -> impl Iterator<Item = ([f64; 2], f64)> {
        let turned = match on {
            DefectOn::Inner => self.scene.shaft_initial_angle,
            _ => self.scene.housing_initial_angle,
        };
        let radius = on.radius(&self.scene.bearing);
        let borne = self.scene.defects.iter().zip(&self.surfaces).filter(move |(defect, _)| defect.on == on);
        borne.map(move |(defect, surface)| {
            let (first, last) = surface.extent();
            ([first / radius, last / radius], defect.angle + turned)
        })
    }

    /// Length of the first defect along its body (rad); `None` without one.
    pub fn defect_length(&self) -> Option<f64> {
        let (defect, surface) = self.scene.defects.first().zip(self.surfaces.first())?;
        let (first, last) = surface.extent();
        Some((last - first) / defect.on.radius(&self.scene.bearing))
    }

    /// Whether an element in this direction is within the length of a ring's defect.
    fn is_in_defect(&self, direction: f64) -> bool {
        let within = |([first, last], centre): ([f64; 2], f64)| {
            let angle = wrap(direction - centre);
            angle >= first && angle <= last
        };
        [DefectOn::Outer, DefectOn::Inner].into_iter().any(|on| self.extents(on).any(within))
    }
}

impl Balance {
    /// Unit vector along the load.
    pub fn load_direction(&self) -> [f64; 2] {
        let [x, y] = self.load;
        let length = (x * x + y * y).sqrt();
        [x / length, y / length]
    }

    /// Stiffness along the load with the transverse position held, e·K e (N/m).
    pub fn held_stiffness(&self) -> f64 {
        let [x, y] = self.load_direction();
        let [[xx, xy], [yx, yy]] = self.stiffness;
        x * (xx * x + xy * y) + y * (yx * x + yy * y)
    }

    /// Stiffness along the load without transverse force, 1/(e·K⁻¹ e) (N/m); 0 where nothing holds the ring sideways.
    pub fn free_stiffness(&self) -> f64 {
        let [x, y] = self.load_direction();
        let [[xx, xy], [yx, yy]] = self.stiffness;
        // e·adj(K) e is the transverse stiffness.
        let transverse = x * (yy * x - xy * y) + y * (xx * y - yx * x);
        if transverse > 0.0 { (xx * yy - xy * yx) / transverse } else { 0.0 }
    }

    /// Numbers of the elements that carry load, from 0.
    pub fn loaded(&self) -> impl Iterator<Item = usize> {
        self.elements.iter().enumerate().filter(|(_, element)| element.inner_force > 0.0).map(|(j, _)| j)
    }
}

fn load_on_bearing(scene: &Scene) -> [f64; 2] {
    if scene.shaft.load != [0.0; 2] { scene.shaft.load } else { scene.housing.load.map(|f| 0.0 - f) }
}

fn load_zone(clearance: f64, displacement: [f64; 2]) -> f64 {
    let [x, y] = displacement;
    let length = (x * x + y * y).sqrt();
    if length <= clearance.abs() {
        return if clearance > 0.0 { 0.0 } else { PI };
    }
    libm::acos(clearance / length)
}
