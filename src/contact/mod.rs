//! Contact of one rolling element with a raceway. Knows no time, no cage and no ring: position and approach in, force
//! out.

pub mod active_set;
mod batched_fft;
pub mod cholesky;
pub mod compliant;
pub mod conjugate_gradients;
pub mod contact_maps;
pub mod crown;
pub mod edge_softness;
pub mod elasticity;
pub mod element_on_raceway;
pub mod equivalent;
pub mod error;
pub mod fft_product;
pub(crate) mod flat_stretches;
pub mod force_law;
pub mod grid;
pub mod half_space;
pub mod love;
pub mod map;
pub mod map_build;
mod map_cells;
mod map_checks;
pub mod map_format;
pub mod map_plan;
pub mod map_specification;
pub mod near_defect;
mod patch_plan;
pub mod raceway_grid;
pub mod rigid_path;
mod rigid_roller;
pub mod rolling;
mod row_pairs;
pub mod smooth_laws;
mod smooth_scale;
mod soft_edges;
pub mod squeeze_film;
