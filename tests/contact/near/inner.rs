//! The half-space on the convex inner raceway: joint with the closed form, convergence of the grid, map against grid. A
//! defect of an element is the same problem on either side; only the arc is counted along the element then.

use crate::er16k::{INNER, OUTER};
use brinell::contact::element_on_raceway::ElementOnRaceway;
use brinell::contact::love::{LoveContact, Resolution};
use brinell::contact::map::MapSpecification;
use brinell::contact::rolling::RacewaySide;
use brinell::surface::{Profile, Surface};
use std::f64::consts::FRAC_PI_2;

/// 640 N on the inner raceway.
const LARGEST: f64 = 9e-6;

fn spall(length: f64) -> Surface {
    Surface::Profile(Profile::spall(length, 100e-6, FRAC_PI_2))
}

fn grid(length: f64, columns: usize, rows: usize) -> LoveContact {
    grid_on(INNER, length, columns, rows)
}

fn grid_on(element: ElementOnRaceway, length: f64, columns: usize, rows: usize) -> LoveContact {
    LoveContact::new(element, &spall(length), 1.8 * LARGEST, Resolution { columns, rows }).unwrap()
}

/// Forces at an approach and arc over the smooth contact's at the largest approach.
fn forces(contact: &mut LoveContact, u: f64, s: f64) -> [f64; 2] {
    contact.solve(u, s).unwrap().forces(crate::hertz).map(|force| force / LARGEST.powf(1.5))
}

#[test]
fn far_from_the_edges_the_grid_is_the_closed_form_without_a_jump() {
    let mut contact = grid(2.74e-3, 32, 16);
    for (u, s) in [(3e-6, -2.1e-3), (8e-6, -2.1013e-3), (8e-6, 2.3e-3)] {
        let [normal, tangential] = forces(&mut contact, u, s);
        // The grid's ripple under a moving element.
        assert!((normal - (u / LARGEST).powf(1.5)).abs() < 5e-4 && tangential.abs() < 1e-4, "{normal} {tangential}");
    }
}

#[test]
fn forces_over_an_edge_are_mirrored_and_those_of_finer_grids() {
    let (mut coarse, mut fine) = (grid(2.74e-3, 24, 12), grid(2.74e-3, 48, 24));
    let edge = -1.37e-3;
    for (u, past) in [(4e-6, -0.05e-3), (7e-6, 0.0), (10e-6, 0.1e-3), (20e-6, 0.25e-3)] {
        let [normal, tangential] = forces(&mut fine, u, edge + past);
        let mirrored = forces(&mut fine, u, -(edge + past));
        assert!((normal - mirrored[0]).abs() < 1e-4 && (tangential + mirrored[1]).abs() < 1e-4, "{mirrored:?}");
        let other = forces(&mut coarse, u, edge + past);
        let off = (normal - other[0]).abs().max((tangential - other[1]).abs());
        // A quarter of what half as many cells miss is left with twice as many.
        assert!(off < 8e-3 && normal > 0.02, "{past}: {normal} {tangential}, {other:?}");
        // The surface falls with growing arc: it pushes that way.
        assert!(tangential > 0.0, "{past}: {tangential}");
    }
}

#[test]
fn a_convex_raceway_lets_the_element_sink_half_as_much_again_as_a_concave_one() {
    // Over an edge a rigid element comes down by s²/(2 r_e); with little force Love's contact begins there, too.
    let mut inner = grid(2.74e-3, 48, 24);
    let outer = grid_on(OUTER, 2.74e-3, 48, 24);
    let past = 0.4e-3;
    let [inside, outside] = [inner.first_touch(past - 1.37e-3), outer.first_touch(past - 1.37e-3)];
    // 25.297 and 16.816 µm; the grid touches with the middle of its first cell, 4 µm from the edge.
    assert!((inside / outside - 1.5061).abs() < 0.01 && (inside - 25.297e-6).abs() < 1e-6, "{inside} {outside}");
    assert!(forces(&mut inner, inside + 1e-6, past - 1.37e-3)[0] > 0.0);
}

/// `cargo test --workspace --test contact inner:: -- --ignored --nocapture` prints rows of `docs/evidence/contact.md`.
#[test]
#[ignore = "takes minutes"]
fn the_map_follows_the_grid_and_the_grid_a_finer_one() {
    let cases = [
        ("10° of the outer raceway", OUTER, 4.124e-3),
        ("10° of the inner raceway", INNER, 2.738e-3),
        ("1.2 mm of an element, on its inner side", INNER, 1.2e-3),
    ];
    let mut outside = [0.0f64; 2];
    for (name, element, length) in cases {
        let specification = MapSpecification::new(LARGEST);
        let map = crate::built(&spall(length), element, specification);
        let (mut contact, mut finer) = (grid_on(element, length, 48, 32), grid_on(element, length, 96, 64));
        let (mut of_map, mut of_grid, mut squares, mut count) = ([0.0f64; 2], [0.0f64; 2], [0.0f64; 2], 0);
        let (from, to) = (map.knots()[0], map.knots()[map.knots().len() - 1]);
        for n in 0..400 {
            let [q, t] = crate::spread(n);
            let s = from + q * (to - from);
            let u = contact.first_touch(s) + t * 1.2 * LARGEST;
            if contact.solve(u, s).unwrap().value > LARGEST {
                continue;
            }
            let exact = forces(&mut contact, u, s);
            let looked_up = map.lookup(u, s).unwrap().forces(crate::hertz).map(|force| force / LARGEST.powf(1.5));
            for k in 0..2 {
                of_map[k] = of_map[k].max((looked_up[k] - exact[k]).abs());
            }
            // Sixteen times as long.
            if n % 8 == 0 {
                let fine = forces(&mut finer, u, s);
                for k in 0..2 {
                    of_grid[k] = of_grid[k].max((exact[k] - fine[k]).abs());
                    squares[k] += (exact[k] - fine[k]).powi(2);
                }
                count += 1;
            }
        }
        let rms = squares.map(|square| (square / f64::from(count)).sqrt());
        println!("| {name} | {} | {of_map:?} | {of_grid:?} | {rms:?} |", map.nodes());
        if element.raceway == RacewaySide::Outer {
            outside = of_grid;
        }
        assert!(of_map.iter().all(|&error| error < 1e-3), "{name}: {of_map:?}");
        // The same grid to the same contact's half-axes: inside it is as good as outside, except where cells happen to
        // lie under the border when the element hangs on the edge by a few of them.
        assert!(of_grid.iter().zip(outside).all(|(&error, outside)| error < 2.0 * outside), "{name}: {of_grid:?}");
    }
}
