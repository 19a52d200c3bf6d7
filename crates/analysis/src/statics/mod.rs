//! The bearing at rest: load distribution, stiffness, critical load.

mod critical_load;
mod static_bearing;
mod stiffness;

pub use critical_load::{Bottom, CriticalLoad, NoCriticalLoad, Sensitivity};
pub use static_bearing::{Balance, LoadedElement, StaticBearing, StaticError};

pub(crate) use static_bearing::in_the_plane;
pub use stiffness::{min_mean_max, sweep};

pub(crate) use stiffness::{evenly_spaced, with_changes};
