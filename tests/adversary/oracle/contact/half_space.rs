//! A sphere on an elastic half-space with a defect, solved on a grid of loaded rectangles (Love 1929; Johnson 1985, eq.
//! 3.25).
//!
//! The grid goes with the element, its cells see the mean depth beneath them, and the pressures are found by dropping
//! what pulls and adding what overlaps, each time with a factorization of all that presses.

use std::f64::consts::PI;

#[derive(Clone, Copy)]
pub struct HalfSpace {
    /// Radii of the element, of the raceway and of its groove (m); a convex raceway's is negative, a plane's infinite.
    pub element: f64,
    pub raceway: f64,
    pub groove: f64,
    /// E* (Pa).
    pub modulus: f64,
    /// Cells along and across.
    pub cells: [usize; 2],
    /// How far the grid is moved along, in cells, up to half of one: where an edge cuts a cell is chance.
    pub shift: f64,
}

/// How far a circle has fallen away at a distance from where it touches (m).
fn sag(radius: f64, x: f64) -> f64 {
    radius.signum() * x * x / (radius.abs() + (radius * radius - x * x).sqrt())
}

/// Displacement at (x, y) from the centre of a rectangle of half sides a, b under unit pressure, times π E*.
fn love(x: f64, y: f64, a: f64, b: f64) -> f64 {
    let s = |p: f64, q: f64| (p * p + q * q).sqrt();
    let (xp, xm, yp, ym) = (x + a, x - a, y + b, y - b);
    xp * ((yp + s(yp, xp)) / (ym + s(ym, xp))).ln()
        + yp * ((xp + s(yp, xp)) / (xm + s(yp, xm))).ln()
        + xm * ((ym + s(ym, xm)) / (yp + s(yp, xm))).ln()
        + ym * ((xm + s(ym, xm)) / (xp + s(ym, xp))).ln()
}

impl HalfSpace {
    /// Normal and tangential force (N) on an element that is pressed by `u` (m) against a raceway whose mean depth (m)
    /// in a cell, between two positions along and two across, is `depth`. `high` is how far the highest rim rises (m).
    pub fn forces(&self, u: f64, high: f64, depth: impl Fn([f64; 2], [f64; 2]) -> f64) -> [f64; 2] {
        if u + high <= 0.0 {
            return [0.0; 2];
        }
        // Circles fall away faster than their parabolas.
        let curvatures = [self.raceway, self.groove].map(|radius| 1.0 / self.element - 1.0 / radius);
        let half = curvatures.map(|curvature| 1.02 * (2.0 * (u + high) / curvature).sqrt());
        let [n, m] = self.cells;
        let size = [2.0 * half[0] / n as f64, 2.0 * half[1] / m as f64];
        let corner = |i: usize, j: usize| [(i as f64 + self.shift) * size[0] - half[0], j as f64 * size[1] - half[1]];
        let cell = |k: usize, shift: f64| {
            let [x, y] = corner(k / m, k % m);
            depth([x + shift, x + shift + size[0]], [y, y + size[1]])
        };
        let overlap: Vec<f64> = (0..n * m)
            .map(|k| {
                let [x, y] = corner(k / m, k % m);
                // Means over the cell, by Gauss's two points.
                let mean = |radius: f64, from: f64, h: f64| {
                    let gap = |share: f64| sag(self.element, from + share * h) - sag(radius, from + share * h);
                    0.5 * (gap(0.5 - 12f64.sqrt().recip()) + gap(0.5 + 12f64.sqrt().recip()))
                };
                u - mean(self.raceway, x, size[0]) - mean(self.groove, y, size[1]) - cell(k, 0.0)
            })
            .collect();
        let pressure = self.pressures(&overlap, size, m);
        let area = size[0] * size[1];
        // ∂(mean depth)/∂s by the cell's two ends.
        let step = 1e-3 * size[0];
        let slope = |k: usize| (cell(k, step) - cell(k, -step)) / (2.0 * step);
        let normal = pressure.iter().sum::<f64>() * area;
        let tangential =
            pressure.iter().enumerate().filter(|p| *p.1 > 0.0).map(|(k, p)| p * slope(k)).sum::<f64>() * area;
        [normal, tangential]
    }

    fn pressures(&self, overlap: &[f64], size: [f64; 2], m: usize) -> Vec<f64> {
        let [n, _] = self.cells;
        let per = 1.0 / (PI * self.modulus);
        let table: Vec<f64> = (0..n * m)
            .map(|k| per * love((k / m) as f64 * size[0], (k % m) as f64 * size[1], 0.5 * size[0], 0.5 * size[1]))
            .collect();
        let between = |a: usize, b: usize| table[(a / m).abs_diff(b / m) * m + (a % m).abs_diff(b % m)];
        let mut pressing: Vec<usize> = (0..overlap.len()).filter(|&k| overlap[k] > 0.0).collect();
        let mut pressure = vec![0.0; overlap.len()];
        for _ in 0..60 {
            let found = solve(&pressing, overlap, between);
            pressure.fill(0.0);
            let pulls = found.iter().any(|&p| p < 0.0);
            for (&k, &p) in pressing.iter().zip(&found) {
                pressure[k] = p.max(0.0);
            }
            if pulls {
                pressing.retain(|&k| pressure[k] > 0.0);
                continue;
            }
            let mut added = Vec::new();
            for k in (0..overlap.len()).filter(|&k| pressure[k] == 0.0) {
                let down: f64 = pressing.iter().map(|&l| between(k, l) * pressure[l]).sum();
                if overlap[k] > down + 1e-9 * overlap[k].abs() {
                    added.push(k);
                }
            }
            if added.is_empty() {
                break;
            }
            pressing.extend(added);
        }
        pressure
    }
}

/// Pressures under which all these cells close up, by Cholesky's factorization.
fn solve(cells: &[usize], overlap: &[f64], between: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let n = cells.len();
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(n);
    let mut x = vec![0.0; n];
    for i in 0..n {
        let mut row = vec![0.0; i + 1];
        for k in 0..=i {
            let above: &[f64] = if k < i { &rows[k] } else { &[] };
            let sum: f64 = row[..k].iter().zip(above).map(|(a, b)| a * b).sum();
            row[k] = if k < i {
                (between(cells[i], cells[k]) - sum) / rows[k][k]
            } else {
                (between(cells[i], cells[i]) - row[..i].iter().map(|a| a * a).sum::<f64>()).sqrt()
            };
        }
        let sum: f64 = row[..i].iter().zip(&x).map(|(a, b)| a * b).sum();
        x[i] = (overlap[cells[i]] - sum) / row[i];
        rows.push(row);
    }
    for i in (0..n).rev() {
        x[i] /= rows[i][i];
        for k in 0..i {
            x[k] -= rows[i][k] * x[i];
        }
    }
    x
}

#[test]
fn a_sphere_on_a_plane_is_hertz() {
    let (r, modulus, u) = (4e-3, 1.1e11, 1e-5);
    let hertz = 4.0 / 3.0 * modulus * f64::sqrt(r) * f64::powf(u, 1.5);
    for (cells, limit) in [(16, 0.012), (32, 0.006)] {
        let plane = f64::INFINITY;
        let half_space =
            HalfSpace { element: r, raceway: plane, groove: plane, modulus, cells: [cells; 2], shift: 0.0 };
        let [normal, tangential] = half_space.forces(u, 0.0, |_, _| 0.0);
        // The grid's own error, which halves with its cells.
        assert!((normal / hertz - 1.0).abs() < limit && tangential == 0.0, "{normal} {hertz}");
    }
}
