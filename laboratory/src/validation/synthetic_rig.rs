//! Synthetic machines: what an accelerometer on one would record while elements pass a spall of known length.
//!
//! The bearing answers by the kinematics of an element of finite size; everything behind it is drawn at random. With s
//! the way past the leading edge, L the spall's length, P = s²/(2 r_e) the way sunk and δ the approach of the most
//! loaded element,
//! ```text
//! force lost   1 − (1 − min(P(s), P(L − s))/δ)^1.5,   all of it while that is above δ;
//!                edges rounded over a random way
//! first impact   where the element meets the floor or, before that, the other edge (s = L/2)
//! last impact    where a free element takes up its load again: between L − s_u and L, P(s_u) = δ;
//!                none if it never got free
//! ```
//! On the inner raceway 1/r_e = 1/r + 1/R_i; it turns with the shaft, and force and impacts follow a load zone that is
//! drawn: the cosine of its angle, and opposite to the load 5 to 30 % of the most.
//!
//! The lost force moves the housing through modes of 0.2 to 3 kHz; impacts ring modes of 1 to 12 kHz, directly and by
//! echoes. Loudness, slip, the cage's wander, shaft harmonics, hum, a gear's tone, knocks that have nothing to do with
//! the bearing, and noise are added. It is no simulation of a machine, and shares with the estimator only the two
//! formulas of sinking; nothing in it was measured.

use brinell::geometry::hertz_constant::{HertzConstants, approach_under};
use brinell::geometry::{STRIBECK, kinematics};
use brinell::scene::Bearing;
use brinell_analysis::sizing::Raceway;
use brinell_analysis::statistics::{Random, rms};
use std::f64::consts::TAU;

/// Way before an edge at which an elastic contact begins to lose its force, in ways to get free: over the edge it has
/// lost 15 %.
const EARLY: f64 = 0.47;

/// A machine, its speed and its recorder.
#[derive(Debug, Clone, PartialEq)]
pub struct SyntheticRig {
    /// Sampling rate (Hz).
    pub rate: f64,
    /// Shaft speed (Hz).
    pub speed: f64,
    /// Load on the bearing (N).
    pub load: f64,
    /// Signal's power above the noise's (dB).
    pub noise_db: f64,
    duration: f64,
    slip: f64,
    /// Scatter of passages from even ones, and of its slow wander (degrees).
    jitter: f64,
    wander: f64,
    /// Modes of the housing and of the structure: frequency (Hz), damping, share.
    slow: Vec<[f64; 3]>,
    fast: Vec<[f64; 3]>,
    /// Delay (s) and strength.
    echoes: Vec<[f64; 2]>,
    /// Duration of an impact (s).
    impact: f64,
    /// Scatter of the impacts' loudness (of its logarithm), and that which both impacts of a passage share.
    loudness: f64,
    shared: f64,
    /// Way from the edge to the floor (degrees).
    floor: f64,
    /// Strength of the first impact, the last being 1, and of the entry's excursion.
    first: f64,
    entry: f64,
    /// Way over which edges are rounded (degrees).
    rounded: f64,
    /// Where between L − s_u and L the load is taken up, 0 to 1.
    reload: f64,
    /// Amplitudes in shares of the signal's root mean square: shaft harmonics, hum, gear; knocks per second and their
    /// strength.
    shaft: f64,
    hum: [f64; 2],
    gear: [f64; 2],
    knocks: [f64; 2],
}

impl SyntheticRig {
    /// A machine drawn at random.
    pub fn draw(random: &mut Random) -> Self {
        let rates = [12_000.0, 12_800.0, 20_000.0, 25_600.0, 32_000.0, 48_000.0, 51_200.0, 64_000.0, 96_000.0];
        let rate = rates[random.below(rates.len())];
        let sometimes = |random: &mut Random, chance: f64| random.uniform() < chance;
        let modes = |random: &mut Random, count: usize, low: f64, high: f64, damping: [f64; 2]| -> Vec<[f64; 3]> {
            let mode = |random: &mut Random| {
                let frequency = logarithmic(random, low, high);
                [frequency, logarithmic(random, damping[0], damping[1]), uniform(random, 0.2, 1.0)]
            };
            (0..count).map(|_| mode(random)).collect()
        };
        let (few, many) = (1 + random.below(3), 3 + random.below(5));
        let echoes = (0..random.below(4)).map(|_| [uniform(random, 1e-4, 7e-4), uniform(random, 0.15, 0.5)]).collect();
        let hum = if sometimes(random, 0.5) { uniform(random, 0.0, 0.7) } else { 0.0 };
        let gear = if sometimes(random, 0.3) { uniform(random, 0.0, 0.5) } else { 0.0 };
        let knocks = if sometimes(random, 0.3) { logarithmic(random, 1.0, 20.0) } else { 0.0 };
        Self {
            rate,
            speed: logarithmic(random, 5.0, 40.0),
            load: logarithmic(random, 30.0, 1000.0),
            noise_db: uniform(random, 0.0, 30.0),
            duration: uniform(random, 3.0, 6.0),
            slip: uniform(random, 0.0, 0.02),
            jitter: uniform(random, 0.02, 0.3),
            wander: uniform(random, 0.0, 0.5),
            slow: modes(random, few, 200.0, 3000.0, [0.02, 0.15]),
            fast: modes(random, many, 1000.0, (0.45 * rate).min(12_000.0), [0.005, 0.04]),
            echoes,
            impact: logarithmic(random, 1e-5, 8e-5),
            loudness: uniform(random, 0.05, 0.4),
            shared: uniform(random, 0.0, 0.3),
            floor: uniform(random, 0.7, 3.0),
            first: logarithmic(random, 0.3, 2.5),
            entry: logarithmic(random, 0.2, 2.0),
            rounded: uniform(random, 0.0, 0.3),
            reload: random.uniform(),
            shaft: uniform(random, 0.0, 0.5),
            hum: [if sometimes(random, 0.5) { 50.0 } else { 60.0 }, hum],
            gear: [logarithmic(random, 300.0, 3000.0), gear],
            knocks: [knocks, logarithmic(random, 0.5, 3.0)],
        }
    }

    /// What it records of a spall of `length` degrees of a raceway, 0 of a healthy bearing.
    pub fn record(&self, bearing: &Bearing, raceway: Raceway, length: f64, random: &mut Random) -> Vec<f64> {
        let count = (self.duration * self.rate) as usize;
        let spacing = 360.0 / bearing.element_count as f64;
        let frequencies = kinematics::frequencies(bearing, self.slip, self.speed);
        let inner = raceway == Raceway::Inner;
        let travel = spacing * if inner { frequencies.bpfi } else { frequencies.bpfo };
        let opposite = if inner { logarithmic(random, 0.05, 0.3) } else { 1.0 };
        let spall = Spall { length, free: unloading(bearing, raceway, self.load), travel };
        let (mut force, mut impacts) = (vec![0.0; count], vec![0.0; count]);
        let mut wander = 0.0;
        for k in 1..(self.duration * travel / spacing) as usize {
            // A passage forgets its wander after twenty.
            wander += -0.05 * wander + 0.3 * self.wander * random.normal();
            let edge = (k as f64 * spacing + wander + self.jitter * random.normal()) / travel;
            let load = if inner { libm::cos(TAU * self.speed * edge).max(opposite) } else { 1.0 };
            if length > 0.0 {
                self.pass(spall, edge, load, &mut force, &mut impacts, random);
            }
        }
        self.ring(force, impacts, random)
    }

    /// One element over the spall, whose leading edge it meets at a time (s) under a share of the load.
    fn pass(&self, spall: Spall, edge: f64, load: f64, force: &mut [f64], impacts: &mut [f64], random: &mut Random) {
        let Spall { length, free, travel } = spall;
        let never_free = 0.5 * length < free;
        let until = if never_free { length } else { length - self.reload * free };
        let reach = length + 3.0 * self.rounded + 2.0 * free;
        let from = ((edge - (3.0 * self.rounded + free) / travel) * self.rate) as usize;
        for (i, f) in force
            .iter_mut()
            .enumerate()
            .skip(from)
            .take(((reach + 3.0 * self.rounded) / travel * self.rate) as usize + 2)
        {
            let s = (i as f64 / self.rate - edge) * travel;
            let lost = |s: f64| {
                let sunk = if s > until {
                    0.0
                } else {
                    (s.min(length - s) + EARLY * free).clamp(0.0, (1.0 + EARLY) * free) / ((1.0 + EARLY) * free)
                };
                let entering = s < 0.5 * length;
                // Free up to the reload, which is a step.
                let sunk = if entering || never_free { sunk } else { f64::from(u8::from(s < until)) };
                1.0 - (1.0 - sunk * sunk).powf(1.5)
            };
            // An edge that is rounded lets go a little at a time.
            let shares = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|share| lost(s + share * self.rounded));
            *f -= load * shares.iter().sum::<f64>() / 5.0;
        }
        let both = self.shared * random.normal();
        let mut impact = |s: f64, strength: f64| {
            let loud = load * strength * (both + self.loudness * random.normal()).exp();
            add_impact(impacts, edge + s / travel, loud, self.impact, self.rate, &self.echoes);
        };
        impact(self.floor.min(0.5 * length), self.first);
        if !never_free {
            impact(until, 1.0);
        }
    }

    /// The machine around it.
    fn ring(&self, force: Vec<f64>, impacts: Vec<f64>, random: &mut Random) -> Vec<f64> {
        let slow = normed(modal(&force, &self.slow, self.rate, true));
        let fast = normed(modal(&impacts, &self.fast, self.rate, false));
        let mut all: Vec<f64> = slow.iter().zip(&fast).map(|(low, high)| self.entry * low + high).collect();
        let signal = rms(&all);
        let unit = if signal > 0.0 { signal } else { 1.0 };
        let mut knocks = vec![0.0; all.len()];
        for _ in 0..(self.knocks[0] * self.duration) as usize {
            add_impact(
                &mut knocks,
                random.uniform() * self.duration,
                random.normal(),
                self.impact,
                self.rate,
                &self.echoes,
            );
        }
        let knocks = normed(modal(&knocks, &self.fast, self.rate, false));
        let phases: Vec<f64> = (0..7).map(|_| TAU * random.uniform()).collect();
        let noise = libm::pow(10.0, -self.noise_db / 20.0);
        for (i, x) in all.iter_mut().enumerate() {
            let t = i as f64 / self.rate;
            let tone = |frequency: f64, phase: usize| libm::sin(TAU * frequency * t + phases[phase]);
            let shaft: f64 = (1..=3).map(|k| tone(k as f64 * self.speed, k - 1) / k as f64).sum();
            let hum: f64 = [1, 3, 5].iter().map(|&k| tone(f64::from(k) * self.hum[0], 3) / f64::from(k)).sum();
            let gear = tone(self.gear[0], 4) * (1.0 + 0.5 * tone(self.speed, 5));
            *x += unit * (self.shaft * shaft + self.hum[1] * hum + self.gear[1] * gear + noise * random.normal());
            *x += unit * if self.knocks[0] > 0.0 { self.knocks[1] * knocks[i] } else { 0.0 };
        }
        all
    }
}

/// A spall as an element meets it.
#[derive(Clone, Copy)]
struct Spall {
    /// Length (degrees).
    length: f64,
    /// Way (degrees) after which the most loaded element is free.
    free: f64,
    /// Element travel per second (degrees).
    travel: f64,
}

/// Way (degrees) after which the most loaded element is free.
fn unloading(bearing: &Bearing, raceway: Raceway, load: f64) -> f64 {
    let force = STRIBECK * load / bearing.element_count as f64;
    raceway.sunk_after(bearing, approach_under(force, HertzConstants::of(bearing).in_series()))
}

/// A half-sine of unit impulse, and its echoes.
fn add_impact(signal: &mut [f64], at: f64, strength: f64, duration: f64, rate: f64, echoes: &[[f64; 2]]) {
    for &[delay, share] in std::iter::once(&[0.0, 1.0]).chain(echoes) {
        let begin = (at + delay) * rate;
        let width = duration * rate;
        let first = begin.ceil().max(0.0) as usize;
        // What falls into each sample: differences of the half-sine's integral.
        let done = |i: f64| 0.5 - 0.5 * libm::cos(std::f64::consts::PI * ((i - begin) / width).clamp(0.0, 1.0));
        for (i, x) in signal.iter_mut().enumerate().skip(first).take(width as usize + 2) {
            *x += strength * share * (done(i as f64) - done(i as f64 - 1.0));
        }
    }
}

/// Response of resonators to a force: acceleration if asked, else velocity, which impacts excite at all frequencies
/// alike. Each is the exact recursion of a mode that is hit by a series of impulses.
fn modal(force: &[f64], modes: &[[f64; 3]], rate: f64, acceleration: bool) -> Vec<f64> {
    let mut sum = vec![0.0; force.len()];
    for &[frequency, damping, share] in modes {
        let omega = TAU * frequency / rate;
        let decay = libm::exp(-damping * omega);
        let turn = omega * (1.0 - damping * damping).sqrt();
        let (re, im) = (decay * libm::cos(turn), decay * libm::sin(turn));
        let (mut a, mut b) = (0.0, 0.0);
        for (s, f) in sum.iter_mut().zip(force) {
            (a, b) = (re * a - im * b + f, re * b + im * a);
            // Displacement is b/ω; acceleration is what is left of the force when spring and damper have theirs.
            *s += share * if acceleration { f - omega * (b + 2.0 * damping * a) } else { a };
        }
    }
    sum
}

fn normed(mut signal: Vec<f64>) -> Vec<f64> {
    let norm = rms(&signal);
    if norm > 0.0 {
        signal.iter_mut().for_each(|x| *x /= norm);
    }
    signal
}

fn uniform(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.uniform()
}

fn logarithmic(random: &mut Random, low: f64, high: f64) -> f64 {
    low * (high / low).powf(random.uniform())
}
