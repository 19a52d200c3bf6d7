//! Filters and envelopes by the Fourier transform of the whole signal.
//!
//! A band is cut out with raised-cosine flanks, so that the filter shifts no phase and rings little. The transform
//! takes the signal as periodic: the first and last milliseconds are worthless, and callers leave the outer passages
//! alone.
//!
//! A crate of its own: the transforms are generic, and are compiled here once for all who use them. So nothing public
//! is generic: it would be compiled with its transforms in each caller.

mod even_filter;

pub use even_filter::EvenFilter;

use realfft::num_complex::Complex;
use realfft::{RealFftPlanner, RealToComplex};
use std::f64::consts::PI;

/// A frequency band (Hz).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// Lower edge, at half amplitude; 0 for none.
    pub low: f64,
    /// Upper edge, at half amplitude; infinite for none.
    pub high: f64,
}

impl Band {
    /// Width of a flank as a share of its edge's frequency.
    const FLANK: f64 = 0.2;

    fn gain(&self, frequency: f64) -> f64 {
        let step = |edge: f64| 0.5 * (1.0 + libm::sin(PI * ((frequency / edge - 1.0) / Self::FLANK).clamp(-0.5, 0.5)));
        let lower = if self.low > 0.0 { step(self.low) } else { 1.0 };
        let upper = if self.high.is_finite() { 1.0 - step(self.high) } else { 1.0 };
        lower * upper
    }
}

/// A signal's spectrum, from which any number of bands can be cut.
pub struct Spectrum {
    bins: Vec<Complex<f64>>,
    len: usize,
    rate: f64,
    planner: RealFftPlanner<f64>,
}

impl Spectrum {
    /// Transforms `signal`, sampled at `rate` (Hz).
    pub fn of(signal: &[f64], rate: f64) -> Self {
        let mut planner = RealFftPlanner::new();
        let bins = forward(planner.plan_fft_forward(signal.len()).as_ref(), signal.to_vec());
        Self { bins, len: signal.len(), rate, planner }
    }

    /// The signal in a band.
    pub fn filtered(&mut self, band: Band) -> Vec<f64> {
        self.inverse(&|frequency| band.gain(frequency), Complex::new(1.0, 0.0))
    }

    /// The signal with each of its frequencies (Hz) multiplied by a gain.
    pub fn shaped(&mut self, gain: &dyn Fn(f64) -> f64) -> Vec<f64> {
        self.inverse(gain, Complex::new(1.0, 0.0))
    }

    /// Squared envelope of the signal in a band: the squared magnitude of its analytic signal.
    pub fn squared_envelope(&mut self, band: Band) -> Vec<f64> {
        let mut envelope = self.filtered(band);
        // The Hilbert transform turns every positive frequency by −90°.
        let quadrature = self.inverse(&|frequency| band.gain(frequency), Complex::new(0.0, -1.0));
        for (x, y) in envelope.iter_mut().zip(quadrature) {
            *x = *x * *x + y * y;
        }
        envelope
    }

    fn inverse(&mut self, gain: &dyn Fn(f64) -> f64, factor: Complex<f64>) -> Vec<f64> {
        let step = self.rate / self.len as f64;
        let scale = 1.0 / self.len as f64;
        let mut bins: Vec<_> =
            self.bins.iter().enumerate().map(|(k, &x)| x * factor * (scale * gain(k as f64 * step))).collect();
        keep_ends_real(&mut bins, self.len);
        let mut signal = vec![0.0; self.len];
        let plan = self.planner.plan_fft_inverse(self.len);
        // Its only errors are wrong lengths and imaginary parts at the ends, excluded above.
        let _ = plan.process(&mut bins, &mut signal);
        signal
    }
}

/// The first bin and, at even length of the signal, the last stand for themselves alone and must be real, which
/// rounding does not leave them: the inverse transform refuses others.
pub(crate) fn keep_ends_real(bins: &mut [Complex<f64>], len: usize) {
    bins[0].im = 0.0;
    if let Some(last) = bins.last_mut().filter(|_| len.is_multiple_of(2)) {
        last.im = 0.0;
    }
}

/// Power spectrum after a Hann window, the signal filled up with zeros to at least `len`; with its bin width (Hz).
pub fn power(signal: &[f64], rate: f64, len: usize) -> (Vec<f64>, f64) {
    let count = signal.len();
    let len = len.max(count).next_power_of_two();
    let window = |i: usize| 0.5 - 0.5 * libm::cos(2.0 * PI * i as f64 / count as f64);
    let mut padded: Vec<f64> = signal.iter().enumerate().map(|(i, x)| x * window(i)).collect();
    padded.resize(len, 0.0);
    let bins = forward(RealFftPlanner::new().plan_fft_forward(len).as_ref(), padded);
    (bins.iter().map(Complex::norm_sqr).collect(), rate / len as f64)
}

/// Circular correlation of two signals of equal length: Σ a(i) b(i − shift) for each shift.
pub fn circular_correlation(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut planner = RealFftPlanner::new();
    let plan = planner.plan_fft_forward(a.len());
    let (a, b) = (forward(plan.as_ref(), a.to_vec()), forward(plan.as_ref(), b.to_vec()));
    let len = 2 * (a.len() - 1) + usize::from(!plan.len().is_multiple_of(2));
    let mut product: Vec<_> = a.iter().zip(&b).map(|(a, b)| a * b.conj() / len as f64).collect();
    keep_ends_real(&mut product, len);
    let mut correlation = vec![0.0; len];
    let _ = planner.plan_fft_inverse(len).process(&mut product, &mut correlation);
    correlation
}

/// Autocorrelation at lags 0 … `lags`; the signal goes on as zeros.
pub fn autocorrelation(signal: &[f64], lags: usize) -> Vec<f64> {
    (0..=lags).map(|lag| signal.iter().zip(signal.iter().skip(lag)).map(|(a, b)| a * b).sum()).collect()
}

fn forward(plan: &dyn RealToComplex<f64>, mut signal: Vec<f64>) -> Vec<Complex<f64>> {
    let mut bins = plan.make_output_vec();
    // Its only error is a wrong length, and the plan made both.
    let _ = plan.process(&mut signal, &mut bins);
    bins
}

/// Running mean over `2·half + 1` samples, shorter at the ends.
pub fn running_mean(signal: &[f64], half: usize) -> Vec<f64> {
    let mut sums = Vec::with_capacity(signal.len() + 1);
    sums.push(0.0);
    let mut sum = 0.0;
    for x in signal {
        sum += x;
        sums.push(sum);
    }
    (0..signal.len())
        .map(|i| {
            let (from, to) = (i.saturating_sub(half), (i + half + 1).min(signal.len()));
            (sums[to] - sums[from]) / (to - from) as f64
        })
        .collect()
}

/// Smoothing with a Gaussian of standard deviation `sigma` samples, the ends continued by their last value.
pub fn gaussian(signal: &[f64], sigma: f64) -> Vec<f64> {
    let reach = (4.0 * sigma).ceil().max(1.0) as isize;
    let weights: Vec<f64> = (-reach..=reach).map(|k| libm::exp(-0.5 * (k as f64 / sigma.max(1e-3)).powi(2))).collect();
    let total: f64 = weights.iter().sum();
    let last = signal.len() as isize - 1;
    (0..signal.len() as isize)
        .map(|i| {
            (-reach..=reach).zip(&weights).map(|(k, w)| w * signal[(i + k).clamp(0, last) as usize]).sum::<f64>()
                / total
        })
        .collect()
}
