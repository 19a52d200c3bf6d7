//! The static equilibrium from which a run starts, where contacts are hard to balance.

use crate::support::{Named, shipped, straight};
use brinell::scene::{Damping, DefectOn, Scene};
use brinell::simulation::SimulationError;
use std::f64::consts::TAU;

/// A shipped scene with straight rollers, damped as whole bearings are where nothing else is known.
fn straight_rollers(name: &str, speed_hz: f64, cage_angle: f64) -> Scene {
    let mut scene = shipped(name);
    scene.bearing.element = straight(9e-3);
    scene.contact.damping = Damping::Proportional(1.25e-5);
    scene.shaft_speed = speed_hz * TAU;
    scene.cage.initial_angle = cage_angle;
    scene
}

/// Starts a bearing and runs it for 2 ms. Gives what its contacts lack of the load at the start (N).
fn lacking(scene: Scene) -> Result<f64, SimulationError> {
    let load = scene.shaft.load;
    let mut bearing = Named::new(scene);
    bearing.0.initialize(0.0)?;
    let [x, y] = bearing.all(["shaft.force.x", "shaft.force.y"]);
    bearing.run(1e-4, 20);
    Ok((x + load[0]).abs().max((y + load[1]).abs()))
}

/// Cage angles at which these start not, or with less of the load than a path between two numbers can cost.
fn refused(scene: impl Fn(f64) -> Scene) -> Vec<String> {
    let angles = (0..24).map(|k| f64::from(k) * TAU / 24.0);
    let one = |angle: f64| {
        let scene = scene(angle);
        // Each roller that rests on the inner ring may lack its own weight.
        let weights = scene.bearing.element_count as f64 * scene.bearing.mass_of_element() * 9.81;
        match lacking(scene) {
            Ok(lacking) if lacking <= weights => None,
            Ok(lacking) => Some(format!("{angle:.3} rad: {lacking} N")),
            Err(error) => Some(format!("{angle:.3} rad: {error}")),
        }
    };
    angles.filter_map(one).collect()
}

#[test]
fn straight_rollers_that_rest_on_the_inner_ring_start_at_every_cage_angle() {
    // From 8.2 Hz on the centrifugal force holds all rollers on the outer raceway.
    for speed_hz in [0.5, 1.0, 2.0, 4.0, 6.0, 8.0] {
        let refused = refused(|angle| straight_rollers("nu205-healthy", speed_hz, angle));
        assert!(refused.is_empty(), "{speed_hz} Hz: {refused:#?}");
    }
}

#[test]
fn straight_rollers_start_beside_defects_of_every_body() {
    for on in [DefectOn::Outer, DefectOn::Inner, DefectOn::Element { element: 0, tilt: 0.0 }] {
        for speed_hz in [2.0, 25.0] {
            let scene = |angle| {
                let mut scene = straight_rollers("nu205-inner", speed_hz, angle);
                scene.defects[0].on = on;
                scene
            };
            let refused = refused(scene);
            assert!(refused.is_empty(), "{on:?}, {speed_hz} Hz: {refused:#?}");
        }
    }
}

/// Three preloaded balls, one of which stands with its flattened side towards the raceways of an outer ring that turns
/// fast: from where the host holds that ring the search for the shaft's place ended on a ledge, 21 N short.
#[test]
fn a_shaft_finds_its_place_between_three_balls_of_which_one_is_worn() {
    let scene = r#"
        name = "three-balls"
        gravity_m_s2 = [0.0, 0.0]
        bearing = { element_diameter_mm = 9.207846868375288, pitch_diameter_mm = 39.69855116940229, element_count = 3,
            conformity_inner = 0.5418311504892677, conformity_outer = 0.5020353924135197,
            radial_clearance_um = -6.661130184825143, outer_compliance_m_n = 1.987772316340408e-11,
            youngs_modulus_gpa = 207.0, poissons_ratio = 0.3, density_kg_m3 = 7800.0 }
        contact = { law = "hertz", damping = "hunt-crossley", damping_chi_s_m = 43.517523779915955 }
        cage = { initial_angle_deg = 136.051194557594 }
        shaft = { motion = "internal", speed_hz = 0.0, load_n = [-21.04788467050047, -12.673127534101988],
            mass_kg = 0.007246800626627155, damping_n_s_m = 2.499002197568621, stiffness_n_m = 0.0 }
        housing = { motion = "host", speed_hz = 654.7213494713124 }
        [defect]
        on = "element"
        element = 2
        angle_deg = -28.046463718615115
        tilt_deg = -14.389073384442872
        length_deg = 72.35224503152276
        depth_um = 15.329727035667183
        edge_slope_deg = 16.53441229791677
    "#;
    let scene = brinell_scene_file::from_toml(scene).unwrap();
    let place = [("housing.x", 1.3336916224803659e-6), ("housing.y", 2.2805856387330655e-6)];
    let mut bearing = Named::started_with(scene, &place);
    for (name, load) in [("shaft.force.x", -21.04788467050047), ("shaft.force.y", -12.673127534101988)] {
        // What a search leaves, a hundred times.
        let force = bearing.get(name);
        assert!((force + load).abs() < 1e-8, "{name}: {force}");
    }
}
