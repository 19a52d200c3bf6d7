//! Trajectories against printed figures.

use super::*;
use brinell::scene::{ContactLaw, Damping, Motion};
use std::f64::consts::{PI, TAU};

/// What the trajectories have in common: loads step after a millisecond.
struct Path {
    scene: SceneBuilder,
    load: [f64; 3],
    moment: [f64; 2],
    later: [f64; 3],
    later_moment: [f64; 2],
    end: f64,
    /// Positions (µm), tilts (mrad), u and v (µm), forces (N) and angles (degrees) at the start and at the end.
    expected: [&'static str; 2],
}

fn shows(simulation: &mut Simulation, expected: &str, halves: f64) {
    let names: [(&[&str], f64); 5] = [
        (&["shaft.x", "shaft.y", "shaft.z"], 1e-6),
        (&["shaft.tilt.x", "shaft.tilt.y"], 1e-3),
        (&["element[1].path", "element[1].axial"], 1e-6),
        (&["element[1].force.inner", "element[1].force.outer"], 1.0),
        (&["element[1].contact_angle.inner", "element[1].contact_angle.outer"], PI / 180.0),
    ];
    for ((names, unit), expected) in names.into_iter().zip(expected.split(',')) {
        let names = names.iter().take(expected.split_whitespace().count());
        let found: Vec<f64> = names.map(|name| simulation.get(name).unwrap()).collect();
        printed_within(halves, &found, unit, expected);
    }
}

impl Path {
    fn must_be_followed(self) {
        let [x, y, z] = self.load;
        let mut scene = self.scene.shaft_load([x, y]).axial_load(z).damping(Damping::HuntCrossley(0.5));
        scene = scene.law(ContactLaw::Hertz).tolerance(1e-11).experiment(0.01, 1e-4);
        let mut scene = scene.build().unwrap();
        scene.shaft.tilt.load_moment = self.moment;
        let freedom = scene.bearing.degrees_of_freedom;
        let mut simulation = started(scene);
        shows(&mut simulation, self.expected[0], 1.1);
        simulation.step(1e-3).unwrap();
        let mut set = |name: &str, value: f64| simulation.set(name, value).unwrap();
        for (axis, value) in ["x", "y", "z"].into_iter().zip(self.later) {
            set(&format!("shaft.load.{axis}"), value);
        }
        if freedom == DegreesOfFreedom::Five {
            for (axis, value) in ["x", "y"].into_iter().zip(self.later_moment) {
                set(&format!("shaft.load_moment.{axis}"), value);
            }
        }
        simulation.step(self.end - 1e-3).unwrap();
        // At tolerance 1e-11 the last printed digit, 1e-13 m, may be one off.
        shows(&mut simulation, self.expected[1], 3.0);
    }
}

fn shaft() -> Ring {
    let mut shaft = Ring::default_shaft();
    assert!(shaft.motion == Motion::Internal && shaft.mass == 3.2638 && shaft.damping == 1376.8);
    shaft.axial.damping = 1376.8;
    shaft
}

#[test]
fn an_angular_contact_bearing_whose_load_steps_moves_as_printed() {
    let bearing = Bearing {
        hertz_inner: Some(2.8220117103e10),
        hertz_outer: Some(2.4979733371e10),
        operating_angle: Some(20f64.to_radians()),
        ..angular(20.0)
    };
    let scene = free_shaft(bearing, DegreesOfFreedom::Three).shaft(shaft()).shaft_speed(TAU * 60.0);
    Path {
        scene: scene.cage(0.0, (-80f64).to_radians()),
        load: [0.0, -200.0, 500.0],
        moment: [0.0; 2],
        later: [30.0, -200.0, 650.0],
        later_moment: [0.0; 2],
        end: 6e-3,
        expected: [
            "0.0001824 -1.2258748 14.1546354, , -11.7420735 8.4322038, 145.428164 146.286609, 22.367399 22.229459",
            "0.1374225 -1.0969556 17.1115966, , -12.1671657 10.2774601, 167.061005 167.909078, 22.875559 22.759542",
        ],
    }
    .must_be_followed();
}

#[test]
fn a_6205_that_tilts_moves_as_printed() {
    let bearing = Bearing {
        hertz_inner: Some(2.5447821326e10),
        hertz_outer: Some(2.6967202749e10),
        element_mass: Some(2.0443e-3),
        operating_angle: Some(15f64.to_radians()),
        ..b6205(8e-6)
    };
    let mut ring = shaft();
    (ring.tilt.transverse_inertia, ring.tilt.polar_inertia, ring.tilt.damping) = (4e-3, 2e-3, 0.4);
    let scene = free_shaft(bearing, DegreesOfFreedom::Five).shaft(ring).shaft_speed(TAU * 40.0);
    Path {
        scene: scene.cage(0.0, (-80f64).to_radians()),
        load: [0.0, -250.0, 350.0],
        moment: [0.3, 0.2],
        later: [0.0, -250.0, 350.0],
        later_moment: [-0.5, 0.5],
        end: 6e-3,
        expected: [
            "1.2530610 -11.9668980 91.3798213, 1.7981733 0.2218177, 1.9070357 27.8599253, \
             240.375840 240.796314, 9.950367 9.834962",
            "3.1007436 -5.5747384 93.3916311, 0.6485921 0.5325005, -0.9883036 38.4179412, \
             185.369700 185.778984, 13.760381 13.682040",
        ],
    }
    .must_be_followed();
}

#[test]
fn a_6205_with_an_outer_spall_that_is_met_at_fifteen_degrees_moves_as_printed() {
    let bearing = Bearing {
        hertz_inner: Some(2.5447889304e10),
        hertz_outer: Some(2.6967253593e10),
        element_mass: Some(2.0443e-3),
        operating_angle: Some(15f64.to_radians()),
        ..b6205(5e-6)
    };
    let scene = free_shaft(bearing, DegreesOfFreedom::Three).shaft(shaft()).shaft_speed(TAU * 30.0);
    let scene = scene.cage(0.0, (-103.0174921316f64).to_radians()).spall(-0.5 * PI, 0.3e-3, 50e-6);
    Path {
        scene,
        load: [0.0, -200.0, 400.0],
        moment: [0.0; 2],
        later: [0.0, -200.0, 400.0],
        later_moment: [0.0; 2],
        end: 3.1e-3,
        expected: [
            "0.0001255 -1.3198215 86.7957892, , -1.9238706 43.3527976, 211.965904 212.205336, 15.466223 15.448164",
            "0.0000599 -1.4512454 86.8346705, , -1.8390510 43.3697620, 218.590428 219.168183, 15.466101 15.445968",
        ],
    }
    .must_be_followed();
}
