//! A stretch of raceway of which a [`MapPlan`] computes nodes: around one flank of a defect, or a whole short defect.
//!
//! [`MapPlan`]: super::plan::MapPlan

use super::cells::{Cells, FINEST};

/// Coarse cells begin so many of their heights above the reference path.
pub(super) const LOWEST: f64 = -1.0;

/// A point of the reference path: arc (m), path (m) and its slope by the arc.
pub(super) struct Reference {
    pub(super) arc: f64,
    pub(in crate::contact) path: f64,
    pub(in crate::contact) slope: f64,
}

/// One stretch of nodes to be computed: its ends, what is beyond them, and its cells.
#[derive(Debug, Clone)]
pub(super) struct PatchPlan {
    /// First arc (m).
    pub(in crate::contact) start: f64,
    /// Depth of the flat stretch before (m).
    pub(super) before: f64,
    /// Depth of the flat stretch after (m); `None` where the mirror image of this one follows.
    pub(super) after: Option<f64>,
    /// Reference path of each strip, coefficients of q⁰ … q³ (m).
    pub(super) references: Vec<[f64; 4]>,
    pub(in crate::contact) cells: Cells,
}

impl PatchPlan {
    /// Last arc (m).
    pub(in crate::contact) fn end(&self) -> f64 {
        self.start + self.cells.size[0] * self.cells.rows.len() as f64
    }

    /// The reference at a lattice index along the raceway.
    pub(super) fn reference(&self, i: usize) -> Reference {
        let strip = (i / FINEST).min(self.references.len() - 1);
        let q = (i - strip * FINEST) as f64 / FINEST as f64;
        let width = self.cells.size[0];
        let [c0, c1, c2, c3] = self.references[strip];
        let path = c0 + q * (c1 + q * (c2 + q * c3));
        let slope = (c1 + q * (2.0 * c2 + 3.0 * q * c3)) / width;
        Reference { arc: self.start + i as f64 / FINEST as f64 * width, path, slope }
    }

    /// Reference path at an arc (m).
    pub(super) fn reference_at(&self, s: f64) -> f64 {
        let along = (s - self.start) / self.cells.size[0];
        let strip = (along.max(0.0) as usize).min(self.references.len() - 1);
        let q = along - strip as f64;
        let [c0, c1, c2, c3] = self.references[strip];
        c0 + q * (c1 + q * (c2 + q * c3))
    }

    /// Height (m) above the reference path at a lattice index along the path.
    pub(super) fn height(&self, j: f64) -> f64 {
        (LOWEST + j / FINEST as f64) * self.cells.size[1]
    }

    /// Depth (m) of the flat stretch that begins or ends with strip `k` of `strips`.
    pub(super) fn flat_of(&self, k: usize, strips: usize) -> Option<f64> {
        match k {
            0 => Some(self.before),
            k if k == strips => self.after,
            _ => None,
        }
    }

    /// Depth (m) of the flat stretch that begins or ends at a lattice index along the raceway.
    pub(super) fn flat(&self, i: usize) -> Option<f64> {
        self.flat_of(i, self.references.len() * FINEST)
    }

    /// What is to be computed of a stretch that is its own mirror image about arc 0: that before it.
    pub(super) fn halved(&self) -> Self {
        let strips = self.cells.rows.len().div_ceil(2);
        let size = [-self.start / strips as f64, self.cells.size[1]];
        Self { after: None, cells: Cells::new(size, vec![0; strips]), ..self.clone() }
    }

    /// The same stretch on the other side of arc 0, where the raceway is its mirror image.
    pub(super) fn mirrored(&self, before: f64) -> Self {
        let references = self.references.iter().rev().map(|&[c0, c1, c2, c3]| {
            // The cubic in 1 − q.
            [c0 + c1 + c2 + c3, -(c1 + 2.0 * c2 + 3.0 * c3), c2 + 3.0 * c3, -c3]
        });
        Self {
            start: -self.end(),
            before,
            after: Some(self.before),
            references: references.collect(),
            cells: self.cells.mirrored(),
        }
    }

    /// A stretch that ends at arc 0 together with its mirror image.
    pub(super) fn with_mirror_image(&self) -> Self {
        let Self { after, mut references, cells, .. } = self.mirrored(self.before);
        references.splice(0..0, self.references.iter().copied());
        Self { after, references, cells: self.cells.followed_by(&cells), ..self.clone() }
    }
}
