//! A roller near a spall under laws `love` and `map`: against published approaches, the plane-strain limit, each other
//! and finer grids.
#![allow(clippy::unwrap_used)]

use crate::nu205;
use brinell::contact::element_on_raceway::{Across, ElementOnRaceway};
use brinell::contact::love::{LoveContact, Resolution};
use brinell::contact::map::{ContactMap, MapSpecification, Sequential};
use brinell::contact::rolling::RacewaySide;
use brinell::geometry::line_contact::logarithmic_depth;
use brinell::surface::{Profile, Surface, Topography};
use brinell_analysis::pressure::{ConjugateGradients, GridContact, GridProblem, at_force};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;

/// E* of two bodies of steel: 207 GPa/(2 · 0.91).
const MODULUS: f64 = 207e9 / 1.82;
const LENGTH: f64 = 9e-3;
const EDGE: f64 = -0.6e-3;

fn spall() -> Surface {
    Surface::Profile(Profile::spall(-2.0 * EDGE, 100e-6, FRAC_PI_2))
}

fn love(crowned: bool, rows: usize) -> LoveContact {
    LoveContact::new(nu205(RacewaySide::Inner, crowned), &spall(), 15e-6, Resolution { columns: 48, rows }).unwrap()
}

/// A roller on the half-space, patches over its whole length and over the width of a line under a force (N) per middle
/// of a crowned one; with `edge` the raceway ends below the roller's centre.
fn problem(element: ElementOnRaceway, force: f64, [columns, rows]: [usize; 2], edge: bool) -> GridProblem {
    let [curvature, _] = element.curvatures();
    let half = 1.3 * (4.0 * 1.5 * force / LENGTH / (PI * MODULUS * curvature)).sqrt();
    let cell = [2.0 * half / columns as f64, LENGTH / rows as f64];
    let crowned = element.across == Across::Roller { length: LENGTH, crowned: true };
    let gap = (0..rows * columns).map(|k| {
        let x = ((k % columns) as f64 + 0.5) * cell[0] - half;
        let y = ((k / columns) as f64 + 0.5) * cell[1] - 0.5 * LENGTH;
        let missing = if edge && x > 0.0 { 1e-3 } else { 0.0 };
        0.5 * curvature * x * x + if crowned { logarithmic_depth(7.5e-3, LENGTH, y) } else { 0.0 } + missing
    });
    GridProblem::new(columns, rows, cell, MODULUS, gap.collect()).unwrap()
}

fn solved(problem: &GridProblem, force: f64) -> GridContact {
    let mut solver = ConjugateGradients::new(problem, 1e-8, f64::INFINITY).unwrap();
    let contact = at_force(|approach| solver.at_approach(approach), force, 4e-9 * force, 1e-11).unwrap();
    let columns = problem.columns();
    assert!(contact.pressure.chunks(columns).all(|row| row[0] == 0.0), "contact ends within the columns");
    contact
}

/// Approach (m) under a force (N), and pressure at the end over that in the middle.
fn on_the_half_space(side: RacewaySide, crowned: bool, force: f64, cells: [usize; 2]) -> [f64; 2] {
    let contact = solved(&problem(nu205(side, crowned), force, cells, false), force);
    let pressure = |row: usize| contact.pressure[row * cells[0] + cells[0] / 2];
    [contact.approach, pressure(0) / pressure(cells[1] / 2)]
}

#[test]
fn a_finite_roller_on_the_half_space_approaches_as_a_prototype_says() {
    use RacewaySide::{Inner, Outer};
    // Another program's table, four digits, 48 × 384 patches; inner and outer raceway, µm.
    for (force, crowned, approaches) in [
        (50.0, false, [0.2278, 0.2216]),
        (300.0, false, [1.1973, 1.1605]),
        (1500.0, false, [5.2256, 5.0418]),
        (300.0, true, [2.1234, 2.0708]),
    ] {
        for (side, expected) in [Inner, Outer].into_iter().zip(approaches) {
            let [approach, _] = on_the_half_space(side, crowned, force, [48, 384]);
            println!("{side:?} {crowned} {force} N: {:.4} µm, printed {expected}", approach * 1e6);
            // Columns are of another width there.
            assert!((approach * 1e6 / expected - 1.0).abs() < 2e-3, "{side:?} {force}: {approach:e} {expected}");
        }
    }
    // Force converges over the rows, pressure at the end of a straight roller does not.
    let [coarse, fine] = [[32, 192], [64, 768]].map(|cells| on_the_half_space(Inner, false, 300.0, cells));
    assert!((coarse[0] / fine[0] - 1.0).abs() < 1.5e-3 && fine[1] > 1.3 * coarse[1], "{coarse:?} {fine:?}");
}

#[test]
fn away_from_the_spall_a_roller_has_the_smooth_raceways_contact() {
    for crowned in [false, true] {
        let mut love = love(crowned, 8);
        for i in 0..20 {
            for (u, s) in [(3e-6, -2e-3), (9e-6, 2e-3)] {
                let found = love.solve(u, s + 1.3e-6 * f64::from(i)).unwrap();
                // The grid's ripple under a moving roller.
                assert!((found.value / u - 1.0).abs() < 2e-4 && found.ds.abs() < 2e-4, "{crowned}: {found:?}");
            }
        }
    }
}

/// Approach (m), except for one constant, of a cylinder in plane strain whose centre is `edge` (m) from the edge of the
/// raceway, infinite without one, under a force per length over π E* (m): u(x) = −2 Σ p ln|x − ξ|, by uniform strips.
fn plane_strain(per_length: f64, curvature: f64, edge: f64) -> f64 {
    let half = 1.6 * (4.0 * per_length / curvature).sqrt();
    let count = 240;
    let width = 2.0 * half / f64::from(count);
    // Strips from the edge on inwards; x from the centre.
    let first = if edge.is_finite() { -edge } else { -half };
    let centres: Vec<f64> = (0..count).map(|k| first + (f64::from(k) + 0.5) * width).filter(|x| *x < half).collect();
    let part = |x: f64| if x == 0.0 { 0.0 } else { x * (x.abs().ln() - 1.0) };
    let kernel = |i: usize, j: usize| {
        let x = centres[i] - centres[j];
        -2.0 * (part(x + 0.5 * width) - part(x - 0.5 * width))
    };
    let mut pressed: Vec<usize> = (0..centres.len()).collect();
    loop {
        // Σ_j K_ij p_j − δ = −κ x²/2, Σ p w = q.
        let n = pressed.len();
        let matrix = DMatrix::from_fn(n + 1, n + 1, |row, column| match (row < n, column < n) {
            (true, true) => kernel(pressed[row], pressed[column]),
            (true, false) => -1.0,
            (false, true) => width,
            (false, false) => 0.0,
        });
        let gap = |row: usize| -0.5 * curvature * centres[pressed[row]].powi(2);
        let known = DVector::from_fn(n + 1, |row, _| if row < n { gap(row) } else { per_length });
        let found = matrix.lu().solve(&known).unwrap();
        let kept: Vec<usize> = pressed.iter().zip(&found).filter(|(_, p)| **p > 0.0).map(|(k, _)| *k).collect();
        if kept.len() == n {
            return found[n];
        }
        pressed = kept;
    }
}

#[test]
fn a_long_roller_on_an_edge_sinks_as_in_plane_strain_and_so_says_the_law() {
    let element = nu205(RacewaySide::Inner, false);
    let [curvature, _] = element.curvatures();
    let (force, cells) = (1000.0, [96, 96]);
    let grids = [false, true].map(|edge| problem(element, force, cells, edge));
    let [smooth, edge] = [0, 1].map(|k| solved(&grids[k], force));
    // Two dimensions have no approach, but a difference of approaches at one force per length.
    let per_length = force / LENGTH / (PI * MODULUS);
    let expected = plane_strain(per_length, curvature, 0.0) - plane_strain(per_length, curvature, f64::INFINITY);
    let found = edge.approach - smooth.approach;
    println!("edge {found:e}, in plane strain {expected:e}");
    // The pressed width is 0.12 mm of a length of 9: at its ends it is a problem of three dimensions.
    assert!((found / expected - 1.0).abs() < 0.03, "{found:e} against {expected:e}");
    // The law's Δ stores on the smooth raceway what the edge stores.
    let stored = |problem: &GridProblem, contact: &GridContact| -> f64 {
        let inside = contact.pressure.iter().zip(problem.gap()).map(|(p, gap)| 0.5 * p * (contact.approach - gap));
        inside.sum::<f64>() * problem.cell()[0] * problem.cell()[1]
    };
    let law = love(false, 16).solve(edge.approach, EDGE).unwrap();
    let equal = ConjugateGradients::new(&grids[0], 1e-8, f64::INFINITY).unwrap().at_approach(law.value).unwrap();
    let energies = [stored(&grids[1], &edge), stored(&grids[0], &equal)];
    println!("{law:?}: energies {energies:?} J, forces {force} and {} N", equal.force * law.du);
    // Rows and columns differ.
    assert!((energies[0] / energies[1] - 1.0).abs() < 5e-3, "{energies:?}");
    assert!((equal.force * law.du / force - 1.0).abs() < 1e-2, "{} N", equal.force * law.du);
}

#[test]
fn half_a_spall_leaves_half_the_roller() {
    // A roller over the middle of a spall under its front half, out of reach: what is left carries as a roller of half
    // the length, K ~ L^(8/9), except for the end that it has more.
    let mut text = "arc_mm,axial_mm,depth_um\n".to_owned();
    for i in 0..=400 {
        for y in 0..=18 {
            let y = f64::from(y) * 0.25;
            writeln!(text, "{},{y},100", f64::from(i) * 5e-3 - 1.0).unwrap();
        }
    }
    let surface = Surface::Topography(Topography::from_csv(&text).unwrap());
    let resolution = Resolution { columns: 24, rows: 16 };
    let element = nu205(RacewaySide::Outer, false);
    let mut love = LoveContact::new(element, &surface, 12e-6, resolution).unwrap();
    let u = 8e-6;
    let found = love.solve(u, 0.0).unwrap();
    // The lamina law's W_half(u) = W_whole(Δ): Δ/u = 2^(−(8/9)(9/19)).
    let expected = 0.5f64.powf(8.0 / 19.0);
    println!("{} {}", found.value / u, expected);
    assert!((found.value / u / expected - 1.0).abs() < 0.03, "{} against {expected}", found.value / u);
    // Beside the spall the whole roller carries.
    assert!((love.solve(u, 3e-3).unwrap().value / u - 1.0).abs() < 1e-3);
}

#[test]
fn the_map_is_the_grid_at_a_spalls_edge_under_a_roller() {
    let largest = 10e-6;
    for crowned in [false, true] {
        let resolution = Resolution { columns: 48, rows: 8 };
        let specification =
            MapSpecification { resolution, tolerated: Some(0.02), ..MapSpecification::of_roller(largest) };
        let element = nu205(RacewaySide::Inner, crowned);
        let map = ContactMap::build(&spall(), element, specification, &mut Sequential(|_, _| {})).unwrap();
        let mut love = love(crowned, 8);
        println!("{crowned}: {:?}", map.accuracy());
        let (mut worst, mut squares, mut count) = (0.0f64, 0.0, 0.0);
        for i in 0..400 {
            let t = f64::from(i);
            let (s, height) = (EDGE + 0.25e-3 * (2.0 * (t * 0.754_877_666).fract() - 1.0), (t * 0.569_840_291).fract());
            let u = love.first_touch(s) + height * 8e-6;
            let (exact, found) = (love.solve(u, s).unwrap(), map.lookup(u, s).unwrap());
            if exact.value > largest {
                continue;
            }
            let force = |value: f64, slope: f64| (value.max(0.0) / largest).powf(10.0 / 9.0) * slope;
            let error = (force(found.value, found.du) - force(exact.value, exact.du)).abs();
            (worst, squares, count) = (worst.max(error), squares + error * error, count + 1.0);
        }
        let rms = f64::sqrt(squares / count);
        println!("worst {worst:e}, root mean square {rms:e} of full scale at {count} points");
        // A row that comes into contact is a step of the stiffness, and rows are few and long here.
        let limits = if crowned { [1.5e-2, 2e-3] } else { [4e-3, 4e-4] };
        assert!(count > 200.0 && worst < limits[0] && rms < limits[1], "{crowned}: {worst:e} {rms:e}");
    }
}
