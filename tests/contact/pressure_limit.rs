//! Pressures that stay below a limit: perfect plasticity of the surface, against an independent solution of the same
//! problem, and a ball on the edge of a spall, whose pressure then has an end.

#![allow(clippy::unwrap_used)]
use brinell::contact::rolling::RacewaySide;
use brinell_analysis::pressure::{BallOnRaceway, ConjugateGradients, GridContact, GridProblem};

/// A sphere of a ball's radius (m) on a plane; E* and the limit (Pa).
const RADIUS: f64 = 3.97e-3;
const MODULUS: f64 = 113.7363e9;
const LIMIT: f64 = 6e9;
/// Force (N) and approach (m) at which Hertz's pressure comes to the limit: π³ R² H³/(6 E*²), R (π H/(2 E*))².
const ONSET: (f64, f64) = (1359.988, 27.260_56e-6);

fn sphere(approach: f64, cells: usize, limit: f64) -> GridContact {
    // The contact's radius of an elastic sphere, and room for one that yields, which is up to 1.4 times as wide.
    let side = 2.0 * 1.5 * (RADIUS * approach).sqrt() / cells as f64;
    let gap = |x: f64, y: f64| (x * x + y * y) / (2.0 * RADIUS);
    let problem = GridProblem::sampled(cells, cells, [side, side], MODULUS, gap).unwrap();
    let contact = ConjugateGradients::new(&problem, 1e-8, limit).unwrap().at_approach(approach).unwrap();
    problem.check_border(&contact).unwrap();
    contact
}

#[test]
fn a_sphere_that_yields_carries_less_and_stays_dented() {
    let (force, approach) = ONSET;
    let closed = std::f64::consts::PI.powi(3) * RADIUS * RADIUS * LIMIT.powi(3) / (6.0 * MODULUS * MODULUS);
    assert!((closed / force - 1.0).abs() < 1e-6, "{closed}");
    for (times, share, dent) in [(2.0, 2.720, 7.85e-6), (4.0, 6.816, 35.05e-6), (8.0, 16.04, 104.56e-6)] {
        let found = sphere(times * approach, 64, LIMIT);
        // Two grids of the independent solution agree to 2e-4; four digits of it are given.
        assert!((found.force / force / share - 1.0).abs() < 1e-3, "{times}: {}", found.force / force);
        let most = |of: &[f64]| of.iter().copied().fold(0.0, f64::max);
        let (highest, deepest) = (most(&found.pressure), most(&found.dent));
        assert!(highest <= LIMIT * (1.0 + 1e-12), "{times}: {highest:e}");
        // The deepest cell is half a cell off the axis, where the sphere is 5.5e-4 of the approach higher.
        assert!((deepest / dent - 1.0).abs() < 5e-3, "{times}: {deepest:e}");
    }
}

#[test]
fn below_the_onset_of_yielding_the_limit_changes_nothing() {
    let (_, approach) = ONSET;
    let [elastic, limited] = [f64::INFINITY, LIMIT].map(|limit| sphere(0.8 * approach, 64, limit));
    assert_eq!(limited.pressure, elastic.pressure);
    assert!(limited.dent.iter().all(|&dent| dent == 0.0) && elastic.dent.is_empty());
}

#[test]
fn the_edge_of_a_spall_is_rounded_by_less_than_half_a_micrometre_and_the_force_hardly_changes() {
    let scene = brinell_scene_file::from_toml(include_str!("../../scenes/er16k-tb1.toml")).unwrap();
    let edge = 0.5 * 15.8f64.to_radians();
    let mut ball = BallOnRaceway::of(&scene, None, RacewaySide::Outer, edge).unwrap();
    // The independent solution's forces at one approach: elastic, and with either limit.
    let elastic = ball.pressed(373.2, 256).unwrap().approach;
    for (limit, force, dent) in [(6e9, 372.05, 0.2e-6..0.4e-6), (4.5e9, 370.81, 0.3e-6..0.6e-6)] {
        ball.pressure_limit = limit;
        let pressed = ball.pressed(force, 256).unwrap();
        // The independent solution's grid leaves the rim's depth uncertain by a third. Here the approach at its forces
        // is above by 3e-4 and 4e-4 on 128 cells, 5e-4 and 6e-4 on 256, 6e-4 and 7e-4 on 1024; without the limit it
        // would be below by 2e-3 and 4e-3.
        assert!((pressed.approach / elastic - 1.0).abs() < 8e-4, "{limit:e}: {:e} {elastic:e}", pressed.approach);
        assert!(pressed.max_pressure() <= limit * (1.0 + 1e-12));
        let (depth, length, at) = pressed.deepest_dent().unwrap();
        assert!(dent.contains(&depth), "{limit:e}: {depth:e} deep");
        assert!((4e-6..14e-6).contains(&length) && at[0].abs() < 20e-6, "{limit:e}: {length:e} long at {at:?}");
    }
    ball.pressure_limit = f64::INFINITY;
    assert_eq!(ball.pressed(372.0, 64).unwrap().deepest_dent(), None);
}

#[test]
fn a_limit_that_is_none_is_refused() {
    let problem = GridProblem::new(1, 1, [1e-6; 2], MODULUS, vec![0.0]).unwrap();
    for limit in [0.0, -1e9, f64::NAN] {
        assert!(ConjugateGradients::new(&problem, 1e-8, limit).is_err());
    }
}
