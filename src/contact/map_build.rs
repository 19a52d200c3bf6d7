//! Making a [`ContactMap`]: where nodes are needed, what they hold, and how far off the map is between them.
//!
//! Around the flanks nodes cover every path from below the first touch to the largest approach. The map is compared with the
//! grid at points between the nodes, one in each cell of nodes; strips of raceway in which the error is larger than asked for get nodes at half the distance,
//! in both directions. That happens where a second contact begins, of the floor beside that of the edge: there the force has a kink
//! in its slope, on a line across the map. Where a dense strip meets a coarse one, its end column lies on the coarse one's cubics, so that value and
//! slopes stay continuous.
//!
//! Columns of nodes do not depend on each other: the caller says how they are computed, one after the other or on all cores, and the
//! result is the same to the last bit.

use std::collections::{BTreeMap, BTreeSet};
use std::hash::Hasher;

use crate::surface::Surface;

use super::{
    equivalent::EquivalentApproach,
    error::ContactError,
    love::LoveContact,
    map::{Accuracy, Column, ContactMap, Node, Patch, Stretch, Strip, combine, hermite},
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

/// Lowest node of a column, one coarse step below the reference path.
const LOWEST: i32 = -1;

/// Halvings of the distance of nodes before the accuracy is given up.
const LEVELS: u32 = 6;

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
        let map = MapPlan::new(surface, element, specification)?.build(runner)?;
        if map.accuracy.max() > specification.accuracy {
            return Err(ContactError::MapNotAccurate {
                achieved: map.accuracy.max(),
                requested: specification.accuracy,
                nodes: map.nodes(),
            });
        }
        Ok(map)
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

/// Halvings of the distance of nodes along the raceway and along the path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Level {
    arc: u32,
    path: u32,
}

/// Errors of both forces relative to full scale in one strip: on its columns, on its rows of nodes, within its cells. The first two tell
/// which way to halve.
#[derive(Debug, Clone, Default)]
struct Errors {
    on_columns: Vec<[f64; 2]>,
    on_rows: Vec<[f64; 2]>,
    within: Vec<[f64; 2]>,
}

/// One stretch of nodes to be computed: its ends, what is beyond them, and how often each strip's nodes were halved.
#[derive(Debug, Clone)]
struct PatchPlan {
    start: f64,
    width: f64,
    levels: Vec<Level>,
    before: f64,
    after: f64,
}

/// Where a column of nodes stands: patch, place in units of the narrowest part of a strip, halvings of the path's step.
type Place = (usize, usize, u32);

/// Nodes at one place: reference path and slope, nodes whose derivatives are by u and s [m, –, –, 1/m].
#[derive(Debug, Clone)]
struct ColumnNodes {
    reference: [f64; 2],
    nodes: Vec<[f64; 4]>,
}

/// A map in the making.
pub struct MapPlan {
    specification: MapSpecification,
    fingerprint: u64,
    contact: LoveContact,
    path_step: f64,
    patches: Vec<PatchPlan>,
    columns: BTreeMap<Place, ColumnNodes>,
}

impl MapPlan {
    /// Plans the coarsest nodes.
    ///
    /// # Errors
    /// [`ContactError::BadInput`] for impossible inputs.
    pub fn new(
        surface: &Surface,
        element: ElementOnRaceway,
        specification: MapSpecification,
    ) -> Result<Self, ContactError> {
        if !(specification.accuracy > 0.0 && specification.accuracy < 1.0) {
            return Err(ContactError::BadInput {
                quantity: "accuracy of the contact map",
                value: specification.accuracy,
                unit: "of full scale",
                limit: "between 0 and 1".to_owned(),
            });
        }
        let largest = specification.largest_approach;
        let path_step = largest / 4.0;
        let contact = LoveContact::new(element, surface, largest + 3.0 * path_step, specification.resolution)?;
        let mut plan = Self {
            specification,
            fingerprint: ContactMap::fingerprint_of(surface, element, specification),
            path_step,
            patches: Vec::new(),
            columns: BTreeMap::new(),
            contact,
        };
        plan.patches = plan.patches_for(surface, element);
        Ok(plan)
    }

    fn patches_for(&self, surface: &Surface, element: ElementOnRaceway) -> Vec<PatchPlan> {
        let largest = self.specification.largest_approach;
        let cell = self.contact.grid().cell()[0];
        let strip_width = 0.25 * element.contact_half_axes(largest)[0];
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
            if s1 - s0 > 2.0 * margin + 2.0 * strip_width {
                free.push((s0 + margin, s1 - margin, depth));
            }
        }
        free.windows(2)
            .map(|pair| {
                let (start, end) = (pair[0].1, pair[1].0);
                let strips = ((end - start) / strip_width).ceil().max(1.0);
                PatchPlan {
                    start,
                    width: (end - start) / strips,
                    levels: vec![Level::default(); strips as usize],
                    before: pair[0].2,
                    after: pair[1].2,
                }
            })
            .collect()
    }

    /// The grid solver without nodes, the arcs [m] between which it is needed, and the depth of the flat stretches
    /// between them: what law `love` solves inside the step.
    pub fn into_love(self) -> (LoveContact, Vec<f64>, Vec<Option<f64>>) {
        let (mut knots, mut flats) = (Vec::new(), Vec::new());
        for (index, patch) in self.patches.iter().enumerate() {
            if index > 0 {
                flats.push(Some(patch.before));
            }
            knots.push(patch.start);
            knots.push(patch.start + patch.width * patch.levels.len() as f64);
            flats.push(None);
        }
        (self.contact, knots, flats)
    }

    /// Computes nodes and the errors between them, and halves strips until the accuracy is met or nodes are at their densest.
    ///
    /// # Errors
    /// When a contact cannot be solved.
    pub fn build(mut self, runner: &mut impl Runner) -> Result<ContactMap, ContactError> {
        let mut errors: BTreeMap<(usize, usize), Errors> = BTreeMap::new();
        let mut stale: Vec<(usize, usize)> = self
            .patches
            .iter()
            .enumerate()
            .flat_map(|(p, patch)| (0..patch.levels.len()).map(move |k| (p, k)))
            .collect();
        loop {
            let missing: Vec<Place> =
                self.places().into_iter().filter(|place| !self.columns.contains_key(place)).collect();
            let solved = runner.run(missing.len(), &|index| self.column(missing[index]))?;
            self.columns.extend(missing.into_iter().zip(solved));
            let map = self.assemble();
            let checks = runner.run(stale.len(), &|index| self.errors(&map, stale[index]))?;
            errors.extend(stale.iter().copied().zip(checks));
            stale = self.refine(&errors);
            if stale.is_empty() {
                return Ok(ContactMap { accuracy: summary(errors.values()), ..map });
            }
        }
    }

    /// Halves the strips that are not accurate enough, and their neighbours until no two differ by more than one halving: an end column as
    /// coarse as a much coarser neighbour would spoil a dense strip. Returns what is to be checked again.
    fn refine(&mut self, errors: &BTreeMap<(usize, usize), Errors>) -> Vec<(usize, usize)> {
        let before: Vec<Vec<Level>> = self.patches.iter().map(|patch| patch.levels.clone()).collect();
        let worst = |found: &[[f64; 2]]| found.iter().flatten().fold(0.0_f64, |m, e| m.max(e.abs()));
        // A little better than asked for: the checks do not hit the worst place.
        let limit = 0.8 * self.specification.accuracy;
        for (&(p, k), found) in errors {
            let level = &mut self.patches[p].levels[k];
            let (mut path, mut arc) = (worst(&found.on_columns) > 0.7 * limit, worst(&found.on_rows) > 0.7 * limit);
            if worst(&found.within) > limit && !(path || arc) {
                (path, arc) = (true, true);
            }
            level.path = (level.path + u32::from(path)).min(LEVELS);
            level.arc = (level.arc + u32::from(arc)).min(LEVELS);
        }
        let mut stale = BTreeSet::new();
        for (p, (patch, before)) in self.patches.iter_mut().zip(before).enumerate() {
            let levels = &mut patch.levels;
            for k in 1..levels.len() {
                levels[k].path = levels[k].path.max(levels[k - 1].path.saturating_sub(1));
            }
            for k in (1..levels.len()).rev() {
                levels[k - 1].path = levels[k - 1].path.max(levels[k].path.saturating_sub(1));
            }
            let changed = |k: usize| levels.get(k).is_some_and(|level| *level != before[k]);
            // The ends of a strip follow its neighbours.
            stale.extend(
                (0..levels.len()).filter(|&k| changed(k) || changed(k + 1) || k > 0 && changed(k - 1)).map(|k| (p, k)),
            );
        }
        stale.into_iter().collect()
    }

    /// Columns of one strip: place of each and halvings of its path step. An end is as coarse as the coarser of its two strips.
    fn places_of(&self, p: usize, k: usize) -> impl Iterator<Item = Place> + '_ {
        let levels = &self.patches[p].levels;
        let (level, finest) = (levels[k], 1_usize << LEVELS);
        let parts = 1_usize << level.arc;
        (0..=parts).map(move |part| {
            let coarser = match part {
                0 if k > 0 => level.path.min(levels[k - 1].path),
                part if part == parts && k + 1 < levels.len() => level.path.min(levels[k + 1].path),
                _ => level.path,
            };
            (p, k * finest + part * (finest >> level.arc), coarser)
        })
    }

    fn places(&self) -> BTreeSet<Place> {
        let strips =
            self.patches.iter().enumerate().flat_map(|(p, patch)| (0..patch.levels.len()).map(move |k| (p, k)));
        strips.flat_map(|(p, k)| self.places_of(p, k)).collect()
    }

    fn arc(&self, (p, at, _): Place) -> f64 {
        let patch = &self.patches[p];
        patch.start + at as f64 / (1_usize << LEVELS) as f64 * patch.width
    }

    /// Depth of the flat stretch that begins or ends at a place.
    fn flat(&self, (p, at, _): Place) -> Option<f64> {
        let patch = &self.patches[p];
        match at {
            0 => Some(patch.before),
            at if at == patch.levels.len() << LEVELS => Some(patch.after),
            _ => None,
        }
    }

    /// Nodes at one place from below the first touch to the largest approach.
    fn column(&self, place: Place) -> Result<ColumnNodes, ContactError> {
        let s = self.arc(place);
        let path_step = self.path_step / f64::from(1_u32 << place.2);
        let reference = match self.flat(place) {
            Some(depth) => [depth, 0.0],
            None => {
                let h = self.contact.grid().cell()[0];
                let touch = |s: f64| self.contact.first_touch(s);
                [touch(s), (touch(s + h) - touch(s - h)) / (2.0 * h)]
            }
        };
        let [touch, slope] = reference;
        let mut contact = self.contact.clone();
        contact.forget();
        let mut nodes = Vec::new();
        let mut onset: Option<(f64, EquivalentApproach)> = None;
        // On and below the reference path the column is the line through two places a little above. The first cells that touch say nothing of
        // the contact's slope: the grid's own derivative is noisy there, by a tenth and more.
        let height = 0.5 * path_step;
        let [near, next] = match self.flat(place) {
            Some(depth) => [1.0, 2.0].map(|n| EquivalentApproach::flat(depth + n * height, depth)),
            None => [
                contact.solve_or_continue(touch + height, s, &mut onset)?,
                contact.solve_or_continue(touch + 2.0 * height, s, &mut onset)?,
            ],
        };
        let rise = (next.value - near.value) / height;
        for i in LOWEST << place.2.. {
            let above = f64::from(i) * path_step;
            if i <= 0 {
                nodes.push([near.value + rise * (above - height), rise, near.ds + near.du * slope, 0.0]);
                continue;
            }
            let u = touch + above;
            let a = match self.flat(place) {
                Some(depth) => EquivalentApproach::flat(u, depth),
                None => contact.solve_or_continue(u, s, &mut onset)?,
            };
            nodes.push([a.value, a.du, a.ds + a.du * slope, a.dus + a.duu * slope]);
            // Some more, for neighbours in which the same height presses less; whole coarse steps, for coarser neighbours.
            if a.value > self.specification.largest_approach + self.path_step && i & ((1 << place.2) - 1) == 0 {
                break;
            }
        }
        Ok(ColumnNodes { reference, nodes })
    }

    fn assemble(&self) -> ContactMap {
        let (mut knots, mut stretches) = (Vec::new(), Vec::new());
        for (p, plan) in self.patches.iter().enumerate() {
            let (start, width) = (plan.start, plan.width);
            let mut patch = Patch {
                start,
                width,
                per_width: 1.0 / width,
                strips: Vec::new(),
                columns: Vec::new(),
                nodes: Vec::new(),
            };
            for (k, &level) in plan.levels.iter().enumerate() {
                let parts = 1_i32 << level.arc;
                let path_step = self.path_step / f64::from(1_u32 << level.path);
                let strip = Strip::new(patch.columns.len(), parts, width, path_step, LOWEST << level.path);
                for place in self.places_of(p, k) {
                    let Some(column) = self.columns.get(&place) else { continue };
                    let nodes =
                        densify(&column.nodes, self.path_step / f64::from(1_u32 << place.2), level.path - place.2);
                    patch.columns.push(Column {
                        reference: [column.reference[0], column.reference[1] * strip.arc_step],
                        at: patch.nodes.len(),
                        count: nodes.len(),
                    });
                    let (du, ds) = (path_step, strip.arc_step);
                    patch.nodes.extend(nodes.iter().map(|n| -> Node { [n[0], n[2] * ds, n[1] * du, n[3] * du * ds] }));
                }
                patch.strips.push(strip);
            }
            if !knots.is_empty() {
                stretches.push(Stretch::Flat(plan.before));
            }
            knots.push(start);
            knots.push(start + width * plan.levels.len() as f64);
            stretches.push(Stretch::Patch(patch));
        }
        let largest_approach = self.specification.largest_approach;
        ContactMap { knots, stretches, largest_approach, accuracy: Accuracy::default(), fingerprint: self.fingerprint }
    }

    /// Errors of one strip, at one place on two edges of each cell of nodes and one within it.
    fn errors(&self, map: &ContactMap, (p, k): (usize, usize)) -> Result<Errors, ContactError> {
        let mut errors = Errors::default();
        let level = self.patches[p].levels[k].path;
        let path_step = self.path_step / f64::from(1_u32 << level);
        let columns: Vec<Place> = self.places_of(p, k).collect();
        let mut contact = self.contact.clone();
        for (part, pair) in columns.windows(2).enumerate() {
            contact.forget();
            let [left, right] =
                [pair[0], pair[1]].map(|place| self.columns.get(&place).map_or(0.0, |c| c.reference[0]));
            for i in LOWEST << level.. {
                // Places within the cell by additive recurrence: they fill it evenly as the cells go by.
                let n = (k * 31 + part * 17) as f64 + f64::from(i) + 64.0;
                let (q, t) = ((n * 0.754_877_666 + 0.5).fract(), (n * 0.569_840_291 + 0.5).fract());
                let (q_row, t_column) = (0.3 + 0.4 * q, 0.3 + 0.4 * t);
                let mut inside = true;
                for (q, t, found) in [
                    (0.0, t_column, &mut errors.on_columns),
                    (q_row, 0.0, &mut errors.on_rows),
                    (q, t, &mut errors.within),
                ] {
                    let s = self.arc(pair[0]) + q * (self.arc(pair[1]) - self.arc(pair[0]));
                    let u = left + q * (right - left) + (f64::from(i) + t) * path_step;
                    match self.error(map, &mut contact, u, s)? {
                        Some(error) => found.push(error),
                        None => inside = false,
                    }
                }
                if !inside {
                    break;
                }
            }
        }
        Ok(errors)
    }

    /// Error of both forces relative to full scale; `None` beyond the largest approach.
    fn error(
        &self,
        map: &ContactMap,
        contact: &mut LoveContact,
        u: f64,
        s: f64,
    ) -> Result<Option<[f64; 2]>, ContactError> {
        let largest = self.specification.largest_approach;
        let full_scale = largest * largest.sqrt();
        let exact = match contact.solve(u, s) {
            Ok(exact) if exact.value <= largest => exact.forces(1.0),
            Ok(_) | Err(ContactError::OutOfRange { .. }) => return Ok(None),
            Err(error) => return Err(error),
        };
        let found = map.lookup(u, s)?.forces(1.0);
        Ok(Some([(found[0] - exact[0]) / full_scale, (found[1] - exact[1]) / full_scale]))
    }
}

/// Puts 2^`halvings` − 1 nodes on the cubic between each two.
fn densify(nodes: &[[f64; 4]], step: f64, halvings: u32) -> Vec<[f64; 4]> {
    let parts = 1_u32 << halvings;
    let mut out = Vec::with_capacity(nodes.len() << halvings);
    for pair in nodes.windows(2) {
        out.push(pair[0]);
        for part in 1..parts {
            let [weights, slopes, _] = hermite(f64::from(part) / f64::from(parts));
            let mix = |v: usize, b: &[f64; 4]| {
                combine(&[pair[0][v], pair[0][v + 1] * step, pair[1][v], pair[1][v + 1] * step], b)
            };
            out.push([mix(0, &weights), mix(0, &slopes) / step, mix(2, &weights), mix(2, &slopes) / step]);
        }
    }
    out.extend(nodes.last());
    out
}

/// Figures over all places with contact.
fn summary<'a>(checks: impl Iterator<Item = &'a Errors>) -> Accuracy {
    let mut accuracy = Accuracy::default();
    let mut squares = [0.0; 2];
    let in_contact = |error: &&[f64; 2]| error[0] != 0.0;
    for [normal, tangential] in
        checks.flat_map(|e| e.on_columns.iter().chain(&e.on_rows).chain(&e.within)).filter(in_contact)
    {
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

fn shallowest(surface: &Surface) -> f64 {
    depths(surface).fold(0.0, f64::min)
}

fn depths(surface: &Surface) -> Box<dyn Iterator<Item = f64> + '_> {
    match surface {
        Surface::Profile(profile) => Box::new(profile.points().iter().map(|&(_, depth)| depth)),
        Surface::Topography(topography) => Box::new(topography.grid().2.iter().copied()),
    }
}
