//! Law `map`: the elastic contact near a defect, solved beforehand on nodes and looked up inside the step.

mod build;
mod cells;
mod checks;
mod contact_maps;
mod flanks;
mod format;
pub mod lookup;
mod patch_plan;
mod plan;
mod second_derivatives;
mod specification;

pub use build::REFUSED;
pub use contact_maps::ContactMaps;
pub use flanks::Flanks;
pub use format::{HEAD, TAIL};
pub use lookup::{CONTINUED, ContactMap, MAPPED};
pub use plan::{MapPlan, Unmapped};
pub use specification::{MapSpecification, Runner, Sequential};
