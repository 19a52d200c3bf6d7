//! A measured topography of a surface: depth over arc and width, bilinear between the points of a rectangular
//! grid.
//!
//! With the hat functions N of the grid lines, h(s, y) = Σ_ij N_i(s) N_j(y) h_ij. The mean over a cell is a sum of
//! products of the hats' integrals, so it is exact, whatever the cell's position and size. Outside the grid h = 0, by a
//! vertical edge where the border is not at depth 0: a patch must be at least as wide as the contact, or end on smooth
//! raceway.
//!
//! The arc is counted from the middle of its range, which is put at the defect's angle. The axial coordinate is taken
//! as given: 0 is the groove's bottom, and it grows with z along the groove's arc; balls at a contact angle run beside
//! the bottom, by 1.08 mm at 15° in a 6205. Nothing is assumed symmetric. Grid lines need not be evenly spaced.

use super::measured::treat;
use super::trace::{ARC, DEPTH};
use super::{Interval, Profile, SurfaceError, csv};
use crate::scene::Measured;

/// Column of the axial coordinate; its presence tells a topography from a trace.
pub(super) const AXIAL: &str = "axial_mm";

/// Depth h (m) over the arc s (m) and the axial coordinate y (m).
#[derive(Debug, Clone, PartialEq)]
pub struct Topography {
    /// Arcs of the grid, ascending.
    arcs: Vec<f64>,
    /// Axial coordinates of the grid, ascending.
    axials: Vec<f64>,
    /// Depths, those of one arc side by side.
    depths: Vec<f64>,
}

impl Topography {
    /// Reads a topography: a header with `arc_mm`, `axial_mm`, `depth_um`, then one point of a full rectangular grid a
    /// line, lines in any order; `#` begins a comment line.
    ///
    /// # Errors
    /// An empty file, missing or unknown columns, values that are no finite numbers, fewer than two grid lines, a point
    /// that is missing or given twice.
    pub fn from_csv(text: &str) -> Result<Self, SurfaceError> {
        let rows = csv::read(text, [ARC, AXIAL, DEPTH])?;
        let arcs = grid_lines(rows.iter().map(|row| row.values[0]), ARC)?;
        let axials = grid_lines(rows.iter().map(|row| row.values[1]), AXIAL)?;
        let needed = arcs.len() * axials.len();
        // A file of scattered points has almost as many grid lines as points: no grid is laid out for it.
        let mut depths = vec![f64::NAN; if rows.len() < needed { 0 } else { needed }];
        let index = |arc: f64, axial: f64| {
            let row = arcs.partition_point(|&value| value < arc);
            row * axials.len() + axials.partition_point(|&value| value < axial)
        };
        if depths.is_empty() {
            let mut taken: Vec<usize> = rows.iter().map(|row| index(row.values[0], row.values[1])).collect();
            taken.sort_unstable();
            taken.dedup();
            let hole = taken.iter().enumerate().find(|(k, index)| k != *index).map_or(taken.len(), |(k, _)| k);
            return Err(SurfaceError::Hole {
                arc_mm: arcs[hole / axials.len()],
                axial_mm: axials[hole % axials.len()],
                found: rows.len(),
                arcs: arcs.len(),
                axials: axials.len(),
                needed,
            });
        }
        for row in &rows {
            let [arc_mm, axial_mm, depth_um] = row.values;
            let depth = &mut depths[index(arc_mm, axial_mm)];
            if !depth.is_nan() {
                return Err(SurfaceError::RepeatedPoint { line: row.line, arc_mm, axial_mm });
            }
            *depth = depth_um / 1e6;
        }
        let middle = 0.5 * (arcs[0] + arcs[arcs.len() - 1]);
        Ok(Self {
            arcs: arcs.iter().map(|arc| (arc - middle) / 1e3).collect(),
            axials: axials.iter().map(|axial| axial / 1e3).collect(),
            depths,
        })
    }

    /// The same with what is to be done to its depths: to each line along the arc as to a trace.
    ///
    /// # Errors
    /// Those of [`from_csv`](Self::from_csv); lines too short for a circle.
    pub fn measured(text: &str, of: &Measured) -> Result<Self, SurfaceError> {
        let mut made = Self::from_csv(text)?;
        let width = made.axials.len();
        for j in 0..width {
            let mut line: Vec<f64> = made.depths.iter().skip(j).step_by(width).copied().collect();
            treat(&made.arcs, &mut line, of)?;
            made.depths.iter_mut().skip(j).step_by(width).zip(line).for_each(|(depth, treated)| *depth = treated);
        }
        Ok(made)
    }

    /// With every depth multiplied by `factor`.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        Self { depths: self.depths.iter().map(|depth| factor * depth).collect(), ..self.clone() }
    }

    /// With every arc multiplied by `factor`.
    pub(crate) fn stretched(&self, factor: f64) -> Self {
        Self { arcs: self.arcs.iter().map(|arc| factor * arc).collect(), ..self.clone() }
    }

    /// As it lies about another place across the raceway (m), which is 0 then.
    pub fn seen_from(&self, axial: f64) -> Self {
        Self { axials: self.axials.iter().map(|at| at - axial).collect(), ..self.clone() }
    }

    /// Whether the depth is not the same everywhere between two axial coordinates (m).
    pub(crate) fn varies_across(&self, [from, to]: [f64; 2]) -> bool {
        let (width, last) = (self.axials.len(), self.axials.len() - 1);
        let lines = touched(&self.axials, [from.max(self.axials[0]), to.min(self.axials[last])]);
        let is_smooth = |j: usize| self.depths.iter().skip(j).step_by(width).all(|&depth| depth == 0.0);
        let ends = (from < self.axials[0] && !is_smooth(0)) || (to > self.axials[last] && !is_smooth(last));
        ends || self.depths.chunks_exact(width).any(|row| lines.clone().any(|j| row[j] != row[lines.start]))
    }

    /// Arcs of the grid, ascending (m).
    pub fn arcs(&self) -> &[f64] {
        &self.arcs
    }

    /// Axial coordinates of the grid, ascending (m).
    pub fn axials(&self) -> &[f64] {
        &self.axials
    }

    /// Depths, those of one arc side by side (m).
    pub fn depths(&self) -> &[f64] {
        &self.depths
    }

    /// First and last arc (m).
    pub fn extent(&self) -> (f64, f64) {
        (self.arcs[0], self.arcs[self.arcs.len() - 1])
    }

    /// Arcs (m) at which the depth jumps: the first and the last, where the border is not at depth 0.
    pub fn edges(&self) -> Vec<f64> {
        let (first, last) = self.extent();
        let width = self.axials.len();
        let borders = [(first, &self.depths[..width]), (last, &self.depths[self.depths.len() - width..])];
        let jumps = borders.into_iter().filter(|(_, depths)| depths.iter().any(|&depth| depth != 0.0));
        jumps.map(|(arc, _)| arc).collect()
    }

    /// Depth (m) at an arc and an axial coordinate (m); on the border the depth of the patch.
    pub fn depth_at(&self, arc: f64, axial: f64) -> f64 {
        let (Some((i, p)), Some((j, q))) = (locate(&self.arcs, arc), locate(&self.axials, axial)) else {
            return 0.0;
        };
        let h = |i: usize, j: usize| self.depths[i * self.axials.len() + j];
        let near = h(i, j) * (1.0 - q) + h(i, j + 1) * q;
        let far = h(i + 1, j) * (1.0 - q) + h(i + 1, j + 1) * q;
        near * (1.0 - p) + far * p
    }

    /// Exact mean depth (m) over the cell between two arcs and two axial coordinates (m), each in ascending order.
    pub fn mean_depth(&self, arc: [f64; 2], axial: [f64; 2]) -> f64 {
        let (rows, columns) = (touched(&self.arcs, arc), touched(&self.axials, axial));
        let mut volume = 0.0;
        for i in rows {
            let row = &self.depths[i * self.axials.len()..][..self.axials.len()];
            let line: f64 = columns.clone().map(|j| hat_integral(&self.axials, j, axial) * row[j]).sum();
            volume += hat_integral(&self.arcs, i, arc) * line;
        }
        volume / ((arc[1] - arc[0]) * (axial[1] - axial[0]))
    }

    /// The profile along the arc at an axial coordinate (m).
    pub fn profile_at(&self, axial: f64) -> Profile {
        Profile::closed(self.arcs.iter().map(|&arc| (arc, self.depth_at(arc, axial))).collect())
    }

    /// The longest interval between two arcs, and between two axial coordinates, over which the depth changes.
    pub(super) fn coarsest(&self) -> [Option<Interval>; 2] {
        let h = |i: usize, j: usize| self.depths[i * self.axials.len() + j];
        let longest = |lines: &[f64], differ: &dyn Fn(usize) -> bool| {
            let intervals = lines.windows(2).enumerate().filter(|(k, _)| differ(*k));
            Interval::longest(intervals.map(|(_, pair)| Interval::new(pair[0], pair[1])))
        };
        [
            longest(&self.arcs, &|i| (0..self.axials.len()).any(|j| h(i, j) != h(i + 1, j))),
            longest(&self.axials, &|j| (0..self.arcs.len()).any(|i| h(i, j) != h(i, j + 1))),
        ]
    }

    /// Arc and depth (m) of the point farthest from the smooth raceway.
    pub(super) fn farthest(&self) -> (f64, f64) {
        let mut farthest = (0.0, 0.0_f64);
        for (index, &depth) in self.depths.iter().enumerate() {
            if depth.abs() > farthest.1.abs() {
                farthest = (self.arcs[index / self.axials.len()], depth);
            }
        }
        farthest
    }
}

/// Distinct coordinates in ascending order.
fn grid_lines(values: impl Iterator<Item = f64>, column: &'static str) -> Result<Vec<f64>, SurfaceError> {
    let mut lines: Vec<f64> = values.collect();
    lines.sort_unstable_by(f64::total_cmp);
    lines.dedup();
    if lines.len() < 2 {
        return Err(SurfaceError::TooFewPoints { found: lines.len(), column });
    }
    Ok(lines)
}

/// The grid interval that holds a coordinate and the position within it, from 0 to 1.
fn locate(lines: &[f64], value: f64) -> Option<(usize, f64)> {
    let last = lines.len() - 1;
    if !(lines[0]..=lines[last]).contains(&value) {
        return None;
    }
    let index = lines.partition_point(|&line| line <= value).saturating_sub(1).min(last - 1);
    Some((index, (value - lines[index]) / (lines[index + 1] - lines[index])))
}

/// Grid lines whose hats reach into the range.
fn touched(lines: &[f64], range: [f64; 2]) -> std::ops::Range<usize> {
    let first = lines.partition_point(|&line| line <= range[0]).saturating_sub(1);
    let end = lines.partition_point(|&line| line < range[1]);
    first..(end + 1).min(lines.len())
}

/// Integral over the range of the hat function of one grid line: 1 there, 0 at its neighbours.
fn hat_integral(lines: &[f64], index: usize, range: [f64; 2]) -> f64 {
    let side = |peak: f64, foot: f64| {
        let (low, high) = if peak < foot { (peak, foot) } else { (foot, peak) };
        let (a, b) = (low.max(range[0]), high.min(range[1]));
        if b <= a {
            return 0.0;
        }
        (b - a) * (0.5 * ((a - foot) + (b - foot)) / (peak - foot))
    };
    let mut integral = 0.0;
    if index > 0 {
        integral += side(lines[index], lines[index - 1]);
    }
    if index + 1 < lines.len() {
        integral += side(lines[index], lines[index + 1]);
    }
    integral
}
