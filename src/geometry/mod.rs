//! Bearing geometry: constants of its contacts, their oil films, kinematics and characteristic frequencies.

pub mod film_thickness;
pub mod hertz_constant;
pub mod kinematics;
pub mod line_contact;
