//! Static stiffness and critical load of a case.

use anyhow::Result;
use brinell_analysis::statics::{StaticBearing, min_mean_max, sweep};

use super::Case;

/// Evenly spaced cage angles of a sweep.
const ANGLES: usize = 200;

/// The bearing at rest.
///
/// # Errors
/// Of its profile.
pub fn bearing(case: &Case) -> Result<StaticBearing> {
    Ok(StaticBearing::new(&case.scene, case.profile())?)
}

/// Least, mean and greatest stiffness along the load over the cage angle (N/µm).
///
/// # Errors
/// Without a balance.
pub fn stiffness(case: &Case) -> Result<[f64; 3]> {
    let swept = sweep(&bearing(case)?, -std::f64::consts::FRAC_PI_2, ANGLES)?;
    Ok(min_mean_max(&swept, |balance| 1e-6 * balance.free_stiffness()))
}

/// Load at which elements on the floor carry again (N); none where they never do.
///
/// # Errors
/// Without a balance.
pub fn critical_load(case: &Case) -> Result<Option<f64>> {
    Ok(bearing(case)?.critical_load()?.ok().map(|critical| critical.load))
}
