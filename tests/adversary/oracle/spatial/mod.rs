//! A ball bearing whose rings move in space, a second time: contact law `hertz`, any defects but topographies.
//!
//! Groove centres lie on circles, of radius C_o = R_o − r_go and C_i = R_i + r_gi about their ring's axis, so that a
//! contact is the distance of a ball's centre from a circle. Every derivative here is a difference quotient, and the
//! integration is a Runge–Kutta pair with its own error estimate: what the library differentiates and what it steps by
//! has no part in it.

mod ball_balance;
mod bearing;
mod case;
mod contact;
mod dimensions;
#[cfg(test)]
mod figures;
mod random;
mod run;
mod statics;
mod surfaces;
pub mod vector;

pub use bearing::{Acting, Ball, SpatialBearing};
pub use case::{AxialSetting, Gyroscopic, Host, SpatialCase, SpatialRing, Step};
pub use random::random;
pub use run::{SpatialRun, Stop};
pub use statics::{Balance, Held};
