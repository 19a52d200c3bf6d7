//! Spectra of a run: that of the acceleration's envelope, and its orders, each as CSV with what there is to mark.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use anyhow::Result;
use brinell::geometry::kinematics::Frequencies;
use brinell::scene::Scene;
use brinell_analysis::spectra::{EnvelopeSpectrum, EvenAngles, OrderSpectrum, envelope_spectrum};
use serde_json::{Value, json};

use super::speed_profile::SpeedProfile;
use crate::shared::{csv, note, whole_file};

/// Highest order that is kept: some harmonics of BPFI in bearings of any size.
const HIGHEST_ORDER: f64 = 200.0;

/// An acceleration at even times.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Acceleration {
    /// Samples (m/s²); none where nothing measures.
    pub(super) samples: Vec<f64>,
    /// Samples per second (Hz).
    pub(super) rate: f64,
}

/// Spectra of one run.
pub(super) struct Spectra<'a> {
    /// The scene, its operating angle known.
    scene: &'a Scene,
    /// Speed of its shaft where that changes.
    profile: Option<&'a SpeedProfile>,
    /// What the spectra are of.
    acceleration: Acceleration,
    /// Where the shaft has turned by equal angles.
    angles: Option<EvenAngles>,
    /// Characteristic frequencies and the shaft's speed (Hz), at the mean speed where it changes; `None` where nothing
    /// turns, or where two rings turn in a ratio that changes.
    frequencies: Option<(Frequencies, f64)>,
}

impl<'a> Spectra<'a> {
    /// Those of an acceleration in a run of a scene.
    pub(super) fn new(scene: &'a Scene, profile: Option<&'a SpeedProfile>, acceleration: Acceleration) -> Self {
        let mut spectra = Self { scene, profile, acceleration, angles: None, frequencies: None };
        spectra.angles = spectra.found_angles();
        spectra.frequencies = spectra.found_frequencies();
        spectra
    }

    /// Spectrum of the envelope as `<scene>-envelope.csv`, and beside it, as `.json`, band, width of a line and the
    /// frequencies to mark; nothing where the run is too short or too coarse, or nothing shakes. With a speed that
    /// changes frequencies are those at the mean speed.
    pub(super) fn write_envelope(&self, folder: &Path) -> Result<Option<PathBuf>> {
        let Acceleration { samples, rate } = &self.acceleration;
        let Some((characteristic, speed)) = self.frequencies else { return Ok(None) };
        let envelope = match self.angles.as_ref().filter(|_| self.changes()) {
            Some(angles) => EnvelopeSpectrum::of_changing_speed(samples, *rate, characteristic, angles),
            None if self.changes() => None,
            None => EnvelopeSpectrum::of(samples, *rate, characteristic, speed),
        };
        let Some(envelope) = envelope else { return Ok(None) };
        let path = folder.join(format!("{}-envelope.csv", self.scene.name));
        csv::table(&path, &[("frequency", "Hz"), ("amplitude", "1")], &[&envelope.frequency, &envelope.amplitude])?;
        println!("{}", path.display());
        let mut description = json!({
            "band_hz": [envelope.band.low, envelope.band.high],
            "line_width_hz": envelope.line_width,
            "rate_hz": rate,
            "frequencies_hz": marks(&characteristic, 1.0),
        });
        if self.changes() {
            description["mean_speed_hz"] = json!(speed);
        }
        let about = path.with_extension("json");
        whole_file::write(&about, serde_json::to_string_pretty(&description)? + "\n")?;
        println!("{}", about.display());
        Ok(Some(path))
    }

    /// Why there is no spectrum of the envelope, and how long a run would be enough.
    pub(super) fn too_short(&self) -> Option<String> {
        let (characteristic, _) = self.frequencies?;
        let shortest = libm::ceil(100.0 * envelope_spectrum::FEWEST_PASSAGES / characteristic.bpfo) / 100.0;
        let Acceleration { samples, rate } = &self.acceleration;
        (!samples.is_empty() && (samples.len() as f64) < shortest * rate).then(|| {
            format!("no spectrum of the envelope: its lines would run into each other; --stop {shortest:.2} is enough")
        })
    }

    /// Orders of the acceleration as `<scene>-orders.csv`; nothing where nothing turns twice, or nothing shakes. Gives
    /// the file, and width of a line and orders to mark.
    pub(super) fn write_orders(&self, folder: &Path) -> Result<Option<(PathBuf, Value)>> {
        let Some((characteristic, speed)) = self.frequencies else { return Ok(None) };
        let Some(angles) = &self.angles else { return Ok(None) };
        if self.acceleration.samples.is_empty() {
            return Ok(None);
        }
        let spectrum = OrderSpectrum::of(&self.acceleration.samples, angles, HIGHEST_ORDER);
        let path = folder.join(format!("{}-orders.csv", self.scene.name));
        csv::table(&path, &[("order", "1"), ("amplitude", "m/s2")], &[&spectrum.order, &spectrum.amplitude])?;
        println!("{}", path.display());
        let used = angles.used();
        let description = json!({
            "line_width": spectrum.line_width,
            "orders": marks(&characteristic, speed),
            "from_s": used.0 / self.acceleration.rate,
            "to_s": used.1 / self.acceleration.rate,
        });
        Ok(Some((path, description)))
    }

    fn changes(&self) -> bool {
        self.profile.is_some_and(|profile| !profile.is_constant())
    }

    fn found_frequencies(&self) -> Option<(Frequencies, f64)> {
        let mut scene = self.scene.clone();
        if let Some(profile) = self.profile {
            let speed = if self.changes() { self.angles.as_ref()?.mean_speed() } else { profile.hertz(0.0) };
            scene.shaft_speed = TAU * speed;
            if self.changes() && scene.housing_speed.is_some_and(|speed| speed != 0.0) {
                note!("note: no spectra: the rings' speeds have no constant ratio");
                return None;
            }
        }
        let frequencies = Frequencies::of(&scene);
        (frequencies.bpfo > 0.0 && frequencies.bpfi > 0.0).then_some((frequencies, scene.shaft_speed.abs() / TAU))
    }

    fn found_angles(&self) -> Option<EvenAngles> {
        let rate = self.acceleration.rate;
        let count = self.acceleration.samples.len();
        let speed = |i: usize| match self.profile {
            Some(profile) => profile.hertz(i as f64 / rate),
            None => self.scene.shaft_speed / TAU,
        };
        EvenAngles::of(&(0..count).map(speed).collect::<Vec<_>>(), rate)
    }
}

/// What is marked, as multiples of `unit` (Hz).
fn marks(of: &Frequencies, unit: f64) -> Value {
    json!({ "BPFO": of.bpfo / unit, "BPFI": of.bpfi / unit, "2 BSF": 2.0 * of.bsf / unit, "FTF": of.ftf / unit })
}
