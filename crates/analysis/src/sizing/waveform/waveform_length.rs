//! Spall length as the trial spall whose simulated passage is most like the measured one; see [`synthesis`].
//!
//! The search goes from coarse to fine: lengths in steps of a degree up to two element spacings (an extended spall
//! looks like a line spall one spacing shorter, except for the frequency of its ringing), deep and, if nothing deep is
//! alike, with floors within the elements' reach, by the cheap contact law; from the best three a climb in length and
//! depth; the best of these with other depths and the scene's own law. A parabola through the best three lengths gives
//! the last digits.
//!
//! A healthy bearing is not silent: as elements take up load and lose it again, it makes a passage of its own. One that
//! explains the recording as well as the best trial says that there is no spall to size.
//!
//! [`synthesis`]: super::synthesis

use super::synthesis::{POINTS, Rig, Run, Trial, below_cut, best_shift, similarity};
use super::trial_search::{FINE, Fit, Peak, Search, lengths, top};
use crate::sizing::measured::Measured;
use crate::sizing::passages::{RESAMPLINGS, fold};
use crate::sizing::raceway;
use crate::sizing::raceway::Raceway;
use crate::statistics;
use crate::statistics::Random;
use brinell::scene::{ContactLaw, Scene};

/// Similarity from which the scene's rig is taken to be the recording's.
pub(crate) const LIKE: f64 = 0.9;
/// Similarity of the coarse search below which the fine one is not worth its time.
const HOPELESS: f64 = 0.5;
/// Depth of the first trial spalls (m): where elements do not reach the floor, it does not matter.
const DEPTH: f64 = 100e-6;
/// Shallow trials, in approaches of the most loaded element: at 3.3 of them the neighbours' squeeze brings the inner
/// ring down to the floor of an extended spall.
const SHALLOW: [f64; 5] = [4.4, 3.4, 2.6, 2.0, 1.5];
/// Depths tried beside the best, as shares of it.
const OTHER_DEPTHS: [f64; 4] = [0.5, 0.25, 2.0, 4.0];
/// Step of the ladder (degrees); half of it where elements stand on the floor, for similarity falls off more steeply
/// there.
const STEP: f64 = 1.0;
/// Climbs from the ladder's best trials at most.
const BEGINNINGS: usize = 4;
/// Similarity at the top of a climb after which no other is tried.
const UNMISTAKABLE: f64 = 0.97;

/// Length by similarity. Angles in degrees of the outer raceway.
#[derive(Debug, Clone, PartialEq)]
pub struct WaveformLength {
    /// Length.
    pub length: f64,
    /// Depth of the best trial (m).
    pub depth: f64,
    /// Standard uncertainty from the scatter of passages.
    pub statistical: f64,
    /// Standard uncertainty from depths that fit as well.
    pub systematic: f64,
    /// Similarity of the best trial.
    pub similarity: f64,
    /// Largest similarity of a trial that is a line spall, and of one that is extended.
    pub by_kind: [f64; 2],
    /// Where in a period an entry begins (share of it).
    pub entry: f64,
    /// The most alike passage, moved over the measured one, with its sign: [`POINTS`] points from the period's
    /// start, norm 1.
    pub model: Vec<f64>,
}

/// Why the scene's rig gives no length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mismatch {
    /// It is not the recording's: similarity of the best trial, 0 where none could be simulated.
    OtherRig(f64),
    /// The rig without a spall explains the recording as well as the best trial.
    Healthy {
        /// Similarity of the rig without a spall.
        similarity: f64,
        /// Whether no trial is better, so that nothing speaks for a spall.
        surely: bool,
    },
}

/// What was tried.
#[derive(Default)]
struct Tried {
    /// Largest similarity of all trials.
    best: f64,
    /// That of the trial which the answer rests on, if it came so far.
    decisive: Option<f64>,
}

/// Sizes the recording by the scene's rig.
///
/// # Errors
/// A rig that cannot be simulated, or sounds different, or without a spall as similar as with one.
pub(crate) fn estimate(measured: &Measured, scene: &Scene, rig: &Rig<'_>) -> Result<WaveformLength, Mismatch> {
    let rows = measured.signal_rows(0.0, POINTS);
    let target = below_cut(&fold::average(&rows), measured.bpfo);
    let healthy = rig.healthy_passage().map_or(0.0, |passage| similarity(&target, &passage));
    // Whatever a trial leaves unexplained, this is within half of it.
    if healthy >= as_good_as(1.0) {
        return Err(Mismatch::Healthy { similarity: healthy, surely: true });
    }
    let mut tried = Tried::default();
    let found = search(measured, scene, &Search { rig, target: &target }, &rows, &mut tried);
    if healthy >= as_good_as(tried.best).max(LIKE) {
        return Err(Mismatch::Healthy { similarity: healthy, surely: healthy >= tried.best });
    }
    found.ok_or(Mismatch::OtherRig(tried.decisive.unwrap_or(tried.best)))
}

/// Similarity from which a passage is as good as the best: within half of what the best itself leaves unexplained.
fn as_good_as(best: f64) -> f64 {
    best - 0.5 * (1.0 - best).max(1e-3)
}

/// The length, if the rig is alike; `tried` is set in any case.
fn search(
    measured: &Measured,
    scene: &Scene,
    search: &Search<'_>,
    rows: &[Vec<f64>],
    tried: &mut Tried,
) -> Option<WaveformLength> {
    let spacing = measured.spacing;
    let simple = |length: f64, depth: f64| Trial { length, depth, law: ContactLaw::Hertz };
    let ladder = |depth: f64, step: f64| -> Vec<Trial> {
        let all = lengths(1.0, 1.95 * spacing, step).filter(|l| (l / spacing - 1.0).abs() > 0.02);
        all.map(|length| simple(length, depth)).collect()
    };
    let mut found = search.fits(&ladder(DEPTH, STEP), Run::Short);
    tried.best = found.first()?.similarity;
    let mut climbed = climbs(search, &found);
    if climbed.first().is_none_or(|best| best.similarity < LIKE)
        && let Some(approach) = raceway::approach(scene)
    {
        let shallow: Vec<Trial> = SHALLOW.iter().flat_map(|times| ladder(times * approach, 0.5 * STEP)).collect();
        found.extend(search.fits(&shallow, Run::Short));
        found.sort_by(|a, b| b.similarity.total_cmp(&a.similarity));
        climbed = climbs(search, &found);
    }
    tried.best = climbed.first().map_or(tried.best, |best| best.similarity);
    let Trial { length: around, depth, .. } = climbed.first()?.trial;
    found.extend(climbed);
    // The usual depth once only, where the climb has not left it.
    let mut peaks: Vec<Peak> = std::iter::once(DEPTH)
        .chain((depth != DEPTH).then_some(depth))
        .chain(OTHER_DEPTHS.iter().map(|share| share * depth))
        .filter_map(|depth| search.peak(around, simple(around, depth)))
        .collect();
    let likest = peaks.iter().map(|p| p.similarity).fold(0.0, f64::max);
    peaks.retain(|p| p.similarity >= as_good_as(likest));
    let [shortest, longest] = statistics::extent(peaks.iter().map(|peak| peak.length));
    // The first is the usual depth, if it is as good: a depth that elements do not reach leaves no trace.
    let cheap = peaks.into_iter().next()?;
    // Below what can be resolved the law's last tenth of a degree decides nothing, and its map is dear.
    let short = raceway::shortest_length(scene, Raceway::Outer).is_some_and(|limit| cheap.length + 2.0 * FINE < limit);
    let own = if short { None } else { search.with_law(&cheap, scene.contact.law) };
    // Of the cheap law the most alike passage; its length lies between trials.
    let length = own.as_ref().map_or(cheap.length, |own| own.trial.length);
    let best = own.unwrap_or_else(|| cheap.fits[cheap.top].clone());
    tried.best = tried.best.max(likest).max(best.similarity);
    tried.decisive = Some(best.similarity);
    if best.similarity < LIKE {
        return None;
    }
    let of_kind = |extended: bool| {
        let all = found.iter().filter(|f| (f.trial.length > spacing) == extended);
        all.map(|f| f.similarity).fold(if (length > spacing) == extended { best.similarity } else { 0.0 }, f64::max)
    };
    let shift = best_shift(search.target, &best.passage).shift;
    Some(WaveformLength {
        length,
        depth: cheap.depth,
        statistical: bootstrap(rows, measured.bpfo, &cheap),
        systematic: 0.5 * (longest - shortest) / 3f64.sqrt(),
        similarity: best.similarity,
        by_kind: [of_kind(false), of_kind(true)],
        entry: (shift - 0.5 * length / spacing).rem_euclid(1.0),
        model: moved_over(search.target, &best.passage, shift),
    })
}

/// Climbs from the best trials of a ladder that differ, the best first; none where all are hopeless.
fn climbs(search: &Search<'_>, found: &[Fit]) -> Vec<Fit> {
    let mut climbed: Vec<Fit> = Vec::new();
    let mut beginnings: Vec<&Fit> = Vec::new();
    for fit in found.iter().filter(|fit| fit.similarity >= HOPELESS) {
        let differs = |b: &&Fit| {
            let ratio = libm::log(b.trial.depth / fit.trial.depth).abs();
            (b.trial.length - fit.trial.length).abs() > 0.8 || ratio > 0.2
        };
        if beginnings.len() == BEGINNINGS || climbed.last().is_some_and(|top| top.similarity > UNMISTAKABLE) {
            break;
        }
        if beginnings.iter().all(differs) {
            beginnings.push(fit);
            climbed.push(search.climb(fit));
        }
    }
    climbed.sort_by(|a, b| b.similarity.total_cmp(&a.similarity));
    climbed
}

/// The passage moved by `shift` periods, its sign that of the target.
fn moved_over(target: &[f64], passage: &[f64], shift: f64) -> Vec<f64> {
    let n = passage.len();
    let by = (shift * n as f64).round() as usize;
    let mut moved: Vec<f64> = (0..n).map(|i| passage[(i + 2 * n - by) % n]).collect();
    let product: f64 = moved.iter().zip(target).map(|(a, b)| a * b).sum();
    moved.iter_mut().for_each(|x| *x *= product.signum());
    moved
}

fn bootstrap(rows: &[Vec<f64>], bpfo: f64, best: &Peak) -> f64 {
    let mut random = Random::new(rows.len() as u64);
    let lengths: Vec<f64> = (0..RESAMPLINGS)
        .filter_map(|_| {
            let mut sum = vec![0.0; POINTS];
            for _ in 0..rows.len() {
                for (s, x) in sum.iter_mut().zip(&rows[random.below(rows.len())]) {
                    *s += x;
                }
            }
            top(&best.fits, &below_cut(&sum, bpfo)).map(|top| top.length)
        })
        .collect();
    statistics::spread(&lengths)
}
