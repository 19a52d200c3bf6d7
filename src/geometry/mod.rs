//! Bearing geometry: constants of its contacts, kinematics and characteristic frequencies.

pub mod hertz_constant;
pub mod kinematics;
pub mod line_contact;
