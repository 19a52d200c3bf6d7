//! A plain script: kurtogram, envelope, and the kind whose lines are highest.
//!
//! The band with the highest kurtosis of the envelope is taken (Antoni 2007, *Fast computation of the kurtogram*, with
//! halved bands only). In the squared envelope's spectrum each of the first three harmonics of BPFO, BPFI and 2 BSF
//! counts by the highest value within 2 % over the median near it. The kind with the highest mean is named, from
//! six times on.

use brinell::geometry::kinematics;
use brinell::scene::Bearing;
use brinell_analysis::recording::Recording;
use brinell_analysis::sizing::Fault;
use brinell_analysis::spectrum::{self, Band, Spectrum};
use brinell_analysis::statistics;

/// Halvings of the range below Nyquist.
const LEVELS: u32 = 4;
/// Narrowest band (BPFI): three harmonics.
const NARROWEST: f64 = 3.0;
const HARMONICS: u32 = 3;
const NEAR: f64 = 0.02;
/// Height from which a fault is named.
const NAMED: f64 = 6.0;

/// The kind that the script names.
pub(super) fn kind(recording: &Recording, bearing: &Bearing) -> Fault {
    let nominal = kinematics::frequencies(bearing, 0.0, recording.speed());
    let rate = recording.rate();
    let mut signal = Spectrum::of(recording.samples(), rate);
    let (mut best, mut envelope) = (f64::NEG_INFINITY, Vec::new());
    for level in 0..=LEVELS {
        let width = 0.5 * rate / f64::from(1 << level);
        if level > 0 && width < NARROWEST * nominal.bpfi {
            break;
        }
        for band in 0..1 << level {
            let low = f64::from(band) * width;
            let squared = signal.squared_envelope(Band { low, high: low + width });
            let power = statistics::rms(&squared) / statistics::mean(&squared).max(f64::MIN_POSITIVE);
            if power > best {
                (best, envelope) = (power, squared);
            }
        }
    }
    let mean = statistics::mean(&envelope);
    envelope.iter_mut().for_each(|x| *x -= mean);
    let (power, bin) = spectrum::power(&envelope, rate, 0);
    let amplitude: Vec<f64> = power.iter().map(|p| p.sqrt()).collect();
    let between = |low: f64, high: f64| {
        let at = |f: f64| ((f / bin).max(0.0) as usize).min(amplitude.len());
        &amplitude[at(low)..at(high)]
    };
    let height = |f: f64| {
        let of = |k: u32| {
            let middle = f64::from(k) * f;
            let line = between(middle * (1.0 - NEAR), middle * (1.0 + NEAR) + bin);
            let noise = statistics::median(between(middle - 0.4 * f, middle + 0.4 * f));
            line.iter().copied().fold(0.0, f64::max) / noise.max(f64::MIN_POSITIVE)
        };
        (1..=HARMONICS).map(of).sum::<f64>() / f64::from(HARMONICS)
    };
    let kinds = [(Fault::Outer, nominal.bpfo), (Fault::Inner, nominal.bpfi), (Fault::Element, 2.0 * nominal.bsf)];
    let heights = kinds.map(|(kind, f)| (kind, height(f)));
    let highest = heights.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
    highest.filter(|(_, height)| *height >= NAMED).map_or(Fault::None, |(kind, _)| kind)
}
