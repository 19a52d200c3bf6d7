//! Elements of unequal size, as the table `[bearing]` has them.

use super::faults::{Faults, TableFault, only_one};
use brinell::scene::quantity::DIAMETER_RMS;
use brinell::scene::{Bearing, BearingError, DrawnDiameters, SceneError};

const OFFSETS: &str = "bearing.element_diameter_offsets_um";
const RMS: &str = "bearing.element_diameter_rms_um";
const SEED: &str = "bearing.element_diameter_seed";

/// Gives elements the diameters of the keys of unequal ones.
pub(super) fn put_into(
    bearing: &mut Bearing,
    offsets_um: Option<Vec<f64>>,
    rms_um: Option<f64>,
    seed: Option<u64>,
) -> Result<(), Faults> {
    let given = [offsets_um.is_some(), rms_um.is_some(), seed.is_some()];
    only_one(&[(OFFSETS, given[0]), (RMS, given[1]), (SEED, given[2])])?;
    match (&offsets_um, rms_um) {
        (None, None) if seed.is_some() => {
            let why = "bearing.element_diameter_seed draws diameters of that size";
            return Err(TableFault::Missing { key: RMS, why }.into());
        }
        (Some(given), _) if given.len() != bearing.element_count => {
            let (found, count) = (given.len(), bearing.element_count);
            return Err(SceneError::from(BearingError::DiameterCount { found, count }).into());
        }
        (Some(given), _) if given.iter().any(|&um| um != 0.0) => {
            bearing.diameter_offsets = given.iter().map(|um| um / 1e6).collect();
        }
        (None, Some(um)) => {
            DIAMETER_RMS.check(um / 1e6)?;
            let why = "diameters of elements are drawn";
            let missing = TableFault::Missing { key: SEED, why };
            let seed = seed.or((um == 0.0).then_some(0)).ok_or(missing)?;
            bearing.draw_diameters(DrawnDiameters { rms: um / 1e6, seed });
        }
        (Some(_), _) | (None, None) => {}
    }
    Ok(())
}
