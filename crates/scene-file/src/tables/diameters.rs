//! Elements of unequal size, as the table `[bearing]` has them.

use super::faults::{Faults, TableFault};
use brinell::scene::quantity::DIAMETER_RMS;
use brinell::scene::{Bearing, BearingError, DrawnDiameters, SceneError};

const OFFSETS: &str = "bearing.element_diameter_offsets_um";
const RMS: &str = "bearing.element_diameter_rms_um";
const SEED: &str = "bearing.element_diameter_seed";

/// The keys of unequal elements.
pub(super) struct Diameters {
    pub(super) offsets_um: Option<Vec<f64>>,
    pub(super) rms_um: Option<f64>,
    pub(super) seed: Option<u64>,
}

impl Diameters {
    /// Diameter of each element beyond the nominal one; none of equal elements.
    pub(super) fn put_into(&self, bearing: &mut Bearing) -> Result<(), Faults> {
        match (&self.offsets_um, self.rms_um) {
            (Some(_), Some(_)) => return Err(TableFault::Both { first: OFFSETS, second: RMS }.into()),
            (Some(_), None) if self.seed.is_some() => {
                return Err(TableFault::Both { first: OFFSETS, second: SEED }.into());
            }
            (None, None) if self.seed.is_some() => {
                let why = "bearing.element_diameter_seed draws diameters of that size";
                return Err(TableFault::Missing { key: RMS, why }.into());
            }
            (Some(given), None) if given.len() != bearing.element_count => {
                let (found, count) = (given.len(), bearing.element_count);
                return Err(SceneError::from(BearingError::DiameterCount { found, count }).into());
            }
            (Some(given), None) if given.iter().any(|&um| um != 0.0) => {
                bearing.diameter_offsets = given.iter().map(|um| um / 1e6).collect();
            }
            (None, Some(um)) => {
                DIAMETER_RMS.check(um / 1e6)?;
                let why = "diameters of elements are drawn";
                let missing = TableFault::Missing { key: SEED, why };
                let seed = self.seed.or((um == 0.0).then_some(0)).ok_or(missing)?;
                bearing.draw_diameters(DrawnDiameters { rms: um / 1e6, seed });
            }
            (Some(_) | None, None) => {}
        }
        Ok(())
    }
}
