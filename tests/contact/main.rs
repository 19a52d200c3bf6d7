//! Contacts near a defect: grids, maps, forces and pressures against closed forms, finer grids and each other.
#![allow(clippy::unwrap_used)]

mod accuracy;
#[path = "../support/counting.rs"]
mod counting;
mod edge;
#[path = "../support/er16k.rs"]
mod er16k;
mod grid;
mod maps;
mod near;
mod pressure;
mod pressure_limit;
mod rollers;
mod rollers_near_defects;
mod surface;
#[path = "../support/mod.rs"]
mod support;

/// Force of a ball on a smooth raceway at an approach (m), over Hertz's constant.
fn hertz(approach: f64) -> f64 {
    approach * approach.sqrt()
}
