//! The numbers of a bearing, and what each contact and each ring is by them.

use crate::case::{Case, Damping, Grooves, Mode, Motion, Ring};
use crate::growth::Growth;
use crate::instant::{Contact, ELEMENTS, Outside, Seat};
use crate::oil::{Oil, Resistance};
use crate::surface::Surfaces;
use crate::turning::quadratic;
use crate::uneven::{AllWaves, Bodies, Own};
use std::f64::consts::{PI, TAU};

/// A bearing by its numbers in SI units.
pub struct Bearing {
    pub count: usize,
    pub r: f64,
    pub rho_0: f64,
    pub clearance: f64,
    pub growth: [Growth; 2],
    pub oil: Option<Oil>,
    pub compliance: f64,
    pub mass: f64,
    /// What elements have of their own: one where all are equal.
    pub own: Vec<Own>,
    pub waves: AllWaves,
    pub gravity: [f64; 2],
    pub damping: Damping,
    /// Speeds of cage, shaft, housing and elements' spin per speed of the shaft and of the housing.
    pub ratios: [[f64; 2]; 4],
    /// Their angles at the start (rad); spin is counted from there.
    pub starts: [f64; 4],
    /// Speeds of shaft and housing at the start (rad/s).
    pub speeds: [f64; 2],
    /// What contacts may meet.
    pub surfaces: Surfaces,
    /// Whether the case has a defect, and whether the inner ring has one or waves.
    pub defective: bool,
    pub inner_marked: bool,
    /// Whether the outer ring turns.
    pub turns: bool,
    pub rings: [Ring; 2],
    pub sensor: Option<[f64; 3]>,
    pub modes: Vec<Mode>,
}

impl Bearing {
    /// Without the defect, whose envelope takes time to find.
    pub fn smooth(case: &Case) -> Self {
        let (d, pitch, clearance) = (case.diameter_mm * 1e-3, case.pitch_mm * 1e-3, case.clearance_um * 1e-6);
        let (r, r_o, r_i) = (d / 2.0, (pitch + d + clearance) / 2.0, (pitch - d - clearance) / 2.0);
        let modulus = case.effective_modulus();
        let (f_i, f_o) = match case.grooves {
            Grooves::Equal(groove) => (groove / (2.0 * case.diameter_mm), groove / (2.0 * case.diameter_mm)),
            Grooves::Each(inner, outer) => (inner, outer),
        };
        let gamma = d / pitch;
        let (cage, spin) = (0.5 * (1.0 - case.slip), (1.0 - case.spin_slip) / (2.0 * gamma));
        let bodies = Bodies { raceways: [r_i, r_o], grooves: [f_i * d, f_o * d], modulus };
        let (nominal, own) = bodies.elements(case);
        Self {
            count: case.count,
            r,
            rho_0: r_o - r,
            clearance,
            growth: nominal.growth,
            own,
            waves: AllWaves::of(case, case.cage_deg * PI / 180.0),
            oil: Oil::new(case, [r, r_i, r_o], [f_i, f_o], modulus),
            compliance: case.compliance,
            mass: nominal.mass,
            gravity: case.gravity,
            damping: case.damping,
            ratios: [
                [cage * (1.0 - gamma), cage * (1.0 + gamma)],
                [1.0, 0.0],
                [0.0, 1.0],
                [-spin * (1.0 - gamma), spin * (1.0 + gamma)],
            ],
            starts: [case.cage_deg, case.rings_deg[0], case.rings_deg[1], 0.0].map(|degrees| degrees * PI / 180.0),
            speeds: [case.speed_hz, case.housing_hz.unwrap_or(0.0)].map(|hz| TAU * hz),
            surfaces: Surfaces::default(),
            defective: !case.defects.is_empty(),
            inner_marked: case.marks_inner_ring(),
            turns: case.housing_hz.is_some(),
            rings: case.rings,
            sensor: case.sensor,
            modes: if case.sensor.is_some() { case.modes.clone() } else { Vec::new() },
        }
    }

    /// What of element `j` is its own.
    pub fn own(&self, j: usize) -> &Own {
        &self.own[j % self.own.len()]
    }

    /// Where element `j` touches the smooth outer raceway (m from the outer ring's centre), and its clearance (m).
    pub fn place(&self, j: usize) -> [f64; 2] {
        let larger = self.own(j).larger;
        [self.rho_0 - 0.5 * larger, self.clearance - larger]
    }

    /// How many numbers a state has.
    pub fn state_count(&self) -> usize {
        self.first_mode() + 2 * self.modes.len()
    }

    /// Index of the first mode's displacement.
    pub(crate) fn first_mode(&self) -> usize {
        ELEMENTS + 2 * self.count + 4
    }

    /// The oil films at the speeds of these turns (m); none is 0.
    pub fn films(&self, turns: &[[f64; 3]; 4]) -> [f64; 2] {
        self.oil.as_ref().map_or([0.0; 2], |oil| oil.films(turns[1][1] - turns[2][1]))
    }

    /// Of cage, shaft, housing and spin for speeds of the rings with their derivatives.
    pub fn turning(&self, angles: [f64; 4], speeds: [[f64; 2]; 2]) -> [[f64; 3]; 4] {
        let sum = |which: usize, order: usize| -> f64 {
            (0..2).map(|ring| self.ratios[which][ring] * speeds[ring][order]).sum()
        };
        [0, 1, 2, 3].map(|which| [angles[which], sum(which, 0), sum(which, 1)])
    }

    /// The force of a contact of element `j`, beside a film of this thickness (m): with side 1, that of the outer
    /// raceway in series with its compliance.
    pub(crate) fn contact(&self, j: usize, side: usize, film: f64, [approach, rate]: [f64; 2]) -> Contact {
        let oil = self.oil.as_ref().map_or(Resistance::default(), |oil| oil.resistance(side, film, approach, rate));
        let film = Contact {
            force: oil.force,
            approach,
            by_rate: oil.by_rate,
            squeezes: oil.force > 0.0,
            steep: oil.steep,
            ..Contact::default()
        };
        if approach <= 0.0 {
            return film;
        }
        let growth = &self.own(j).growth[side];
        let (mut own, mut yields) = (approach, 1.0);
        if side == 1 && self.compliance > 0.0 {
            // Newton from above on a convex function: δ + c Q(δ) = Δ.
            for _ in 0..200 {
                let [force, slope] = growth.force(own);
                let next = own - (own + self.compliance * force - approach) / (1.0 + self.compliance * slope);
                let done = (next - own).abs() <= 1e-16 * own;
                own = next;
                if done {
                    break;
                }
            }
            yields = (1.0 + self.compliance * growth.force(own)[1]).powi(2);
        }
        let [elastic, slope] = growth.force(own);
        let damper = match self.damping {
            Damping::HuntCrossley(chi) => elastic * chi,
            Damping::Proportional(tau) => slope * tau,
        } / yields;
        let pushed = elastic + damper * rate;
        let (pushes, force) = (pushed > 0.0, pushed.max(0.0));
        // A damper that pushes with √δ is steep where δ is small: a force grows with less than δ^1.7.
        let steep = oil.steep + if pushes { 1.7 * force / approach } else { 0.0 };
        Contact { force: force + oil.force, by_rate: damper + oil.by_rate, pushes, steep, ..film }
    }

    /// Position, velocity and acceleration of a ring; the acceleration only if it is prescribed.
    fn ring(&self, which: usize, outside: &Outside, t: f64, y: &[f64]) -> [[f64; 3]; 2] {
        match self.rings[which].motion {
            Motion::Internal => [0, 1].map(|a| [y[4 * which + a], y[4 * which + 2 + a], 0.0]),
            Motion::Host => outside.rings[which].map(|c| quadratic(c, t)),
            Motion::Fixed => [[0.0; 3]; 2],
        }
    }

    /// Positions, velocities and prescribed accelerations of both rings.
    pub fn motions(&self, outside: &Outside, t: f64, y: &[f64]) -> [[[f64; 3]; 2]; 2] {
        [0, 1].map(|which| self.ring(which, outside, t, y))
    }

    pub fn seat(&self, j: usize, cage: [f64; 3], [shaft, housing]: &[[[f64; 3]; 2]; 2], y: &[f64]) -> Seat {
        let [angle, omega, _] = cage;
        let angle = angle + TAU * j as f64 / self.count as f64;
        let (sin, cos) = angle.sin_cos();
        let (u, u_rate) = (y[ELEMENTS + 2 * j], y[ELEMENTS + 2 * j + 1]);
        let rho = self.place(j)[0] + u;
        let q = [housing[0][0] - shaft[0][0] + rho * cos, housing[1][0] - shaft[1][0] + rho * sin];
        let q_rate = [
            housing[0][1] - shaft[0][1] + u_rate * cos - rho * omega * sin,
            housing[1][1] - shaft[1][1] + u_rate * sin + rho * omega * cos,
        ];
        Seat { angle, e_r: [cos, sin], rho, u, u_rate, q, q_rate }
    }
}
