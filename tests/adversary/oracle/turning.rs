//! What turns evenly accelerated, and in which order a bearing's parts are counted that do.

/// Which of the turns a body follows.
pub const SHAFT: usize = 1;
pub const HOUSING: usize = 2;
pub const SPIN: usize = 3;

/// Angle, speed and acceleration of cage, shaft, housing and spin.
pub type Turns = [[f64; 3]; 4];

/// Value and first and second derivative at `t` of what has those of `c` at 0.
pub fn quadratic(c: [f64; 3], t: f64) -> [f64; 3] {
    [c[0] + t * (c[1] + 0.5 * t * c[2]), c[1] + t * c[2], c[2]]
}
