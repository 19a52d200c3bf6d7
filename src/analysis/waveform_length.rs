//! Spall length as the trial spall whose simulated passage is most like the measured one; see [`synthesis`].
//!
//! The search goes from coarse to fine: lengths in steps of a degree up to two element spacings (an extended spall looks like
//! a line spall one spacing shorter, but for the frequency of its ringing), with the cheap contact law; the three best finer;
//! the best with several depths and the scene's own law. A parabola through the best three lengths gives the last digits.
//!
//! [`synthesis`]: super::synthesis

use super::measured::Measured;
use super::passages;
use super::statistics::{self, Random};
use super::synthesis::{POINTS, Rig, Run, Trial, below_cut, best_shift, likeness};
use crate::scene::{ContactLaw, Scene};

/// Likeness from which the scene's rig is taken to be the recording's.
pub const LIKE: f64 = 0.9;
/// Likeness of the coarse search below which the fine one is not worth its time.
const HOPELESS: f64 = 0.6;
/// Depth of trial spalls [m]: where elements do not reach the floor, it does not matter.
const DEPTH: f64 = 100e-6;
/// Other depths tried at the best length [m].
const OTHER_DEPTHS: [f64; 4] = [25e-6, 50e-6, 200e-6, 400e-6];
/// Resamplings of the passages.
const RESAMPLINGS: usize = 60;
/// Step of the last search [degrees].
const FINE: f64 = 0.1;
/// Half the range in which the contact's width can shift a length [degrees].
const WIDE: f64 = 0.8;

/// Length by likeness. Angles in degrees of the outer raceway.
#[derive(Debug, Clone, PartialEq)]
pub struct WaveformLength {
    /// Length.
    pub length: f64,
    /// Depth of the best trial [m].
    pub depth: f64,
    /// Standard uncertainty from the scatter of passages.
    pub statistical: f64,
    /// Standard uncertainty from depths that fit as well.
    pub systematic: f64,
    /// Likeness of the best trial.
    pub likeness: f64,
    /// Largest likeness of a trial that is a line spall, and of one that is extended.
    pub by_kind: [f64; 2],
    /// Where in a period an entry begins [share of it].
    pub entry: f64,
    /// The most alike passage, moved over the measured one and turned its way: [`POINTS`] points from the period's start, norm 1.
    pub model: Vec<f64>,
}

/// A rig that is not the recording's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NotAlike {
    /// Likeness of the best trial; 0 where none could be simulated.
    pub likeness: f64,
}

/// Sizes the recording by the scene's rig.
///
/// # Errors
/// A rig that cannot be simulated, or sounds different.
pub fn estimate(measured: &Measured, scene: &Scene, rig: &Rig<'_>) -> Result<WaveformLength, NotAlike> {
    let mut heard = NotAlike { likeness: 0.0 };
    let found = search(measured, scene, rig, &mut heard);
    found.ok_or(heard)
}

fn search(measured: &Measured, scene: &Scene, rig: &Rig<'_>, heard: &mut NotAlike) -> Option<WaveformLength> {
    let rows = measured.signal_rows(0.0, POINTS);
    let target = below_cut(&passages::average(&rows), measured.bpfo);
    let search = Search { rig, target: &target };
    let spacing = measured.spacing;
    let simple = |length: f64| Trial { length, depth: DEPTH, law: ContactLaw::Hertz };
    let coarse: Vec<Trial> =
        lengths(1.0, 1.95 * spacing, 1.0).filter(|l| (l / spacing - 1.0).abs() > 0.02).map(simple).collect();
    let mut found = search.fits(&coarse, Run::Short);
    heard.likeness = found.first()?.likeness;
    if heard.likeness < HOPELESS {
        return None;
    }
    let mut near: Vec<f64> = Vec::new();
    for fit in &found {
        if near.len() < 3 && near.iter().all(|l| (l - fit.trial.length).abs() > 1.5) {
            near.push(fit.trial.length);
        }
    }
    let closer: Vec<Trial> = near.iter().flat_map(|&l| lengths((l - 0.8).max(0.3), l + 0.8, 0.2)).map(simple).collect();
    let closer = search.fits(&closer, Run::Short);
    let around = closer.first()?.trial.length;
    found.extend(closer);
    let mut peaks: Vec<Peak> = std::iter::once(DEPTH)
        .chain(OTHER_DEPTHS)
        .filter_map(|depth| search.peak(around, Trial { length: around, depth, law: ContactLaw::Hertz }))
        .collect();
    let likest = peaks.iter().map(|p| p.likeness).fold(0.0, f64::max);
    // As good as the best: within half of what the best itself leaves unexplained.
    let limit = likest - 0.5 * (1.0 - likest).max(1e-3);
    peaks.retain(|p| p.likeness >= limit);
    let range = peaks.iter().fold((f64::MAX, f64::MIN), |(l, h), p| (l.min(p.length), h.max(p.length)));
    // The first is the usual depth, if it is as good: a depth that elements do not reach leaves no trace.
    let cheap = peaks.into_iter().next()?;
    let own = search.with_law(&cheap, scene.contact.law);
    let best = own.unwrap_or_else(|| OwnLaw {
        length: cheap.length,
        likeness: cheap.likeness,
        passage: cheap.fits[cheap.top].passage.clone(),
    });
    heard.likeness = best.likeness;
    if best.likeness < LIKE {
        return None;
    }
    let of_kind = |extended: bool| {
        let all = found.iter().filter(|f| (f.trial.length > spacing) == extended);
        all.map(|f| f.likeness).fold(if (best.length > spacing) == extended { best.likeness } else { 0.0 }, f64::max)
    };
    let (shift, _) = best_shift(&target, &best.passage);
    Some(WaveformLength {
        length: best.length,
        depth: cheap.depth,
        statistical: bootstrap(&rows, measured.bpfo, &cheap),
        systematic: 0.5 * (range.1 - range.0) / 3f64.sqrt(),
        likeness: best.likeness,
        by_kind: [of_kind(false), of_kind(true)],
        entry: (shift - 0.5 * best.length / spacing).rem_euclid(1.0),
        model: moved_over(&target, &best.passage, shift),
    })
}

/// A trial with its passage.
#[derive(Debug, Clone)]
struct Fit {
    trial: Trial,
    likeness: f64,
    passage: Vec<f64>,
}

struct Search<'a> {
    rig: &'a Rig<'a>,
    target: &'a [f64],
}

impl Search<'_> {
    /// The top of likeness around a length.
    fn peak(&self, around: f64, trial: Trial) -> Option<Peak> {
        let from = (around - 3.0 * FINE).max(FINE);
        let trials: Vec<Trial> =
            lengths(from, around + 3.0 * FINE, FINE).map(|length| Trial { length, ..trial }).collect();
        Peak::of(self.fits(&trials, Run::Long), self.target)
    }

    /// The same by a law that minds the contact's width and so shifts the edges, with two runs of it: a map is dear.
    ///
    /// How long a run by that law seems to be when measured with the cheap law's runs says how much that law errs.
    fn with_law(&self, peak: &Peak, law: ContactLaw) -> Option<OwnLaw> {
        // The map is the grid's law, computed beforehand.
        let law = if law == ContactLaw::Love { ContactLaw::Map } else { law };
        if law == ContactLaw::Hertz {
            return None;
        }
        let trial = |length: f64, law: ContactLaw| Trial { length, depth: peak.depth, law };
        let ruler: Vec<Trial> = lengths((peak.length - WIDE).max(FINE), peak.length + WIDE, FINE)
            .map(|length| trial(length, ContactLaw::Hertz))
            .collect();
        let mut ruler = self.fits(&ruler, Run::Long);
        ruler.sort_by(|a, b| a.trial.length.total_cmp(&b.trial.length));
        let seems = top(&ruler, self.target)?.0;
        let mut length = seems;
        let mut passage = Vec::new();
        for _ in 0..2 {
            passage = self.rig.passage(trial(length, law), Run::Long).ok()?;
            length = (length - (top(&ruler, &passage)?.0 - seems)).max(FINE);
        }
        Some(OwnLaw { length, likeness: likeness(self.target, &passage), passage })
    }

    /// The trials in the order of their likeness; those that cannot be simulated are left out.
    fn fits(&self, trials: &[Trial], run: Run) -> Vec<Fit> {
        let threads = std::thread::available_parallelism().map_or(1, |n| n.get().min(8));
        let share = trials.len().div_ceil(threads).max(1);
        let fit = |&trial: &Trial| {
            let passage = self.rig.passage(trial, run).ok()?;
            Some(Fit { trial, likeness: likeness(self.target, &passage), passage })
        };
        let mut fits: Vec<Fit> = std::thread::scope(|scope| {
            let parts: Vec<_> = trials
                .chunks(share)
                .map(|part| scope.spawn(move || part.iter().filter_map(fit).collect::<Vec<_>>()))
                .collect();
            parts.into_iter().flat_map(|part| part.join().unwrap_or_default()).collect()
        });
        fits.sort_by(|a, b| b.likeness.total_cmp(&a.likeness));
        fits
    }
}

/// The answer by the scene's own law.
struct OwnLaw {
    length: f64,
    likeness: f64,
    passage: Vec<f64>,
}

/// The top of likeness over length at one depth.
#[derive(Debug, Clone)]
struct Peak {
    length: f64,
    depth: f64,
    likeness: f64,
    /// In the order of length.
    fits: Vec<Fit>,
    top: usize,
}

impl Peak {
    fn of(mut fits: Vec<Fit>, target: &[f64]) -> Option<Self> {
        fits.sort_by(|a, b| a.trial.length.total_cmp(&b.trial.length));
        let depth = fits.first()?.trial.depth;
        let (length, likeness, top) = top(&fits, target)?;
        Some(Self { length, depth, likeness, fits, top })
    }
}

/// Length, likeness and index at the top of the parabola through the best three.
fn top(fits: &[Fit], target: &[f64]) -> Option<(f64, f64, usize)> {
    let like: Vec<f64> = fits.iter().map(|f| likeness(target, &f.passage)).collect();
    let i = (0..like.len()).max_by(|&a, &b| like[a].total_cmp(&like[b]))?;
    let length = fits[i].trial.length;
    if i == 0 || i + 1 == fits.len() {
        return Some((length, like[i], i));
    }
    let (a, b, c) = (like[i - 1], like[i], like[i + 1]);
    let bend = a - 2.0 * b + c;
    let shift = if bend < 0.0 { 0.5 * (a - c) / bend } else { 0.0 };
    Some((length + shift * FINE, b, i))
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
            top(&best.fits, &below_cut(&sum, bpfo)).map(|(length, _, _)| length)
        })
        .collect();
    statistics::spread(&lengths)
}

fn lengths(from: f64, to: f64, step: f64) -> impl Iterator<Item = f64> {
    let count = ((to - from) / step + 1e-9).floor().max(0.0) as usize;
    (0..=count).map(move |i| from + step * i as f64)
}
