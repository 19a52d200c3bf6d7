//! Equations of motion of a rolling bearing, contact law `hertz`, written from the equations and not from the crate.
//!
//! Each element's distance from the outer ring's centre is ρ = ρ₀ + u, its angle is the cage's. Seen from the outer
//! ring, which accelerates by a_o:
//! ```text
//! m u'' = F·e_r + m (g·e_r + ρ ω² − a_o·e_r)
//! ```
//! so a_o comes first. F is what both raceways push: each with Q along the normal of its rigid path, tan κ = P′ over
//! the distance from that ring's centre. Where the host moves the outer ring by a jump, an element keeps its u and its
//! velocity in space.

// What helpers unwrap is a test's own set-up, and names say what its numbers are.
#![allow(clippy::unwrap_used, clippy::expect_used, missing_docs)]

mod bearing;
pub mod case;
pub mod contact;
mod elimination;
mod instant;
pub mod motion;
pub mod random_case;
pub mod spatial;
pub mod surface;
pub mod turning;

pub use bearing::Bearing;
pub use contact::{growth, half_space, oil};
pub use instant::{Acting, Contact, ELEMENTS, Outside, SENSOR, Seat};
pub use motion::{balance, linear, run, signals, surfaces};
pub use random_case::draw;
pub use surface::envelope;

use contact::hertz;
use surface::uneven;
