//! How far a contact map is from the grid it was made from, on the three kinds of surface: a vertical edge, a measured
//! trace, a rough topography.

use crate::er16k::OUTER as ER16K;
use crate::support;
use brinell::contact::element_on_raceway::ElementOnRaceway;
use brinell::contact::love::{LoveContact, Resolution};
use brinell::contact::map::{ContactMap, MapSpecification};
use brinell::contact::rolling::RacewaySide;
use brinell::simulation::setup;
use brinell::surface::Surface;

/// A shallow spall with sloped flanks, whose floor is rough by 1 µm and different at front and back; the element
/// touches the floor.
fn rough() -> Surface {
    Surface::Topography(crate::topography(-60..61, 0.0065, -20..21, 0.1, |s, y| {
        let flank = ((0.35 - s.abs()) / 0.08).clamp(0.0, 1.0);
        let waves =
            (17.0 * s + 2.0 * y).sin() + 0.7 * (31.0 * s - 3.0 * y + 1.0).sin() + 0.5 * (5.0 * y + 9.0 * s).cos();
        flank * (8.0 + waves)
    }))
}

/// Differences of both forces between a map and a grid, over points that fill the map evenly: largest and root mean
/// square, of full scale.
fn compare(map: &ContactMap, grid: &mut LoveContact, points: usize) -> ([f64; 2], [f64; 2]) {
    let largest = map.largest_approach();
    let (mut worst, mut squares, mut count) = ([0.0_f64; 2], [0.0; 2], 0.0);
    let stretches: Vec<[f64; 2]> = map.knots().chunks(2).map(|ends| [ends[0], ends[1]]).collect();
    for n in 0..points {
        let [from, to] = stretches[n % stretches.len()];
        let [q, t] = crate::spread(n);
        let s = from + q * (to - from);
        let u = grid.first_touch(s) + t * 1.3 * largest;
        let exact = grid.solve(u, s).unwrap();
        if exact.value > largest {
            continue;
        }
        let (exact, found) = (exact.forces(crate::hertz), map.lookup(u, s).unwrap().forces(crate::hertz));
        count += 1.0;
        for k in 0..2 {
            let error = (found[k] - exact[k]) / largest.powf(1.5);
            worst[k] = worst[k].max(error.abs());
            squares[k] += error * error;
        }
    }
    assert!(count > 0.5 * points as f64);
    (worst, squares.map(|sum| (sum / count).sqrt()))
}

fn demonstrate(name: &str, map: &ContactMap, surface: &Surface, element: ElementOnRaceway, of: MapSpecification) {
    let mut grid = LoveContact::new(element, surface, 1.8 * of.largest_approach, of.resolution).unwrap();
    let (worst, mean) = compare(map, &mut grid, 1000);
    let per_flank = map.nodes() / 2;
    // What was asked for, and a tenth of it; the budget of nodes the method is meant for.
    assert!(worst.iter().all(|&e| e <= 1e-3), "{name}: {worst:?}");
    assert!(mean.iter().all(|&e| e <= 1e-4), "{name}: {mean:?}");
    assert!(per_flank <= 1500, "{name}: {per_flank}");
}

/// The map that a shipped scene's FMU holds.
fn demonstrate_shipped(name: &str) {
    let scene = support::shipped_as_it_is(name);
    let profile = support::profile_of(&scene);
    let surface = Surface::load(&scene.defects[0], profile.as_deref(), &scene.bearing).unwrap();
    let bytes = support::map_of(&scene, profile.as_deref()).unwrap();
    let map = ContactMap::from_bytes(&bytes, setup::map_fingerprint(&scene, std::slice::from_ref(&surface)).unwrap())
        .unwrap();
    let (element, side) = (ElementOnRaceway::of(&scene.bearing, RacewaySide::Outer), RacewaySide::Outer);
    demonstrate(name, &map, &surface, element, setup::map_specification(&scene, side));
}

#[test]
fn the_map_follows_the_grid_at_a_vertical_edge() {
    demonstrate_shipped("er16k-tb1");
}

#[test]
fn the_map_follows_the_grid_over_a_measured_trace() {
    // One patch from before the first edge to after the last.
    demonstrate_shipped("6205-epps");
}

/// `cargo test --workspace --release --test contact accuracy:: -- --ignored`
#[test]
#[ignore = "takes minutes: without mirrored halves a contact has twice the unknowns"]
fn the_map_follows_the_grid_over_a_rough_topography() {
    let specification =
        MapSpecification { resolution: Resolution { columns: 40, rows: 32 }, ..MapSpecification::new(10e-6) };
    let surface = rough();
    let map = crate::built(&surface, ER16K, specification);
    demonstrate("rough", &map, &surface, ER16K, specification);
}
