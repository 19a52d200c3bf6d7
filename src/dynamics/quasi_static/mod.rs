//! Elements without inertia, which are in balance between both raceways at every instant.

pub(in crate::dynamics) mod balance_lanes;
mod balance_variation;
pub(in crate::dynamics) mod element_balance;
mod path_search;

pub(in crate::dynamics) use balance_lanes::SmoothElements;
pub(in crate::dynamics) use element_balance::{BodyTorque, InBalance};
pub(in crate::dynamics) use path_search::PathSearch;
