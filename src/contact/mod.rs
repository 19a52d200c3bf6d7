//! Contact of one rolling element with a raceway. Knows no time, no cage and no ring: place and approach in, force out.

pub mod force_law;
pub mod near_defect;
pub mod rigid_path;
