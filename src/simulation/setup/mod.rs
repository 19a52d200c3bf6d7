//! From a scene to the parameters of its equations and the contact maps that they need.

mod across;
mod arrangement;
mod maps;
mod model;
mod parameters;
mod specification;
mod tracks;
mod waves;

pub use across::{check_reach, track_across, track_width};
pub use arrangement::largest_force;
pub use maps::{NeededMap, build_map, map_fingerprint, needed_maps, stored_map};
pub use model::build_model;
pub use specification::map_specification;
pub use tracks::with_operating_angle;

pub(in crate::simulation) use model::Setup;
pub(in crate::simulation) use parameters::{parameter, start_values};
pub(in crate::simulation) use specification::forces_of;
