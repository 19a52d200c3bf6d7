//! Equations of motion of rings, rolling elements and sensor: state in, derivative and forces out.
//!
//! Knows neither steps nor hosts. Time enters only through a [`drive::Drive`], which gives the cage angle and the
//! prescribed motions and loads as polynomials of the time since the last communication point.

mod balance_lanes;
mod balance_variation;
mod balanced_derivative;
mod body_rates;
pub mod contact_lanes;
pub(crate) mod dense_output;
pub mod drive;
mod element_balance;
mod element_block;
mod element_contacts;
mod element_variation;
pub mod equilibrium;
mod equilibrium_error;
pub mod equilibrium_variation;
pub mod film;
pub mod forces;
mod gap_lanes;
pub mod irregularity;
pub mod jacobian;
pub mod kinematics;
pub mod layout;
mod linearized;
pub mod model;
mod other_contacts;
mod path_search;
pub mod raceway;
mod right_hand_side;
mod ring_motion;
pub mod sensor_modes;
pub mod supports;
pub mod tangent;
pub mod variation;
