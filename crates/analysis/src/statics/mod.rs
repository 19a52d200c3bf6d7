//! The bearing at rest: load distribution, stiffness, critical load.

mod critical_load;
mod in_space;
mod static_bearing;
mod stiffness;
mod study;

pub use critical_load::{Bottom, CriticalLoad, NoCriticalLoad, Sensitivity};
pub use in_space::{BalanceInSpace, BearingInSpace, LoadedBall};
pub use static_bearing::{Balance, LoadedElement, StaticBearing};
pub use stiffness::{min_mean_max, sweep};
pub use study::StaticError;

pub(crate) use stiffness::{evenly_spaced, with_changes};
pub(crate) use study::{InBalance, in_balance, surfaces_and_map};
