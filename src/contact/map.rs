//! Law `map`: the equivalent approach Δ(u, s), solved beforehand on nodes and interpolated.
//!
//! Element, raceway and defect do not change during a run, so the contact is one function of radial path and arc. Near the
//! defect's flanks Δ is a C¹ bicubic Hermite surface through nodes whose gradients are the grid solver's own forces; both forces are
//! derivatives of that one surface, hence a closed path costs no work whatever the interpolation error. On the smooth
//! raceway Δ = u and on a flat floor Δ = u − depth, in closed form; the flanks' first and last columns *are* these forms, so the pieces join in
//! value and slope. The path is counted from a smooth reference T(s) close to the first touch, so that the onset runs along the
//! nodes and not across them: Δ(u, s) = f(u − T(s), s). Below the onset Δ is continued linearly, which keeps its zero where the contact begins.
//!
//! Valid for Δ up to `largest_approach`; beyond it a lookup is an error, never a number.

use super::{equivalent::EquivalentApproach, error::ContactError};

/// Δ and its scaled derivatives at a node: Δ, Δ_s ds, Δ_u du, Δ_us du ds [m]. Value and arc derivative lie side by side: they are
/// interpolated alike.
pub(super) type Node = [f64; 4];

/// Error of a map between its nodes, relative to the smooth contact's force at the largest approach.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Accuracy {
    /// Largest error of the normal force.
    pub max_normal: f64,
    /// Root mean square error of the normal force.
    pub rms_normal: f64,
    /// Largest error of the tangential force.
    pub max_tangential: f64,
    /// Root mean square error of the tangential force.
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

/// Nodes at one arc: reference path and its slope times the strip's arc step [m], place of the first node, number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Column {
    pub(super) reference: [f64; 2],
    pub(super) at: usize,
    pub(super) count: usize,
}

/// One interval of a patch, with nodes as dense as the accuracy needs them there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Strip {
    /// Index of the first of its `parts` + 1 columns.
    pub(super) first: usize,
    pub(super) parts: i32,
    /// Distance of nodes along the raceway and along the path [m], and nodes per metre.
    pub(super) arc_step: f64,
    pub(super) path_step: f64,
    pub(super) per_arc: f64,
    pub(super) per_path: f64,
    /// Index of the lowest node; node 0 stands on the reference path.
    pub(super) lowest: i32,
}

impl Strip {
    pub(super) fn new(first: usize, parts: i32, width: f64, path_step: f64, lowest: i32) -> Self {
        let arc_step = width / f64::from(parts);
        Self { first, parts, arc_step, path_step, per_arc: 1.0 / arc_step, per_path: 1.0 / path_step, lowest }
    }
}

/// A stretch of raceway with nodes, cut into strips of one width.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Patch {
    /// First arc and width of a strip [m].
    pub(super) start: f64,
    pub(super) width: f64,
    pub(super) per_width: f64,
    pub(super) strips: Vec<Strip>,
    pub(super) columns: Vec<Column>,
    pub(super) nodes: Vec<Node>,
}

/// What lies between the patches.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Stretch {
    /// Raceway lowered by a constant depth [m].
    Flat(f64),
    /// Nodes.
    Patch(Patch),
}

/// Equivalent approach of one element near one defect.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactMap {
    /// Arcs at which the stretches meet; the raceway is smooth before the first and after the last.
    pub(super) knots: Vec<f64>,
    /// One fewer than knots.
    pub(super) stretches: Vec<Stretch>,
    pub(super) largest_approach: f64,
    pub(super) accuracy: Accuracy,
    pub(super) fingerprint: u64,
}

impl ContactMap {
    /// Arcs [m] from the defect's centre at which the pieces of the map meet, ascending. Outside the raceway is smooth.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Largest Δ [m] the map was made for.
    pub fn largest_approach(&self) -> f64 {
        self.largest_approach
    }

    /// Error found between the nodes when the map was made.
    pub fn accuracy(&self) -> Accuracy {
        self.accuracy
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        let count = |stretch: &Stretch| if let Stretch::Patch(patch) = stretch { patch.nodes.len() } else { 0 };
        self.stretches.iter().map(count).sum()
    }

    /// Fingerprint of the inputs the map was made from.
    pub fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// Equivalent approach at radial path `u` and arc `s` [m].
    ///
    /// # Errors
    /// [`ContactError::OutOfRange`] where the approach is larger than the map was made for.
    #[inline]
    pub fn lookup(&self, u: f64, s: f64) -> Result<EquivalentApproach, ContactError> {
        let next = self.knots.iter().take_while(|&&knot| knot <= s).count();
        match self.stretches.get(next.wrapping_sub(1)) {
            Some(Stretch::Patch(patch)) => patch.lookup(u, s).ok_or_else(|| self.out_of_range(u)),
            Some(Stretch::Flat(depth)) => Ok(EquivalentApproach::flat(u, *depth)),
            None => Ok(EquivalentApproach::flat(u, 0.0)),
        }
    }

    #[cold]
    fn out_of_range(&self, u: f64) -> ContactError {
        ContactError::OutOfRange {
            quantity: "radial path in the contact map",
            value: u,
            lower: f64::NEG_INFINITY,
            upper: self.largest_approach,
        }
    }
}

impl Patch {
    #[inline]
    fn lookup(&self, u: f64, s: f64) -> Option<EquivalentApproach> {
        // Signed 32-bit conversions: one instruction, where unsigned ones are several.
        let along = (s - self.start) * self.per_width;
        let k = (along as i32).min(self.strips.len() as i32 - 1);
        let strip = self.strips.get(k as usize)?;
        let along = (along - f64::from(k)) * f64::from(strip.parts);
        let part = (along as i32).min(strip.parts - 1);
        let q = along - f64::from(part);
        let first = strip.first + part as usize;
        let [left, right] = self.columns.get(first..first + 2)? else { return None };
        let (du, ds) = (strip.per_path, strip.per_arc);
        let lowest = f64::from(strip.lowest);
        let by_arc = hermite(q);
        let reference =
            |b: &[f64; 4]| combine(&[left.reference[0], left.reference[1], right.reference[0], right.reference[1]], b);
        let height = (u - reference(&by_arc[0])) * du - lowest;
        // Below the nodes the lowest edge is continued by its slope.
        let below = height < 0.0;
        let cell = height.max(0.0) as i32;
        let t = if below { 0.0 } else { height - f64::from(cell) };
        let cell = cell as usize;
        let pair = |column: &Column| -> Option<[Node; 2]> {
            if cell + 1 >= column.count {
                return None;
            }
            match self.nodes.get(column.at + cell..column.at + cell + 2)? {
                [low, high] => Some([*low, *high]),
                _ => None,
            }
        };
        let (l, r) = (pair(left)?, pair(right)?);
        let by_path = hermite(t);
        // Along the path first: value and arc derivative at both columns, each with its path derivatives.
        let across = |b: &[f64; 4]| {
            let mut mixed = [0.0; 4];
            for v in 0..2 {
                mixed[v] = (l[0][v] * b[0] + l[0][v + 2] * b[1]) + (l[1][v] * b[2] + l[1][v + 2] * b[3]);
                mixed[v + 2] = (r[0][v] * b[0] + r[0][v + 2] * b[1]) + (r[1][v] * b[2] + r[1][v + 2] * b[3]);
            }
            mixed
        };
        let (v, v_t, v_tt) = (across(&by_path[0]), across(&by_path[1]), across(&by_path[2]));
        let mut f = EquivalentApproach {
            value: combine(&v, &by_arc[0]),
            du: combine(&v_t, &by_arc[0]) * du,
            ds: combine(&v, &by_arc[1]) * ds,
            duu: combine(&v_tt, &by_arc[0]) * du * du,
            dus: combine(&v_t, &by_arc[1]) * du * ds,
            dss: combine(&v, &by_arc[2]) * ds * ds,
        };
        if below {
            let gap = height * strip.path_step;
            f.value += f.du * gap;
            f.ds += f.dus * gap;
            f.dss += combine(&v_t, &by_arc[2]) * du * ds * ds * gap;
            f.duu = 0.0;
        }
        // Δ(u, s) = f(u − T(s), s)
        let (slope, bend) = (reference(&by_arc[1]) * ds, reference(&by_arc[2]) * ds * ds);
        Some(EquivalentApproach {
            value: f.value,
            du: f.du,
            ds: f.ds - f.du * slope,
            duu: f.duu,
            dus: f.dus - f.duu * slope,
            dss: f.dss - 2.0 * f.dus * slope + f.duu * slope * slope - f.du * bend,
        })
    }
}

/// Cubic Hermite weights of value and slope at 0 and at 1, with two derivatives.
#[inline(always)]
pub(super) fn hermite(t: f64) -> [[f64; 4]; 3] {
    let w = 1.0 - t;
    [
        [w * w * (1.0 + 2.0 * t), t * w * w, t * t * (3.0 - 2.0 * t), -t * t * w],
        [-6.0 * t * w, w * (1.0 - 3.0 * t), 6.0 * t * w, t * (3.0 * t - 2.0)],
        [12.0 * t - 6.0, 6.0 * t - 4.0, 6.0 - 12.0 * t, 6.0 * t - 2.0],
    ]
}

#[inline(always)]
pub(super) fn combine(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])
}
