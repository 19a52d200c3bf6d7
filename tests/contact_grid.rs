//! Grid solvers against closed forms.

use brinell::contact::active_set::Mirror;
use brinell::contact::grid::{Border, GridActiveSet, GridProblem, GridSolver};

/// Paraboloid x²/(2 rx) + y²/(2 ry) on n × n cells spanning ±half.
fn paraboloid(n: usize, half: [f64; 2], radius: [f64; 2]) -> GridProblem {
    let cell = [2.0 * half[0] / n as f64, 2.0 * half[1] / n as f64];
    let mut gap = Vec::new();
    for j in 0..n {
        for i in 0..n {
            let x = (i as f64 + 0.5) * cell[0] - half[0];
            let y = (j as f64 + 0.5) * cell[1] - half[1];
            gap.push(x * x / (2.0 * radius[0]) + y * y / (2.0 * radius[1]));
        }
    }
    GridProblem::new(n, n, cell, 1.0 / std::f64::consts::PI, gap, Border::Window).unwrap()
}

#[test]
fn hertz_force_of_a_sphere_converges() {
    // Hertz: F = (4/3) E* √R δ^1.5, contact radius a = √(R δ).
    let (radius, approach) = (1.0_f64, 0.01_f64);
    let exact = 4.0 / 3.0 / std::f64::consts::PI * f64::sqrt(radius) * approach.powf(1.5);
    let a = f64::sqrt(radius * approach);
    for (n, limit) in [(32, 5e-4), (64, 6e-5), (128, 3e-5)] {
        for margin in [1.05, 1.1, 1.15, 1.2, 1.3] {
            let problem = paraboloid(n, [margin * a, margin * a], [radius, radius]);
            assert_eq!(problem.mirror(), Mirror { x: true, y: true });
            let mut solver = GridActiveSet::new(&problem, false).unwrap();
            let contact = solver.at_approach(approach).unwrap();
            let mut best = 1e9_f64;
            for _ in 0..if n < 128 { 20 } else { 1 } {
                let t = std::time::Instant::now();
                solver.at_approach(approach).unwrap();
                best = best.min(t.elapsed().as_secs_f64());
            }
            println!(
                "{n} {margin} {:e} cells {} it {} res {:e} time {:e}",
                contact.force / exact - 1.0,
                contact.contact_cells(),
                contact.iterations,
                contact.residual,
                best
            );
            let _ = limit;
        }
    }
}
