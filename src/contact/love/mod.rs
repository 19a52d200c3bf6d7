//! Law `love`: the elastic contact near a defect, solved on a grid of cells whose influence on each other Love's
//! equation gives.

mod active_set;
mod cholesky;
mod edge_softness;
mod flat_stretches;
mod half_space;
pub mod love_contact;
mod raceway_grid;
mod row_pairs;
mod second_derivatives;
mod smooth_scale;
mod soft_edges;

pub use active_set::{ActiveSet, Effort, Window};
pub use cholesky::{Cholesky, NotPositiveDefinite};
pub use edge_softness::{EdgeSoftness, image_factor};
pub use half_space::{KernelTable, rectangle_kernel};
pub use love_contact::LoveContact;
pub use raceway_grid::{ColumnSpan, RacewayGrid, Resolution};
pub use row_pairs::{Mirror, PressedCell, Run};

pub(crate) use flat_stretches::{Arcs, check_ends};

pub(in crate::contact) use flat_stretches::{Flat, flats, reach, shallowest};
