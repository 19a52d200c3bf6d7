//! One instant: how the state is laid out, what the host says, where elements are and what acts on them.

use crate::turning::Turns;

/// Time within a communication step, and what the host says for it.
#[derive(Debug, Clone, Copy)]
pub struct Outside {
    /// Angles of cage, shaft, housing and spin at the start of the step, their speeds and accelerations.
    pub turns: [[f64; 3]; 4],
    /// As in [`crate::case::Host::rings`].
    pub rings: [[[f64; 3]; 2]; 2],
}

/// Positions and velocities: rings x y vx vy each, sensor y vy, then u and u' of each element, then impulses of the
/// mean forces, then displacements and velocities of the sensor's modes.
pub const SENSOR: usize = 8;
pub const ELEMENTS: usize = 10;

/// One contact.
#[derive(Debug, Clone, Copy, Default)]
pub struct Contact {
    pub force: f64,
    pub approach: f64,
    /// ∂(force)/∂(rate of approach) (N s/m).
    pub by_rate: f64,
    pub pushes: bool,
    /// Whether oil is pressed out of it.
    pub squeezes: bool,
    /// Bound of ∂(force)/∂(approach) (N/m), except for the elastic part.
    pub steep: f64,
    /// Whose defect it is over: the ring's (0) or the element's.
    pub over: Option<usize>,
}

/// What acts at one instant.
#[derive(Debug, Clone, Default)]
pub struct Acting {
    /// Inner and outer contact of each element.
    pub contacts: Vec<[Contact; 2]>,
    /// The bearing's force on shaft and housing (N).
    pub rings: [[f64; 2]; 2],
    /// Their accelerations (m/s²).
    pub accelerations: [[f64; 2]; 2],
    pub sensor: f64,
    /// What the sensor shows of it through its modes.
    pub measured: f64,
    /// On the cage, and on the shaft by its defect (N m).
    pub torque: f64,
    pub shaft_torque: f64,
}

/// Where an element is, and how it moves, seen from both rings' centres.
pub struct Seat {
    /// Direction from the outer ring's centre, its cosine and sine, and the element's distance.
    pub angle: f64,
    pub e_r: [f64; 2],
    pub rho: f64,
    pub u: f64,
    pub u_rate: f64,
    /// From the inner ring's centre.
    pub q: [f64; 2],
    pub q_rate: [f64; 2],
}

impl Seat {
    /// Direction of the element from a ring's centre, and how fast that turns.
    pub fn turning(&self, side: usize, turns: &Turns) -> [f64; 2] {
        if side == 1 {
            return [self.angle, turns[0][1]];
        }
        let ([x, y], [vx, vy]) = (self.q, self.q_rate);
        [y.atan2(x), (x * vy - y * vx) / (x * x + y * y)]
    }
}
