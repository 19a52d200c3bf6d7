//! Stresses in an elastic half-space below a pressure on its surface, z into the body; tension is positive.
//!
//! Love (1929) for a normal pressure p, with V = ∫ p/ρ and χ = ∫ p ln(z + ρ) over the loaded area:
//!
//! ```text
//! 2π σ_xx = 2ν V_z − z V_xx − (1−2ν) χ_xx     2π τ_xy = −z V_xy − (1−2ν) χ_xy
//! 2π σ_yy = 2ν V_z − z V_yy − (1−2ν) χ_yy     2π τ_xz = −z V_xz
//! 2π σ_zz =    V_z − z V_zz                   2π τ_yz = −z V_yz
//! ```
//!
//! Under a uniform pressure each derivative is the mixed difference of one function of the distance (X, Y) from the
//! rectangle's four corners, ρ² = X² + Y² + z²:
//!
//! ```text
//! V_z  −atan(XY/(zρ))            V_xy  1/ρ             χ_xx  atan(Y/X) − atan(zY/(Xρ))
//! V_xx −XY/(ρ(X²+z²))            V_xz  −zY/(ρ(X²+z²))  χ_xy  ln(z + ρ)
//! ```
//!
//! and those with x and y exchanged; V_zz = −V_xx − V_yy. Cells that meet in a corner share its value, so a grid costs
//! one evaluation a corner and not four a cell.
//!
//! Valid below the surface and, at z = 0, away from the lines on which cells end. Elastic; residual stresses,
//! friction and the bulk stress of the ring are not in it.

use super::contact_pressure::Pressed;
use std::f64::consts::TAU;

/// A stress tensor (Pa).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stress {
    /// σ_xx, σ_yy, σ_zz.
    pub normal: [f64; 3],
    /// τ_xy, τ_xz, τ_yz.
    pub shear: [f64; 3],
}

impl Stress {
    /// Von Mises' equivalent stress (Pa).
    pub fn von_mises(&self) -> f64 {
        let ([x, y, z], [xy, xz, yz]) = (self.normal, self.shear);
        let square = |v: f64| v * v;
        let normal = square(x - y) + square(y - z) + square(z - x);
        (0.5 * normal + 3.0 * (square(xy) + square(xz) + square(yz))).sqrt()
    }
}

/// Corners of loaded cells: x and y (m), and the mixed difference of the pressures that meet there (Pa).
#[derive(Debug, Clone)]
pub struct Corners {
    poissons_ratio: f64,
    corners: Vec<[f64; 3]>,
}

impl Corners {
    /// Those of a pressure in bodies of this Poisson's ratio, of `block` × `block` cells taken together by their mean:
    /// 1 takes each by itself.
    pub fn new(pressed: &Pressed, poissons_ratio: f64, block: usize) -> Self {
        let block = block.max(1);
        let blocks = pressed.cells.map(|cells| cells.div_ceil(block));
        let mut mean = vec![0.0; blocks[0] * blocks[1]];
        for (cell, &p) in pressed.pressure.iter().enumerate() {
            let (i, j) = (cell % pressed.cells[0] / block, cell / pressed.cells[0] / block);
            mean[j * blocks[0] + i] += p / (block * block) as f64;
        }
        let at = |i: usize, j: usize| {
            let inside = i >= 1 && j >= 1 && i <= blocks[0] && j <= blocks[1];
            if inside { mean[(j - 1) * blocks[0] + i - 1] } else { 0.0 }
        };
        let position = |k: usize, i: usize| {
            pressed.middle[k] + ((i * block) as f64 - 0.5 * pressed.cells[k] as f64) * pressed.cell[k]
        };
        let mut corners = Vec::new();
        for j in 0..=blocks[1] {
            for i in 0..=blocks[0] {
                // The distance counts from the corner to the point: the cell beyond it is met with its lower side.
                let weight = (at(i, j) + at(i + 1, j + 1)) - (at(i + 1, j) + at(i, j + 1));
                if weight != 0.0 {
                    corners.push([position(0, i), position(1, j), weight]);
                }
            }
        }
        Self { poissons_ratio, corners }
    }

    /// Stress at a point (m), x, y and depth.
    pub fn stress(&self, [x, y, z]: [f64; 3]) -> Stress {
        let nu = self.poissons_ratio;
        let mut sum = Stress::default();
        for &[corner_x, corner_y, weight] in &self.corners {
            let of_corner = corner_stress(x - corner_x, y - corner_y, z, nu);
            for k in 0..3 {
                sum.normal[k] += weight * of_corner.normal[k];
                sum.shear[k] += weight * of_corner.shear[k];
            }
        }
        let scaled = |values: [f64; 3]| values.map(|value| value / TAU);
        Stress { normal: scaled(sum.normal), shear: scaled(sum.shear) }
    }
}

/// 2π times the stress of a unit pressure on the quarter plane that ends at the corner, up to what no difference sees.
fn corner_stress(x: f64, y: f64, z: f64, nu: f64) -> Stress {
    let rho = (x * x + y * y + z * z).sqrt();
    let (across_y, across_x) = (rho * (x * x + z * z), rho * (y * y + z * z));
    let v_z = -libm::atan2(x * y, z * rho);
    let (v_xx, v_yy) = (-x * y / across_y, -x * y / across_x);
    // Both angles of χ_xx in one, which does not leap where X changes its sign.
    let chi_xx = libm::atan2(x * y * (rho - z), x * x * rho + z * y * y);
    let chi_yy = libm::atan2(x * y * (rho - z), y * y * rho + z * x * x);
    let free = 1.0 - 2.0 * nu;
    Stress {
        normal: [
            2.0 * nu * v_z - z * v_xx - free * chi_xx,
            2.0 * nu * v_z - z * v_yy - free * chi_yy,
            v_z + z * (v_xx + v_yy),
        ],
        shear: [-z / rho - free * libm::log(z + rho), z * z * y / across_y, z * z * x / across_x],
    }
}

/// The largest von Mises stress among points of ascending depth, and its depth (m), by a parabola through the three
/// points around it.
pub fn maximum(depths: &[f64], stresses: &[Stress]) -> [f64; 2] {
    let values: Vec<f64> = stresses.iter().map(Stress::von_mises).collect();
    let Some(top) = (0..values.len()).max_by(|&a, &b| values[a].total_cmp(&values[b])) else { return [0.0; 2] };
    if top == 0 || top + 1 == values.len() {
        return [values[top], depths[top]];
    }
    let (before, after) = (values[top - 1] - values[top], values[top + 1] - values[top]);
    let step = 0.5 * (before - after) / (before + after);
    [values[top] - 0.25 * (before - after) * step, depths[top] + step * (depths[top + 1] - depths[top])]
}
