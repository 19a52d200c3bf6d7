//! Cost of one contact: cold grids, warm grid under a moving element, lookup in a map, a map. 
//! `cargo bench --manifest-path crates/contact-bench/Cargo.toml`

#![allow(clippy::expect_used)]

use std::f64::consts::FRAC_PI_2;
use std::hint::black_box;

use brinell::contact::conjugate_gradients::ConjugateGradients;
use brinell::contact::grid::{Border, GridActiveSet, GridProblem, GridSolver};
use brinell::contact::love::LoveContact;
use brinell::contact::map::ContactMap;
use brinell::contact::map_specification::{MapSpecification, Sequential};
use brinell::contact::element_on_raceway::{Across, ElementOnRaceway};
use brinell::contact::raceway_grid::Resolution;
use brinell::contact::rolling::RacewaySide;
use brinell::surface::{Profile, Surface};
use criterion::{Criterion, criterion_group, criterion_main};

const ER16K: ElementOnRaceway =
    ElementOnRaceway {
        element_radius: 3.97e-3,
        raceway_radius: 23.6325e-3,
        across: Across::Groove(4.095e-3),
        raceway: RacewaySide::Outer,
    };
const LENGTH: f64 = 6.517e-3;
const LARGEST: f64 = 10e-6;

/// Sphere on a plane, n × n cells over 1.2 Hertz radii.
fn sphere(n: usize) -> GridProblem {
    let half = 0.12;
    let cell = 2.0 * half / n as f64;
    let at = |i: usize| (i as f64 + 0.5) * cell - half;
    let gap = (0..n * n).map(|c| 0.5 * (at(c % n).powi(2) + at(c / n).powi(2))).collect();
    GridProblem::new(n, n, [cell, cell], 1.0, gap, Border::Window).expect("a sphere is possible")
}

fn cold(c: &mut Criterion) {
    for n in [32, 64, 128] {
        let problem = sphere(n);
        let mut cg = ConjugateGradients::new(&problem, 1e-8).expect("possible");
        c.bench_function(&format!("cold {n}, conjugate gradients"), |b| b.iter(|| cg.at_approach(black_box(0.01))));
        if n <= 64 {
            let mut direct = GridActiveSet::new(&problem, false).expect("possible");
            c.bench_function(&format!("cold {n}, active set"), |b| b.iter(|| direct.at_approach(black_box(0.01))));
        }
    }
}

fn near_an_edge(c: &mut Criterion) {
    let surface = Surface::Profile(Profile::spall(LENGTH, 100e-6, FRAC_PI_2));
    // 64 × 16 cells over a window of 1.4 × the ellipse: 46 × 12 across the ellipse itself. Two such grids are solved,
    // half a row apart.
    let resolution = Resolution { columns: 46, rows: 12 };
    let mut love = LoveContact::new(ER16K, &surface, LARGEST, resolution).expect("possible");
    for (name, u, from) in [("smooth", 6e-6, -0.5e-3), ("edge", 6e-6, -0.05e-3), ("on the edge only", 30e-6, 0.4e-3)] {
        // 10 Hz shaft: about 0.5 µm of arc in a microsecond.
        let mut step = 0;
        c.bench_function(&format!("warm 64 x 16 twice, {name}"), |b| {
            b.iter(|| {
                step = (step + 1) % 200;
                love.solve(black_box(u), -0.5 * LENGTH + from + 0.5e-6 * f64::from(step))
            })
        });
    }
    let specification = MapSpecification::new(LARGEST);
    let map = ContactMap::build(&surface, ER16K, specification, &mut Sequential(|_, _| ())).expect("accurate");
    let mut step = 0;
    c.bench_function("map lookup", |b| {
        b.iter(|| {
            step = (step + 1) % 1000;
            map.lookup(black_box(5e-6), -0.5 * LENGTH - 0.1e-3 + 0.2e-6 * f64::from(step))
        })
    });
    let mut slow = c.benchmark_group("map");
    slow.sample_size(10);
    slow.bench_function("two flanks to 1e-3", |b| {
        b.iter(|| ContactMap::build(&surface, ER16K, specification, &mut Sequential(|_, _| ())))
    });
}

criterion_group!(benches, cold, near_an_edge);
criterion_main!(benches);
