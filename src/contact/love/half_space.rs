//! Surface deflection of an elastic half-space under one uniformly loaded rectangle.
//!
//! Love (1929); Johnson, Contact Mechanics, eq. 3.25. A pressure p on the cell |x| ≤ a, |y| ≤ b lowers the surface at
//! (x, y) by u = p D(x, y)/(π E*), where D is the integral of 1/r over the cell. With S(p,q) = √(p² + q²):
//!
//! ```text
//! D = (x+a) ln{[(y+b)+S(y+b,x+a)]/[(y−b)+S(y−b,x+a)]} + (y+b) ln{[(x+a)+S(y+b,x+a)]/[(x−a)+S(y+b,x−a)]}
//!   + (x−a) ln{[(y−b)+S(y−b,x−a)]/[(y+b)+S(y+b,x−a)]} + (y−b) ln{[(x−a)+S(y−b,x−a)]/[(x+a)+S(y−b,x+a)]}
//! ```
//!
//! Each logarithm is a difference of two asinh. Written as one asinh of a positive sum it loses nothing; what remains
//! is the difference of two lengths of the order of the cell, which costs about (distance/cell) × 2⁻⁵³. Beyond ten cell
//! lengths the integral is therefore taken by Gauss's rule, all of whose terms are positive, and no cancellation is
//! left at any distance.
//!
//! Valid for a body thick and wide against the contact, linear elastic, frictionless. A sharp edge of the real body is
//! more compliant than this half-space.

use libm::asinh;

/// Nodes and weights of Gauss–Legendre on [−1, 1], positive half; enough for 1e-14 beyond ten cell lengths.
const GAUSS_6: [(f64, f64); 3] = [
    (0.238_619_186_083_196_9, 0.467_913_934_572_691_05),
    (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (0.932_469_514_203_152, 0.171_324_492_379_170_36),
];

/// Integral of 1/r over the rectangle 2a × 2b, seen from the point (x, y) relative to its centre (m).
///
/// `half_x` = a and `half_y` = b are half the cell's sides (m). Relative error below 1e-12 for sides up to 1:100.
pub fn rectangle_kernel(x: f64, y: f64, half_x: f64, half_y: f64) -> f64 {
    let (x, y, a, b) = (x.abs(), y.abs(), half_x, half_y);
    let reach = 20.0 * a.max(b);
    if x * x + y * y > reach * reach {
        return far_field(x, y, a, b);
    }
    let side = |p: f64, q: f64, half: f64| {
        if p == 0.0 { 0.0 } else { p * asinh_difference(p, q, half) }
    };
    (side(x + a, y, b) - side(x - a, y, b)) + (side(y + b, x, a) - side(y - b, x, a))
}

/// asinh((q+h)/|p|) − asinh((q−h)/|p|) for q ≥ 0, p ≠ 0, without cancellation.
fn asinh_difference(p: f64, q: f64, h: f64) -> f64 {
    let (far, near) = (q + h, q - h);
    let (s_far, s_near) = (length(far, p), length(near, p));
    if near > 0.0 {
        asinh(4.0 * q * h / (far * s_near + near * s_far))
    } else {
        // Both terms are positive: the foot of the perpendicular lies inside the side.
        asinh(far / p.abs()) + asinh(-near / p.abs())
    }
}

fn far_field(x: f64, y: f64, a: f64, b: f64) -> f64 {
    let mut sum = 0.0;
    for (nx, wx) in GAUSS_6 {
        for (ny, wy) in GAUSS_6 {
            let (x0, x1, y0, y1) = (x - nx * a, x + nx * a, y - ny * b, y + ny * b);
            let near = 1.0 / length(x0, y0) + 1.0 / length(x1, y1);
            let across = 1.0 / length(x0, y1) + 1.0 / length(x1, y0);
            sum += wx * wy * (near + across);
        }
    }
    a * b * sum
}

fn length(p: f64, q: f64) -> f64 {
    (p * p + q * q).sqrt()
}

/// [`rectangle_kernel`] at all offsets of a regular grid: entry (di, dj) for |di| < `columns`, |dj| < `rows`.
#[derive(Debug, Clone)]
pub struct KernelTable {
    columns: usize,
    rows: usize,
    cell: [f64; 2],
    values: Vec<f64>,
}

impl KernelTable {
    /// Table for cells of the full sides `cell` = [along x, along y] (m).
    pub fn new(columns: usize, rows: usize, cell: [f64; 2]) -> Self {
        let half = cell.map(|side| 0.5 * side);
        Self::from_function(columns, rows, cell, |x, y| rectangle_kernel(x, y, half[0], half[1]))
    }

    /// Table of another influence, even along x, at the offsets (x, y) (m) for x and y not below 0.
    pub(super) fn from_function(
        columns: usize,
        rows: usize,
        cell: [f64; 2],
        influence: impl Fn(f64, f64) -> f64,
    ) -> Self {
        let width = 2 * columns - 1;
        let mut values = vec![0.0; width * rows];
        for dj in 0..rows {
            for di in 0..columns {
                let (x, y) = (di as f64 * cell[0], dj as f64 * cell[1]);
                let value = influence(x, y);
                values[dj * width + columns - 1 + di] = value;
                values[dj * width + columns - 1 - di] = value;
            }
        }
        Self { columns, rows, cell, values }
    }

    /// Offsets along x run over |di| < `columns`.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Offsets along y run over |dj| < `rows`.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Full sides of a cell (m).
    pub fn cell(&self) -> [f64; 2] {
        self.cell
    }

    /// Values for one |dj|, over di = −(columns−1) … columns−1.
    pub fn row(&self, dj: usize) -> &[f64] {
        let width = 2 * self.columns - 1;
        &self.values[dj * width..(dj + 1) * width]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (di, dj, b/a, D) for cells 1 × b/a, evaluated from the formula above with 60 digits.
    const MULTI_PRECISION: [(i32, i32, f64, f64); 70] = [
        (0, 0, 1.0, 3.525_494_348_078_172),
        (1, 0, 1.0, 1.038_049_735_904_756),
        (0, 1, 1.0, 1.038_049_735_904_756),
        (1, 1, 1.0, 0.724_697_438_134_33),
        (4, 1, 1.0, 0.243_130_414_176_324_9),
        (9, 0, 1.0, 0.111_168_205_203_545_95),
        (11, 3, 1.0, 0.087_733_918_241_531_83),
        (40, 0, 1.0, 0.025_000_651_006_060_273),
        (0, 7, 1.0, 0.142_978_402_598_231_6),
        (333, 5, 1.0, 0.003_002_665_673_702_009_4),
        (5000, 0, 1.0, 0.000_200_000_000_333_333_33),
        (0, 5000, 1.0, 0.000_200_000_000_333_333_33),
        (5000, 5000, 1.0, 0.000_141_421_356_355_160_63),
        (4999, 1, 1.0, 0.000_200_040_004_332_732_86),
        (0, 0, 3.0, 5.601_593_819_887_684),
        (1, 0, 3.0, 2.487_444_612_173_416),
        (0, 1, 3.0, 1.090_600_810_653_598_5),
        (1, 1, 3.0, 1.011_774_198_530_335),
        (4, 1, 3.0, 0.601_424_146_461_870_5),
        (9, 0, 3.0, 0.332_143_393_501_688_8),
        (11, 3, 3.0, 0.211_192_321_933_186_1),
        (40, 0, 3.0, 0.074_986_334_119_835_64),
        (0, 7, 3.0, 0.143_087_210_918_839_22),
        (333, 5, 3.0, 0.008_999_859_542_363_075),
        (5000, 0, 3.0, 0.000_599_999_993_000_000_2),
        (0, 5000, 3.0, 0.000_200_000_000_629_629_63),
        (5000, 5000, 3.0, 0.000_189_736_660_071_795_3),
        (4999, 1, 3.0, 0.000_600_119_908_935_815_2),
        (0, 0, 10.0, 7.993_127_478_580_090_5),
        (1, 0, 10.0, 4.716_856_152_639_772),
        (0, 1, 10.0, 1.097_873_392_386_700_3),
        (1, 1, 10.0, 1.089_198_966_776_809_2),
        (4, 1, 10.0, 0.984_487_208_680_131_6),
        (9, 0, 10.0, 1.061_567_781_643_271),
        (11, 3, 10.0, 0.315_068_403_428_924_45),
        (40, 0, 10.0, 0.249_366_315_915_600_24),
        (0, 7, 10.0, 0.143_099_616_406_518_64),
        (333, 5, 10.0, 0.029_696_136_013_245_9),
        (5000, 0, 10.0, 0.001_999_999_673_333_476_8),
        (0, 5000, 10.0, 0.000_200_000_000_663_333_33),
        (5000, 5000, 10.0, 0.000_199_007_438_685_847_35),
        (4999, 1, 10.0, 0.002_000_395_750_770_379_3),
        (0, 0, 32.0, 10.317_928_891_387_076),
        (1, 0, 32.0, 7.024_040_873_914_689),
        (0, 1, 32.0, 1.098_539_968_358_865_7),
        (1, 1, 32.0, 1.097_674_024_556_760_2),
        (4, 1, 32.0, 1.085_010_944_066_098_4),
        (9, 0, 32.0, 2.680_308_160_432_778),
        (11, 3, 32.0, 0.334_180_176_873_271_84),
        (40, 0, 32.0, 0.780_106_660_783_758_5),
        (0, 7, 32.0, 0.143_100_723_791_066_73),
        (333, 5, 32.0, 0.086_604_790_450_539_58),
        (5000, 0, 32.0, 0.006_399_989_098_716_78),
        (0, 5000, 32.0, 0.000_200_000_000_666_341_15),
        (5000, 5000, 32.0, 0.000_199_902_415_881_808_8),
        (4999, 1, 32.0, 0.006_401_138_203_592_837),
        (0, 0, 100.0, 12.596_651_399_387_754),
        (1, 0, 100.0, 9.301_014_488_399_668),
        (0, 1, 100.0, 1.098_604_881_445_88),
        (1, 1, 100.0, 1.098_516_014_771_103_3),
        (4, 1, 100.0, 1.097_186_555_690_541_1),
        (9, 0, 100.0, 4.832_943_121_179_551),
        (11, 3, 100.0, 0.336_235_272_790_859_2),
        (40, 0, 100.0, 2.095_242_569_428_102_7),
        (0, 7, 100.0, 0.143_100_831_368_048_55),
        (333, 5, 100.0, 0.166_668_276_798_857_46),
        (5000, 0, 100.0, 0.019_999_666_748_325_776),
        (0, 5000, 100.0, 0.000_200_000_000_666_633_34),
        (5000, 5000, 100.0, 0.000_199_990_001_416_370_9),
        (4999, 1, 100.0, 0.019_999_666_748_245_8),
    ];

    #[test]
    fn kernel_equals_multi_precision_values_up_to_five_thousand_cells_away() {
        for (di, dj, aspect, exact) in MULTI_PRECISION {
            let value = rectangle_kernel(f64::from(di), f64::from(dj) * aspect, 0.5, 0.5 * aspect);
            let error = value / exact - 1.0;
            // Nearest the switch to Gauss's rule 2000 half-sides × 2⁻⁵³ remain; the bound asked for is 1e-11.
            assert!(error.abs() < 1e-12, "({di}, {dj}) aspect {aspect}: {value} against {exact}, {error:e}");
        }
    }

    #[test]
    fn kernel_equals_quadrature_of_one_over_r() {
        // Composite midpoint rule with 800² points, error about (1/800)²/24/r²: the closed form is not its own witness.
        for (x, y, a, b) in [(2.0, 0.3, 0.5, 0.5), (1.0, 2.5, 0.5, 1.5), (-3.0, 1.0, 0.5, 0.25)] {
            let n = 800;
            let mut sum = 0.0;
            for i in 0..n {
                for j in 0..n {
                    let u = x - a + 2.0 * a * (f64::from(i) + 0.5) / f64::from(n);
                    let v = y - b + 2.0 * b * (f64::from(j) + 0.5) / f64::from(n);
                    sum += 1.0 / length(u, v);
                }
            }
            let quadrature = sum * 4.0 * a * b / f64::from(n * n);
            let error = rectangle_kernel(x, y, a, b) / quadrature - 1.0;
            assert!(error.abs() < 1e-6, "at ({x}, {y}): {error:e}");
        }
    }

    #[test]
    fn kernel_does_not_jump_where_the_closed_form_hands_over_to_the_quadrature() {
        for aspect in [1.0, 10.0, 100.0] {
            let switch = 20.0 * 0.5 * aspect;
            for angle in [0.0_f64, 0.4, 0.8, 1.2, 1.57] {
                let (c, s) = (angle.cos(), angle.sin());
                let inside = rectangle_kernel(switch * 0.999_999_9 * c, switch * 0.999_999_9 * s, 0.5, 0.5 * aspect);
                let far = far_field(switch * 0.999_999_9 * c, switch * 0.999_999_9 * s, 0.5, 0.5 * aspect);
                // Rounding of the closed form, 1000 aspect half-sides × 2⁻⁵³.
                assert!((inside / far - 1.0).abs() < 1e-12, "aspect {aspect}, angle {angle}");
            }
        }
    }

    #[test]
    fn equation_1_of_larizza_et_al_is_loves_on_a_cell_beside_it_and_far_off() {
        // Term by term as printed, with x, y, a and b as they are.
        let printed = |x: f64, y: f64, a: f64, b: f64| {
            let s = length;
            (x + a) * (((y + b) + s(y + b, x + a)) / ((y - b) + s(y - b, x + a))).ln()
                + (y + b) * (((x + a) + s(y + b, x + a)) / ((x - a) + s(y + b, x - a))).ln()
                + (x - a) * (((y - b) + s(y - b, x - a)) / ((y + b) + s(y + b, x - a))).ln()
                + (y - b) * (((x - a) + s(y - b, x - a)) / ((x + a) + s(y - b, x + a))).ln()
        };
        let (a, b) = (0.5, 0.75);
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (-1.0, 0.0), (0.0, 1.5), (-2.0, 3.0), (7.0, -4.5)] {
            let error = printed(x, y, a, b) / rectangle_kernel(x, y, a, b) - 1.0;
            // Differences of logarithms as printed lose 2⁻⁵³ times the square of distance over cell, a few hundred.
            assert!(error.abs() < 1e-13, "at ({x}, {y}): {error:e}");
        }
    }
}
