//! Equations of motion of a rolling bearing, contact law `hertz`, written from the equations and not from the crate.
//!
//! Each element's distance from the outer ring's centre is ρ = ρ₀ + u, its angle is the cage's. Seen from the outer ring, which
//! accelerates by a_o:
//! ```text
//! m u'' = Q_i n·e_r − F_r + m (g·e_r + ρ ω² − a_o·e_r)
//! ```
//! so a_o comes first. F_r, F_t: the outer contact's force on the element, inwards and counter-clockwise, Q along the normal of
//! the rigid path, tan κ = P′/ρ. Where the host moves the outer ring by a jump, an element keeps its u and its velocity in space.

pub mod balance;
pub mod envelope;
pub mod half_space;
mod hertz;
pub mod run;

use crate::case::{Case, Damping, Defect, Grooves, Length, Motion, Ring, Shape};
use envelope::{Envelope, Feature};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

pub struct Bearing {
    pub count: usize,
    pub r: f64,
    pub rho_0: f64,
    pub clearance: f64,
    pub stiffness: [f64; 2],
    pub compliance: f64,
    pub mass: f64,
    pub gravity: [f64; 2],
    pub damping: Damping,
    pub ratio: f64,
    pub cage_start: f64,
    pub speed: f64,
    pub defect: Option<(Envelope, f64)>,
    /// Whether the case has a defect.
    pub defective: bool,
    pub rings: [Ring; 2],
    pub sensor: Option<[f64; 3]>,
}

/// Time within a communication step, and what the host says for it.
#[derive(Debug, Clone, Copy)]
pub struct Outside {
    pub cage: [f64; 3],
    /// As in [`crate::case::Host::rings`].
    pub rings: [[[f64; 3]; 2]; 2],
}

/// Positions and velocities: rings x y vx vy each, sensor y vy, then u and u' of each element, then impulses of the mean forces.
pub const SENSOR: usize = 8;
pub const ELEMENTS: usize = 10;

/// One contact.
#[derive(Debug, Clone, Copy, Default)]
pub struct Contact {
    pub force: f64,
    pub approach: f64,
    /// ∂(force)/∂(rate of approach) [N s/m].
    pub by_rate: f64,
    pub pushes: bool,
}

/// What acts at one instant.
#[derive(Debug, Clone, Default)]
pub struct Acting {
    /// Inner and outer contact of each element.
    pub contacts: Vec<[Contact; 2]>,
    /// The bearing's force on shaft and housing [N].
    pub rings: [[f64; 2]; 2],
    /// Their accelerations [m/s²].
    pub accelerations: [[f64; 2]; 2],
    pub sensor: f64,
    pub torque: f64,
}

pub fn quadratic(c: [f64; 3], t: f64) -> [f64; 3] {
    [c[0] + t * (c[1] + 0.5 * t * c[2]), c[1] + t * c[2], c[2]]
}

impl Bearing {
    pub fn new(case: &Case) -> Self {
        let mut bearing = Self::smooth(case);
        bearing.defect = case.defect.as_ref().and_then(|defect| {
            Some((envelope_of(defect, bearing.r, bearing.rho_0 + bearing.r)?, defect.angle_deg * PI / 180.0))
        });
        bearing
    }

    /// Without the defect, whose envelope takes time to find.
    pub fn smooth(case: &Case) -> Self {
        let (d, pitch, clearance) = (case.diameter_mm * 1e-3, case.pitch_mm * 1e-3, case.clearance_um * 1e-6);
        let (r, r_o, r_i) = (d / 2.0, (pitch + d + clearance) / 2.0, (pitch - d - clearance) / 2.0);
        let modulus = case.modulus_gpa * 1e9 / (2.0 * (1.0 - case.poisson * case.poisson));
        let (f_i, f_o) = match case.grooves {
            Grooves::Equal(groove) => (groove / (2.0 * case.diameter_mm), groove / (2.0 * case.diameter_mm)),
            Grooves::Each(inner, outer) => (inner, outer),
        };
        let computed = [
            hertz::stiffness([1.0 / r + 1.0 / r_i, 1.0 / r - 1.0 / (f_i * d)], modulus),
            hertz::stiffness([1.0 / r - 1.0 / r_o, 1.0 / r - 1.0 / (f_o * d)], modulus),
        ];
        let mass = case.mass_g.map_or_else(|| 4.0 / 3.0 * PI * r * r * r * case.density.unwrap(), |mass| mass * 1e-3);
        Self {
            count: case.count,
            r,
            rho_0: r_o - r,
            clearance,
            stiffness: [0, 1].map(|side| case.hertz[side].unwrap_or(computed[side])),
            compliance: case.compliance,
            mass,
            gravity: case.gravity,
            damping: case.damping,
            ratio: 0.5 * (1.0 - d / pitch) * (1.0 - case.slip),
            cage_start: case.cage_deg * PI / 180.0,
            speed: TAU * case.speed_hz,
            defect: None,
            defective: case.defect.is_some(),
            rings: case.rings,
            sensor: case.sensor,
        }
    }

    pub fn len(&self) -> usize {
        ELEMENTS + 2 * self.count + 4
    }

    /// Angle of element `j` from the defect's centre, within half a turn.
    pub fn angle_to_defect(&self, j: usize, cage: f64) -> f64 {
        let angle = cage + TAU * j as f64 / self.count as f64 - self.defect.as_ref().map_or(0.0, |d| d.1);
        angle - TAU * (angle / TAU).round()
    }

    /// The force of a contact: with side 1, that of the outer raceway in series with its compliance.
    fn contact(&self, side: usize, approach: f64, rate: f64) -> Contact {
        if approach <= 0.0 {
            return Contact { approach, ..Contact::default() };
        }
        let k = self.stiffness[side];
        let (mut own, mut yields) = (approach, 1.0);
        if side == 1 && self.compliance > 0.0 {
            // Newton from above on a convex function: δ + c K δ^1.5 = Δ.
            for _ in 0..200 {
                let next = own - (own + self.compliance * k * own * own.sqrt() - approach) / self.softness(k, own);
                let done = (next - own).abs() <= 1e-16 * own;
                own = next;
                if done {
                    break;
                }
            }
            yields = self.softness(k, own).powi(2);
        }
        let root = k * own.sqrt();
        let damper = match self.damping {
            Damping::HuntCrossley(chi) => root * own * chi,
            Damping::Proportional(tau) => root * 1.5 * tau,
        };
        let force = root * own + damper * (rate / yields);
        Contact { force: force.max(0.0), approach, by_rate: damper / yields, pushes: force > 0.0 }
    }

    /// dΔ/dδ of a contact in series with the compliance.
    fn softness(&self, k: f64, own: f64) -> f64 {
        1.0 + 1.5 * self.compliance * k * own.sqrt()
    }

    /// Place, velocity and acceleration of a ring; the acceleration only if it is prescribed.
    fn ring(&self, which: usize, outside: &Outside, t: f64, y: &[f64]) -> [[f64; 3]; 2] {
        match self.rings[which].motion {
            Motion::Internal => [0, 1].map(|a| [y[4 * which + a], y[4 * which + 2 + a], 0.0]),
            Motion::Host => outside.rings[which].map(|c| quadratic(c, t)),
            Motion::Fixed => [[0.0; 3]; 2],
        }
    }

    /// Derivative of the state `y` at `t` into the communication step. `features` are what the elements touch.
    pub fn rates(
        &self,
        outside: &Outside,
        t: f64,
        (y, features): (&[f64], &[Feature]),
        rates: &mut [f64],
        acting: &mut Acting,
    ) {
        let [cage, omega, alpha] = quadratic(outside.cage, t);
        let places = [0, 1].map(|which| self.ring(which, outside, t, y));
        let (shaft, housing) = (places[0], places[1]);
        acting.contacts.clear();
        acting.rings = [[0.0; 2]; 2];
        // Pushes along e_r without the rings' acceleration, then the tangential ones.
        let mut along = [0.0; 128];
        acting.torque = 0.0;
        for j in 0..self.count {
            let (sin, cos) = (cage + TAU * j as f64 / self.count as f64).sin_cos();
            let (u, u_rate) = (y[ELEMENTS + 2 * j], y[ELEMENTS + 2 * j + 1]);
            let rho = self.rho_0 + u;
            let q = [housing[0][0] - shaft[0][0] + rho * cos, housing[1][0] - shaft[1][0] + rho * sin];
            let q_rate = [
                housing[0][1] - shaft[0][1] + u_rate * cos - rho * omega * sin,
                housing[1][1] - shaft[1][1] + u_rate * sin + rho * omega * cos,
            ];
            let length = q[0].hypot(q[1]);
            let n = [q[0] / length, q[1] / length];
            let inner = self.contact(0, self.rho_0 - self.clearance - length, -(n[0] * q_rate[0] + n[1] * q_rate[1]));
            let (path, slope) = match &self.defect {
                None => (0.0, 0.0),
                Some((envelope, _)) => envelope.path(features[j], self.angle_to_defect(j, cage)),
            };
            let outer = self.contact(1, u - path, u_rate - slope * omega);
            let kappa = (slope / rho).atan();
            let (f_r, f_t) = (outer.force * kappa.cos(), outer.force * kappa.sin());
            for (a, (e_r, e_t)) in [(cos, -sin), (sin, cos)].into_iter().enumerate() {
                acting.rings[0][a] -= inner.force * n[a];
                acting.rings[1][a] += f_r * e_r - f_t * e_t;
            }
            let gravity =
                [self.gravity[0] * cos + self.gravity[1] * sin, self.gravity[1] * cos - self.gravity[0] * sin];
            along[j] = inner.force * (n[0] * cos + n[1] * sin) - f_r + self.mass * (gravity[0] + rho * omega * omega);
            let around = inner.force * (n[1] * cos - n[0] * sin) + f_t;
            acting.torque += rho * (around + self.mass * (gravity[1] - 2.0 * u_rate * omega - rho * alpha));
            acting.contacts.push([inner, outer]);
        }
        self.ring_rates(outside, t, (y, &places), rates, acting);
        let a_o = acting.accelerations[1];
        for j in 0..self.count {
            let (sin, cos) = (cage + TAU * j as f64 / self.count as f64).sin_cos();
            rates[ELEMENTS + 2 * j] = y[ELEMENTS + 2 * j + 1];
            rates[ELEMENTS + 2 * j + 1] = along[j] / self.mass - (a_o[0] * cos + a_o[1] * sin);
            acting.torque -= (self.rho_0 + y[ELEMENTS + 2 * j]) * self.mass * (a_o[1] * cos - a_o[0] * sin);
        }
        let impulses = ELEMENTS + 2 * self.count;
        for i in 0..4 {
            rates[impulses + i] = acting.rings[i / 2][i % 2];
        }
    }

    fn ring_rates(
        &self,
        outside: &Outside,
        t: f64,
        (y, places): (&[f64], &[[[f64; 3]; 2]; 2]),
        rates: &mut [f64],
        acting: &mut Acting,
    ) {
        let mut reaction = 0.0;
        (rates[SENSOR], rates[SENSOR + 1]) = (0.0, 0.0);
        acting.sensor = 0.0;
        if let Some([mass, stiffness, damping]) = self.sensor {
            reaction = stiffness * (y[SENSOR] - places[1][1][0]) + damping * (y[SENSOR + 1] - places[1][1][1]);
            acting.sensor = -reaction / mass;
            (rates[SENSOR], rates[SENSOR + 1]) = (y[SENSOR + 1], acting.sensor);
        }
        for which in 0..2 {
            let ring = &self.rings[which];
            for a in 0..2 {
                let [x, v, prescribed] = places[which][a];
                acting.accelerations[which][a] = prescribed;
                (rates[4 * which + a], rates[4 * which + 2 + a]) = (0.0, 0.0);
                if ring.motion == Motion::Internal {
                    let load = quadratic(outside.rings[which][a], t)[0];
                    let own = load + acting.rings[which][a] - ring.damping * v - ring.stiffness * x;
                    let own = if which == 1 && a == 1 { own + reaction } else { own };
                    acting.accelerations[which][a] = own / ring.mass;
                    (rates[4 * which + a], rates[4 * which + 2 + a]) = (v, own / ring.mass);
                }
            }
        }
    }
}

/// The envelope of a profile; a topography has none.
fn envelope_of(defect: &Defect, r: f64, r_o: f64) -> Option<Envelope> {
    let points: Vec<(f64, f64)> = match &defect.shape {
        Shape::Trace(points) => {
            let middle = 0.5 * (points[0].0 + points[points.len() - 1].0);
            points.iter().map(|(arc, depth)| ((arc - middle) * 1e-3, depth * 1e-6)).collect()
        }
        Shape::Spall { length, depth_um, slope_deg } => {
            let half = 0.5
                * match length {
                    Length::Degrees(degrees) => degrees * PI / 180.0 * r_o,
                    Length::Millimetres(length) => length * 1e-3,
                };
            let (depth, slope) = (depth_um * 1e-6, slope_deg * PI / 180.0);
            let run = if *slope_deg >= 90.0 { 0.0 } else { (depth * (FRAC_PI_2 - slope).tan()).min(half) };
            vec![(-half, 0.0), (run - half, depth), (half - run, depth), (half, 0.0)]
        }
        Shape::Topography(_) => return None,
    };
    Some(Envelope::new(&points, r, r_o))
}
