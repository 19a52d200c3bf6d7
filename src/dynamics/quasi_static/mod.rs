//! Elements in balance between both raceways: those without inertia at every instant, all others at the start. And
//! what that makes of the forces on the rings: the tangent stiffness.

mod balance_lanes;
mod element_balance;
mod path_search;
mod tangent;

pub use tangent::{RingJacobian, Rings};

pub(crate) use tangent::{in_plane, stacked};

pub(in crate::dynamics) use balance_lanes::SmoothElements;
pub(in crate::dynamics) use element_balance::InBalance;
pub(in crate::dynamics) use path_search::PathSearch;
pub(in crate::dynamics) use tangent::{Balanced, RadialForce, add_by_offset};
