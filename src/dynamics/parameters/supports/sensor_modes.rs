//! What lies between the outer ring and a sensor: the modes of the structure that the sensor sits on.
//!
//! A structure on a base that accelerates by a vibrates against it in its modes, and takes the sensor along:
//! ```text
//! z'' + 2 ζ ω z' + ω² z = −a        measured: a + Σ (Γ z'' + Κ ω z')
//! H(s) = 1 − Σ (Γ s² + Κ ω s) / (s² + 2 ζ ω s + ω²)
//! ```
//! Γ, a mode's gain, is its participation factor times its shape where the sensor sits; of a structure with all its
//! modes they add up to 1. Κ is 0 unless damping couples the modes, so that points of the structure swing out of phase.
//! The base is the sensor's own body. The structure is light: nothing of it acts back, so its
//! modes are no states of the equations of motion. They follow each integration step once it is accepted, under the
//! acceleration that its dense output has: a cubic, for which the response is a power series with no error but
//! rounding.

use crate::numerics::lanes::{Kernel, Lanes, QUAD, WIDEST, Wide, dispatch};
use crate::numerics::number::Number;
use crate::numerics::polynomials::Quintic;
use crate::scene::{MOST_SENSORS, Scene};
use std::f64::consts::TAU;

/// Terms of the power series: over a radian of a mode the next are below 1/20! = 4e-19.
const TERMS: usize = 21;
/// Acceleration of a sensor's body over a step, as a cubic in the share of the step.
type Cubic = [f64; 4];

/// Modes between the outer ring and all sensors.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SensorModes {
    modes: Vec<Mode>,
    /// Share of each sensor's own acceleration that it measures, 1 − Σ Γ.
    direct: [f64; MOST_SENSORS],
    /// Index of the first sensor's displacement in a state, before its velocity; the next sensor's is [`QUAD`] more.
    index: usize,
}

/// One mode.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Mode {
    /// Number of the sensor, from 0.
    sensor: usize,
    /// ω (rad/s).
    frequency: f64,
    /// ζ.
    damping_ratio: f64,
    /// Γ.
    gain: f64,
    /// Κ.
    quadrature_gain: f64,
}

/// State and derivative of the equations of motion at both ends of a step of `length` (s).
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepEnds<'a> {
    pub(crate) states: [&'a [f64]; 2],
    pub(crate) derivatives: [&'a [f64]; 2],
    pub(crate) length: f64,
}

impl SensorModes {
    /// Those of a scene, the first sensor being at `index` of a state.
    pub(in crate::dynamics) fn new(scene: &Scene, index: usize) -> Self {
        let of_sensor = |(sensor, of): (usize, &crate::scene::Sensor)| {
            let modes = of.modes.iter();
            modes
                .map(move |mode| Mode {
                    sensor,
                    frequency: TAU * mode.frequency,
                    damping_ratio: mode.damping_ratio,
                    gain: mode.gain,
                    quadrature_gain: mode.quadrature_gain,
                })
                .collect::<Vec<_>>()
        };
        let modes: Vec<Mode> = scene.sensors.iter().enumerate().flat_map(of_sensor).collect();
        let mut direct = [1.0; MOST_SENSORS];
        for mode in &modes {
            direct[mode.sensor] -= mode.gain;
        }
        Self { modes, direct, index }
    }

    /// Length of their state: z (m) and z' (m/s) of each mode.
    pub fn state_len(&self) -> usize {
        2 * self.modes.len()
    }

    /// Moves their state from the start of a step on to a `share` of it.
    pub(crate) fn advance(&self, ends: StepEnds, share: f64, state: &mut [f64]) {
        // A sample at the very start of a step: the series gives z' as a quotient of what is 0 then.
        if share == 0.0 {
            return;
        }
        let mut states = state.as_chunks_mut::<2>().0;
        for of_sensor in self.modes.chunk_by(|one, next| one.sensor == next.sensor) {
            let acceleration = acceleration(ends, self.index + of_sensor[0].sensor * QUAD);
            let (of_these, rest) = states.split_at_mut(of_sensor.len());
            for (modes, states) in of_sensor.chunks(WIDEST).zip(of_these.chunks_mut(WIDEST)) {
                dispatch(SideBySide { modes, acceleration, length: ends.length, share, states });
            }
            states = rest;
        }
    }

    /// Rate of slot `i` of their state, while the sensors' bodies have these accelerations (m/s²).
    pub fn slope(&self, i: usize, acceleration: impl Fn(usize) -> f64, state: &[f64]) -> f64 {
        let (mode, start) = (&self.modes[i / 2], i - i % 2);
        let z = [state[start], state[start + 1]];
        if i == start { z[1] } else { mode.returning(z) - acceleration(mode.sensor) }
    }

    /// What sensor `k` measures (m/s²) while its body accelerates by `acceleration` (m/s²).
    pub fn measured(&self, k: usize, acceleration: f64, state: &[f64]) -> f64 {
        let by_mode = |(mode, z): (&Mode, [f64; 2])| mode.shown([mode.returning(z), z[1]]);
        let own = self.of(k, state).map(by_mode);
        self.direct[k] * acceleration + own.sum::<f64>()
    }

    /// Share of the acceleration of sensor `k`'s body that it measures at once.
    pub fn direct(&self, k: usize) -> f64 {
        self.direct[k]
    }

    /// Change per second (m/s³) of what sensor `k` measures, except for that of its body's acceleration.
    pub fn rate(&self, k: usize, acceleration: f64, state: &[f64]) -> f64 {
        let by_mode = |(mode, z): (&Mode, [f64; 2])| {
            let second = mode.returning(z) - acceleration;
            mode.shown([mode.returning([z[1], second]), second])
        };
        self.of(k, state).map(by_mode).sum()
    }

    fn of(&self, k: usize, state: &[f64]) -> impl Iterator<Item = (&Mode, [f64; 2])> {
        self.modes.iter().zip(state.as_chunks::<2>().0.iter().copied()).filter(move |(mode, _)| mode.sensor == k)
    }
}

impl Mode {
    /// Acceleration by its spring and damper, −2 ζ ω z' − ω² z.
    fn returning(&self, [z, rate]: [f64; 2]) -> f64 {
        -self.frequency * (2.0 * self.damping_ratio * rate + self.frequency * z)
    }

    /// What a sensor sees (m/s²) of z'' and z'.
    fn shown(&self, [second, rate]: [f64; 2]) -> f64 {
        self.gain * second + self.quadrature_gain * self.frequency * rate
    }
}

/// Up to eight modes of one sensor, moved on to a share of a step.
struct SideBySide<'a> {
    modes: &'a [Mode],
    acceleration: Cubic,
    /// Of the step (s).
    length: f64,
    share: f64,
    states: &'a mut [[f64; 2]],
}

impl Kernel for SideBySide<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) {
        let Self { modes, acceleration, length, share, states } = self;
        let mut turns = [[0.0; WIDEST]; 2];
        let (mut pieces, mut state) = ([1.0; WIDEST], [[0.0; WIDEST]; 2]);
        for (i, (mode, z)) in modes.iter().zip(&*states).enumerate() {
            [turns[0][i], turns[1][i]] = [mode.frequency, mode.damping_ratio];
            [state[0][i], state[1][i]] = *z;
            // Pieces of a radian at most.
            pieces[i] = (mode.frequency * length * share).ceil().max(1.0);
        }
        for part in 0..modes.len().div_ceil(S::F64_LANES) {
            let of = |numbers: &[f64; WIDEST]| Lanes::part(simd, numbers, part);
            let (number, count) = (|number: f64| Lanes::splat(simd, number), of(&pieces));
            let by = number(share) / count;
            let mut z = state.each_ref().map(of);
            let own = &pieces[part * S::F64_LANES..(part + 1) * S::F64_LANES];
            let most = own.iter().fold(0.0f64, |most, &pieces| most.max(pieces));
            for piece in 0..most as usize {
                let piece = number(piece as f64);
                let acceleration = section(acceleration.map(number), piece * by, by);
                let moved = follow(turns.each_ref().map(of), acceleration, number(length) * by, z);
                // A mode whose pieces are done waits for the others of its register.
                z = [0, 1].map(|k| piece.if_less(count, moved[k], z[k]));
            }
            z[0].put(&mut state[0], part);
            z[1].put(&mut state[1], part);
        }
        for (i, z) in states.iter_mut().enumerate() {
            *z = [state[0][i], state[1][i]];
        }
    }
}

/// z and z' of modes of these frequencies (rad/s) and damping ratios moved on by `h` (s), under an acceleration that is
/// a cubic in the share of that time.
#[inline(always)]
fn follow<T: Number<Plain = T>>([frequency, damping_ratio]: [T; 2], acceleration: [T; 4], h: T, z: [T; 2]) -> [T; 2] {
    let number = |number: f64| h.plain(number);
    let turn = frequency * h;
    let (damping, spring) = (number(2.0) * damping_ratio * turn, turn * turn);
    let zero = number(0.0);
    let mut terms = [zero; TERMS];
    [terms[0], terms[1]] = [z[0], h * z[1]];
    for k in 0..TERMS - 2 {
        let from = if k < acceleration.len() { h * h * acceleration[k] } else { zero };
        let (next, after) = ((k + 1) as f64, (k + 2) as f64);
        let sum = damping * number(next) * terms[k + 1] + spring * terms[k] + from;
        terms[k + 2] = -sum / number(next * after);
    }
    // From the last term on: each is in as many of the sums that make up the slope as its power says.
    let (mut sum, mut slope) = (zero, zero);
    for k in (1..TERMS).rev() {
        sum = sum + terms[k];
        slope = slope + sum;
    }
    [terms[0] + sum, slope / h]
}

/// Acceleration over a step of the body whose displacement is at this index of a state.
fn acceleration(ends: StepEnds, index: usize) -> Cubic {
    let StepEnds { states, derivatives, length } = ends;
    let seconds = derivatives.map(|rate| rate[index + 1]);
    Quintic::new(length, 0.0).second_derivative(
        states.map(|state| state[index]),
        derivatives.map(|rate| rate[index]),
        seconds,
    )
}

/// The cubic over a part of its step that begins at `from` and is `by` long, both as shares.
#[inline(always)]
fn section<T: Number<Plain = T>>([a, b, c, d]: [T; 4], from: T, by: T) -> [T; 4] {
    let (two, three) = (from.plain(2.0), from.plain(3.0));
    [
        a + from * (b + from * (c + from * d)),
        by * (b + from * (two * c + from * three * d)),
        by * by * (c + three * from * d),
        by * by * by * d,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative to the largest of what is compared; the closed forms below round as much.
    const ROUNDING: f64 = 1e-14;

    fn mode(damping_ratio: f64) -> Mode {
        Mode { sensor: 0, frequency: TAU * 3e3, damping_ratio, gain: 1.0, quadrature_gain: 0.0 }
    }

    impl Mode {
        /// Alone, and among modes that take more pieces and fewer: with the same bits.
        fn advance(&self, acceleration: &Cubic, length: f64, share: f64, z: &mut [f64; 2]) {
            let start = *z;
            let among = |frequencies: &[f64]| {
                let other = |&by: &f64| Mode { frequency: by * self.frequency, ..*self };
                let modes: Vec<Mode> = frequencies.iter().map(other).collect();
                let mut states = vec![start; modes.len()];
                let (acceleration, states_of) = (*acceleration, &mut states[..]);
                dispatch(SideBySide { modes: &modes, acceleration, length, share, states: states_of });
                states
            };
            *z = among(&[1.0])[0];
            assert_eq!(among(&[0.1, 3.0, 1.0, 7.0, 1.0, 0.0])[2], *z);
            assert_eq!(among(&[0.1, 3.0, 2.0, 7.0, 1.0, 0.0])[4], *z);
        }
    }

    #[test]
    fn a_struck_mode_rings_out_as_the_closed_form_says() {
        for damping_ratio in [0.001, 0.05, 0.7] {
            let mode = mode(damping_ratio);
            let decay = damping_ratio * mode.frequency;
            let ringing = mode.frequency * (1.0 - damping_ratio * damping_ratio).sqrt();
            // From a thousandth of a radian to nine whole turns in one step.
            for time in [5e-8, 2e-5, 3e-3] {
                let mut z = [0.0, 1.0];
                mode.advance(&[0.0; 4], time, 1.0, &mut z);
                let (fall, angle) = ((-decay * time).exp(), ringing * time);
                let expected = [
                    fall * angle.sin() / ringing,
                    fall * (angle.cos() - damping_ratio / (1.0 - damping_ratio * damping_ratio).sqrt() * angle.sin()),
                ];
                let largest = expected[0].hypot(expected[1] / mode.frequency);
                // Each of up to 57 pieces rounds.
                let limit = 60.0 * ROUNDING * largest;
                assert!((z[0] - expected[0]).abs() < limit, "{damping_ratio} {time}: {:e}", z[0] - expected[0]);
                assert!((z[1] - expected[1]).abs() < limit * mode.frequency, "{damping_ratio} {time}");
            }
        }
    }

    #[test]
    fn a_forced_mode_follows_the_polynomial_that_solves_its_equation() {
        // z = 1 − 2 s + 3 s² + 0.5 s³ in the share s of the step needs this acceleration.
        let (mode, h) = (mode(0.05), 4e-5);
        let z = |s: f64| 1.0 + s * (-2.0 + s * (3.0 + s * 0.5));
        let rate = |s: f64| (-2.0 + s * (6.0 + s * 1.5)) / h;
        let (c, k) = (2.0 * mode.damping_ratio * mode.frequency, mode.frequency * mode.frequency);
        let acceleration = [
            -(6.0 / (h * h) - c * 2.0 / h + k),
            -(3.0 / (h * h) + c * 6.0 / h - k * 2.0),
            -(c * 1.5 / h + k * 3.0),
            -k * 0.5,
        ];
        for share in [0.1, 0.5, 1.0] {
            let mut state = [z(0.0), rate(0.0)];
            mode.advance(&acceleration, h, share, &mut state);
            assert!((state[0] - z(share)).abs() < ROUNDING, "{share}");
            assert!((state[1] - rate(share)).abs() < ROUNDING * 10.0 / h, "{share}");
        }
    }

    #[test]
    fn a_part_of_a_cubic_is_that_cubic() {
        let cubic = |[a, b, c, d]: Cubic, s: f64| a + s * (b + s * (c + s * d));
        let whole = [1.0, -3.0, 2.0, 5.0];
        for s in [0.0, 0.3, 1.0] {
            let found = cubic(section(whole, 0.25, 0.5), s);
            assert!((found - cubic(whole, 0.25 + 0.5 * s)).abs() < ROUNDING, "{s}");
        }
    }
}
