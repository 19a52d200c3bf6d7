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
#[path = "../support/mod.rs"]
mod support;
mod surface;
mod two_materials;

use brinell::contact::element_on_raceway::{Across, ElementOnRaceway};
use brinell::contact::map::{ContactMap, MapSpecification, Sequential};
use brinell::contact::rolling::RacewaySide;
use brinell::surface::{Surface, Topography};
use std::fmt::Write;
use std::ops::Range;

/// Force of a ball on a smooth raceway at an approach (m), over Hertz's constant.
fn hertz(approach: f64) -> f64 {
    approach * approach.sqrt()
}

/// The map of a surface.
fn built(surface: &Surface, element: ElementOnRaceway, specification: MapSpecification) -> ContactMap {
    ContactMap::build(surface, element, specification, &mut Sequential(|_, _| ())).unwrap()
}

/// A roller of 7.5 mm × 9 mm on a raceway of the NU205.
fn nu205(raceway: RacewaySide, crowned: bool) -> ElementOnRaceway {
    let raceway_radius = if raceway == RacewaySide::Inner { 15.75e-3 } else { 23.25e-3 };
    let across = Across::Roller { length: 9e-3, crowned };
    ElementOnRaceway { element_radius: 3.75e-3, raceway_radius, across, raceway }
}

/// The n-th of points that fill a square evenly: Kronecker's sequence with the golden ratio's relatives.
fn spread(n: usize) -> [f64; 2] {
    [(0.754_877_666 * n as f64).fract(), (0.569_840_291 * n as f64).fract()]
}

/// A topography with points at whole multiples of two distances (mm), its depth in µm.
fn topography(
    arcs: Range<i32>,
    long: f64,
    places: Range<i32>,
    wide: f64,
    depth: impl Fn(f64, f64) -> f64,
) -> Topography {
    let mut text = String::from("arc_mm,axial_mm,depth_um\n");
    for (i, j) in arcs.flat_map(|i| places.clone().map(move |j| (i, j))) {
        let (s, y) = (long * f64::from(i), wide * f64::from(j));
        writeln!(text, "{s:.5},{y:.5},{:.6}", depth(s, y)).unwrap();
    }
    Topography::from_csv(&text).unwrap()
}
