//! What is known of a communication step and of the rings.

use nalgebra::{Matrix3, Vector3};

/// A force, a place, a velocity along x, y, z.
pub(in crate::simulation) type Triple = Vector3<f64>;

/// A communication step that has been taken.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::simulation) struct Step {
    /// Its length (s); 0 for none.
    pub(in crate::simulation) length: f64,
    /// Place, velocity, acceleration and its rate at the start, of both rings, as the bearing has moved them.
    pub(in crate::simulation) motion: [[Triple; 4]; 2],
    /// Force (N) on both rings where the step before had brought them.
    pub(in crate::simulation) start: [Triple; 2],
    /// Its mean over the step.
    pub(in crate::simulation) mean: [Triple; 2],
    /// What had been foretold as the force to hold, and the force's rate at the start (N/s).
    pub(in crate::simulation) foretold: [Triple; 2],
    pub(in crate::simulation) rate: [Triple; 2],
    /// 1 if anybody had asked for that, and for the rate.
    pub(in crate::simulation) is_foretold: f64,
    pub(in crate::simulation) has_rate: f64,
    /// Force where the step has brought the rings.
    pub(in crate::simulation) end: [Triple; 2],
    /// Tangent stiffness −∂F/∂x of the inner ring there (N/m).
    pub(in crate::simulation) stiffness: Matrix3<f64>,
}

/// A ring as the error of its place goes on.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::simulation) struct Body {
    /// Whether the host moves it: then the rest is learned.
    pub(in crate::simulation) is_hosted: bool,
    /// kg; 0 for a ring that stands.
    pub(in crate::simulation) mass: f64,
    /// Stiffness (N/m) and damping (N s/m) to the ground.
    pub(in crate::simulation) stiffness: Triple,
    pub(in crate::simulation) damping: Triple,
}

impl Step {
    /// All its numbers.
    pub(super) fn numbers(&mut self) -> impl Iterator<Item = &mut f64> {
        let Self { length, motion, start, mean, foretold, rate, is_foretold, has_rate, end, stiffness } = self;
        let forces = [start, mean, foretold, rate, end].into_iter().flatten().flat_map(|force| force.iter_mut());
        let motion = motion.as_flattened_mut().iter_mut().flat_map(|of| of.iter_mut());
        [length, is_foretold, has_rate].into_iter().chain(motion).chain(forces).chain(stiffness.iter_mut())
    }
}
