//! The path of a rigid ball's centre across a line spall with sharp edges, on a track that lies at a contact angle.
//!
//! Along the track the raceway has the radius R_n = R_c/cos α_n (Meusnier), and an arc s = R_c ψ on it is the angle
//! ψ cos α_n about that radius' centre. There a ball that leans on an edge at an angle d has its centre at
//! R cos d ∓ √(r² − R² sin² d) from the centre, inside a hollow or outside a shaft.

use std::f64::consts::{PI, TAU};

/// A spall of one ring.
#[derive(Debug, Clone, Copy)]
pub(super) struct Path {
    /// Where its middle is in its ring (rad).
    pub(super) centre: f64,
    /// Half of its length as an angle about the bearing's axis.
    half: f64,
    depth: f64,
    cosine: f64,
    /// Along rolling.
    radius: f64,
    ball: f64,
    /// Whether the raceway is hollow.
    hollow: bool,
}

impl Path {
    /// With the circle of the track (m), the cosine of its angle, and the spall's middle and half of its length (rad)
    /// and its depth (m).
    pub(super) fn new(track: f64, cosine: f64, ball: f64, hollow: bool, [centre, half, depth]: [f64; 3]) -> Self {
        Self { centre, half, depth, cosine, radius: track / cosine, ball, hollow }
    }

    /// How far the ball's centre sinks (m) at an angle in the ring, and its derivative (m/rad).
    pub(super) fn sunk(&self, angle: f64) -> [f64; 2] {
        let past = angle - self.centre;
        let off = past - TAU * ((past + PI) / TAU).floor();
        let edge = self.half - off.abs();
        if edge <= 0.0 {
            return [0.0; 2];
        }
        let (sin, cos) = (edge * self.cosine).sin_cos();
        let (across, big) = (self.radius * sin, self.radius * cos);
        let inside = self.ball * self.ball - across * across;
        if inside <= 0.0 {
            return [self.depth, 0.0];
        }
        let root = inside.sqrt();
        // Sagittas, no differences of the radii: R (1 − cos d) and r − √(r² − R² sin² d).
        let (of_raceway, of_ball) = (across * across / (self.radius + big), across * across / (self.ball + root));
        let slope = across * big / root;
        let (sunk, rate) = match self.hollow {
            true => (of_ball - of_raceway, slope - across),
            false => (of_ball + of_raceway, slope + across),
        };
        if sunk >= self.depth {
            return [self.depth, 0.0];
        }
        // Farther from its edge it is deeper, and towards the middle the nearer edge is the one behind.
        [sunk, -off.signum() * rate * self.cosine]
    }

    /// Angles in the ring, from the middle, at which the path has a corner or begins.
    pub(super) fn corners(&self) -> Vec<f64> {
        let mut corners = vec![-self.half, 0.0, self.half];
        // Where it comes to the floor, by halving.
        if self.sunk(self.centre)[0] >= self.depth {
            let (mut low, mut high) = (0.0, self.half);
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                if self.sunk(self.centre + middle)[0] >= self.depth { low = middle } else { high = middle }
            }
            corners.extend([-high, high]);
        }
        corners
    }
}
