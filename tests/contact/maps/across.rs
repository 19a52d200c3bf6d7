//! A pit beside the track of a ball at a contact angle: slices of law `map` against law `love`, and that against the
//! fine grid of pressures, wherever the contact is across the groove.

use std::sync::Arc;

use brinell::contact::across::Slices;
use brinell::contact::element_on_raceway::ElementOnRaceway;
use brinell::contact::love::{LoveContact, Resolution};
use brinell::contact::map::MapSpecification;
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

fn bearing() -> Bearing {
    Bearing { radial_clearance: 8e-6, ..Bearing::steel_balls(9, 7.94e-3, 39.04e-3) }
}

fn element() -> ElementOnRaceway {
    ElementOnRaceway::at_angle(&bearing(), RacewaySide::Outer, 15f64.to_radians())
}

/// A smooth pit, 0.6 mm long and 1.6 mm wide, 5 µm deep; its middle is 0.3 mm from arc and place 0.
fn pit() -> Topography {
    let hump =
        |x: f64, half: f64| if x.abs() < half { (0.5 * std::f64::consts::PI * x / half).cos().powi(2) } else { 0.0 };
    crate::topography(-50..51, 0.006, -14..27, 0.05, |s, y| 5.0 * hump(s, 0.3) * hump(y - 0.3, 0.8))
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
    // Steps (m) by path, arc and place, and how large second derivatives are along them (1/m).
    let (steps, scales) = ([1e-9, 1e-8, 1e-8], [1e4f64, 1e3, 1e3]);
    let (mut left_out, mut compared) = (0, 0);
    for at in points(60, 0.6e-3, |_, _| 1e-6) {
        let found = solved(&mut love, at);
        if found[0] < 0.1 * LARGEST {
            continue;
        }
        let second = love.second_derivatives_across(at[0], at[1], at[2]).unwrap();
        for k in 0..3 {
            let mut moved = |by: f64| {
                let mut at = at;
                at[k] += by * steps[k];
                (solved(&mut love, at), love.second_derivatives_across(at[0], at[1], at[2]).unwrap())
            };
            let [(after, second_after), (before, second_before)] = [moved(1.0), moved(-1.0)];
            let over = |i: usize| (after[i] - before[i]) / (2.0 * steps[k]);
            assert!((over(0) - found[1 + k]).abs() < 1e-6, "{at:?} by {k}: {} {}", over(0), found[1 + k]);
            for i in 0..3 {
                let scale = scales[i].max(scales[k]);
                compared += 1;
                // Where a cell joins or leaves the contact between the points, second derivatives step.
                if (second_after[i][k] - second_before[i][k]).abs() > 1e-3 * scale {
                    left_out += 1;
                    continue;
                }
                let error = (over(1 + i) - second[i][k]).abs();
                assert!(error < 1e-3 * scale, "{at:?} {i} by {k}: {} {}", over(1 + i), second[i][k]);
            }
        }
    }
    assert!(compared > 200 && left_out < compared / 5, "{left_out} of {compared}");
}

/// Slices this far (m) apart on both sides of the track.
fn slices(beside: i32, distance: f64) -> NearDefect {
    let specification = MapSpecification { accuracy: 5e-3, resolution: CELLS, ..MapSpecification::new(LARGEST) };
    let map = |k: i32| {
        let surface = Surface::Topography(pit().seen_from(f64::from(k) * distance));
        Arc::new(crate::built(&surface, element(), specification))
    };
    let maps: Vec<_> = (-beside..=beside).map(map).collect();
    let end = f64::from(beside) * distance;
    NearDefect::Map(NearMap::new(Arc::clone(&maps[0]), 1.0).with_slices(Slices::new(maps, [-end, end], distance)))
}

/// Δ and its slopes by slices.
fn looked_up(near: &NearDefect, [u, s, place]: [f64; 3]) -> Slopes {
    let cell = near.knots().partition_point(|&knot| knot <= s).clamp(1, near.knots().len() - 1) - 1;
    let (Approach { value, by_path, by_angle, .. }, by_place) =
        near.approach_across(cell, [u, place], (s, DISTANCE), true, &mut LoveSolvers::default()).unwrap();
    [value, by_path, by_angle, by_place]
}

#[test]
fn slices_follow_law_love_along_and_across_the_groove() {
    let [_, half] = element().contact_half_axes(LARGEST);
    let (near, mut love) = (slices(3, 0.125 * half), love(&Surface::Topography(pit()), CELLS));
    let touch = love.clone();
    let [mut worst, mut single, mut most] = [[0.0f64; 3]; 3];
    // As far as the last slices but one: from there on the slope across goes to 0.
    for at in points(300, 0.25 * half, |s, _| touch.first_touch(s)) {
        let exact = solved(&mut love, at);
        if exact[0] > LARGEST {
            continue;
        }
        let (exact, found) = (forces(exact), forces(looked_up(&near, at)));
        let on_track = forces(looked_up(&near, [at[0], at[1], 0.0]));
        for i in 0..3 {
            worst[i] = worst[i].max((found[i] - exact[i]).abs());
            let one = if i == 2 { 0.0 } else { on_track[i] };
            single[i] = single[i].max((one - exact[i]).abs());
            most[i] = most[i].max(exact[i].abs());
        }
    }
    println!("largest {most:?}, wrong by {worst:?}, with one slice {single:?}");
    // Of the largest force: the maps' own error, 1e-3 each, and as much of the cubics between them.
    assert!(worst[0] < 5e-3 && worst[1] < 2e-4 && worst[2] < 3e-3, "{worst:?}");
    // What a single slice on the track would be wrong by.
    assert!(single[0] > 0.05 && single[1] > 1e-3 && single[2] > 0.03, "{single:?}");
}

#[test]
fn forces_by_slices_are_slopes_of_one_approach_and_end_without_a_jump() {
    let [_, half] = element().contact_half_axes(LARGEST);
    let (distance, step) = (0.25 * half, 1e-9);
    let near = slices(1, distance);
    for at in points(40, 1.2 * distance, |_, _| 3e-6) {
        let found = looked_up(&near, at);
        for k in 0..3 {
            let moved = |by: f64| looked_up(&near, std::array::from_fn(|i| at[i] + if i == k { by } else { 0.0 }))[0];
            let slope = (moved(step) - moved(-step)) / (2.0 * step);
            // Rounding of some 1e-5 m over the step; steps of the second derivative, up to 1e4 per metre.
            assert!((slope - found[1 + k]).abs() < 1e-5, "{at:?} by {k}: {slope} {}", found[1 + k]);
        }
        if at[2].abs() > distance {
            let end = looked_up(&near, [at[0], at[1], distance.copysign(at[2])]);
            assert_eq!((found[0], found[3]), (end[0], 0.0), "{at:?}");
        }
    }
}

#[test]
fn the_contact_beside_the_track_is_that_of_the_fine_grid_of_pressures() {
    let topography = pit();
    let mut love = love(&Surface::Topography(topography.clone()), Resolution { columns: 48, rows: 32 });
    let modulus = brinell::geometry::hertz_constant::effective_modulus(&bearing());
    for [s, place] in [[0.0, 0.0], [0.1e-3, 0.3e-3], [-0.25e-3, 0.5e-3], [0.05e-3, -0.4e-3]] {
        let surface = Surface::Topography(topography.seen_from(place));
        let ball = BallOnRaceway {
            bodies: element(),
            effective_modulus: modulus,
            poissons_ratio: bearing().poissons_ratio,
            pressure_limit: f64::INFINITY,
            defects: vec![DefectBelow { surface, arc: s }],
        };
        let force = 300.0;
        let pressed = ball.pressed(force, 256).unwrap();
        let smooth = BallOnRaceway { defects: Vec::new(), ..ball.clone() }.pressed(force, 256).unwrap();
        let [value, du, _, dy] = solved(&mut love, [pressed.approach, s, place]);
        // F = F_smooth(Δ) ∂Δ/∂u, and across the raceway by ∂Δ/∂η.
        let scale = (value / smooth.approach).powf(1.5);
        // The ball's gap slopes away from its middle: pressure on it pushes by what slope it has there.
        let (r, groove) = (element().element_radius, 0.52 * 7.94e-3);
        let slope = |y: f64| y / (r * r - y * y).sqrt() - y / (groove * groove - y * y).sqrt();
        let area = pressed.cell[0] * pressed.cell[1];
        let across: f64 =
            pressed.under_pressure().map(|cell| pressed.pressure[cell] * area * slope(pressed.centre(cell)[1])).sum();
        // Some 1e-3 of the force at an edge; the pit is smooth.
        assert!((scale * du - 1.0).abs() < 1e-3, "{s:e} {place:e}: {}", scale * du);
        assert!((force * scale * dy - across).abs() < 2e-6 * force, "{s:e} {place:e}: {across}");
    }
}
