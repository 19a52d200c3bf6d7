//! The scenes that the extremes are made of, of balls and of rollers.

use crate::support::shipped;
use brinell::scene::{Damping, Defect, DefectShape, ElementInertia, Ring, Scene};
use std::f64::consts::FRAC_PI_2;

/// One kind of bearing under extremes.
#[derive(Clone, Copy)]
pub struct Kind {
    /// What the names of its cases begin with where both kinds stand beside each other.
    pub prefix: &'static str,
    healthy: &'static str,
    spalled: &'static str,
    /// Number of elements of the healthy bearing.
    pub count: usize,
}

pub const BALLS: Kind = Kind { prefix: "", healthy: "6205-healthy", spalled: "er16k-tb1", count: 9 };
pub const ROLLERS: Kind = Kind { prefix: "rollers: ", healthy: "nu205-healthy", spalled: "nu205-inner", count: 13 };

impl Kind {
    pub fn is_rollers(self) -> bool {
        !self.prefix.is_empty()
    }

    /// What is said of balls, or of rollers.
    pub fn pick<T>(self, balls: T, rollers: T) -> T {
        if self.is_rollers() { rollers } else { balls }
    }

    pub fn healthy(self) -> Scene {
        shipped(self.healthy)
    }

    pub fn spalled(self) -> Scene {
        shipped(self.spalled)
    }

    pub fn hosted(self) -> Scene {
        let mut scene = self.healthy();
        for ring in [&mut scene.shaft, &mut scene.housing] {
            *ring = Ring::hosted();
        }
        scene.sensors.clear();
        scene
    }

    pub fn fifty_kilonewton(self, damping: Damping) -> Scene {
        loaded(self.healthy(), 5e4, damping)
    }

    /// A spall whose edges fall by one degree.
    pub fn gentle(self) -> Scene {
        let shape = DefectShape::Spall { length: 20e-3, depth: 1e-4, edge_slope: 1f64.to_radians() };
        Scene { defects: vec![Defect::outer(-FRAC_PI_2, shape)], ..self.spalled() }
    }
}

pub fn lighter(mut scene: Scene, factor: f64) -> Scene {
    scene.bearing.element_mass = Some(factor * scene.bearing.mass_of_element());
    scene
}

/// The same, its elements in balance at every instant.
pub fn without_inertia(mut scene: Scene) -> Scene {
    scene.bearing.element_inertia = ElementInertia::None;
    scene
}

pub fn loaded(mut scene: Scene, load: f64, damping: Damping) -> Scene {
    (scene.shaft.load, scene.contact.damping) = ([0.0, -load], damping);
    scene
}
