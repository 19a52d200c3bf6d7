//! The scenes that the extremes are made of.

use crate::support::shipped;
use brinell::scene::{Damping, Defect, DefectShape, Ring, Scene};
use std::f64::consts::FRAC_PI_2;

pub fn healthy() -> Scene {
    shipped("6205-healthy")
}

pub fn spalled() -> Scene {
    shipped("er16k-tb1")
}

pub fn hosted() -> Scene {
    let mut scene = shipped("6205-healthy");
    for ring in [&mut scene.shaft, &mut scene.housing] {
        *ring = Ring::hosted();
    }
    scene.sensors.clear();
    scene
}

pub fn lighter(mut scene: Scene, factor: f64) -> Scene {
    scene.bearing.element_mass = Some(factor * scene.bearing.mass_of_element());
    scene
}

pub fn loaded(mut scene: Scene, load: f64, damping: Damping) -> Scene {
    (scene.shaft.load, scene.contact.damping) = ([0.0, -load], damping);
    scene
}

pub fn fifty_kilonewton(damping: Damping) -> Scene {
    loaded(healthy(), 5e4, damping)
}

/// A spall whose edges fall by one degree.
pub fn gentle() -> Scene {
    let shape = DefectShape::Spall { length: 20e-3, depth: 1e-4, edge_slope: 1f64.to_radians() };
    Scene { defects: vec![Defect::outer(-FRAC_PI_2, shape)], ..spalled() }
}
