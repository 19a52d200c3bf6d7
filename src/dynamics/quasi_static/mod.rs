//! Elements without inertia, which are in balance between both raceways at every instant.

mod balance_lanes;
mod element_balance;
mod path_search;
mod tangent;

pub use tangent::{RingJacobian, Rings};

pub(crate) use tangent::stacked;

pub(in crate::dynamics) use balance_lanes::SmoothElements;
pub(in crate::dynamics) use element_balance::InBalance;
pub(in crate::dynamics) use path_search::PathSearch;
pub(in crate::dynamics) use tangent::RadialForce;
