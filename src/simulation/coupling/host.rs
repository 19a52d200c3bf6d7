//! A host as its bearing sees it: which force it takes, and the mass, spring and damper on which that acts.
//!
//! *Mass.* At a communication point a held force U changes at once, and all else that acts on the ring is continuous.
//! So the acceleration jumps by ΔU/m ([`Way`](super::way)), and m is what relates both over the last steps.
//!
//! *Which force.* The bearing knows all that may be held; that is taken whose changes are parallel to the jumps. They
//! are half a step apart from each other, and jumps are exact but for (ωh)³: a phase of ωh/2 shows after a part of a
//! swing. Where there are no jumps, force is interpolated; who asks for its derivative uses that.
//!
//! *Spring and damper* are what is left: R = m ā − U, its change Δ R = −k Δx − c Δv. Without jumps mass and spring
//! cannot be told apart in an oscillation; the spring is then taken into the mass, which leaves the frequency.
//! Forces that swing with the ring (unbalance) look like a spring or a damper below 0, and are taken for none.

use super::step::{Body, Step, Triple};
use super::way::Way;

/// Steps in which what has been learned fades to a third.
const FADING: f64 = 1.0 - 1.0 / 128.0;
/// Steps before a mass is known, before a spring is, and before it is sure which force is held.
const SETTLED: f64 = 6.0;
const SETTLED_REST: f64 = 20.0;
const SETTLED_FORCE: f64 = 64.0;
/// Share of the changes of acceleration from which on, in squares, there are jumps at all.
const JUMPS: f64 = 0.05;
/// Share of the jumps, in squares, that a force may leave unexplained.
const UNEXPLAINED: f64 = 0.1;
/// How far changes of place, velocity and acceleration must be from going together, in squares.
const APART: f64 = 0.05;
/// Changes of the force below this share of it say nothing: rounding.
const NOTHING: f64 = 1e-9;

/// Forces that may be held, by their number: the mean over the step before, the force at the start, the mean over this
/// step, the force at its end, and the mean that was foretold.
const MEAN: usize = 2;
const FORETOLD: usize = 4;
const FORCES: usize = 5;
const NAMES: [&str; FORCES] =
    ["mean_force of the step before", "force of its start", "mean_force", "force of its end", "next_mean_force"];

/// What a host is known to be.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Host {
    /// kg; 0 while it is not known.
    pub(super) mass: f64,
    stiffness: f64,
    damping: f64,
    /// Steps that have been learned from.
    steps: f64,
    /// 1 if it asks for the force's rate.
    derives: f64,
    /// Steps without interruption.
    in_a_row: f64,
    /// Sums: jumps by jumps, by changes of each force, and those by themselves.
    jumps: f64,
    by_jumps: [f64; FORCES],
    changes: [f64; FORCES],
    /// Changes of the mean acceleration a, of the velocity v and of the mean force F along a line: aa, av, vv, aF, vF.
    kinetic: [f64; 5],
    /// Those of place x, velocity v and rest R: xx, xv, vv, xR, vR.
    rest: [f64; 5],
    before: Before,
}

/// The step before.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Before {
    forces: [Triple; FORCES],
    line: Triple,
    /// Acceleration at its end, and its means.
    end: Triple,
    acceleration: Triple,
    velocity: Triple,
    place: Triple,
    rest: Triple,
}

/// What a coupling has lost in a step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Lost {
    /// Force that the host took beyond the mean of the bearing's (N).
    pub(super) force: Triple,
    /// How far the bearing's way of the ring was ahead of the host's in the mean (m).
    pub(super) gap: Triple,
    /// How far beyond its place a held force has brought the ring (m).
    pub(super) beyond: Triple,
}

/// How the force comes to the ring.
enum Taken {
    /// Held, of this number.
    Held(usize),
    /// Along a line.
    Linear,
}

impl Host {
    /// As a body.
    pub(super) fn body(&self) -> Body {
        let [stiffness, damping] = [self.stiffness, self.damping].map(Triple::repeat);
        Body { is_hosted: true, mass: self.mass, stiffness, damping }
    }

    /// Forgets the step before.
    pub(super) fn interrupt(&mut self) {
        self.in_a_row = 0.0;
    }

    /// Learns from a step, and says what the coupling has lost in it.
    pub(super) fn complete(&mut self, step: &Step, ring: usize, way: &Way) -> Lost {
        let (mean, before) = (step.mean[ring], self.before);
        self.derives = step.has_rate;
        let late_mean = if self.in_a_row > 0.0 { before.forces[MEAN] } else { step.start[ring] };
        let forces = [late_mean, step.start[ring], mean, step.end[ring], step.foretold[ring]];
        let line = along_a_line(step, ring);
        let [start, end] = way.ends();
        if self.in_a_row > 0.0 && (mean - before.forces[MEAN]).norm() > NOTHING * mean.norm() {
            self.learn(step, (&forces, line), way, start);
        }
        let mut lost = Lost { gap: gap(step, ring, way, start), ..Lost::default() };
        let mut rest = Triple::zeros();
        if self.mass > 0.0 {
            match self.taken() {
                Taken::Held(number) => {
                    lost.force = forces[number] - mean;
                    lost.beyond = (step.end[ring] - step.start[ring]) * (way.length * way.length / (12.0 * self.mass));
                    rest = way.acceleration * self.mass - forces[number];
                    self.learn_rest(way, rest);
                }
                Taken::Linear => {
                    let rises = step.end[ring] - step.start[ring] - change_along_a_line(step, ring);
                    lost.force = along_a_line(step, ring) - mean;
                    lost.beyond = rises * (way.length * way.length / (12.0 * self.mass));
                }
            }
        }
        let (acceleration, velocity, place) = (way.acceleration, way.velocity, way.place);
        self.before = Before { forces, line, end, acceleration, velocity, place, rest };
        self.in_a_row += 1.0;
        lost
    }

    /// Learns the mass.
    fn learn(&mut self, step: &Step, (forces, line): (&[Triple; FORCES], Triple), way: &Way, start: Triple) {
        let before = self.before;
        self.steps += 1.0;
        let jump = start - before.end;
        let mut changes: [Triple; FORCES] = std::array::from_fn(|k| forces[k] - before.forces[k]);
        if step.is_foretold == 0.0 {
            changes[FORETOLD] = Triple::zeros();
        }
        self.jumps = FADING * self.jumps + jump.norm_squared();
        fade(&mut self.by_jumps, &changes.map(|change| change.dot(&jump)));
        fade(&mut self.changes, &changes.map(|change| change.norm_squared()));
        let [a, v] = [way.acceleration - before.acceleration, way.velocity - before.velocity];
        let force = line - before.line;
        fade(&mut self.kinetic, &[a.dot(&a), a.dot(&v), v.dot(&v), a.dot(&force), v.dot(&force)]);
        if self.steps < SETTLED {
            return;
        }
        let mass = match self.taken() {
            Taken::Held(number) => self.by_jumps[number] / self.jumps,
            Taken::Linear => {
                // m a = F − c v, the damper only where it shows.
                let alone = [self.kinetic[3] / self.kinetic[0], 0.0];
                let both = least_squares(self.kinetic).map(|[mass, damping]| [mass, -damping]);
                let shows = |of: &[f64; 2]| self.steps > SETTLED_REST && of[0] > 0.0 && of[1] > 0.0;
                let [mass, damping] = both.filter(shows).unwrap_or(alone);
                (self.stiffness, self.damping) = (0.0, damping);
                mass
            }
        };
        if mass > 0.0 && mass.is_finite() {
            self.mass = mass;
        }
    }

    /// Learns spring and damper from what the step's force leaves.
    fn learn_rest(&mut self, way: &Way, rest: Triple) {
        let before = self.before;
        if self.in_a_row == 0.0 || before.rest == Triple::zeros() {
            return;
        }
        let [x, v, r] = [way.place - before.place, way.velocity - before.velocity, rest - before.rest];
        let new = [x.dot(&x), x.dot(&v), v.dot(&v), x.dot(&r), v.dot(&r)];
        fade(&mut self.rest, &new);
        if self.steps > SETTLED_REST
            && let Some([k, c]) = least_squares(self.rest)
        {
            (self.stiffness, self.damping) = ((-k).max(0.0), (-c).max(0.0));
        }
    }

    /// Which force it takes, as far as its jumps show.
    fn taken(&self) -> Taken {
        // Squares of what is left of the jumps, as shares; whoever asks for what is foretold holds that.
        let left = |number: usize| {
            let (by, change) = (self.by_jumps[number], self.changes[number]);
            if by > 0.0 { 1.0 - by * by / (self.jumps * change) } else { f64::INFINITY }
        };
        let best = (0..FORETOLD).min_by(|&a, &b| left(a).total_cmp(&left(b))).unwrap_or(MEAN);
        if self.derives > 0.0 {
            return Taken::Linear;
        }
        let held = if left(FORETOLD) <= 4.0 * left(best) { FORETOLD } else { best };
        let jumps = self.jumps > JUMPS * self.kinetic[0] && left(held) < UNEXPLAINED;
        if jumps { Taken::Held(held) } else { Taken::Linear }
    }

    /// The force that it takes, by name.
    pub(super) fn force(&self) -> &'static str {
        match self.taken() {
            Taken::Held(number) => NAMES[number],
            Taken::Linear => "force along a line",
        }
    }

    /// Whether it has taken enough steps to tell forces half a step apart.
    pub(super) fn shows_its_force(&self) -> bool {
        self.mass > 0.0 && self.steps > SETTLED_FORCE
    }

    /// Whether it takes a force that is not of the step's mean.
    pub(super) fn is_of_first_order(&self) -> bool {
        matches!(self.taken(), Taken::Held(number) if number != MEAN && number != FORETOLD)
    }

    /// All its numbers.
    pub(super) fn numbers(&mut self) -> impl Iterator<Item = &mut f64> {
        let Self {
            mass,
            stiffness,
            damping,
            steps,
            derives,
            in_a_row,
            jumps,
            by_jumps,
            changes,
            kinetic,
            rest,
            before,
        } = self;
        let Before { forces, line, end, acceleration, velocity, place, rest: before } = before;
        let triples = [line, end, acceleration, velocity, place, before].into_iter().chain(forces);
        let single = [mass, stiffness, damping, steps, derives, in_a_row, jumps];
        let sums = by_jumps.iter_mut().chain(changes).chain(kinetic).chain(rest);
        single.into_iter().chain(sums).chain(triples.flat_map(|triple| triple.iter_mut()))
    }
}

/// Change over a step of a force that goes along a line, by its rate at the start where the host asks for that, and its
/// mean.
/// Adds to sums of which what is old counts less and less.
fn fade(sums: &mut [f64], new: &[f64]) {
    sums.iter_mut().zip(new).for_each(|(sum, new)| *sum = FADING * *sum + new);
}

fn change_along_a_line(step: &Step, ring: usize) -> Triple {
    if step.has_rate > 0.0 { step.rate[ring] * step.length } else { step.end[ring] - step.start[ring] }
}

fn along_a_line(step: &Step, ring: usize) -> Triple {
    step.start[ring] + change_along_a_line(step, ring) * 0.5
}

/// How far the bearing's way of a ring was ahead of the host's, in the mean over the step (m).
fn gap(step: &Step, ring: usize, way: &Way, start: Triple) -> Triple {
    let [_, _, acceleration, rate] = step.motion[ring];
    let square = way.length * way.length;
    (acceleration - start) * (square / 6.0) + (rate - way.rate) * (square * way.length / 24.0)
}

/// p and q of the best y = p a + q b, by the sums aa, ab, bb, ay, by; `None` where a and b go together.
fn least_squares([aa, ab, bb, ay, by]: [f64; 5]) -> Option<[f64; 2]> {
    let determinant = aa * bb - ab * ab;
    (determinant > APART * aa * bb).then(|| [(bb * ay - ab * by) / determinant, (aa * by - ab * ay) / determinant])
}
