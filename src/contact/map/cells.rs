//! Cells of a contact map under construction: a rectangle of coarse cells, some cut in four, some of their parts again.
//!
//! Corners lie on a lattice of the finest cells. A corner in the middle of a coarser neighbour's side *hangs*: its
//! value, slopes and twist are those of the neighbour's cubic there, so that both sides of the line carry the same
//! cubics of value and slope: the surface stays C¹. No cell is next to one more than once more cut.

use crate::numerics::polynomials::hermite;
use std::collections::{BTreeMap, BTreeSet};

use super::lookup::{Cell, Cubic, evaluate};

/// Cuts before the accuracy is given up.
pub(super) const LEVELS: u32 = 6;
/// Lattice steps along a coarse cell.
pub(super) const FINEST: usize = 1 << LEVELS;

/// Value, slopes and twist of f at a node: f, f_s, f_h, f_sh [m, –, –, 1/m].
pub(super) type Node = [f64; 4];

/// Where a corner is on the lattice, in the order of strips.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct LatticeIndex {
    /// Along the raceway.
    pub(super) i: usize,
    /// Along the path.
    pub(super) j: usize,
}

/// A cell, in the order of coarse ones first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Key {
    /// Number of cuts.
    pub(super) level: u32,
    /// Index among cells so often cut, along the raceway.
    pub(super) i: usize,
    /// The same along the path.
    pub(super) j: usize,
}

impl Key {
    /// Those of coarse cells, of which there are as many above each other as `rows` says, strip by strip.
    fn coarse(rows: &[usize]) -> impl Iterator<Item = Self> {
        rows.iter().enumerate().flat_map(|(i, &rows)| (0..rows).map(move |j| Self { level: 0, i, j }))
    }

    /// The four parts, left low, right low, left high, right high.
    fn parts(self) -> [Self; 4] {
        let Self { level, i, j } = self;
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(di, dj)| Self { level: level + 1, i: 2 * i + di, j: 2 * j + dj })
    }
}

/// The cells of one patch.
#[derive(Debug, Clone)]
pub(super) struct Cells {
    /// Length and height of a coarse cell (m).
    pub(super) size: [f64; 2],
    /// Coarse cells in each strip.
    pub(super) rows: Vec<usize>,
    pub(super) leaves: BTreeSet<Key>,
    pub(super) nodes: BTreeMap<LatticeIndex, Node>,
    pub(super) cubics: BTreeMap<Key, Cubic>,
}

impl Cells {
    pub(in crate::contact) fn new(size: [f64; 2], rows: Vec<usize>) -> Self {
        let leaves = Key::coarse(&rows).collect();
        Self { size, rows, leaves, nodes: BTreeMap::new(), cubics: BTreeMap::new() }
    }

    /// Corners of a cell: left low, right low, left high, right high.
    pub(super) fn corners(Key { level, i, j }: Key) -> [LatticeIndex; 4] {
        let side = FINEST >> level;
        [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)].map(|(i, j)| LatticeIndex { i: i * side, j: j * side })
    }

    /// Leaf over one lattice step, given by its lower left corner.
    fn leaf_at(&self, i: usize, j: usize) -> Option<Key> {
        if self.rows.get(i / FINEST).is_none_or(|&rows| j >= rows * FINEST) {
            return None;
        }
        (0..=LEVELS)
            .map(|level| Key { level, i: i >> (LEVELS - level), j: j >> (LEVELS - level) })
            .find(|k| self.leaves.contains(k))
    }

    /// The coarsest leaf in whose side a corner lies.
    fn hangs_on(&self, LatticeIndex { i, j }: LatticeIndex) -> Option<Key> {
        let mut coarsest: Option<Key> = None;
        for (di, dj) in [(1, 1), (0, 1), (1, 0), (0, 0)] {
            let (Some(left), Some(low)) = ((i + di).checked_sub(1), (j + dj).checked_sub(1)) else { continue };
            let Some(leaf) = self.leaf_at(left, low) else { continue };
            let side = FINEST >> leaf.level;
            let corner = i.is_multiple_of(side) && j.is_multiple_of(side);
            if !corner && coarsest.is_none_or(|other| leaf.level < other.level) {
                coarsest = Some(leaf);
            }
        }
        coarsest
    }

    /// Cuts a leaf in four, and before it neighbours that would be two cuts behind.
    pub(super) fn divide(&mut self, key: Key) {
        if !self.leaves.contains(&key) {
            return;
        }
        let Key { level, i, j } = key;
        let side = FINEST >> level;
        let (left, low) = (i * side, j * side);
        let sides = [
            (left.checked_sub(1), Some(low)),
            (Some(left + side), Some(low)),
            (Some(left), low.checked_sub(1)),
            (Some(left), Some(low + side)),
        ];
        for (i, j) in sides {
            if let (Some(i), Some(j)) = (i, j)
                && let Some(neighbour) = self.leaf_at(i, j)
                && neighbour.level < level
            {
                self.divide(neighbour);
            }
        }
        self.leaves.remove(&key);
        self.leaves.extend(key.parts());
    }

    /// Corners that are nodes and not yet known, strip by strip upwards.
    pub(super) fn missing(&self) -> Vec<LatticeIndex> {
        let corners: BTreeSet<LatticeIndex> = self.leaves.iter().flat_map(|&key| Self::corners(key)).collect();
        corners
            .into_iter()
            .filter(|corner| !self.nodes.contains_key(corner) && self.hangs_on(*corner).is_none())
            .collect()
    }

    /// Number of nodes in use.
    pub(super) fn node_count(&self) -> usize {
        let corners: BTreeSet<LatticeIndex> = self.leaves.iter().flat_map(|&key| Self::corners(key)).collect();
        corners.into_iter().filter(|corner| self.hangs_on(*corner).is_none()).count()
    }

    /// Makes the cubics of all leaves, coarse ones first; returns those that changed.
    pub(super) fn assemble(&mut self) -> Vec<Key> {
        let before = std::mem::take(&mut self.cubics);
        let mut changed = Vec::new();
        for &key in &self.leaves {
            let corners = Self::corners(key).map(|corner| match self.hangs_on(corner) {
                Some(coarse) => self.hanging(coarse, corner),
                None => self.nodes.get(&corner).copied().unwrap_or_default(),
            });
            let part = 1.0 / f64::from(1_u32 << key.level);
            let cubic = cubic(&corners, self.size[0] * part, self.size[1] * part);
            if before.get(&key) != Some(&cubic) {
                changed.push(key);
            }
            self.cubics.insert(key, cubic);
        }
        changed
    }

    fn hanging(&self, coarse: Key, LatticeIndex { i, j }: LatticeIndex) -> Node {
        let side = FINEST >> coarse.level;
        let (q, t) = ((i - coarse.i * side) as f64 / side as f64, (j - coarse.j * side) as f64 / side as f64);
        let cells = f64::from(1_u32 << coarse.level);
        let Some(cubic) = self.cubics.get(&coarse) else { return [f64::NAN; 4] };
        let f = evaluate(cubic, q, t, cells / self.size[0], cells / self.size[1]);
        [f.value, f.ds, f.du, f.dus]
    }

    /// The cells of a raceway that is this one's mirror image.
    pub(super) fn mirrored(&self) -> Self {
        let strips = self.rows.len();
        let nodes = self
            .nodes
            .iter()
            .map(|(&at, &[f, ds, dh, dsh])| (LatticeIndex { i: strips * FINEST - at.i, ..at }, [f, -ds, dh, -dsh]));
        let mut mirrored = Self {
            size: self.size,
            rows: self.rows.iter().rev().copied().collect(),
            leaves: self.leaves.iter().map(|&key| Key { i: (strips << key.level) - 1 - key.i, ..key }).collect(),
            nodes: nodes.collect(),
            cubics: BTreeMap::new(),
        };
        mirrored.assemble();
        mirrored
    }

    /// The cells of two mirror images that meet, `self` first.
    pub(super) fn followed_by(&self, mirrored: &Self) -> Self {
        let strips = self.rows.len();
        let mut whole = self.clone();
        whole.rows.extend(&mirrored.rows);
        whole.leaves.extend(mirrored.leaves.iter().map(|&key| Key { i: (strips << key.level) + key.i, ..key }));
        whole
            .nodes
            .extend(mirrored.nodes.iter().map(|(&at, &node)| (LatticeIndex { i: strips * FINEST + at.i, ..at }, node)));
        // Where they meet, nothing changes along the raceway.
        for (_, node) in whole.nodes.iter_mut().filter(|(at, _)| at.i == strips * FINEST) {
            (node[1], node[3]) = (0.0, 0.0);
        }
        whole.assemble();
        whole
    }

    /// The cells as a map stores them: coarse ones strip by strip, cut ones after.
    pub(super) fn stored(&self) -> (Vec<Cell>, Vec<Cubic>) {
        let index: BTreeMap<Key, u32> = self.cubics.keys().zip(0..).map(|(&key, n)| (key, n)).collect();
        let mut keys: Vec<Key> = Key::coarse(&self.rows).collect();
        let mut cells = Vec::new();
        while let Some(&key) = keys.get(cells.len()) {
            if let Some(&leaf) = index.get(&key) {
                cells.push(Cell::Leaf(leaf));
                continue;
            }
            let first = keys.len() as u32;
            keys.extend(key.parts());
            cells.push(Cell::Divided([first, first + 1, first + 2, first + 3]));
        }
        (cells, self.cubics.values().copied().collect())
    }
}

/// The bicubic Hermite surface of a cell's four corners (left low, right low, left high, right high), `length` ×
/// `height` (m).
fn cubic(corners: &[Node; 4], length: f64, height: f64) -> Cubic {
    // Along the raceway first: coefficients in q of value and path slope at both ends of the path.
    let along = |left: &Node, right: &Node, v: usize, scale: f64| {
        hermite::cubic([scale * left[v], scale * length * left[v + 1], scale * right[v], scale * length * right[v + 1]])
    };
    let order = |node: &Node| [node[0], node[1], node[2], node[3]];
    let [a, b, c, d] = [order(&corners[0]), order(&corners[1]), order(&corners[2]), order(&corners[3])];
    let (low, high) = (along(&a, &b, 0, 1.0), along(&c, &d, 0, 1.0));
    let (low_slope, high_slope) = (along(&a, &b, 2, height), along(&c, &d, 2, height));
    let mut out = [[0.0; 4]; 4];
    for i in 0..4 {
        let column = hermite::cubic([low[i], low_slope[i], high[i], high_slope[i]]);
        for j in 0..4 {
            out[j][i] = column[j];
        }
    }
    out
}
