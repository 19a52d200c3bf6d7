//! Samples of several channels in one row.

/// Channels out of samples that take turns.
pub(super) fn deinterleaved(samples: &[f64], channels: usize) -> Vec<Vec<f64>> {
    (0..channels.max(1)).map(|k| samples.iter().skip(k).step_by(channels.max(1)).copied().collect()).collect()
}
