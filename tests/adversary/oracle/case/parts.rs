//! Rollers in place of balls, oil between them and the raceways, waves around bodies, and a structure's modes below the
//! sensor.

use super::On;

/// A cylindrical roller.
#[derive(Debug, Clone, Copy)]
pub struct Roller {
    pub length_mm: f64,
    pub laminae: u32,
    /// By the standard's logarithmic crown; straight without.
    pub crowned: bool,
}

/// An oil film.
#[derive(Debug, Clone, Copy)]
pub struct Film {
    pub viscosity: f64,
    pub pressure_viscosity: f64,
    pub layer_um: Option<f64>,
}

/// Waves of one order around a body.
#[derive(Debug, Clone, Copy)]
pub struct Wave {
    pub on: On,
    pub order: u32,
    pub amplitude_um: f64,
    /// Angle of a crest, where the radius is largest, counted as a defect's.
    pub crest_deg: f64,
}

/// A mode of the structure below the sensor.
#[derive(Debug, Clone, Copy)]
pub struct Mode {
    pub frequency_hz: f64,
    pub damping_ratio: f64,
    pub gain: f64,
    pub quadrature_gain: f64,
}

impl Roller {
    /// Its keys in the table of the bearing.
    pub fn toml(&self) -> String {
        let Self { length_mm, laminae, crowned } = self;
        let profile = if *crowned { "log" } else { "straight" };
        format!(
            "element = \"cylindrical-roller\"\nroller_length_mm = {length_mm:?}\nroller_profile = \"{profile}\"\n\
             roller_laminae = {laminae}\n"
        )
    }
}

impl Film {
    /// Its table.
    pub fn toml(&self) -> String {
        let Self { viscosity, pressure_viscosity, layer_um } = self;
        let layer = layer_um.map_or(String::new(), |layer| format!("layer_um = {layer:?}\n"));
        format!("[film]\nviscosity_pa_s = {viscosity:?}\npressure_viscosity_1_pa = {pressure_viscosity:?}\n{layer}")
    }
}

impl Wave {
    /// Its table.
    pub fn toml(&self) -> String {
        let Self { on, order, amplitude_um, crest_deg } = self;
        let body = match on {
            On::Outer => "on = \"outer\"".to_owned(),
            On::Inner => "on = \"inner\"".to_owned(),
            On::Element { element, .. } => format!("on = \"element\"\nelement = {}", element + 1),
        };
        format!("[[waviness]]\n{body}\norder = {order}\namplitude_um = {amplitude_um:?}\nangle_deg = {crest_deg:?}\n")
    }
}

impl Mode {
    /// Its table, behind that of its sensor.
    pub fn toml(&self) -> String {
        let Self { frequency_hz, damping_ratio, gain, quadrature_gain } = self;
        format!(
            "[[sensor.mode]]\nfrequency_hz = {frequency_hz:?}\ndamping_ratio = {damping_ratio:?}\ngain = {gain:?}\n\
             quadrature_gain = {quadrature_gain:?}\n"
        )
    }

    /// How much larger than its body's acceleration what the sensor measures may be.
    pub fn amplification(&self) -> f64 {
        (self.gain.abs() + self.quadrature_gain.abs()) * (1.0 + 0.5 / self.damping_ratio)
    }
}
