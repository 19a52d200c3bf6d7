//! Law `love`: one element near the defect, solved on the raceway's own grid.
//!
//! The grid gives the energy W_g(u, s) = ½ Σ p (u − h) and its derivatives ∂W_g/∂u = Σ p, ∂W_g/∂s = −Σ p ∂h/∂s, exact
//! for the discrete contact. The equivalent approach is the approach on the *smooth* raceway at which the same grid
//! stores the same energy,
//!
//! ```text
//! Δ(u, s) = W_smooth⁻¹(W_g(u, s))
//! ```
//!
//! W_g is the mean over two grids whose rows are half a row apart: a row that comes into contact is a step in the
//! stiffness, and half a row later the other grid takes the step. That leaves a quarter of the force's ripple for twice
//! the work; twice the rows would take eight times.
//!
//! Δ is u on the smooth raceway and u − depth on a flat floor, whatever the resolution and the difference between
//! circles and Hertz's paraboloids (0.4 to 2.4 % in force): the law joins the closed form without a jump. E* and K
//! cancel. Any function of (u, s) is a potential, hence the rescaling costs no energy either. On the smooth raceway
//! there remains the ripple of the grid as the element passes over its cells; `docs/evidence/contact.md` gives figures.
//!
//! Pressure at a sharp corner grows without bound as the grid is refined (the force does not). A half-space knows
//! nothing of the corner's own compliance; [`LoveContact::with_edges`] adds it.

use crate::surface::Surface;
use libm::pow;

use super::active_set::{ActiveSet, Window};
use super::edge_softness::{EdgeSoftness, StepImage};
use super::half_space::KernelTable;
use super::raceway_grid::{RacewayGrid, Resolution};
use super::row_pairs::PressedCell;
use super::smooth_scale::{Energy, SmoothScale};
use super::soft_edges::{GridEdge, SoftEdge, WindowSize};
use crate::contact::element_on_raceway::ElementOnRaceway;
use crate::contact::equivalent::EquivalentApproach;
use crate::contact::error::ContactError;

/// Nodes of the smooth raceway's energy; quadratically dense towards zero.
const SMOOTH_NODES: usize = 64;
/// The grid touches where the centre of its first cell touches, a little late. Below this many times that path the
/// contact is a cell or two.
const ONSET_TOUCHES: f64 = 3.0;
/// Below this part of the largest approach a contact is a few cells and its stiffness is noise: Δ is continued
/// linearly. The force there is 0.2 % of the largest, and by some per cent of that wrong.
const ONSET: f64 = 0.015;

/// The contact of an element with one raceway, solved when asked.
#[derive(Debug, Clone)]
pub struct LoveContact {
    pub(super) layers: Vec<Layer>,
    largest_approach: f64,
    /// n of a force that grows as δ^n.
    order: f64,
    /// Distance from edges within which they make the raceway softer (m).
    soft_reach: f64,
    pub(super) smooth: SmoothScale,
    solves: u64,
}

/// One grid with its solver.
#[derive(Debug, Clone)]
pub(super) struct Layer {
    pub(super) grid: RacewayGrid,
    /// Rows on one side of an element that hold its contacts.
    half_rows: usize,
    softness: Option<Softness>,
    pub(super) solver: ActiveSet,
    interference: Vec<f64>,
    pub(super) slopes: Vec<f64>,
    /// Right-hand side on the pressed cells.
    pub(super) unit: Vec<f64>,
    /// Of the last contact: its window's first column, and its energy.
    pub(super) first: i32,
    pub(super) energy: Energy,
}

/// Softness of the edges of one raceway.
#[derive(Debug, Clone, Copy)]
struct Softness {
    of: EdgeSoftness,
    /// Half-axis of the largest contact along the raceway (m).
    half_axis: f64,
}

impl Softness {
    /// The edges of a grid.
    fn edges(self, grid: &RacewayGrid) -> impl Iterator<Item = GridEdge> {
        grid.edges(self.half_axis, self.of.deepest * self.half_axis).filter(|edge| edge.depth > 0.0)
    }
}

impl LoveContact {
    /// Prepares grid, kernel and the smooth raceway's energy for Δ up to `largest_approach` (m).
    ///
    /// # Errors
    /// [`ContactError::BadInput`] for impossible radii or approaches.
    pub fn new(
        element: ElementOnRaceway,
        surface: &Surface,
        largest_approach: f64,
        resolution: Resolution,
    ) -> Result<Self, ContactError> {
        Self::with_edges(element, surface, largest_approach, resolution, None)
    }

    /// As [`LoveContact::new`], with sharp edges of this softness.
    ///
    /// # Errors
    /// As there; [`ContactError::NoEdge`] for a surface without a sharp edge.
    pub fn with_edges(
        element: ElementOnRaceway,
        surface: &Surface,
        largest_approach: f64,
        resolution: Resolution,
        softness: Option<EdgeSoftness>,
    ) -> Result<Self, ContactError> {
        let grid = RacewayGrid::new(element, Some(surface), largest_approach, resolution)?;
        let half_axis = element.contact_half_axes(largest_approach)[0];
        let softness = softness.map(|of| Softness { of, half_axis });
        let mut soft_reach = 0.0;
        if let Some(softness) = softness {
            soft_reach = softness.edges(&grid).map(|edge| StepImage::reach(edge.depth)).fold(0.0, f64::max);
            if soft_reach == 0.0 {
                return Err(ContactError::NoEdge);
            }
        }
        let layer = |grid| Layer::new(grid, largest_approach, softness);
        let layers = vec![layer(grid.interlaced())?, layer(grid)?];
        let (order, smooth) = (element.order(), SmoothScale::default());
        let mut contact = Self { layers, largest_approach, order, soft_reach, smooth, solves: 0 };
        contact.smooth = contact.smooth_scale()?;
        // The largest contact once, beside the defect: solvers then have the room for all others.
        contact.energy(largest_approach, surface.extent().0 - 4.0 * element.contact_half_axes(largest_approach)[0])?;
        contact.forget();
        contact.solves = 0;
        Ok(contact)
    }

    /// The same with nothing solved yet, and with the room that this one was made with.
    pub(in crate::contact) fn copy(&self) -> Self {
        let mut copy = self.clone();
        copy.layers.iter_mut().for_each(|layer| layer.make_room(self.largest_approach));
        copy.forget();
        copy
    }

    /// The grid under the element that has a row along the groove's bottom.
    pub fn grid(&self) -> &RacewayGrid {
        &self.layers[0].grid
    }

    /// Contacts solved so far.
    pub fn solves(&self) -> u64 {
        self.solves
    }

    /// Distance from edges within which they make the raceway softer (m); 0 where they do not.
    pub(in crate::contact) fn soft_reach(&self) -> f64 {
        self.soft_reach
    }

    /// Largest Δ (m) that is answered.
    pub fn largest_approach(&self) -> f64 {
        self.largest_approach
    }

    /// Radial path (m) at which an element at arc `s` (m) begins to touch.
    pub fn first_touch(&self, s: f64) -> f64 {
        // A groove is lowest in its middle, along the first grid's row; a topography may be so anywhere.
        let grids = if self.grid().mirrored() { 1 } else { self.layers.len() };
        self.layers.iter().take(grids).map(|layer| layer.grid.first_touch(s)).fold(f64::INFINITY, f64::min)
    }

    /// Forgets the last contact, so that the next answer does not depend on it even in its rounding.
    pub fn forget(&mut self) {
        for layer in &mut self.layers {
            layer.solver.forget();
        }
    }

    /// Equivalent approach at radial path `u` and arc `s` (m), without second derivatives.
    ///
    /// # Errors
    /// [`ContactError::OutOfRange`] beyond the largest approach, [`ContactError::NotConverged`] when the grid cannot be
    /// solved.
    pub fn solve(&mut self, u: f64, s: f64) -> Result<EquivalentApproach, ContactError> {
        let touch = self.first_touch(s);
        if self.is_far(u, touch) {
            // No contact within reach: how far off it is, and no more.
            return Ok(EquivalentApproach::flat(u, touch));
        }
        self.solve_or_continue(u, s, touch)
    }

    /// Whether no contact is within reach at a path, the first touch being at another (m).
    pub(super) fn is_far(&self, u: f64, touch: f64) -> bool {
        u < touch - 0.1 * self.largest_approach
    }

    /// As [`LoveContact::solve`], but with the first-order continuation however far off the contact is.
    pub(in crate::contact) fn continued(&mut self, u: f64, s: f64) -> Result<EquivalentApproach, ContactError> {
        self.solve_or_continue(u, s, self.first_touch(s))
    }

    fn solve_or_continue(&mut self, u: f64, s: f64, touch: f64) -> Result<EquivalentApproach, ContactError> {
        if u > touch {
            let approach = self.equivalent(u, s)?;
            if approach.value >= self.smooth.onset() {
                return Ok(approach);
            }
        }
        self.below_onset(u, s, touch)
    }

    /// First-order continuation from the path at which Δ has the onset's small value.
    fn below_onset(&mut self, u: f64, s: f64, touch: f64) -> Result<EquivalentApproach, ContactError> {
        let (at, found) = self.at_onset(s, touch)?;
        let value = found.value + found.du * (u - at);
        Ok(EquivalentApproach { value, du: found.du, ds: found.ds, ..EquivalentApproach::default() })
    }

    /// The path (m) at which Δ has the onset's small value, and Δ there.
    pub(super) fn at_onset(&mut self, s: f64, touch: f64) -> Result<(f64, EquivalentApproach), ContactError> {
        let onset = self.smooth.onset();
        let (mut low, mut high) = (touch, f64::INFINITY);
        let mut at = touch + onset;
        let mut iterations = 0;
        loop {
            let found = self.equivalent(at, s)?;
            let miss = found.value - onset;
            if miss.abs() < 1e-9 * onset {
                return Ok((at, found));
            }
            if miss > 0.0 {
                high = at
            } else {
                low = at
            }
            iterations += 1;
            if iterations > 60 {
                return Err(ContactError::NotConverged { iterations, residual: miss / onset, limit: 1e-9 });
            }
            let newton = at - miss / found.du;
            at = if newton > low && newton < high {
                newton
            } else if high.is_finite() {
                0.5 * (low + high)
            } else {
                at + onset
            };
        }
    }

    pub(super) fn equivalent(&mut self, u: f64, s: f64) -> Result<EquivalentApproach, ContactError> {
        let energy = self.energy(u, s)?;
        let approach = self.smooth.equivalent(energy);
        if !(approach.value <= self.largest_approach * (1.0 + 1e-9)) {
            return Err(ContactError::OutOfRange {
                quantity: "equivalent approach",
                value: approach.value,
                lower: f64::NEG_INFINITY,
                upper: self.largest_approach,
            });
        }
        Ok(approach)
    }

    /// Mean over the grids.
    fn energy(&mut self, u: f64, s: f64) -> Result<Energy, ContactError> {
        let limit = self.grid().deepest() + 3.0 * self.largest_approach;
        if !(u <= limit) || !s.is_finite() {
            return Err(ContactError::OutOfRange {
                quantity: "radial path",
                value: u,
                lower: f64::NEG_INFINITY,
                upper: limit,
            });
        }
        let mut sum = Energy::default();
        let part = 1.0 / self.layers.len() as f64;
        for layer in &mut self.layers {
            sum.add(&layer.energy(u, s, self.largest_approach)?, part);
            self.solves += 1;
        }
        Ok(sum)
    }

    /// W of the smooth raceway, the element above the middle of a cell.
    fn smooth_scale(&mut self) -> Result<SmoothScale, ContactError> {
        let smooth: Vec<Layer> = self
            .layers
            .iter()
            .map(|layer| Layer::new(layer.grid.without_defect(), self.largest_approach, None))
            .collect::<Result<_, _>>()?;
        let with_defect = std::mem::replace(&mut self.layers, smooth);
        let s = self.grid().centre(0);
        let onset = (ONSET_TOUCHES * self.grid().first_touch(s)).max(ONSET * self.largest_approach);
        let (low, high) = (onset.sqrt(), (1.02 * self.largest_approach).sqrt());
        // W grows as Δ^(n + 1), about.
        let power = 1.0 / (1.0 + self.order);
        let mut nodes = Vec::new();
        for k in 0..=SMOOTH_NODES {
            let root = low + (high - low) * k as f64 / SMOOTH_NODES as f64;
            let u = root * root;
            let energy = self.energy(u, s)?;
            let v = pow(energy.w, power);
            let slope = power * v / energy.w * energy.u;
            nodes.push([v, u, 1.0 / slope]);
        }
        self.layers = with_defect;
        Ok(SmoothScale::new(nodes, power))
    }
}

impl Layer {
    fn new(grid: RacewayGrid, largest_approach: f64, softness: Option<Softness>) -> Result<Self, ContactError> {
        let solver = solver_for(&grid, largest_approach, softness)?;
        let [interference, slopes, unit] = [const { Vec::new() }; 3];
        let energy = Energy::default();
        let half_rows = grid.half_rows();
        let mut layer = Self { grid, half_rows, softness, solver, interference, slopes, first: 0, unit, energy };
        layer.make_room(largest_approach);
        Ok(layer)
    }

    /// Makes room for every window; a copy has none except for what is filled.
    fn make_room(&mut self, largest_approach: f64) {
        let (rows, columns) = (self.grid.rows(), self.grid.widest(self.grid.deepest() + 3.0 * largest_approach));
        self.interference.reserve(rows * columns);
        self.slopes.reserve(columns);
        self.solver.make_room();
    }

    /// Puts the element at another place across the raceway (m); the grid is widened until its contacts are on it.
    pub(super) fn move_across(&mut self, place: f64, largest_approach: f64) -> Result<(), ContactError> {
        let needed = self.half_rows + (place.abs() / self.grid.cell()[1]).ceil() as usize;
        if self.grid.half_rows() < needed {
            self.grid.set_rows(needed);
            self.solver = solver_for(&self.grid, largest_approach, self.softness)?;
        }
        self.grid.move_across(place);
        Ok(())
    }

    fn energy(&mut self, u: f64, s: f64, largest_approach: f64) -> Result<Energy, ContactError> {
        loop {
            let span = self.grid.window(u, s);
            self.grid.interference(u, s, span, &mut self.interference, &mut self.slopes);
            for (row, values) in self.interference.chunks_exact_mut(span.count).enumerate() {
                let share = self.grid.share(row);
                if share < 1.0 {
                    values.iter_mut().for_each(|value| *value *= share);
                }
            }
            let window = Window { first: span.first, columns: span.count, interference: &self.interference };
            self.solver.solve(window)?;
            let rows = self.grid.rows();
            let border = |row: usize| row + 1 == rows || (row == 0 && !self.grid.mirrored());
            if !self.grid.can_widen() || !self.solver.runs().iter().any(|run| border(run.row)) {
                (self.first, self.energy) = (span.first, self.collect(span.first));
                return Ok(self.energy);
            }
            // The contact is wider than the grid across the raceway: more rows, and once more.
            let half = self.grid.half_rows();
            self.grid.set_rows(half + half / 4 + 2);
            self.solver = solver_for(&self.grid, largest_approach, self.softness)?;
        }
    }

    fn collect(&self, first: i32) -> Energy {
        let columns = self.slopes.len();
        let mut energy = Energy::default();
        for PressedCell { row, column, pressure: p, .. } in self.solver.cells() {
            let column = (column - first) as usize;
            let share = self.grid.share(row);
            // ∂h/∂s = −∂h/∂t
            energy.w += 0.5 * p * self.interference[row * columns + column];
            energy.u += share * p;
            energy.s += share * p * self.slopes[column];
        }
        energy
    }
}

fn solver_for(
    grid: &RacewayGrid,
    largest_approach: f64,
    softness: Option<Softness>,
) -> Result<ActiveSet, ContactError> {
    let columns = grid.widest(grid.deepest() + 3.0 * largest_approach);
    let rows = if grid.mirrored() { 2 * grid.rows() } else { grid.rows() };
    let kernel = KernelTable::new(columns, rows, grid.cell());
    let size = WindowSize { columns, rows: grid.rows(), kernel_rows: rows };
    let edges = softness.into_iter().flat_map(|softness| {
        let soft = move |edge| SoftEdge::new(edge, softness.of.factor, grid.cell(), size, grid.mirror());
        softness.edges(grid).map(soft)
    });
    Ok(ActiveSet::new(&kernel, grid.rows(), grid.mirror())?.with_edges(edges.collect()))
}
