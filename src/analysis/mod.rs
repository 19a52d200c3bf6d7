//! What an engineer reads out of a scene or a recording. A leaf: nothing imports it.

pub mod critical_load;
pub mod static_bearing;
pub mod stiffness;
