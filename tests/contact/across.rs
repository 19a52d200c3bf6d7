//! A pit beside the track of a ball at a contact angle: slices of law `map` against law `love`, and that against the
//! fine grid of pressures, wherever the contact is across the groove.
#![allow(clippy::unwrap_used)]

use std::fmt::Write;
use std::sync::Arc;

use brinell::contact::across::Slices;
use brinell::contact::element_on_raceway::ElementOnRaceway;
use brinell::contact::love::{LoveContact, Resolution};
use brinell::contact::map::{ContactMap, MapSpecification, Sequential};
use brinell::contact::near_defect::{Approach, LoveSolvers, NearDefect, NearMap};
use brinell::contact::rolling::RacewaySide;
use brinell::scene::Bearing;
use brinell::surface::{Surface, Topography};
use brinell_analysis::pressure::{BallOnRaceway, DefectBelow};

/// Largest approach (m), of some 600 N.
const LARGEST: f64 = 8e-6;
const CELLS: Resolution = Resolution { columns: 24, rows: 16 };
/// Distance of the ball's centre from the ring's axis (m), which only scales what is not asked for here.
const DISTANCE: f64 = 19.5e-3;

fn element() -> ElementOnRaceway {
    let bearing = Bearing { radial_clearance: 8e-6, ..Bearing::steel_balls(9, 7.94e-3, 39.04e-3) };
    ElementOnRaceway::at_angle(&bearing, RacewaySide::Outer, 15f64.to_radians())
}

/// A smooth pit, 0.6 mm long and 1.6 mm wide, 5 µm deep; its middle is 0.3 mm from arc and place 0.
fn pit() -> Topography {
    let mut text = String::from("arc_mm,axial_mm,depth_um\n");
    let hump =
        |x: f64, half: f64| if x.abs() < half { (0.5 * std::f64::consts::PI * x / half).cos().powi(2) } else { 0.0 };
    for i in 0..=100 {
        for j in 0..=40 {
            let (s, y) = (f64::from(i) * 0.006 - 0.3, f64::from(j) * 0.05 - 0.7);
            writeln!(text, "{s:.5},{y:.5},{:.6}", 5.0 * hump(s, 0.3) * hump(y - 0.3, 0.8)).unwrap();
        }
    }
    Topography::from_csv(&text).unwrap()
}

/// Δ with its slopes by path, arc and place.
type Slopes = [f64; 4];

/// Forces of a ball (N/N of the largest) along the normal, along the raceway and across it, by the ball's way.
fn forces([value, du, ds, dy]: Slopes) -> [f64; 3] {
    let force = (value.max(0.0) / LARGEST).powf(1.5);
    // The contact goes r_g/d = 26 times as far across as the ball's centre.
    [force * du, -force * ds, -26.0 * force * dy]
}

/// Path, arc and place (m) of points that fill the surroundings of the pit evenly, up to `across` (m) from the track.
fn points(count: usize, across: f64, first_touch: impl Fn(f64, f64) -> f64) -> Vec<[f64; 3]> {
    let fraction = |n: usize, by: f64| (n as f64 * by).fract();
    (1..=count)
        .map(|n| {
            let s = 0.4e-3 * (2.0 * fraction(n, 0.819_172_51) - 1.0);
            let place = across * (2.0 * fraction(n, 0.671_043_61) - 1.0);
            [first_touch(s, place) + (0.02 + 0.9 * fraction(n, 0.549_700_48)) * LARGEST, s, place]
        })
        .collect()
}

fn love(surface: &Surface, cells: Resolution) -> LoveContact {
    LoveContact::new(element(), surface, 1.8 * LARGEST, cells).unwrap()
}

fn solved(love: &mut LoveContact, [u, s, place]: [f64; 3]) -> Slopes {
    let (found, by_place) = love.solve_across(u, s, place).unwrap();
    [found.value, found.du, found.ds, by_place]
}

#[test]
fn slopes_across_and_second_derivatives_are_those_of_the_approach() {
    let mut love = love(&Surface::Topography(pit()), CELLS);
    let steps = [1e-9, 1e-8, 1e-8];
    let (mut left_out, mut compared) = (0, 0);
    for at in points(60, 0.6e-3, |_, _| 1e-6) {
        let mut moved = |k: usize, by: f64| {
            let mut at = at;
            at[k] += by * steps[k];
            solved(&mut love, at)
        };
        let mut over = |k: usize, h: f64| {
            let (after, before) = (moved(k, h), moved(k, -h));
            [0, 1, 2, 3].map(|i: usize| (after[i] - before[i]) / (2.0 * h * steps[k]))
        };
        let differences: Vec<_> = (0..3).map(|k| [over(k, 1.0), over(k, 2.0)]).collect();
        let found = solved(&mut love, at);
        if found[0] < 0.1 * LARGEST {
            continue;
        }
        let second = love.second_derivatives_across(at[0], at[1], at[2]).unwrap();
        for k in 0..3 {
            let [near, far] = differences[k];
            // Where a cell joins or leaves the contact between the points, slopes have a kink.
            let kinked = |i: usize, scale: f64| (near[i] - far[i]).abs() > 1e-4 * scale;
            let scale = [1.0, 0.01, 0.01][k];
            assert!((near[0] - found[1 + k]).abs() < 1e-4 * scale, "{at:?} {k}: {} {}", near[0], found[1 + k]);
            for i in 0..3 {
                let scale = [[1e4, 1e3, 1e3], [1e3, 1e3, 1e3], [1e3, 1e3, 1e3]][i][k];
                compared += 1;
                if kinked(1 + i, scale) {
                    left_out += 1;
                    continue;
                }
                let error = (near[1 + i] - second[i][k]).abs();
                assert!(error < 2e-3 * scale, "{at:?} {i} {k}: {} {}", near[1 + i], second[i][k]);
            }
        }
    }
    println!("{left_out} of {compared} left out");
    assert!(compared > 200 && left_out < compared / 4, "{left_out} of {compared}");
}

#[test]
fn slices_follow_law_love_along_and_across_the_groove() {
    let specification = MapSpecification { accuracy: 5e-3, resolution: CELLS, ..MapSpecification::new(LARGEST) };
    let topography = pit();
    let [_, half] = element().contact_half_axes(LARGEST);
    for (apart, beside) in [(0.125, 3), (0.25, 3)] {
        let (distance, count) = (apart * half, 2 * beside + 1);
        let first = -(beside as f64) * distance;
        let begun = std::time::Instant::now();
        let maps = (0..count).map(|k| {
            let surface = Surface::Topography(topography.seen_from(first + k as f64 * distance));
            Arc::new(ContactMap::build(&surface, element(), specification, &mut Sequential(|_, _| ())).unwrap())
        });
        let maps: Vec<_> = maps.collect();
        println!("{count} maps in {:?}, {} nodes, {:?}", begun.elapsed(), maps[0].nodes(), maps[0].accuracy());
        let map = Arc::clone(&maps[0]);
        let near = NearDefect::Map(NearMap::new(map, 1.0).with_slices(Slices::new(maps, [first, -first], distance)));
        let mut love = love(&Surface::Topography(topography.clone()), CELLS);
        let touch = love.clone();
        let (mut worst, mut single, mut most) = ([0.0f64; 3], [0.0f64; 3], [0.0f64; 3]);
        for at in points(300, (beside - 1) as f64 * distance, |s, _| touch.first_touch(s)) {
            let exact = solved(&mut love, at);
            if exact[0] > LARGEST {
                continue;
            }
            let exact = forces(exact);
            let of = |place: f64| {
                let cell = near.knots().partition_point(|&knot| knot <= at[1]).clamp(1, near.knots().len() - 1) - 1;
                let (Approach { value, by_path, by_angle, .. }, by_place) = near
                    .approach_across(cell, [at[0], place], (at[1], DISTANCE), true, &mut LoveSolvers::default())
                    .unwrap();
                forces([value, by_path, by_angle, by_place])
            };
            let (found, on_track) = (of(at[2]), of(0.0));
            for i in 0..3 {
                worst[i] = worst[i].max((found[i] - exact[i]).abs());
                let one = if i == 2 { 0.0 } else { on_track[i] };
                single[i] = single[i].max((one - exact[i]).abs());
                most[i] = most[i].max(exact[i].abs());
            }
        }
        println!("{apart} half-lengths: largest {most:?}, wrong by {worst:?}, with one slice {single:?}");
    }
}

#[test]
fn the_contact_beside_the_track_is_that_of_the_fine_grid_of_pressures() {
    let topography = pit();
    let mut love = love(&Surface::Topography(topography.clone()), Resolution { columns: 48, rows: 32 });
    let bearing = Bearing { radial_clearance: 8e-6, ..Bearing::steel_balls(9, 7.94e-3, 39.04e-3) };
    let modulus = brinell::geometry::hertz_constant::effective_modulus(&bearing);
    for [s, place] in [[0.0, 0.0], [0.1e-3, 0.3e-3], [-0.25e-3, 0.5e-3], [0.05e-3, -0.4e-3]] {
        let surface = Surface::Topography(topography.seen_from(place));
        let ball = BallOnRaceway {
            bodies: element(),
            effective_modulus: modulus,
            poissons_ratio: bearing.poissons_ratio,
            pressure_limit: f64::INFINITY,
            defects: vec![DefectBelow { surface, arc: s }],
        };
        let force = 300.0;
        let pressed = ball.pressed(force, 256).unwrap();
        let smooth = BallOnRaceway { defects: Vec::new(), ..ball.clone() }.pressed(force, 256).unwrap();
        let [value, du, ds, dy] = solved(&mut love, [pressed.approach, s, place]);
        // F = F_smooth(Δ) ∂Δ/∂u, and along the raceway and across it by the slopes.
        let scale = (value / smooth.approach).powf(1.5);
        // The ball's gap slopes away from its middle: pressure on it pushes by what slope it has there.
        let (r, groove) = (element().element_radius, 0.52 * 7.94e-3);
        let slope = |y: f64| y / (r * r - y * y).sqrt() - y / (groove * groove - y * y).sqrt();
        let area = pressed.cell[0] * pressed.cell[1];
        let across: f64 =
            pressed.under_pressure().map(|cell| pressed.pressure[cell] * area * slope(pressed.centre(cell)[1])).sum();
        println!(
            "{s:e} {place:e}: {} of the force, across {} for {}, along {}",
            scale * du,
            force * scale * dy,
            across,
            scale * ds
        );
    }
}
