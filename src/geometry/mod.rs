//! Bearing geometry: constants of its contacts, their oil films, kinematics and characteristic frequencies.

pub mod curvature;
pub mod film_thickness;
pub mod hertz_constant;
pub mod kinematics;
pub mod line_contact;

/// Force on the most loaded element over an even share F/Z of the bearing's load, for usual clearances (Stribeck, *Ball
/// bearings for various loads*, Trans. ASME 29, 1907): balls without any have 4.37.
pub const STRIBECK: f64 = 5.0;
