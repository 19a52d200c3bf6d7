//! Where defects are: on which body, how it turns, and which of its parts a contact is over.

use super::envelope::{Envelope, Pair, within_half_a_turn};
use super::{Bearing, Outside, Seat, quadratic};
use crate::case::{Defect, On, Shape};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Which of the turns a body follows.
pub const SHAFT: usize = 1;
pub const HOUSING: usize = 2;
pub const SPIN: usize = 3;

/// Angle, speed and acceleration of cage, shaft, housing and spin.
pub type Turns = [[f64; 3]; 4];

/// A defect as one raceway's contacts meet it.
pub struct Surface {
    pub envelope: Envelope,
    /// Angle of its middle [rad] in its frame.
    pub centre: f64,
    pub frame: usize,
    /// The element that bears it.
    element: Option<usize>,
}

impl Surface {
    /// Angle from the defect's middle to a direction in which the bodies touch, within half a turn.
    pub fn psi(&self, direction: f64, turns: &Turns) -> f64 {
        within_half_a_turn(direction - turns[self.frame][0] - self.centre)
    }
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

impl Bearing {
    /// What element `j` may meet on the inner or the outer raceway.
    pub fn surface(&self, side: usize, j: usize) -> Option<&Surface> {
        self.surfaces[side].as_ref().filter(|surface| surface.element.is_none_or(|element| element == j))
    }

    /// Angle of a contact from the middle of what it may meet.
    pub fn psi(&self, side: usize, j: usize, seat: &Seat, turns: &Turns) -> f64 {
        self.surface(side, j).map_or(0.0, |surface| surface.psi(seat.turning(side, turns)[0], turns))
    }

    /// The stretches that the inner contacts are in where `inner`, and the outer ones where `outer`.
    pub fn stretches(&self, outside: &Outside, t: f64, y: &[f64], sides: [bool; 2], into: &mut [[usize; 2]]) {
        let turns: Turns = outside.turns.map(|turn| quadratic(turn, t));
        let places = self.places(outside, t, y);
        for side in (0..2).filter(|&side| sides[side] && self.surfaces[side].is_some()) {
            for (j, stretches) in into.iter_mut().enumerate() {
                if let Some(surface) = self.surface(side, j) {
                    let seat = self.seat(j, turns[0], &places, y);
                    stretches[side] = surface.envelope.stretch(self.psi(side, j, &seat, &turns));
                }
            }
        }
    }

    /// Whether there is an edge that only a side could meet.
    pub fn leaps(&self) -> bool {
        self.surfaces.iter().flatten().any(|surface| surface.envelope.leaps())
    }

    /// Angular speed [rad/s] of contacts past a defect where the rings turn at these speeds.
    pub fn past(&self, defect: Option<&Defect>, speeds: [f64; 2]) -> f64 {
        let turn = |which: usize| self.ratios[which][0] * speeds[0] + self.ratios[which][1] * speeds[1];
        let frame = match defect.map(|defect| defect.on) {
            Some(On::Inner) => turn(SHAFT),
            Some(On::Element { .. }) => turn(SPIN),
            Some(On::Outer) => turn(HOUSING),
            None => 0.0,
        };
        turn(0) - frame
    }
}

/// What inner and outer contacts may meet of a defect; a topography has no envelope.
pub fn of(bearing: &Bearing, defect: &Defect) -> [Option<Surface>; 2] {
    let (r, r_o) = (bearing.r, bearing.rho_0 + bearing.r);
    let (r_i, angle) = (bearing.rho_0 - bearing.clearance - r, defect.angle_deg * PI / 180.0);
    let surface = |pair: Pair, frame: usize, (centre, element): (f64, Option<usize>)| {
        let (raceway, own) = match pair {
            Pair::OuterRing => (r_o, r_o),
            Pair::InnerRing => (r_i, r_i),
            Pair::ElementOutside => (r_o, r),
            Pair::ElementInside => (r_i, r),
        };
        let envelope = Envelope::new(&points(defect, own, r)?, pair, r, raceway);
        Some(Surface { envelope, centre, frame, element })
    };
    match defect.on {
        On::Outer => [None, surface(Pair::OuterRing, HOUSING, (angle, None))],
        On::Inner => [surface(Pair::InnerRing, SHAFT, (angle, None)), None],
        On::Element { element, .. } => {
            let outside = bearing.starts[0] + TAU * element as f64 / bearing.count as f64 + angle;
            // The side that faces the inner raceway is half a turn on.
            let inside = outside - PI;
            [
                surface(Pair::ElementInside, SPIN, (inside, Some(element))),
                surface(Pair::ElementOutside, SPIN, (outside, Some(element))),
            ]
        }
    }
}

/// Arcs and depths [m] of a defect on a body of radius `own`.
fn points(defect: &Defect, own: f64, r: f64) -> Option<Vec<(f64, f64)>> {
    match &defect.shape {
        Shape::Trace(points) => {
            let middle = 0.5 * (points[0].0 + points[points.len() - 1].0);
            Some(points.iter().map(|&(arc, depth)| ((arc - middle) * 1e-3, depth * 1e-6)).collect())
        }
        Shape::Spall { length, depth_um, slope_deg } => {
            let length = length.on(own);
            let off = match defect.on {
                On::Element { tilt_deg, .. } => 2.0 * r * (tilt_deg * PI / 180.0).sin(),
                _ => 0.0,
            };
            // Of a round pit the track crosses a chord.
            let half = 0.5 * (length * length - off * off).sqrt();
            let (depth, slope) = (depth_um * 1e-6, slope_deg * PI / 180.0);
            let run = if *slope_deg >= 90.0 { 0.0 } else { (depth * (FRAC_PI_2 - slope).tan()).min(half) };
            Some(vec![(-half, 0.0), (run - half, depth), (half - run, depth), (half, 0.0)])
        }
        Shape::Topography(_) => None,
    }
}
