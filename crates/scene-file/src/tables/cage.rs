//! The table `[cage]` of the scene file.

use super::faults::{Faults, TableFault, only_one};
use brinell::scene::quantity::CAGE_SPACING_RMS;
use brinell::scene::{Cage, CageIrregularity, SceneError};
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::TAU;

const INITIAL_ANGLE_DEG: f64 = -90.0;

#[derive(JsonSchema, Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct CageTable {
    /// Share by which the cage lags behind pure rolling.
    slip: f64,
    /// Angle of element 1 at the start, counter-clockwise from +x.
    #[schemars(extend("default" = INITIAL_ANGLE_DEG))]
    initial_angle_deg: Option<f64>,
    /// Offset of each element from even spacing; the cage is even without it.
    spacing_deg: Option<Vec<f64>>,
    /// Root mean square of offsets that are drawn; instead of the list.
    #[schemars(extend("default" = 0.0))]
    spacing_rms_deg: Option<f64>,
    /// Root mean square of each element's motion in its pocket.
    #[schemars(extend("default" = 0.0))]
    jitter_rms_deg: Option<f64>,
    /// Root mean square of the cage speed's relative wander; the cage turns evenly where it is 0.
    #[schemars(extend("default" = 0.0))]
    wander: Option<f64>,
    /// Figures measured on recordings, instead of spacing, jitter and wander: 0.6 % and 0.4 % of the spacing, wander
    /// 0.3 %; none without it.
    irregularity: Option<Preset>,
    /// Which cage of that kind; needed where something is drawn.
    seed: Option<u64>,
}

/// Figures that stand for measured ones.
#[derive(JsonSchema, Deserialize, Clone, Copy)]
#[serde(rename_all = "kebab-case")]
enum Preset {
    Recorded,
}

impl CageTable {
    pub(crate) fn into_cage(self, count: usize) -> Result<Cage, Faults> {
        let initial_angle = self.initial_angle_deg.unwrap_or(INITIAL_ANGLE_DEG).to_radians();
        Ok(Cage { slip: self.slip, spin_slip: 0.0, initial_angle, irregularity: self.irregularity(count)? })
    }

    fn irregularity(&self, count: usize) -> Result<Option<CageIrregularity>, Faults> {
        only_one(&[
            ("cage.irregularity", self.irregularity.is_some()),
            ("cage.spacing_deg", self.spacing_deg.is_some()),
            ("cage.spacing_rms_deg", self.spacing_rms_deg.is_some()),
            ("cage.jitter_rms_deg", self.jitter_rms_deg.is_some()),
            ("cage.wander", self.wander.is_some()),
        ])?;
        let degrees = |key: Option<f64>| key.unwrap_or(0.0).to_radians();
        let [spacing, jitter, wander] = match self.irregularity {
            Some(Preset::Recorded) => {
                let [spacing, jitter, wander] = CageIrregularity::RECORDED;
                [spacing * TAU / count as f64, jitter * TAU / count as f64, wander]
            }
            None => [degrees(self.spacing_rms_deg), degrees(self.jitter_rms_deg), self.wander.unwrap_or(0.0)],
        };
        let is_random = [spacing, jitter, wander].iter().any(|rms| *rms != 0.0);
        if is_random && self.seed.is_none() {
            return Err(TableFault::Missing {
                key: "cage.seed",
                why: "spacing, jitter or wander of the cage is random",
            }
            .into());
        }
        let seed = self.seed.unwrap_or(0);
        let offsets = match &self.spacing_deg {
            Some(given) => {
                if given.len() != count {
                    return Err(SceneError::SpacingCount { found: given.len(), count }.into());
                }
                CageIrregularity::centred(&given.iter().map(|degrees| degrees.to_radians()).collect::<Vec<_>>())
            }
            None => {
                CAGE_SPACING_RMS.check(spacing)?;
                CageIrregularity::drawn_offsets(count, spacing, seed)
            }
        };
        let is_even = offsets.iter().all(|&offset| offset == 0.0) && jitter == 0.0 && wander == 0.0;
        let drawn = self.spacing_deg.is_none().then_some(spacing);
        Ok((!is_even).then_some(CageIrregularity { offsets, drawn, jitter, wander, seed }))
    }
}
