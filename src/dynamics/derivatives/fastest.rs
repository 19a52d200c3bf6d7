//! The fastest of what moves, by which explicit steps are chosen, and where bodies are in a state.

/// Indices of a body's position and velocity along one axis in the state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BodyIndices {
    /// Of the position.
    pub position: usize,
    /// Of the velocity.
    pub velocity: usize,
}

/// What moves fastest.
#[derive(Debug, Clone, Copy, Default)]
pub struct Fastest {
    /// Magnitude of its eigenvalue (1/s).
    pub eigenvalue: f64,
    /// Its damping ratio, 0 to 1.
    pub damping: f64,
}

impl Fastest {
    /// Takes a motion into account that accelerates by its position (1/s²) and its velocity (1/s).
    pub(super) fn consider(&mut self, by_position: f64, by_velocity: f64) {
        // λ² = by_velocity λ + by_position
        let half = 0.5 * by_velocity;
        let square = half * half + by_position;
        // Two real eigenvalues, or a pair of magnitude √(−by_position).
        let (root, damping) = if square >= 0.0 {
            (half.abs() + square.sqrt(), 1.0)
        } else {
            ((-by_position).sqrt(), -half / (-by_position).sqrt())
        };
        if root > self.eigenvalue {
            *self = Self { eigenvalue: root, damping: damping.clamp(0.0, 1.0) };
        }
    }
}
