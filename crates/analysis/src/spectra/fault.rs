//! Which part of the bearing is damaged: combs at BPFO, BPFI and twice the BSF beside each other.
//!
//! A comb near BPFO alone does not prove a fault of the outer raceway. As BPFO + BPFI = Z f_shaft, each of its
//! harmonics is a sideband of the inner raceway's comb, three of its harmonics fall within 1 % on two of BPFI and four
//! within 2 % on three of 2 BSF: most recordings of the others show one there too. So the three are sought beside each
//! other, the inner raceway's with the sidebands of the shaft that carries it through the load zone, an element's with
//! those of the cage that carries it. Of those that stand above chance the one whose harmonics stand highest above the
//! noise is the fault's: sidebands are weaker than what they belong to, and a comb that shares some lines has not all
//! of them.

use crate::spectra::{Comb, Pattern, find_combs};
use crate::spectrum::{Band, Spectrum};
use brinell::geometry::kinematics::Frequencies;
use serde::Serialize;

/// Part of the bearing that seems to be damaged, by a recording's combs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Fault {
    /// The outer raceway.
    Outer,
    /// The inner raceway.
    Inner,
    /// A rolling element.
    Element,
    /// Two kinds stand out by about as much, or recordings of one bearing differ.
    Undecided,
    /// No comb stands out of chance, or nothing is more like the recording than the scene's bearing without a spall.
    None,
}

/// A comb of harmonics in the envelope's spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CombReport {
    /// Its frequency (Hz).
    pub frequency_hz: f64,
    /// How far it stands above chance (standard deviations).
    pub significance: f64,
    /// How far its harmonics stand above the noise near them (nepers of power): what distinguishes kinds.
    pub strength: f64,
}

/// The combs of the three kinds of fault.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CombsReport {
    /// At BPFO.
    pub outer: CombReport,
    /// At BPFI, with sidebands at the shaft's speed.
    pub inner: CombReport,
    /// At twice the BSF, with sidebands at the cage's speed.
    pub element: CombReport,
}

/// How much stronger than any other that is significant a comb must be to be the fault's (nepers of power): twice the
/// power. Recordings of outer and inner raceways show 2 to 5.
const CLEARLY: f64 = 0.7;

/// The strongest comb of each kind of fault.
#[derive(Debug, Clone, PartialEq)]
pub struct Combs {
    /// Near BPFO.
    pub outer: Comb,
    /// Near BPFI.
    pub inner: Comb,
    /// Near 2 BSF.
    pub element: Comb,
}

impl Combs {
    /// Searches a recording of a shaft that turns at `speed` (Hz) near the nominal frequencies.
    pub fn find(spectrum: &mut Spectrum, rate: f64, nominal: Frequencies, speed: f64) -> Self {
        Self::find_of(&mut |band| (spectrum.squared_envelope(band), rate), rate, nominal, speed)
    }

    /// The same in the squared envelopes that `envelope` gives of a band, each with its own rate (Hz).
    pub fn find_of(
        envelope: &mut dyn FnMut(Band) -> (Vec<f64>, f64),
        rate: f64,
        nominal: Frequencies,
        speed: f64,
    ) -> Self {
        let patterns = [(nominal.bpfo, 0.0), (nominal.bpfi, speed), (2.0 * nominal.bsf, nominal.ftf)];
        let patterns = patterns.map(|(frequency, sideband)| Pattern { frequency, sideband });
        let [outer, inner, element] = find_combs(envelope, rate, patterns, nominal.bpfo, speed);
        Self { outer, inner, element }
    }

    /// The kind that the recording looks like.
    pub fn fault(&self) -> Fault {
        let mut all = [(&self.outer, Fault::Outer), (&self.inner, Fault::Inner), (&self.element, Fault::Element)];
        // Those above chance first, the strongest of them at the front.
        all.sort_by(|(a, _), (b, _)| {
            b.is_significant().cmp(&a.is_significant()).then(b.strength.total_cmp(&a.strength))
        });
        let [(first, fault), (second, _), _] = all;
        if !first.is_significant() {
            return Fault::None;
        }
        let close = second.is_significant() && first.strength < second.strength + CLEARLY;
        if close { Fault::Undecided } else { fault }
    }

    /// That of a kind of fault, where one is named.
    pub fn of(&self, fault: Fault) -> Option<&Comb> {
        match fault {
            Fault::Outer => Some(&self.outer),
            Fault::Inner => Some(&self.inner),
            Fault::Element => Some(&self.element),
            Fault::Undecided | Fault::None => None,
        }
    }

    /// Whether no other comb stands higher than the outer raceway's: what the scene's rig may be asked about.
    pub fn outer_leads(&self) -> bool {
        self.outer.significance >= self.inner.significance.max(self.element.significance)
    }

    /// As reported.
    pub fn report(&self) -> CombsReport {
        let of = |comb: &Comb| CombReport {
            frequency_hz: comb.frequency,
            significance: comb.significance,
            strength: comb.strength,
        };
        CombsReport { outer: of(&self.outer), inner: of(&self.inner), element: of(&self.element) }
    }

    /// The strongest.
    pub fn strongest(&self) -> &Comb {
        let inside = if self.inner.significance > self.element.significance { &self.inner } else { &self.element };
        if self.outer_leads() { &self.outer } else { inside }
    }

    /// In words.
    pub fn described(&self) -> String {
        let one = |name: &str, comb: &Comb| {
            format!("{name} {:.1} of strength {:.1} at {:.2} Hz", comb.significance, comb.strength, comb.frequency)
        };
        format!("{}, {}, {}", one("BPFO", &self.outer), one("BPFI", &self.inner), one("2 BSF", &self.element))
    }
}
