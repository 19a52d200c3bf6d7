//! Equations of motion of a rolling bearing, contact law `hertz`, written from the equations and not from the crate.
//!
//! Each element's distance from the outer ring's centre is ρ = ρ₀ + u, its angle is the cage's. Seen from the outer
//! ring, which accelerates by a_o:
//! ```text
//! m u'' = F·e_r + m (g·e_r + ρ ω² − a_o·e_r)
//! ```
//! so a_o comes first. F is what both raceways push: each with Q along the normal of its rigid path, tan κ = P′ over
//! the distance from that ring's centre. Where the host moves the outer ring by a jump, an element keeps its u and its
//! velocity in space.

// What helpers unwrap is a test's own set-up, and names say what its numbers are.
#![allow(clippy::unwrap_used, clippy::expect_used, missing_docs)]

pub mod balance;
pub mod case;
pub mod draw;
pub mod envelope;
pub mod growth;
pub mod half_space;
mod hertz;
pub mod oil;
mod ring_rates;
pub mod run;
pub mod signals;
pub mod surfaces;

use crate::case::{Case, Damping, Grooves, Mode, Motion, On, Ring};
use growth::Growth;
use oil::{Oil, Resistance};
use std::f64::consts::{PI, TAU};
use surfaces::{Stretches, Surfaces, Turns};

pub struct Bearing {
    pub count: usize,
    pub r: f64,
    pub rho_0: f64,
    pub clearance: f64,
    pub growth: [Growth; 2],
    pub oil: Option<Oil>,
    pub compliance: f64,
    pub mass: f64,
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
    /// Whether the case has a defect, and whether the inner ring has one.
    pub defective: bool,
    pub inner_defective: bool,
    /// Whether the outer ring turns.
    pub turns: bool,
    pub rings: [Ring; 2],
    pub sensor: Option<[f64; 3]>,
    pub modes: Vec<Mode>,
}

/// Time within a communication step, and what the host says for it.
#[derive(Debug, Clone, Copy)]
pub struct Outside {
    /// Angles of cage, shaft, housing and spin at the start of the step, their speeds and accelerations.
    pub turns: [[f64; 3]; 4],
    /// As in [`crate::case::Host::rings`].
    pub rings: [[[f64; 3]; 2]; 2],
    /// Thickness of the oil films inside and outside (m).
    pub films: [f64; 2],
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
    /// Bound of ∂(force)/∂(approach) (N/m), but for the elastic part.
    pub steep: f64,
    /// Whose defect it is over: the ring's (0) or the element's.
    pub over: Option<usize>,
}

/// A contact, its force on the element (x, y), the torque of that on the body with the defect, and what that turns
/// with.
struct Push {
    contact: Contact,
    force: [f64; 2],
    torque: f64,
    frame: Option<usize>,
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

pub fn quadratic(c: [f64; 3], t: f64) -> [f64; 3] {
    [c[0] + t * (c[1] + 0.5 * t * c[2]), c[1] + t * c[2], c[2]]
}

impl Bearing {
    pub fn new(case: &Case) -> Self {
        let mut bearing = Self::smooth(case);
        bearing.surfaces = surfaces::of(&bearing, case).unwrap_or_default();
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
        let gamma = d / pitch;
        let (cage, spin) = (0.5 * (1.0 - case.slip), (1.0 - case.spin_slip) / (2.0 * gamma));
        let volume = match case.roller {
            Some(roller) => PI * r * r * roller.length_mm * 1e-3,
            None => 4.0 / 3.0 * PI * r * r * r,
        };
        let mass = case.mass_g.map_or_else(|| volume * case.density.unwrap(), |mass| mass * 1e-3);
        let points = [0, 1].map(|side| Growth::Point(case.hertz[side].unwrap_or(computed[side])));
        let growth = Growth::of_roller(case).map_or(points, |line| [line.clone(), line]);
        Self {
            count: case.count,
            r,
            rho_0: r_o - r,
            clearance,
            growth,
            oil: Oil::new(case, [r, r_i, r_o], [f_i, f_o], modulus),
            compliance: case.compliance,
            mass,
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
            inner_defective: case.defects.iter().any(|defect| defect.on == On::Inner),
            turns: case.housing_hz.is_some(),
            rings: case.rings,
            sensor: case.sensor,
            modes: if case.sensor.is_some() { case.modes.clone() } else { Vec::new() },
        }
    }

    /// How many numbers a state has.
    pub fn state_count(&self) -> usize {
        self.first_mode() + 2 * self.modes.len()
    }

    /// Index of the first mode's displacement.
    fn first_mode(&self) -> usize {
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

    /// The force of a contact, beside a film of this thickness (m): with side 1, that of the outer raceway in series
    /// with its compliance.
    fn contact(&self, side: usize, film: f64, approach: f64, rate: f64) -> Contact {
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
        let growth = &self.growth[side];
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
        let rho = self.rho_0 + u;
        let q = [housing[0][0] - shaft[0][0] + rho * cos, housing[1][0] - shaft[1][0] + rho * sin];
        let q_rate = [
            housing[0][1] - shaft[0][1] + u_rate * cos - rho * omega * sin,
            housing[1][1] - shaft[1][1] + u_rate * sin + rho * omega * cos,
        ];
        Seat { angle, e_r: [cos, sin], rho, u, u_rate, q, q_rate }
    }

    /// Both contacts of an element.
    fn pushes(&self, j: usize, seat: &Seat, turns: &Turns, films: [f64; 2], stretches: &Stretches) -> [Push; 2] {
        let length = seat.q[0].hypot(seat.q[1]);
        let n = [seat.q[0] / length, seat.q[1] / length];
        let opening = n[0] * seat.q_rate[0] + n[1] * seat.q_rate[1];
        // Paths count from the film outside; both films take from the clearance.
        let smooth = [self.rho_0 - self.clearance + films[0] + films[1] - length, seat.u];
        let (apart, rates, outwards) = ([length, seat.rho], [-opening, seat.u_rate], [n, seat.e_r]);
        [0, 1].map(|side| {
            let over = self.over(side, j, seat, turns, stretches);
            let (path, slope, past) = over.as_ref().map_or((0.0, 0.0, 0.0), |over| (over.path, over.slope, over.rate));
            let mut contact = self.contact(side, films[side], smooth[side] - path, rates[side] - slope * past);
            contact.over = over.as_ref().map(|over| over.which);
            let kappa = if slope == 0.0 { 0.0 } else { (slope / apart[side]).atan() };
            let away = if side == 0 { contact.force } else { -contact.force } * kappa.cos();
            let ([x, y], around) = (outwards[side], contact.force * kappa.sin());
            // The force passes through the centre of the body without the defect.
            let torque = -around * apart[side];
            let force = [away * x - around * y, away * y + around * x];
            Push { contact, force, torque, frame: over.map(|over| over.surface.frame) }
        })
    }

    /// Derivative of the state `y` at `t` into the communication step. `stretches` are those that the contacts are in.
    pub fn rates(
        &self,
        outside: &Outside,
        t: f64,
        y: &[f64],
        stretches: &[Stretches],
        rates: &mut [f64],
        acting: &mut Acting,
    ) {
        let turns: Turns = outside.turns.map(|turn| quadratic(turn, t));
        let [_, omega, alpha] = turns[0];
        let motions = self.motions(outside, t, y);
        acting.contacts.clear();
        acting.rings = [[0.0; 2]; 2];
        // Pushes along e_r without the rings' acceleration, then the tangential ones.
        let mut along = [0.0; 128];
        (acting.torque, acting.shaft_torque) = (0.0, 0.0);
        for j in 0..self.count {
            let seat = self.seat(j, turns[0], &motions, y);
            let ([cos, sin], rho) = (seat.e_r, seat.rho);
            let pushes = self.pushes(j, &seat, &turns, outside.films, &stretches[j]);
            let mut net = [self.mass * self.gravity[0], self.mass * self.gravity[1]];
            for (side, push) in pushes.iter().enumerate() {
                for a in 0..2 {
                    net[a] += push.force[a];
                    acting.rings[side][a] -= push.force[a];
                }
                match push.frame {
                    Some(surfaces::SPIN) => acting.torque += push.torque,
                    Some(surfaces::SHAFT) => acting.shaft_torque += push.torque,
                    _ => {}
                }
            }
            along[j] = net[0] * cos + net[1] * sin + self.mass * rho * omega * omega;
            let around = net[1] * cos - net[0] * sin;
            acting.torque += rho * (around - self.mass * (2.0 * seat.u_rate * omega + rho * alpha));
            acting.contacts.push(pushes.map(|push| push.contact));
        }
        self.ring_rates(outside, t, y, &motions, rates, acting);
        let a_o = acting.accelerations[1];
        for j in 0..self.count {
            let (sin, cos) = (turns[0][0] + TAU * j as f64 / self.count as f64).sin_cos();
            rates[ELEMENTS + 2 * j] = y[ELEMENTS + 2 * j + 1];
            rates[ELEMENTS + 2 * j + 1] = along[j] / self.mass - (a_o[0] * cos + a_o[1] * sin);
            acting.torque -= (self.rho_0 + y[ELEMENTS + 2 * j]) * self.mass * (a_o[1] * cos - a_o[0] * sin);
        }
        let impulses = ELEMENTS + 2 * self.count;
        for i in 0..4 {
            rates[impulses + i] = acting.rings[i / 2][i % 2];
        }
    }
}
