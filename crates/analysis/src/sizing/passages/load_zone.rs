//! Passages in and out of the load zone.
//!
//! A spall of the inner raceway turns with the shaft, and an element that meets it opposite to the load is hardly
//! squeezed there: its passage is many times weaker and carries noise into every average. What is averaged are the
//! passages above the middle, on a logarithmic scale, between weak and strong ones; with the same noise in each, the
//! mean of those is close to the best that weights can do.

use crate::statistics;

/// Quantiles of strength that stand for weak and for strong passages.
const WEAK: f64 = 0.1;
const STRONG: f64 = 0.9;
/// Share of a strong passage's strength below which one does not count: a tenth of its power.
const LEAST: f64 = 0.3;
/// Ratio of strong to weak from which there is a load zone at all: below, passages scatter by as much anywhere.
pub(crate) const MODULATED: f64 = 1.5;

/// How the passages' strength varies.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LoadZone {
    /// Strength of strong passages over that of weak ones.
    pub(crate) modulation: f64,
    /// The strong ones.
    pub(crate) inside: Vec<usize>,
}

impl LoadZone {
    /// Of passages whose squared high-frequency envelopes are `rows`, each over one spacing, wherever in it the events
    /// are.
    pub(crate) fn of(rows: &[Vec<f64>]) -> Self {
        let strength: Vec<f64> = rows.iter().map(|row| statistics::mean(row).max(0.0).sqrt()).collect();
        let quantile = |share: f64| statistics::quantile(&strength, share).unwrap_or(0.0).max(f64::MIN_POSITIVE);
        let (weak, strong) = (quantile(WEAK), quantile(STRONG));
        let limit = (weak * strong).sqrt().max(LEAST * strong);
        let inside = (0..rows.len()).filter(|&k| strength[k] >= limit).collect();
        Self { modulation: strong / weak, inside }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_passages_under_load_are_separated_from_the_others() {
        // Ten passages a turn of which four are five times as strong.
        let row = |k: usize| vec![if k % 10 < 4 { 25.0 } else { 1.0 }; 8];
        let zone = LoadZone::of(&(0..200).map(row).collect::<Vec<_>>());
        assert_eq!(zone.modulation, 5.0);
        assert_eq!(zone.inside, (0..200).filter(|k| k % 10 < 4).collect::<Vec<_>>());
        assert_eq!(LoadZone::of(&[]).inside, Vec::<usize>::new());
    }
}
