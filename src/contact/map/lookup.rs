//! Law `map`: the equivalent approach Δ(u, s), solved beforehand on nodes and interpolated.
//!
//! Element, raceway and defect do not change during a run, so the contact is one function of radial path and arc. Near
//! the defect's flanks Δ is a C¹ surface of bicubic Hermite cells through nodes whose gradients are the grid solver's
//! own forces; both forces are derivatives of that one surface, hence a closed path costs no work whatever the
//! interpolation error. On the smooth raceway Δ = u and on a flat floor Δ = u − depth, in closed form; the flanks'
//! first and last columns *are* these forms, so the pieces join in value and slope. The path is counted from a smooth
//! reference T(s) close to the first touch, so that the onset runs along the nodes and not across them: Δ(u, s) = f(u −
//! T(s), s). Below the lowest nodes Δ is continued linearly, which keeps its zero where the contact begins.
//!
//! A cell that is not accurate enough is cut in four, again and again: a second contact (the floor's beside the edge's)
//! begins on a line across the map, and only the cells on that line need to be small.
//!
//! Valid for Δ up to `largest_approach`; above, Δ is continued linearly up to [`CONTINUED`] times that, where F is some
//! per cent off (`docs/evidence/contact.md`), and beyond a lookup is an error, never a number.

use crate::contact::equivalent::EquivalentApproach;
use crate::contact::error::ContactError;

/// A map answers up to so many times its largest approach; above it by continuation.
pub const CONTINUED: f64 = 1.5;
/// What a contact map bounds.
pub const MAPPED: &str = "equivalent approach in the contact map";

/// Coefficients `c[j][i]` of q^i t^j, with q along the raceway and t along the path from 0 to 1.
pub(super) type Cubic = [[f64; 4]; 4];

/// Error of a map between its nodes, relative to the smooth contact's force at the largest approach.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Accuracy {
    /// Largest error of the normal force.
    pub max_normal: f64,
    /// Root mean square error of the normal force over arc and path.
    pub rms_normal: f64,
    /// Largest error of the tangential force.
    pub max_tangential: f64,
    /// Root mean square error of the tangential force over arc and path.
    pub rms_tangential: f64,
    /// Points between nodes at which the errors were found.
    pub points: usize,
}

impl Accuracy {
    /// The larger of the two largest errors.
    pub fn max(&self) -> f64 {
        self.max_normal.max(self.max_tangential)
    }
}

/// A stretch of raceway one coarse cell long.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Strip {
    /// Reference path T(s): coefficients of q⁰ … q³ (m).
    pub(super) reference: [f64; 4],
    /// Index of the lowest coarse cell.
    pub(super) first: usize,
    /// Coarse cells one above the other.
    pub(super) rows: f64,
}

/// A cell: one cubic, or four cells [left low, right low, left high, right high].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Cell {
    Leaf(u32),
    Divided([u32; 4]),
}

/// A stretch of raceway with nodes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Patch {
    /// First arc (m).
    pub(in crate::contact) start: f64,
    /// Length and height of a coarse cell (m), and how many make a metre.
    pub(super) size: [f64; 2],
    pub(super) per_metre: [f64; 2],
    /// Coarse cells begin so many of their heights above the reference path.
    pub(super) lowest: f64,
    pub(super) strips: Vec<Strip>,
    last_strip: f64,
    /// Coarse cells first, strip by strip; then cut ones, each after the one it is part of.
    pub(in crate::contact) cells: Vec<Cell>,
    pub(super) leaves: Vec<Cubic>,
}

/// What lies between the patches.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Stretch {
    /// Raceway lowered by a constant depth (m).
    Flat(f64),
    /// Nodes.
    Patch(Patch),
}

/// Equivalent approach of one element near one defect.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactMap {
    /// Arcs at which the stretches meet; the raceway is smooth before the first and after the last.
    pub(in crate::contact) knots: Vec<f64>,
    /// One fewer than knots.
    pub(super) stretches: Vec<Stretch>,
    pub(super) nodes: usize,
    pub(super) largest_approach: f64,
    pub(super) accuracy: Accuracy,
    pub(super) fingerprint: u64,
}

impl ContactMap {
    /// Arcs (m) from the defect's centre at which the pieces of the map meet, ascending. Outside the raceway is smooth.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Largest Δ (m) the map was made for.
    pub fn largest_approach(&self) -> f64 {
        self.largest_approach
    }

    /// Error found between the nodes when the map was made.
    pub fn accuracy(&self) -> Accuracy {
        self.accuracy
    }

    /// Number of nodes at which contacts were solved.
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// Fingerprint of the inputs the map was made from.
    pub fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// Equivalent approach at radial path `u` and arc `s` (m).
    ///
    /// # Errors
    /// [`ContactError::OutOfRange`] where the approach is much larger than the map was made for.
    #[inline]
    pub fn lookup(&self, u: f64, s: f64) -> Result<EquivalentApproach, ContactError> {
        let next = self.knots.iter().take_while(|&&knot| knot <= s).count();
        self.lookup_in(next.wrapping_sub(1), u, s)
    }

    /// As [`ContactMap::lookup`], between knots `stretch` and `stretch` + 1 or slightly beyond.
    ///
    /// # Errors
    /// As [`ContactMap::lookup`].
    #[inline]
    pub fn lookup_in(&self, stretch: usize, u: f64, s: f64) -> Result<EquivalentApproach, ContactError> {
        match self.stretches.get(stretch) {
            Some(Stretch::Patch(patch)) => match patch.lookup(u, s) {
                Some(approach) if approach.value <= CONTINUED * self.largest_approach => Ok(approach),
                beyond => Err(self.out_of_range(beyond.map_or(u, |approach| approach.value))),
            },
            Some(Stretch::Flat(depth)) => Ok(EquivalentApproach::flat(u, *depth)),
            None => Ok(EquivalentApproach::flat(u, 0.0)),
        }
    }

    #[cold]
    pub(super) fn out_of_range(&self, approach: f64) -> ContactError {
        ContactError::OutOfRange {
            quantity: MAPPED,
            value: approach,
            lower: f64::NEG_INFINITY,
            upper: CONTINUED * self.largest_approach,
        }
    }
}

impl Patch {
    pub(in crate::contact) fn new(
        start: f64,
        size: [f64; 2],
        lowest: f64,
        strips: Vec<Strip>,
        cells: Vec<Cell>,
        leaves: Vec<Cubic>,
    ) -> Self {
        let last_strip = strips.len() as f64 - 1.0;
        Self { start, size, per_metre: size.map(|side| 1.0 / side), lowest, strips, last_strip, cells, leaves }
    }

    /// Where in the patch a path and an arc lie.
    #[inline(always)]
    pub(super) fn place(&self, u: f64, s: f64) -> Option<Place<'_>> {
        let [mut per_arc, mut per_path] = self.per_metre;
        let along = (s - self.start) * per_arc;
        let (k, from) = whole_part(along, self.last_strip);
        let mut q = along - from;
        let strip = self.strips.get(k)?;
        let [c0, c1, c2, c3] = strip.reference;
        let reference = (c0 + q * c1) + (q * q) * (c2 + q * c3);
        let slope = (c1 + q * (2.0 * c2 + q * (3.0 * c3))) * per_arc;
        let second = (2.0 * c2 + 6.0 * q * c3) * per_arc * per_arc;
        let height = (u - reference) * per_path - self.lowest;
        let inside = height.max(0.0).min(strip.rows);
        let (row, below) = whole_part(inside, strip.rows - 1.0);
        let mut t = inside - below;
        let mut cell = self.cells.get(strip.first + row)?;
        let leaf = loop {
            match cell {
                Cell::Leaf(leaf) => break self.leaves.get(*leaf as usize)?,
                Cell::Divided(parts) => {
                    (q, t, per_arc, per_path) = (2.0 * q, 2.0 * t, 2.0 * per_arc, 2.0 * per_path);
                    let (right, high) = (usize::from(q >= 1.0), usize::from(t >= 1.0));
                    (q, t) = (q - right as f64, t - high as f64);
                    cell = self.cells.get(parts[right + 2 * high] as usize)?;
                }
            }
        };
        Some(Place { leaf, q, t, per_arc, per_path, beyond: height - inside, slope, second })
    }

    #[inline]
    fn lookup(&self, u: f64, s: f64) -> Option<EquivalentApproach> {
        let Place { leaf, q, t, per_arc, per_path, beyond, slope, .. } = self.place(u, s)?;
        let mut f = evaluate(leaf, q, t, per_arc, per_path);
        if beyond != 0.0 {
            let beyond = beyond * self.size[1];
            // Beyond the nodes the edge is continued by its slope.
            f.value += f.du * beyond;
            f.ds += f.dus * beyond;
            f.duu = 0.0;
        }
        // Δ(u, s) = f(u − T(s), s)
        Some(EquivalentApproach {
            value: f.value,
            du: f.du,
            ds: f.ds - f.du * slope,
            duu: f.duu,
            dus: f.dus - f.duu * slope,
        })
    }
}

/// A place in a patch: its cell, and the reference path there.
pub(super) struct Place<'a> {
    pub(super) leaf: &'a Cubic,
    /// Where in the cell, from 0 to 1 along the raceway and along the path, and how much these grow a metre.
    pub(super) q: f64,
    pub(super) t: f64,
    pub(super) per_arc: f64,
    pub(super) per_path: f64,
    /// Distance above the highest nodes or, negative, below the lowest, in heights of a coarse cell.
    pub(super) beyond: f64,
    /// T′ and T″ (1/m).
    pub(super) slope: f64,
    pub(super) second: f64,
}

/// The whole number below `x`, at least 0 and at most `last`, as an index and as a number; for a whole `x` it may be
/// the one before. Adding 1.5 × 2⁵² leaves it in the low bits: half the instructions of two conversions.
#[inline(always)]
fn whole_part(x: f64, last: f64) -> (usize, f64) {
    const SHIFT: f64 = 6_755_399_441_055_744.0;
    let shifted = (x - 0.5).max(0.0).min(last) + SHIFT;
    (shifted.to_bits() as u32 as usize, shifted - SHIFT)
}

/// Value and derivatives of a cubic whose q and t grow by `per_arc` and `per_path` a metre.
#[inline(always)]
pub(super) fn evaluate(c: &Cubic, q: f64, t: f64, per_arc: f64, per_path: f64) -> EquivalentApproach {
    let [value, by_t, by_tt] = along_path(c, t);
    EquivalentApproach {
        value: value_at(&value, q),
        du: value_at(&by_t, q) * per_path,
        ds: slope_at(&value, q) * per_arc,
        duu: value_at(&by_tt, q) * per_path * per_path,
        dus: slope_at(&by_t, q) * per_path * per_arc,
    }
}

/// Coefficients of q⁰ … q³ at one t: of the value, and of its first and second derivative by t.
#[inline(always)]
pub(super) fn along_path(c: &Cubic, t: f64) -> [[f64; 4]; 3] {
    let (mut value, mut by_t, mut by_tt) = ([0.0; 4], [0.0; 4], [0.0; 4]);
    for i in 0..4 {
        let (c0, c1, c2, c3) = (c[0][i], c[1][i], c[2][i], c[3][i]);
        let top = c2 + t * c3;
        let middle = c1 + t * top;
        value[i] = c0 + t * middle;
        let inner = top + t * c3;
        by_t[i] = middle + t * inner;
        by_tt[i] = 2.0 * (inner + t * c3);
    }
    [value, by_t, by_tt]
}

/// A cubic at q.
#[inline(always)]
pub(super) fn value_at(p: &[f64; 4], q: f64) -> f64 {
    (p[0] + q * p[1]) + (q * q) * (p[2] + q * p[3])
}

/// Its derivative.
#[inline(always)]
pub(super) fn slope_at(p: &[f64; 4], q: f64) -> f64 {
    p[1] + q * (2.0 * p[2] + 3.0 * q * p[3])
}
