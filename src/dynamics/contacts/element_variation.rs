//! A small change of what one element sees, of which its contacts' change to first order follows.

use crate::numerics::plane::Vector;

/// A small change of what one element sees.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::dynamics) struct ElementVariation {
    /// Of the outer ring's position less that of the inner.
    pub(in crate::dynamics) offset: Vector,
    /// Of the outer ring's velocity less that of the inner.
    pub(in crate::dynamics) drift: Vector,
    pub(in crate::dynamics) path: f64,
    pub(in crate::dynamics) path_rate: f64,
    pub(in crate::dynamics) cage_angle: f64,
    pub(in crate::dynamics) cage_speed: f64,
    /// Of the speed that oil films follow.
    pub(in crate::dynamics) film_speed: f64,
    /// Of angle and speed of the frames of defects, in the order of [`Frame`](crate::dynamics::parameters::Frame).
    pub(in crate::dynamics) frames: [[f64; 2]; 3],
}

impl ElementVariation {
    /// Of the path alone.
    pub(in crate::dynamics) fn of_path() -> Self {
        Self { path: 1.0, ..Self::default() }
    }

    /// Of u' alone.
    pub(in crate::dynamics) fn of_path_rate() -> Self {
        Self { path_rate: 1.0, ..Self::default() }
    }

    /// Of the rings' offset along one axis alone.
    pub(in crate::dynamics) fn of_offset(axis: usize) -> Self {
        let mut offset = Vector::zeros();
        offset[axis] = 1.0;
        Self { offset, ..Self::default() }
    }
}
