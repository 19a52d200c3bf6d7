//! Contacts near a defect: grids, maps, forces and pressures against closed forms, finer grids and each other.

mod accuracy;
mod across;
mod allocations;
#[path = "../support/counting.rs"]
mod counting;
mod edge;
#[path = "../support/er16k.rs"]
mod er16k;
mod flanks;
mod grid;
mod inner;
mod laws;
mod map;
mod pressure;
mod pressure_limit;
mod rigid_path;
mod rollers;
mod rollers_near_defects;
mod second_derivatives;
#[path = "../support/mod.rs"]
mod support;
mod surface;
mod whole_raceway;

/// Force of a ball on a smooth raceway at an approach (m), over Hertz's constant.
fn hertz(approach: f64) -> f64 {
    approach * approach.sqrt()
}
