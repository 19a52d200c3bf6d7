//! Making a [`ContactMap`]: where nodes are needed, what they hold, and how far off the map is between them.
//!
//! Nodes stand at arcs where the element is above the middle of a cell, so that all see the same grid. Around the flanks
//! they cover every path from below the first touch to the largest approach. The map is compared with the grid at points between the nodes, in all
//! positions relative to the cells; while the error is larger than asked for, the distance of the nodes is halved.
//!
//! Columns of nodes do not depend on each other: the caller says how they are computed, one after the other or on all cores, and the
//! result is the same to the last bit.

use std::hash::Hasher;

use crate::surface::Surface;

use super::{
    equivalent::EquivalentApproach,
    error::ContactError,
    love::LoveContact,
    map::{Accuracy, Column, ContactMap, Node, Patch, Stretch},
    map_format::Fingerprint,
    raceway_grid::{ElementOnRaceway, Resolution},
};

/// What a map is to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapSpecification {
    /// Largest equivalent approach Δ [m] that may be asked for.
    pub largest_approach: f64,
    /// Largest error of either force between nodes, relative to the smooth contact's force at the largest approach.
    pub accuracy: f64,
    /// Cells of the grid across Hertz's ellipse at the largest approach.
    pub resolution: Resolution,
}

impl MapSpecification {
    /// 0.1 % of full scale on 64 × 16 cells.
    pub fn new(largest_approach: f64) -> Self {
        Self { largest_approach, accuracy: 1e-3, resolution: Resolution { columns: 64, rows: 16 } }
    }
}

/// Column of nodes or errors at the checks of a column, whichever job was asked for.
type Job<'a, T> = &'a (dyn Fn(usize) -> Result<T, ContactError> + Sync);

/// How independent jobs are run: `run(count, job)` returns `job(0)` … `job(count − 1)` in order.
pub trait Runner {
    /// Runs the jobs; `done` is called after each with the number finished.
    ///
    /// # Errors
    /// The first error of a job.
    fn run<T: Send>(&mut self, count: usize, job: Job<'_, T>) -> Result<Vec<T>, ContactError>;
}

/// One after the other, with a callback (finished, of) for a progress bar.
pub struct Sequential<F: FnMut(usize, usize)>(pub F);

impl<F: FnMut(usize, usize)> Runner for Sequential<F> {
    fn run<T: Send>(&mut self, count: usize, job: Job<'_, T>) -> Result<Vec<T>, ContactError> {
        let mut results = Vec::with_capacity(count);
        for index in 0..count {
            results.push(job(index)?);
            (self.0)(index + 1, count);
        }
        Ok(results)
    }
}

/// Lowest node of a column, one step below the reference path.
const LOWEST: i32 = -1;

/// Halvings of the node distance before the accuracy is given up.
const LEVELS: u32 = 4;

impl ContactMap {
    /// Map for an element over `surface`.
    ///
    /// # Errors
    /// [`ContactError::BadInput`] for impossible inputs, [`ContactError::MapNotAccurate`] when even the finest nodes miss the accuracy.
    pub fn build(
        surface: &Surface,
        element: ElementOnRaceway,
        specification: MapSpecification,
        runner: &mut impl Runner,
    ) -> Result<Self, ContactError> {
        let mut last = None;
        for level in 0..LEVELS {
            let plan = MapPlan::new(surface, element, specification, level)?;
            let map = plan.build(runner)?;
            if map.accuracy.max() <= specification.accuracy {
                return Ok(map);
            }
            last = Some((map.accuracy.max(), map.nodes()));
        }
        let (achieved, nodes) = last.unwrap_or((f64::NAN, 0));
        Err(ContactError::MapNotAccurate { achieved, requested: specification.accuracy, nodes })
    }

    /// Fingerprint of all inputs: a stored map with another one belongs to something else.
    pub fn fingerprint_of(surface: &Surface, element: ElementOnRaceway, specification: MapSpecification) -> u64 {
        let mut hash = Fingerprint::default();
        hash.write(env!("CARGO_PKG_VERSION").as_bytes());
        let mut number = |value: f64| hash.write(&value.to_bits().to_le_bytes());
        for value in [element.element_radius, element.raceway_radius, element.groove_radius] {
            number(value);
        }
        number(specification.largest_approach);
        number(specification.accuracy);
        number(specification.resolution.columns as f64);
        number(specification.resolution.rows as f64);
        match surface {
            Surface::Profile(profile) => {
                for &(arc, depth) in profile.points() {
                    number(arc);
                    number(depth);
                }
            }
            Surface::Topography(topography) => {
                let (arcs, axials, depths) = topography.grid();
                for values in [arcs, axials, depths] {
                    number(values.len() as f64);
                    for &value in values {
                        number(value);
                    }
                }
            }
        }
        hash.finish()
    }
}

/// One stretch of nodes to be computed.
#[derive(Debug, Clone)]
struct PatchPlan {
    first_column: i32,
    columns: usize,
    before: f64,
    after: f64,
}

/// A map before its nodes are known.
pub struct MapPlan {
    specification: MapSpecification,
    fingerprint: u64,
    contact: LoveContact,
    stride: i32,
    arc_step: f64,
    path_step: f64,
    patches: Vec<PatchPlan>,
}

impl MapPlan {
    /// Plans nodes at a distance halved `level` times.
    ///
    /// # Errors
    /// [`ContactError::BadInput`] for impossible inputs.
    pub fn new(
        surface: &Surface,
        element: ElementOnRaceway,
        specification: MapSpecification,
        level: u32,
    ) -> Result<Self, ContactError> {
        let largest = specification.largest_approach;
        let fingerprint = ContactMap::fingerprint_of(surface, element, specification);
        let fine = f64::from(1_u32 << level);
        let [a, _] = element.checked()?.contact_half_axes(largest);
        let path_step = largest / (4.0 * fine);
        let wanted = 0.2 * a / fine;
        let prepared = largest + 3.0 * path_step;
        // Cells are counted across the ellipse at the largest approach that is solved.
        let contact = LoveContact::new(element, surface, prepared, specification.resolution)?;
        let cell = contact.grid().cell()[0];
        // An even number of cells, so that half-way between two nodes the element is above a cell's middle again.
        let stride = ((0.5 * wanted / cell).round().max(0.5) * 2.0) as i32;
        let mut plan = Self {
            specification,
            fingerprint,
            stride,
            arc_step: f64::from(stride) * cell,
            path_step,
            patches: Vec::new(),
            contact,
        };
        plan.patches = plan.patches_for(surface, element);
        Ok(plan)
    }

    fn patches_for(&self, surface: &Surface, element: ElementOnRaceway) -> Vec<PatchPlan> {
        let largest = self.specification.largest_approach;
        let cell = self.contact.grid().cell()[0];
        // No cell of another depth may be in contact.
        let clear = 1.2 * element.contact_half_axes(largest)[0] + 3.0 * cell;
        let (from, to) = surface.extent();
        let mut flats = vec![(f64::NEG_INFINITY, from, 0.0)];
        if let Surface::Profile(profile) = surface {
            for pair in profile.points().windows(2) {
                let ((s0, d0), (s1, d1)) = (pair[0], pair[1]);
                if d0 == d1 && s1 > s0 {
                    flats.push((s0, s1, d0));
                }
            }
        }
        flats.push((to, f64::INFINITY, 0.0));
        let raised = -shallowest(surface);
        let mut free = Vec::new();
        for (s0, s1, depth) in flats {
            // Higher raceway on either side must stay below the element that presses on the flat.
            let margin = clear.max(reach(element, depth + raised + largest) + 2.0 * cell);
            let margin = if depth <= -raised { clear } else { margin };
            if s1 - s0 > 2.0 * margin + 2.0 * self.arc_step {
                free.push((s0 + margin, s1 - margin, depth));
            }
        }
        let column = |s: f64| self.contact.grid().column_at(s);
        free.windows(2)
            .map(|pair| {
                let (first_column, last) = (column(pair[0].1) - 1, column(pair[1].0) + 1);
                let columns = ((last - first_column + self.stride - 1) / self.stride) as usize + 1;
                PatchPlan { first_column, columns, before: pair[0].2, after: pair[1].2 }
            })
            .collect()
    }

    /// Number of columns of nodes.
    pub fn columns(&self) -> usize {
        self.patches.iter().map(|patch| patch.columns).sum()
    }

    /// Computes all nodes and the errors between them.
    ///
    /// # Errors
    /// When a contact cannot be solved.
    pub fn build(&self, runner: &mut impl Runner) -> Result<ContactMap, ContactError> {
        let jobs: Vec<(usize, usize)> =
            self.patches.iter().enumerate().flat_map(|(p, patch)| (0..patch.columns).map(move |k| (p, k))).collect();
        let columns = runner.run(jobs.len(), &|index| {
            let (p, k) = jobs[index];
            self.column(&self.patches[p], k)
        })?;
        let mut map = self.assemble(columns);
        let checks = runner.run(jobs.len(), &|index| {
            let (p, k) = jobs[index];
            self.errors(&map, &self.patches[p], k)
        })?;
        map.accuracy = summary(&checks);
        Ok(map)
    }

    fn arc(&self, patch: &PatchPlan, k: usize) -> f64 {
        self.contact.grid().centre(patch.first_column + k as i32 * self.stride)
    }

    /// Depth of the flat stretch that begins or ends at a column.
    fn flat(patch: &PatchPlan, k: usize) -> Option<f64> {
        match k {
            0 => Some(patch.before),
            k if k + 1 == patch.columns => Some(patch.after),
            _ => None,
        }
    }

    /// Reference path at a column and its slope over one step.
    fn reference(&self, patch: &PatchPlan, k: usize) -> [f64; 2] {
        let touch = |k: usize| Self::flat(patch, k).unwrap_or_else(|| self.contact.first_touch(self.arc(patch, k)));
        match Self::flat(patch, k) {
            Some(depth) => [depth, 0.0],
            None => [touch(k), 0.5 * (touch(k + 1) - touch(k - 1))],
        }
    }

    /// Nodes of one column from below the first touch to the largest approach.
    fn column(&self, patch: &PatchPlan, k: usize) -> Result<([f64; 2], Vec<Node>), ContactError> {
        let s = self.arc(patch, k);
        let [touch, over_step] = self.reference(patch, k);
        let slope = over_step / self.arc_step;
        let mut contact = self.contact.clone();
        contact.forget();
        let mut nodes = Vec::new();
        let mut onset: Option<(f64, EquivalentApproach)> = None;
        for i in LOWEST.. {
            let u = touch + f64::from(i) * self.path_step;
            let approach = match Self::flat(patch, k) {
                Some(depth) => EquivalentApproach::flat(u, depth),
                None => contact.solve_or_continue(u, s, &mut onset)?,
            };
            nodes.push([
                approach.value,
                approach.du * self.path_step,
                (approach.ds + approach.du * slope) * self.arc_step,
                (approach.dus + approach.duu * slope) * self.path_step * self.arc_step,
            ]);
            // One node more, for neighbours in which the same height presses less.
            if approach.value > self.specification.largest_approach + self.path_step {
                break;
            }
        }
        Ok(([touch, over_step], nodes))
    }

    fn assemble(&self, columns: Vec<([f64; 2], Vec<Node>)>) -> ContactMap {
        let mut columns = columns.into_iter();
        let (mut knots, mut stretches) = (Vec::new(), Vec::new());
        for plan in &self.patches {
            let mut patch = Patch {
                start: self.arc(plan, 0),
                arc_step: self.arc_step,
                path_step: self.path_step,
                lowest: LOWEST,
                columns: Vec::new(),
                nodes: Vec::new(),
            };
            for (reference, nodes) in columns.by_ref().take(plan.columns) {
                patch.columns.push(Column { reference, at: patch.nodes.len(), count: nodes.len() });
                patch.nodes.extend(nodes);
            }
            if !knots.is_empty() {
                stretches.push(Stretch::Flat(plan.before));
            }
            knots.push(self.arc(plan, 0));
            knots.push(self.arc(plan, plan.columns - 1));
            stretches.push(Stretch::Patch(patch));
        }
        ContactMap {
            knots,
            stretches,
            largest_approach: self.specification.largest_approach,
            accuracy: Accuracy::default(),
            fingerprint: self.fingerprint,
        }
    }

    /// Errors of both forces at points right of a column, one in each cell of nodes, relative to full scale.
    fn errors(&self, map: &ContactMap, patch: &PatchPlan, k: usize) -> Result<Vec<[f64; 2]>, ContactError> {
        let mut errors = Vec::new();
        if k + 1 == patch.columns {
            return Ok(errors);
        }
        let largest = self.specification.largest_approach;
        let full_scale = largest * largest.sqrt();
        let mut contact = self.contact.clone();
        contact.forget();
        for i in LOWEST.. {
            // Places within the cell by additive recurrence: they fill it evenly as the cells go by.
            let n = (k * 31) as f64 + f64::from(i - LOWEST);
            let (q, t) = ((n * 0.754_877_666 + 0.5).fract(), (n * 0.569_840_291 + 0.5).fract());
            let s = self.arc(patch, k) + q * self.arc_step;
            let [left, right] = [self.reference(patch, k)[0], self.reference(patch, k + 1)[0]];
            let u = left + q * (right - left) + (f64::from(i) + t) * self.path_step;
            let exact = match contact.solve(u, s) {
                Ok(exact) if exact.value <= largest => exact.forces(1.0),
                Ok(_) | Err(ContactError::OutOfRange { .. }) => break,
                Err(error) => return Err(error),
            };
            let found = map.lookup(u, s)?.forces(1.0);
//DBG             if std::env::var("DUMP").is_ok() { println!("E {s:e} {u:e} {:e} {:e} {:e} {:e}", contact.first_touch(s), exact[0]/full_scale, (found[0] - exact[0]) / full_scale, (found[1] - exact[1]) / full_scale); }
            if exact[0] > 0.0 || found[0] > 0.0 {
                errors.push([(found[0] - exact[0]) / full_scale, (found[1] - exact[1]) / full_scale]);
            }
        }
        Ok(errors)
    }
}

fn summary(checks: &[Vec<[f64; 2]>]) -> Accuracy {
    let mut accuracy = Accuracy::default();
    let mut squares = [0.0; 2];
    for [normal, tangential] in checks.iter().flatten() {
        accuracy.max_normal = accuracy.max_normal.max(normal.abs());
        accuracy.max_tangential = accuracy.max_tangential.max(tangential.abs());
        squares[0] += normal * normal;
        squares[1] += tangential * tangential;
        accuracy.points += 1;
    }
    let count = accuracy.points.max(1) as f64;
    accuracy.rms_normal = (squares[0] / count).sqrt();
    accuracy.rms_tangential = (squares[1] / count).sqrt();
    accuracy
}

/// Distance [m] along the raceway within which the element comes lower than `depth` [m]; a little more than the circles'.
fn reach(element: ElementOnRaceway, depth: f64) -> f64 {
    (2.0 * depth.max(0.0) / element.curvatures()[0]).sqrt()
}

fn deepest(surface: &Surface) -> f64 {
    depths(surface).fold(0.0, f64::max)
}

fn shallowest(surface: &Surface) -> f64 {
    depths(surface).fold(0.0, f64::min)
}

fn depths(surface: &Surface) -> Box<dyn Iterator<Item = f64> + '_> {
    match surface {
        Surface::Profile(profile) => Box::new(profile.points().iter().map(|&(_, depth)| depth)),
        Surface::Topography(topography) => Box::new(topography.grid().2.iter().copied()),
    }
}
