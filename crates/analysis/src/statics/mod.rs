//! The bearing at rest: load distribution, stiffness, critical load.

mod critical_load;
mod in_space;
mod load_rating;
mod static_bearing;
mod stiffness;

pub use critical_load::{Bottom, CriticalLoad, NoCriticalLoad, Sensitivity};
pub use in_space::{BalanceInSpace, BearingInSpace, LoadedBall};
pub use load_rating::{dynamic_rating, static_rating};
pub use static_bearing::{Balance, LoadedElement, StaticBearing, StaticError};
pub use stiffness::{min_mean_max, sweep};

pub(crate) use static_bearing::{InBalance, in_balance, surfaces_and_map};
pub(crate) use stiffness::{evenly_spaced, with_changes};
