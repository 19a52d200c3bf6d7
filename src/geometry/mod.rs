//! Bearing geometry: constants of its contacts, their oil films, kinematics and characteristic frequencies.
//!
//! ```
//! use brinell::geometry::hertz_constant::{HertzConstants, approach_under};
//! use brinell::geometry::kinematics::frequencies;
//! use brinell::scene::Bearing;
//!
//! let bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3);
//! // At 25 turns a second a point of the outer raceway is passed 9/2 (1 − 7.94/39.04) times as often.
//! assert!((frequencies(&bearing, 0.0, 25.0).bpfo - 89.6).abs() < 0.1);
//! // 500 N press a ball some micrometres into the outer raceway.
//! assert!((3e-6..3e-5).contains(&approach_under(500.0, HertzConstants::of(&bearing).outer)));
//! ```

pub mod curvature;
pub mod film_thickness;
pub mod hertz_constant;
pub mod kinematics;
pub mod line_contact;
pub mod load_rating;

/// Force on the most loaded element over an even share F/Z of the bearing's load, for usual clearances (Stribeck, *Ball
/// bearings for various loads*, Trans. ASME 29, 1907): balls without any have 4.37.
pub const STRIBECK: f64 = 5.0;
