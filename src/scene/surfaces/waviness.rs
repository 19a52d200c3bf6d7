//! Waviness: waves around the whole circumference of a body.

use super::super::Bearing;
use serde::{Deserialize, Serialize};

/// One order of the waviness of a body, w cos n(ψ − ψ_n) in its radius.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Waviness {
    /// The body.
    pub on: WavyBody,
    /// Waves around it n.
    pub order: u32,
    /// Amplitude w (m).
    pub amplitude: f64,
    /// Angle ψ_n of a crest (rad), where the radius is largest; counted as that of a [defect](super::Defect::angle).
    pub crest: f64,
}

/// A body that may be wavy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum WavyBody {
    /// The outer raceway.
    Outer,
    /// The inner raceway.
    Inner,
    /// A rolling element, from 0.
    Element(usize),
}

impl WavyBody {
    /// Its radius where it is wavy (m).
    pub fn radius(self, bearing: &Bearing) -> f64 {
        match self {
            Self::Outer => bearing.outer_raceway_radius(),
            Self::Inner => bearing.inner_raceway_radius(),
            Self::Element(_) => bearing.element_radius(),
        }
    }
}
