//! A cage that is not even: elements off their even positions in it, and a cage that runs ahead and lags behind.
//!
//! Everything is a function of the nominal cage angle since the start, θ_n − θ_0, so there is no state but that angle,
//! and any communication step, a step taken again and a state put back give equal bits:
//! ```text
//! θ_j = θ_n + 2πj/Z + ε_j + ξ_j + W,   ω_j = ω_n (1 + ξ_j' + W')
//! ```
//! ε_j is constant: an element's position in its pocket, or an eccentric cage. ξ_j is stationary, one course for each
//! element. W is common to all: the cage's own angle, whose rate makes the slip wander. Both are cubic B-splines with
//! Gaussian coefficients from a counter hash of (seed, course, index), over knots one element spacing and three turns
//! of the cage apart. What recordings show of each is in `docs/how-to/defects.md`.
//!
//! A spline's third derivative jumps at its knots. Within a step that is some 1e-14 m of an element's way, far below
//! what integration leaves, so steps do not end there.

use super::element_block::ElementBlock;
use super::excitation::WholeAngle;
use super::kinematics::CageState;
use crate::numerics::counter_noise::gaussian;
use crate::numerics::lanes::WIDEST;
use crate::scene::CageIrregularity;
use std::f64::consts::TAU;

/// Knots of the jitter in one turn are as many as elements; those of the wander are so many turns apart.
const WANDER_TURNS: f64 = 3.0;
/// Mean square of a cubic B-spline with unit coefficients: ∫B² = 151/315.
const MEAN_SQUARE: f64 = 151.0 / 315.0;
/// That of its derivative by the knots: ∫B'² = 2/3.
const MEAN_SQUARE_OF_RATE: f64 = 2.0 / 3.0;

/// The moving part of a cage's irregularity.
#[derive(Debug, Clone)]
pub struct Irregularity {
    seed: u64,
    /// Nominal cage angle at the start (rad).
    start: f64,
    /// Standard deviation of the jitter's coefficients (rad); 0 for none.
    jitter: f64,
    /// That of the wander's (rad); 0 for none.
    wander: f64,
    /// What the wander's spline is at the start (rad).
    first: f64,
    count: usize,
}

/// An element's angle ahead of its position in an even cage that turns evenly, and its derivatives by the nominal cage
/// angle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Lead {
    /// Value (rad).
    pub angle: f64,
    /// First derivative.
    pub rate: f64,
    /// Second derivative (1/rad).
    pub second: f64,
    /// Third derivative (1/rad²).
    pub third: f64,
}

/// Cubic polynomials of the intervals that were evaluated last: nothing but a shortcut for those who ask often.
#[derive(Debug, Clone, Default)]
pub struct LeadPieces {
    /// Where they are those of the jitter, and one for each element.
    jitter: Option<PieceKey>,
    of_elements: Vec<[f64; 4]>,
    /// Where it is that of the wander.
    wander: Option<PieceKey>,
    of_cage: [f64; 4],
}

/// What a polynomial follows from.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PieceKey {
    seed: u64,
    deviation: f64,
    interval: i64,
}

/// A position among evenly spaced knots.
struct KnotPosition {
    /// Number of the interval between two of them.
    interval: i64,
    /// Share of it that is behind.
    share: f64,
}

/// Courses of random numbers; 0 is that of the constant offsets.
#[derive(Clone, Copy)]
enum NoiseSeries {
    /// Of the cage.
    Wander,
    /// Of an element.
    Jitter(usize),
}

impl NoiseSeries {
    fn number(self) -> u64 {
        match self {
            Self::Wander => 1,
            Self::Jitter(element) => 2 + element as u64,
        }
    }
}

impl std::ops::Add for Lead {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            angle: self.angle + other.angle,
            rate: self.rate + other.rate,
            second: self.second + other.second,
            third: self.third + other.third,
        }
    }
}

impl Lead {
    /// Speed (rad/s) and acceleration (rad/s²) of what is so far ahead of the nominal cage.
    #[inline]
    pub fn speed(&self, cage: &CageState) -> [f64; 2] {
        let Self { rate, second, .. } = *self;
        [cage.speed * (1.0 + rate), cage.acceleration * (1.0 + rate) + cage.speed * cage.speed * second]
    }
}

impl LeadPieces {
    /// Room for `count` elements.
    pub(in crate::dynamics) fn new(count: usize) -> Self {
        Self { of_elements: vec![[0.0; 4]; count], ..Self::default() }
    }
}

impl Irregularity {
    /// The moving part of a scene's irregularity for `count` elements, the cage being at `start` (rad) at the start;
    /// `None` where nothing moves.
    pub fn new(cage: &CageIrregularity, count: usize, start: f64) -> Option<Self> {
        if cage.jitter == 0.0 && cage.wander == 0.0 {
            return None;
        }
        let pitch = WANDER_TURNS * TAU;
        let mut uneven = Self {
            seed: cage.seed,
            start,
            jitter: cage.jitter / MEAN_SQUARE.sqrt(),
            wander: cage.wander * pitch / MEAN_SQUARE_OF_RATE.sqrt(),
            first: 0.0,
            count,
        };
        uneven.first = uneven.piece(NoiseSeries::Wander, 0, uneven.wander)[0];
        Some(uneven)
    }

    /// Lead of element `j` at an angle of the nominal cage.
    ///
    /// Out of the way of even cages, as all that asks for it is.
    #[cold]
    pub fn of_element(&self, j: usize, cage: WholeAngle) -> Lead {
        let common = self.of_cage(cage);
        if self.jitter == 0.0 {
            return common;
        }
        let KnotPosition { interval, share } = self.knot_position(cage, self.count as f64);
        common + evaluated(&self.piece(NoiseSeries::Jitter(j), interval, self.jitter), share, self.count as f64 / TAU)
    }

    /// The same with `pieces` at hand.
    #[cold]
    pub(super) fn of_element_with(&self, j: usize, cage: WholeAngle, pieces: &mut LeadPieces) -> Lead {
        let common = self.of_cage_with(cage, pieces);
        if self.jitter == 0.0 {
            return common;
        }
        let share = self.jitters(cage, pieces);
        common + evaluated(&pieces.of_elements[j], share, self.count as f64 / TAU)
    }

    /// Puts what all elements are ahead at an angle of the nominal cage, and how fast they go, into `elements`; gives
    /// the lead of the cage itself.
    #[inline(always)]
    pub(super) fn update_all(&self, cage: WholeAngle, elements: &mut [ElementBlock], pieces: &mut LeadPieces) -> Lead {
        let common = self.of_cage_with(cage, pieces);
        if self.jitter == 0.0 {
            for block in elements {
                (block.lead, block.pace) = ([common.angle; WIDEST], [1.0 + common.rate; WIDEST]);
                block.pace_by_angle = [common.second; WIDEST];
            }
            return common;
        }
        let share = self.jitters(cage, pieces);
        for (block, pieces) in elements.iter_mut().zip(pieces.of_elements.chunks(WIDEST)) {
            for (i, piece) in pieces.iter().enumerate() {
                let found = common + evaluated(piece, share, self.count as f64 / TAU);
                (block.lead[i], block.pace[i], block.pace_by_angle[i]) = (found.angle, 1.0 + found.rate, found.second);
            }
        }
        common
    }

    /// Makes `pieces` those of all elements' jitter at an instant; gives the share of their interval that is behind.
    #[inline(always)]
    fn jitters(&self, cage: WholeAngle, pieces: &mut LeadPieces) -> f64 {
        let KnotPosition { interval, share } = self.knot_position(cage, self.count as f64);
        let key = PieceKey { seed: self.seed, deviation: self.jitter, interval };
        if pieces.jitter != Some(key) {
            self.renew(pieces, key);
        }
        share
    }

    /// The polynomials of all elements' jitter in another interval.
    #[cold]
    fn renew(&self, pieces: &mut LeadPieces, key: PieceKey) {
        pieces.jitter = Some(key);
        pieces.of_elements.resize(self.count, [0.0; 4]);
        for (j, piece) in pieces.of_elements.iter_mut().enumerate() {
            *piece = self.piece(NoiseSeries::Jitter(j), key.interval, self.jitter);
        }
    }

    /// Lead of the cage itself: that of all elements together. It is 0 at the start.
    pub fn of_cage(&self, cage: WholeAngle) -> Lead {
        self.of_cage_by(cage, |interval| self.wander_piece(interval))
    }

    /// The same with `pieces` at hand.
    #[inline(always)]
    fn of_cage_with(&self, cage: WholeAngle, pieces: &mut LeadPieces) -> Lead {
        self.of_cage_by(cage, |interval| {
            let key = PieceKey { seed: self.seed, deviation: self.wander, interval };
            if pieces.wander != Some(key) {
                (pieces.wander, pieces.of_cage) = (Some(key), self.wander_piece(interval));
            }
            pieces.of_cage
        })
    }

    #[inline(always)]
    fn of_cage_by(&self, cage: WholeAngle, piece: impl FnOnce(i64) -> [f64; 4]) -> Lead {
        if self.wander == 0.0 {
            return Lead::default();
        }
        let per_turn = 1.0 / WANDER_TURNS;
        let KnotPosition { interval, share } = self.knot_position(cage, per_turn);
        evaluated(&piece(interval), share, per_turn / TAU)
    }

    /// The polynomial of the cage's lead in one interval.
    #[cold]
    fn wander_piece(&self, interval: i64) -> [f64; 4] {
        let [value, c1, c2, c3] = self.piece(NoiseSeries::Wander, interval, self.wander);
        [value - self.first, c1, c2, c3]
    }

    /// Where the cage is among knots of which there are `per_turn` in a turn.
    #[inline(always)]
    fn knot_position(&self, cage: WholeAngle, per_turn: f64) -> KnotPosition {
        // Whole turns first, so that no digits are lost to them.
        let turns = cage.turns as f64 * per_turn;
        let (whole, rest) = (turns.floor(), turns - turns.floor());
        let at = rest + (cage.rest - self.start) / TAU * per_turn;
        KnotPosition { interval: whole as i64 + at.floor() as i64, share: at - at.floor() }
    }

    /// The spline's polynomial in one interval.
    #[cold]
    fn piece(&self, course: NoiseSeries, interval: i64, deviation: f64) -> [f64; 4] {
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| deviation * gaussian(self.seed, course.number(), interval + k));
        [(a + 4.0 * b + c) / 6.0, (c - a) / 2.0, (a - 2.0 * b + c) / 2.0, (3.0 * (b - c) + (d - a)) / 6.0]
    }
}

/// A polynomial of the share of an interval, and its derivatives by the angle, of which `per_radian` intervals make one
/// radian.
#[inline(always)]
fn evaluated(&[c0, c1, c2, c3]: &[f64; 4], t: f64, per_radian: f64) -> Lead {
    let square = per_radian * per_radian;
    Lead {
        angle: c0 + t * (c1 + t * (c2 + t * c3)),
        rate: (c1 + t * (2.0 * c2 + t * 3.0 * c3)) * per_radian,
        second: (2.0 * c2 + t * 6.0 * c3) * square,
        third: 6.0 * c3 * square * per_radian,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn irregular(jitter: f64, wander: f64, seed: u64) -> Irregularity {
        let cage = CageIrregularity { offsets: vec![], drawn: None, jitter, wander, seed };
        Irregularity::new(&cage, 9, -1.2).unwrap()
    }

    fn at(turns: i64, angle: f64) -> WholeAngle {
        WholeAngle { turns, rest: angle }
    }

    #[test]
    fn leads_and_their_derivatives_are_continuous_and_belong_together() {
        let of = irregular(0.01, 0.02, 7);
        for k in 0..4000 {
            let (angle, step) = (f64::from(k) * 0.0137 - 20.0, 1e-5);
            for j in [0, 8] {
                let [before, here, after] = [-step, 0.0, step].map(|by| of.of_element(j, at(0, angle + by)));
                for (values, slope, size) in
                    [([before.angle, after.angle], here.rate, 1.0), ([before.rate, after.rate], here.second, 10.0)]
                {
                    // Central differences, a knot perhaps between them.
                    let quotient = (values[1] - values[0]) / (2.0 * step);
                    assert!((quotient - slope).abs() < 1e-5 * size, "{angle} {quotient} {slope}");
                }
                if (of.knot_position(at(0, angle), 9.0).share - 0.5).abs() < 0.4
                    && (of.knot_position(at(0, angle), 1.0 / 3.0).share - 0.5).abs() < 0.4
                {
                    let quotient = (after.second - before.second) / (2.0 * step);
                    assert!((quotient - here.third).abs() < 1e-5, "{angle} {quotient} {}", here.third);
                }
            }
        }
    }

    #[test]
    fn pieces_at_hand_change_no_bit_whatever_was_asked_before() {
        let cages =
            [irregular(0.01, 0.02, 7), irregular(0.01, 0.02, 8), irregular(0.02, 0.01, 7), irregular(0.0, 0.02, 7)];
        let (mut pieces, mut elements) = (LeadPieces::default(), vec![ElementBlock::default(); 2]);
        for k in 0..200 {
            // Forwards, backwards and to another cage.
            let (of, cage) = (&cages[k % 4], at(k as i64 % 3, f64::from(k as u32 * 7919 % 50) * 0.21 - 5.0));
            for j in [0, 8] {
                assert_eq!(of.of_element_with(j, cage, &mut pieces), of.of_element(j, cage));
            }
            assert_eq!(of.update_all(cage, &mut elements, &mut pieces), of.of_cage(cage));
            assert_eq!(elements[1].lead[0], of.of_element(8, cage).angle);
        }
    }

    #[test]
    fn turns_count_as_angles_do() {
        let of = irregular(0.01, 0.02, 3);
        for turns in [-400, -1, 0, 1, 2, 1000] {
            for angle in [-3.0, 0.1, 2.9, 7.0] {
                let (one, other) = (of.of_element(4, at(turns, angle)), of.of_element(4, at(turns - 1, angle + TAU)));
                assert!((one.angle - other.angle).abs() < 1e-13 && (one.rate - other.rate).abs() < 1e-13);
            }
        }
        assert_eq!(of.of_cage(at(0, -1.2)).angle, 0.0);
    }

    #[test]
    fn harmonics_of_passages_lose_height_as_a_normal_jitter_takes_it() {
        let sigma = 0.02 * TAU / 9.0;
        let of = irregular(sigma, 0.0, 5);
        for harmonic in [1, 3, 6] {
            let count = 60_000;
            let phase =
                |k: i32| f64::from(9 * harmonic) * of.of_element(0, at(0, of.start + f64::from(k) * TAU / 9.0)).angle;
            let mean = (0..count).map(|k| phase(k).cos()).sum::<f64>() / f64::from(count);
            // Passages are a spacing apart, where a spline has its knots and half its coefficients' mean square.
            let at_knots = 0.5 / MEAN_SQUARE;
            let expected = (-0.5 * at_knots * (TAU * f64::from(harmonic) * 0.02).powi(2)).exp();
            assert!((mean - expected).abs() < 0.01, "{harmonic}: {mean} {expected}");
        }
    }

    #[test]
    fn mean_squares_and_covariances_are_those_asked_for() {
        let (jitter, wander) = (0.004, 0.003);
        let (mut squares, mut neighbours, mut between, mut rates) = (0.0, 0.0, 0.0, 0.0);
        let count = 40_000;
        let of = irregular(jitter, wander, 11);
        let own = irregular(jitter, 0.0, 11);
        for k in 0..count {
            let angle = f64::from(k) * 0.35;
            let lead = |j: usize, angle: f64| own.of_element(j, at(0, angle)).angle;
            let here = lead(2, angle);
            squares += here * here;
            neighbours += here * lead(2, angle + TAU / 9.0);
            between += here * lead(3, angle);
            rates += of.of_cage(at(0, angle)).rate.powi(2);
        }
        let mean = |sum: f64| sum / f64::from(count);
        // About 20 000 independent coefficients: 1 % of a mean square; 740 of the wander's: 5 %.
        assert!((mean(squares).sqrt() / jitter - 1.0).abs() < 0.02, "{}", mean(squares).sqrt());
        // B₇(1)/B₇(0) = (1191/5040)/(151/315).
        assert!((mean(neighbours) / mean(squares) - 1191.0 / 2416.0).abs() < 0.02);
        assert!((mean(between) / mean(squares)).abs() < 0.03);
        assert!((mean(rates).sqrt() / wander - 1.0).abs() < 0.1, "{}", mean(rates).sqrt());
    }
}
