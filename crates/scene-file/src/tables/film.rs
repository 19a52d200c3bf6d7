//! The table `[film]` of the scene file.

use brinell::scene::Film;
use schemars::JsonSchema;
use serde::Deserialize;

/// An oil film.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FilmTable {
    /// Viscosity of the oil at the bearing's temperature.
    viscosity_pa_s: f64,
    /// How the viscosity's logarithm grows with pressure; mineral oils have about 2e-8.
    pressure_viscosity_1_pa: f64,
    /// Height up to which oil fills a gap; every gap without it.
    layer_um: Option<f64>,
}

impl FilmTable {
    pub(super) fn into_film(self) -> Film {
        Film {
            viscosity: self.viscosity_pa_s,
            pressure_viscosity: self.pressure_viscosity_1_pa,
            layer: self.layer_um.map(|layer| layer * 1e-6),
        }
    }
}
