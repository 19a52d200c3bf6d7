//! The surfaces that balls in space meet: those of the rings on tracks that lie at a contact angle, and a ball's own on
//! the great circle through both of its contacts.
//!
//! Along its track a raceway has the radius R_n = R_c/cos α_n (Meusnier), and an arc R_c ψ on it is the angle ψ cos α_n
//! about that radius' centre. A ring's defect has the angles about the axis that it has at the groove's bottom,
//! whatever the track; a ball's own has its angles about the ball's centre.

use crate::case::{Defect, On};
use crate::envelope::{Envelope, Feature, Pair, within_half_a_turn};
use crate::surfaces::points;
use crate::turning::{HOUSING, SHAFT, SPIN, Turns};
use std::f64::consts::{PI, TAU};

/// Where balls run on a raceway.
#[derive(Debug, Clone, Copy)]
pub(super) struct Track {
    /// Radius of the groove's bottom and of the track's circle about the axis (m).
    pub(super) bottom: f64,
    pub(super) circle: f64,
    /// Of the track's contact angle.
    pub(super) cosine: f64,
}

/// The defects of one body as the contacts of one raceway meet them.
struct Met {
    envelope: Envelope,
    /// Angle of the first one's middle (rad) in its frame.
    centre: f64,
    frame: usize,
    /// Angles of the envelope per angle in the frame.
    shortened: f64,
}

/// All of a bearing's.
#[derive(Default)]
pub(super) struct Surfaces {
    rings: [Option<Met>; 2],
    own: Vec<Option<[Met; 2]>>,
}

/// What a contact is over: how far the ball's centre sinks (m), the derivative of that by the angle in the frame of the
/// body that bears it (m/rad), and how fast the contact goes past there (rad/s).
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Over {
    pub(super) sunk: f64,
    pub(super) slope: f64,
    pub(super) past: f64,
}

impl Met {
    /// Of a body whose bottom has this radius (m), each arc on the track so many times as long, that rolls on or
    /// under a raceway of the radius `rolling` (m); in the frame of its own spin, counted from the start. None
    /// without a defect.
    fn of(body: &[&Defect], radius: f64, (pair, rolling): (Pair, f64), bottom: (f64, f64)) -> Option<Self> {
        let centre = body.first()?.angle_deg * PI / 180.0;
        let envelope = Envelope::new(&profiles(body, bottom, radius), pair, radius, rolling);
        Some(Self { envelope, centre, frame: SPIN, shortened: 1.0 })
    }
}

impl Surfaces {
    /// Of balls of this radius (m), the first of which is at the angle `cage` at the start.
    pub(super) fn new(defects: &[Defect], tracks: [Track; 2], radius: f64, (count, cage): (usize, f64)) -> Self {
        let on = |wanted: &dyn Fn(On) -> bool| defects.iter().filter(|defect| wanted(defect.on)).collect::<Vec<_>>();
        let of_ring =
            |side: usize, pair: Pair, frame: usize, on_it: On| {
                let Track { bottom, circle, cosine } = tracks[side];
                Met::of(&on(&|on| on == on_it), radius, (pair, circle / cosine), (bottom, circle / bottom))
                    .map(|met| Met { frame, shortened: cosine, ..met })
            };
        let of_ball = |j: usize| {
            let body = on(&|on| matches!(on, On::Element { element, .. } if element == j));
            let outwards = cage + TAU * j as f64 / count as f64;
            let met = |side: usize, pair: Pair, facing: f64| {
                let met = Met::of(&body, radius, (pair, tracks[side].circle / tracks[side].cosine), (radius, 1.0))?;
                Some(Met { centre: met.centre + facing, ..met })
            };
            // What faces the inner raceway is half a turn on.
            Some([met(0, Pair::ElementInside, outwards - PI)?, met(1, Pair::ElementOutside, outwards)?])
        };
        Self {
            rings: [of_ring(0, Pair::InnerRing, SHAFT, On::Inner), of_ring(1, Pair::OuterRing, HOUSING, On::Outer)],
            own: (0..count).map(of_ball).collect(),
        }
    }

    fn met(&self, side: usize, j: usize) -> impl Iterator<Item = &Met> {
        let own = self.own[j].as_ref().map(|own| &own[side]);
        [self.rings[side].as_ref(), own].into_iter().flatten()
    }

    /// What ball `j` is over on a raceway, in this direction from the ring, which turns at this rate (rad/s): of the
    /// ring's defect and its own the one that lets them come nearer.
    pub(super) fn over(&self, side: usize, j: usize, [direction, rate]: [f64; 2], turns: &Turns) -> Over {
        let of = |met: &Met| {
            let angle = within_half_a_turn(direction - turns[met.frame][0] - met.centre) * met.shortened;
            let feature = met.envelope.feature(met.envelope.stretch(angle));
            let (sunk, slope) = met.envelope.path(feature, angle);
            let past = rate - turns[met.frame][1];
            (feature != Feature::Smooth).then_some(Over { sunk, slope: slope * met.shortened, past })
        };
        let deeper = |ring: Over, own: Over| if own.sunk > ring.sunk { own } else { ring };
        self.met(side, j).filter_map(of).reduce(deeper).unwrap_or_default()
    }

    /// Times up to `length` at which an outer contact comes to touch something else, ascending. Where the inner ones do
    /// the rings decide.
    pub(super) fn passages(&self, turns: &Turns, length: f64) -> Vec<f64> {
        let (mut times, count) = (Vec::new(), self.own.len());
        for j in 0..count {
            for met in self.met(1, j) {
                let past: [f64; 3] = std::array::from_fn(|k| turns[0][k] - turns[met.frame][k]);
                for change in &met.envelope.changes {
                    let at = past[0] + TAU * j as f64 / count as f64 - met.centre - change / met.shortened;
                    crossings([at, past[1], past[2]], length, &mut times);
                }
            }
        }
        times.sort_by(f64::total_cmp);
        times
    }

    /// Whether there is an edge that only a side could meet.
    pub(super) fn leaps(&self) -> bool {
        (0..self.own.len()).any(|j| [0, 1].iter().any(|&side| self.met(side, j).any(|met| met.envelope.leaps())))
    }
}

/// Arcs on the track and depths (m) of all defects of a body whose bottom has this radius (m), each arc there so many
/// times as long, around the middle of the first.
fn profiles(body: &[&Defect], (bottom, longer): (f64, f64), radius: f64) -> Vec<Vec<(f64, f64)>> {
    let of = |defect: &&Defect| {
        let away = bottom * within_half_a_turn((defect.angle_deg - body[0].angle_deg) * PI / 180.0);
        let points = points(defect, bottom, radius)?;
        Some(points.into_iter().map(|(arc, depth)| ((arc + away) * longer, depth)).collect::<Vec<_>>())
    };
    let mut profiles: Vec<Vec<(f64, f64)>> = body.iter().filter_map(of).collect();
    profiles.sort_by(|a, b| a[0].0.total_cmp(&b[0].0));
    profiles
}

/// Times up to `length` at which an angle that changes by a quadratic is a whole number of turns.
fn crossings([start, speed, rate]: [f64; 3], length: f64, times: &mut Vec<f64>) {
    let at = |t: f64| start + t * (speed + 0.5 * t * rate);
    let reversal = -speed / rate;
    let turn = if reversal > 0.0 && reversal < length { reversal } else { length };
    for (from, to) in [(0.0, turn), (turn, length)] {
        let (low, high) = (at(from).min(at(to)), at(from).max(at(to)));
        let mut whole = (low / TAU).ceil();
        while to > from && whole * TAU <= high {
            let (mut early, mut late) = (from, to);
            for _ in 0..80 {
                let middle = 0.5 * (early + late);
                if (at(middle) < whole * TAU) == (at(to) > at(from)) { early = middle } else { late = middle }
            }
            times.push(late);
            whole += 1.0;
        }
    }
}

/// Exact rigid balls over a sharp edge of a 6205 of 5 µm, at tracks of 0 and 15°: printed in µm.
#[test]
fn a_ball_sinks_at_a_sharp_edge_as_printed() {
    use crate::case::{Length, Shape};
    let (radius, [r_i, r_o], r_g) = (3.97e-3, [15.5475e-3, 23.4925e-3], 0.52 * 7.94e-3);
    for (degrees, outer, inner) in
        [(0.0, 4.189_532, 6.327_068), (15.0, 4.163_240, 6.386_196), (40.0, 4.009_314, 6.733_747)]
    {
        let cosine = (degrees * PI / 180.0f64).cos();
        let track =
            |bottom: f64, inwards: f64| Track { bottom, circle: bottom + inwards * r_g * (1.0 - cosine), cosine };
        let tracks = [track(r_i, 1.0), track(r_o, -1.0)];
        for (side, on, expected) in [(0, On::Inner, inner), (1, On::Outer, outer)] {
            // 0.2 mm of the bottom's arc behind the edge of a spall of 4 mm.
            let shape = Shape::Spall { length: Length::Millimetres(4.0), depth_um: 500.0, slope_deg: 90.0 };
            let surfaces = Surfaces::new(&[Defect { on, angle_deg: 0.0, shape }], tracks, radius, (1, 0.0));
            let at = 1.8e-3 / tracks[side].bottom;
            let sunk = |at: f64| surfaces.over(side, 0, [at, 1.0], &[[0.0; 3]; 4]);
            assert!((sunk(at).sunk * 1e6 - expected).abs() < 1e-6, "{degrees} {side}: {:e}", sunk(at).sunk);
            let quotient = (sunk(at + 1e-7).sunk - sunk(at - 1e-7).sunk) / 2e-7;
            assert!((sunk(at).slope - quotient).abs() < 1e-6 * quotient.abs(), "{:e} {quotient:e}", sunk(at).slope);
        }
    }
}
