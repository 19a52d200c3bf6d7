//! Line or extended: how the rings sound after an entry and after an exit, against the stiffness of the scene's
//! bearing.
//!
//! The rings swing against each other on the bearing's stiffness k, softer while an element is free in the spall and
//! softer still while two are (an extended spall, longer than the element spacing). With the rings' masses m_i, m_o
//! (and the sensor's on the outer one) and their supports k_i, k_o, the upper frequency f of
//! ```text
//! | k + k_i − (2πf)² m_i        −k          |
//! |        −k          k + k_o − (2πf)² m_o | = 0
//! ```
//! is expected; k is the tangent stiffness along the load in static balance with an element halfway between the edges
//! after an entry, and halfway between exit and next entry after an exit. Invalid for elements that carry load inside
//! the spall: above the critical load, at which the element in the middle touches both rings again, stiffness cannot
//! distinguish the two kinds.

use crate::sizing::waveform::{Rig, Trial, synthesis};
use crate::spectrum;
use crate::statics::{NoCriticalLoad, StaticBearing, StaticError};
use brinell::scene::Scene;
use std::f64::consts::TAU;

/// Relative distance of a measured from an expected frequency up to which they agree.
const AGREE: f64 = 0.1;
/// Frequencies among which ringing is sought (Hz).
const RANGE: (f64, f64) = (150.0, 2500.0);

/// Frequencies of the rings' mode (Hz).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ringing {
    /// Between an entry and the next exit.
    pub after_entry: f64,
    /// Between an exit and the next entry.
    pub after_exit: f64,
}

impl Ringing {
    /// Largest relative distance from another.
    pub fn distance(&self, other: &Self) -> f64 {
        let log_ratio = |a: f64, b: f64| libm::log(a / b).abs();
        log_ratio(self.after_entry, other.after_entry).max(log_ratio(self.after_exit, other.after_exit))
    }

    /// After entry, after exit (Hz).
    pub fn pair(self) -> [f64; 2] {
        [self.after_entry, self.after_exit]
    }

    /// Whether they agree within what a few periods of ringing allow.
    pub fn agrees(&self, other: &Self) -> bool {
        self.distance(other) < AGREE
    }
}

/// What the scene's rings do with a trial spall of this length.
///
/// # Errors
/// Those of the static balance.
pub fn expected(rig: &Rig<'_>, trial: Trial, spacing: f64) -> Result<Ringing, StaticError> {
    let scene = rig.with_spall(trial);
    let bearing = StaticBearing::new(&scene, None)?;
    let centre = scene.defects.first().map_or(0.0, |d| d.angle);
    let over = trial.length.rem_euclid(spacing);
    // Element 1 that far past the leading edge (degrees).
    let frequency = |past_edge: f64| -> Result<f64, StaticError> {
        let cage_angle = centre + (past_edge - 0.5 * trial.length).to_radians();
        Ok(upper_frequency(&scene, bearing.balance(cage_angle, bearing.load())?.held_stiffness()))
    };
    Ok(Ringing { after_entry: frequency(0.5 * over)?, after_exit: frequency(0.5 * (over + spacing))? })
}

fn upper_frequency(scene: &Scene, stiffness: f64) -> f64 {
    let sensor: f64 = scene.sensors.iter().map(|sensor| sensor.mass).sum();
    let (m_i, m_o) = (scene.shaft.mass, scene.housing.mass + sensor);
    let (a, b) = ((stiffness + scene.shaft.stiffness) / m_i, (stiffness + scene.housing.stiffness) / m_o);
    let coupling = stiffness * stiffness / (m_i * m_o);
    (0.5 * (a + b) + (0.25 * (a - b) * (a - b) + coupling).sqrt()).sqrt() / TAU
}

/// Smallest load (N) at which elements at the bottom of the spall carry some of it, or why there is none.
///
/// # Errors
/// Those of the static balance.
pub(crate) fn critical_load(scene: &Scene, trial: Trial) -> Result<Result<f64, NoCriticalLoad>, StaticError> {
    Ok(StaticBearing::new(&synthesis::with_spall(scene, trial), None)?.critical_load()?.map(|critical| critical.load))
}

/// Strongest frequency of a stretch of signal sampled at `rate` (Hz); `None` when it is shorter than two of its
/// periods.
pub fn strongest(signal: &[f64], rate: f64) -> Option<f64> {
    if signal.len() < 16 {
        return None;
    }
    let mean = crate::statistics::mean(signal);
    let centred: Vec<f64> = signal.iter().map(|x| x - mean).collect();
    let (power, bin) = spectrum::power(&centred, rate, 16 * signal.len());
    let (from, to) = ((RANGE.0 / bin) as usize + 1, ((RANGE.1 / bin) as usize).min(power.len() - 1));
    let peak = (from..to).max_by(|&a, &b| power[a].total_cmp(&power[b]))?;
    let frequency = peak as f64 * bin;
    (signal.len() as f64 / rate * frequency > 2.0 && peak > from && peak + 1 < to).then_some(frequency)
}
