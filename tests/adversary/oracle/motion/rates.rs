//! The right-hand side: what contacts push with, and the derivative of the state.

use crate::bearing::Bearing;
use crate::instant::{Acting, Contact, ELEMENTS, Outside, Seat};
use crate::surface::Stretches;
use crate::turning::{SHAFT, SPIN, Turns, quadratic};
use std::f64::consts::TAU;

/// A contact, its force on the element (x, y), the torque of that on the body with the defect or the waves, and what
/// that turns with.
struct Push {
    contact: Contact,
    force: [f64; 2],
    torque: f64,
    frame: usize,
}

impl Bearing {
    /// Both contacts of an element.
    fn pushes(&self, j: usize, seat: &Seat, turns: &Turns, films: [f64; 2], stretches: &Stretches) -> [Push; 2] {
        let length = seat.q[0].hypot(seat.q[1]);
        let n = [seat.q[0] / length, seat.q[1] / length];
        let opening = n[0] * seat.q_rate[0] + n[1] * seat.q_rate[1];
        // Paths count from the film outside; both films take from the clearance.
        let [place, clearance] = self.place(j);
        let smooth = [place - clearance + films[0] + films[1] - length, seat.u];
        let (apart, rates, outwards) = ([length, seat.rho], [-opening, seat.u_rate], [n, seat.e_r]);
        [0, 1].map(|side| {
            let over = self.over(side, j, seat, turns, stretches);
            let (path, slope, past) = over.as_ref().map_or((0.0, 0.0, 0.0), |over| (over.path, over.slope, over.rate));
            let wave = self.wave(side, j, seat, turns);
            let approach = [smooth[side] - path - wave.path, rates[side] - slope * past - wave.slope * wave.rate];
            let mut contact = self.contact(j, side, films[side], approach);
            contact.over = over.as_ref().map(|over| over.which);
            let kappa = if slope == 0.0 { 0.0 } else { (slope / apart[side]).atan() };
            let away = if side == 0 { contact.force } else { -contact.force } * kappa.cos();
            let leaning = kappa.sin() + wave.slope / apart[side];
            let ([x, y], around) = (outwards[side], contact.force * leaning);
            // The force passes through the centre of the body without the defect or the waves.
            let torque = -around * apart[side];
            let force = [away * x - around * y, away * y + around * x];
            // All of it is the normal force of a wave's flank.
            contact.force *= kappa.cos().hypot(leaning);
            Push { contact, force, torque, frame: over.map_or(wave.frame, |over| over.surface.frame) }
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
            let pushes = self.pushes(j, &seat, &turns, self.films(&turns), &stretches[j]);
            let mass = self.own(j).mass;
            let mut net = [mass * self.gravity[0], mass * self.gravity[1]];
            for (side, push) in pushes.iter().enumerate() {
                for a in 0..2 {
                    net[a] += push.force[a];
                    acting.rings[side][a] -= push.force[a];
                }
                match push.frame {
                    SPIN => acting.torque += push.torque,
                    SHAFT => acting.shaft_torque += push.torque,
                    _ => {}
                }
            }
            along[j] = net[0] * cos + net[1] * sin + mass * rho * omega * omega;
            let around = net[1] * cos - net[0] * sin;
            acting.torque += rho * (around - mass * (2.0 * seat.u_rate * omega + rho * alpha));
            acting.contacts.push(pushes.map(|push| push.contact));
        }
        self.ring_rates(outside, t, y, &motions, rates, acting);
        let a_o = acting.accelerations[1];
        for j in 0..self.count {
            let (sin, cos) = (turns[0][0] + TAU * j as f64 / self.count as f64).sin_cos();
            rates[ELEMENTS + 2 * j] = y[ELEMENTS + 2 * j + 1];
            let mass = self.own(j).mass;
            rates[ELEMENTS + 2 * j + 1] = along[j] / mass - (a_o[0] * cos + a_o[1] * sin);
            acting.torque -= (self.place(j)[0] + y[ELEMENTS + 2 * j]) * mass * (a_o[1] * cos - a_o[0] * sin);
        }
        let impulses = ELEMENTS + 2 * self.count;
        for i in 0..4 {
            rates[impulses + i] = acting.rings[i / 2][i % 2];
        }
    }
}
