//! The search among trial spalls for the one whose simulated passage is most like a measured one.
//!
//! Similarity has one top per spall but many lower ones beside it (a period of ringing off), so that a ladder of
//! lengths comes first. From the best rungs the search climbs in length and depth together: where elements reach the
//! floor, a micrometre of depth moves their strikes as much as a tenth of a degree of length does, and neither is found
//! without the other.

use super::synthesis::{Rig, Run, Trial, similarity};
use brinell::scene::ContactLaw;
use rayon::prelude::*;

/// Step of the last search (degrees).
pub(super) const FINE: f64 = 0.1;
/// Half the range in which the contact's width can shift a length (degrees).
const WIDE: f64 = 0.8;
/// First steps of a climb, in length (degrees) and as a ratio of depths.
const FIRST_STEPS: (f64, f64) = (0.4, 1.25);
/// Times the steps are halved: to a twentieth of a degree and 3 % of the depth.
const HALVINGS: usize = 3;
/// Steps after which a climb is given up; usual ones take fewer than ten.
const MOST_STEPS: usize = 24;

/// A trial with its passage.
#[derive(Debug, Clone)]
pub(crate) struct Fit {
    pub(crate) trial: Trial,
    pub(crate) similarity: f64,
    pub(crate) passage: Vec<f64>,
}

/// A rig, and the measured passage that its trials are compared with.
pub(super) struct Search<'a> {
    pub(crate) rig: &'a Rig<'a>,
    pub(crate) target: &'a [f64],
}

impl Search<'_> {
    /// Climbs from a trial to the nearest top of similarity over length and depth.
    pub(super) fn climb(&self, from: &Fit) -> Fit {
        let mut best = from.clone();
        let (mut by_length, mut by_depth) = FIRST_STEPS;
        let mut halvings = 0;
        // Neighbours of one trial are neighbours of the next, and were less similar.
        let mut tried = vec![from.trial];
        for _ in 0..MOST_STEPS {
            let around = [-1.0, 0.0, 1.0].into_iter().flat_map(|l| [1.0 / by_depth, 1.0, by_depth].map(|d| (l, d)));
            let trials: Vec<Trial> = around
                .filter(|&step| step != (0.0, 1.0))
                .map(|(l, d)| Trial {
                    length: (best.trial.length + l * by_length).max(FINE),
                    depth: best.trial.depth * d,
                    ..best.trial
                })
                .filter(|trial| !tried.iter().any(|before| is_same(before, trial)))
                .collect();
            tried.extend(&trials);
            let next = self.fits(&trials, Run::Short).into_iter().next();
            if let Some(next) = next.filter(|next| next.similarity > best.similarity) {
                best = next;
            } else if halvings < HALVINGS {
                halvings += 1;
                by_length *= 0.5;
                by_depth = by_depth.sqrt();
            } else {
                break;
            }
        }
        best
    }

    /// The top of similarity around a length.
    pub(crate) fn peak(&self, around: f64, trial: Trial) -> Option<Peak> {
        let from = (around - 3.0 * FINE).max(FINE);
        let trials: Vec<Trial> =
            lengths(from, around + 3.0 * FINE, FINE).map(|length| Trial { length, ..trial }).collect();
        Peak::of(self.fits(&trials, Run::Long), self.target)
    }

    /// The same by a law that minds the contact's width and so shifts the edges, with two runs of it: a map is dear.
    ///
    /// How long a run by that law seems to be when measured with the cheap law's runs says how much that law errs.
    pub(super) fn with_law(&self, peak: &Peak, law: ContactLaw) -> Option<Fit> {
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
        let seems = top(&ruler, self.target)?.length;
        let mut length = seems;
        let mut passage = Vec::new();
        for _ in 0..2 {
            passage = self.rig.passage(trial(length, law), Run::Long).ok()?;
            length = (length - (top(&ruler, &passage)?.length - seems)).max(FINE);
        }
        Some(Fit { trial: trial(length, law), similarity: similarity(self.target, &passage), passage })
    }

    /// The trials in the order of their similarity; those that cannot be simulated are left out.
    pub(crate) fn fits(&self, trials: &[Trial], run: Run) -> Vec<Fit> {
        let fit = |&trial: &Trial| {
            let passage = self.rig.passage(trial, run).ok()?;
            Some(Fit { trial, similarity: similarity(self.target, &passage), passage })
        };
        // One by one, because some trials take several times as long as others.
        let mut fits: Vec<Fit> = trials.par_iter().with_max_len(1).filter_map(fit).collect();
        fits.sort_by(|a, b| b.similarity.total_cmp(&a.similarity));
        fits
    }
}

/// Whether two trials of a climb are one, except for rounding of the steps that led to them.
fn is_same(one: &Trial, other: &Trial) -> bool {
    (one.length - other.length).abs() < 1e-9 && (one.depth / other.depth - 1.0).abs() < 1e-9
}

/// The top of similarity over length at one depth.
#[derive(Debug, Clone)]
pub(super) struct Peak {
    pub(crate) length: f64,
    pub(crate) depth: f64,
    pub(crate) similarity: f64,
    /// In the order of length.
    pub(crate) fits: Vec<Fit>,
    pub(crate) top: usize,
}

impl Peak {
    fn of(mut fits: Vec<Fit>, target: &[f64]) -> Option<Self> {
        fits.sort_by(|a, b| a.trial.length.total_cmp(&b.trial.length));
        let depth = fits.first()?.trial.depth;
        let Top { length, similarity, index: top } = top(&fits, target)?;
        Some(Self { length, depth, similarity, fits, top })
    }
}

/// Where trials are most similar.
pub(super) struct Top {
    /// Length at the top of the parabola through the best three.
    pub(crate) length: f64,
    /// Similarity of the best.
    pub(crate) similarity: f64,
    /// Which that is.
    pub(crate) index: usize,
}

/// The top of trials by rising length.
pub(crate) fn top(fits: &[Fit], target: &[f64]) -> Option<Top> {
    let like: Vec<f64> = fits.iter().map(|f| similarity(target, &f.passage)).collect();
    let i = (0..like.len()).max_by(|&a, &b| like[a].total_cmp(&like[b]))?;
    let length = fits[i].trial.length;
    if i == 0 || i + 1 == fits.len() {
        return Some(Top { length, similarity: like[i], index: i });
    }
    let shift = crate::statistics::vertex([like[i - 1], like[i], like[i + 1]]);
    Some(Top { length: length + shift * FINE, similarity: like[i], index: i })
}

/// Lengths from one to another (degrees).
pub(crate) fn lengths(from: f64, to: f64, step: f64) -> impl Iterator<Item = f64> {
    let count = ((to - from) / step + 1e-9).floor().max(0.0) as usize;
    (0..=count).map(move |i| from + step * i as f64)
}
