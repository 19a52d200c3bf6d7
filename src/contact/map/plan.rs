//! Where a [`ContactMap`] needs nodes, what they hold, and how far off it is between them.
//!
//! Around the flanks nodes cover every path from below the first touch to the largest approach. The map is compared
//! with the grid at two to four points in each cell of nodes; a cell in which the error is larger than asked for is cut
//! in four. That happens where a second contact begins, of the floor beside that of the edge: there the force has a
//! kink in its slope, on a line across the map.

use crate::numerics::ninth_root;
use crate::numerics::polynomials::hermite;
use crate::surface::Surface;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use super::cells::{Cells, FINEST, Key, LEVELS, LatticeIndex, Node};
use super::checks::{Check, Error, summary};
use super::lookup::{Accuracy, ContactMap, Patch, Stretch, Strip};
use super::patch_plan::{LOWEST, PatchPlan, Reference};
use super::specification::{MapSpecification, Runner};
use crate::contact::element_on_raceway::ElementOnRaceway;
use crate::contact::error::ContactError;
use crate::contact::love::{Arcs, Flat, LoveContact, check_ends, flats, reach, shallowest};

/// Coarse cells up to the largest approach.
const ROWS: f64 = 4.0;
/// The grid is prepared for so many times the largest approach: coarse cells reach above it.
pub(super) const PREPARED: f64 = 1.8;
/// The root mean square error is to be this part of the largest one.
const MEAN: f64 = 0.1;
/// Nodes or cells of one job: the next contact starts from the last one within a job.
const JOB: usize = 8;

/// A map in the making.
pub struct MapPlan {
    specification: MapSpecification,
    fingerprint: u64,
    contact: LoveContact,
    /// Copies of it that jobs have done with: the factor in one has some megabytes.
    idle: Mutex<Vec<LoveContact>>,
    /// Whether the element is a roller.
    line: bool,
    /// Whether the defect is its own mirror image about arc 0.
    symmetric: bool,
    patches: Vec<PatchPlan>,
}

/// Width (m) of a coarse cell along the raceway.
pub(super) fn strip_width(element: ElementOnRaceway, largest: f64) -> f64 {
    0.25 * element.contact_half_axes(largest)[0]
}

/// Distance (m) from the end of a flat stretch at which a contact of the largest approach is over cells of its depth
/// alone, cells being so long.
fn clear(element: ElementOnRaceway, largest: f64, cell: f64) -> f64 {
    1.2 * element.contact_half_axes(largest)[0] + 3.0 * cell
}

/// The same from the end of a floor at this depth (m) below the highest raceway, which must also stay below the element
/// that presses on the floor.
pub(super) fn floor_margin(element: ElementOnRaceway, largest: f64, cell: f64, depth: f64) -> f64 {
    clear(element, largest, cell).max(reach(element, depth + largest) + 2.0 * cell)
}

/// The grid solver, and where it is needed.
#[derive(Debug)]
pub struct Unmapped {
    pub(in crate::contact) contact: LoveContact,
    /// Ascending arcs (m) at which cells meet.
    pub(in crate::contact) knots: Vec<f64>,
    /// Depth (m) of each cell that is flat.
    pub(in crate::contact) flats: Vec<Option<f64>>,
}

impl MapPlan {
    /// Plans the coarsest nodes.
    ///
    /// # Errors
    /// [`ContactError::BadInput`] for impossible inputs, [`ContactError::EndsMeet`] for a defect around the whole
    /// raceway.
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
        let MapSpecification { resolution, edges, .. } = specification;
        let prepared = PREPARED * specification.largest_approach;
        let contact = LoveContact::with_edges(element, surface, prepared, resolution, edges)?;
        let fingerprint = ContactMap::fingerprint_of(surface, element, specification);
        let line = element.length().is_some();
        let idle = Mutex::default();
        let symmetric = surface.is_symmetric();
        let mut plan = Self { specification, fingerprint, contact, idle, line, symmetric, patches: Vec::new() };
        plan.patches = plan.patches_for(surface, element);
        if let (Some(first), Some(last)) = (plan.patches.first(), plan.patches.last()) {
            let felt = Arcs { first: first.start, last: last.end() };
            let why = "where contacts of the largest force (contact.largest_force_n) reach it";
            check_ends(Arcs::of(surface), felt, element.raceway_radius, why)?;
        }
        Ok(plan)
    }

    fn patches_for(&self, surface: &Surface, element: ElementOnRaceway) -> Vec<PatchPlan> {
        let largest = self.specification.largest_approach;
        let cell = self.contact.grid().cell()[0];
        let strip_width = strip_width(element, largest);
        let raised = -shallowest(surface);
        let mut free = Vec::new();
        for Flat { start, end, depth } in flats(surface) {
            let margin = if depth <= -raised {
                clear(element, largest, cell).max(self.contact.soft_reach())
            } else {
                floor_margin(element, largest, cell, depth + raised)
            };
            if end - start > 2.0 * margin + 2.0 * strip_width {
                free.push(Flat { start: start + margin, end: end - margin, depth });
            }
        }
        free.windows(2)
            .map(|pair| {
                let (start, end) = (pair[0].end, pair[1].start);
                let strips = ((end - start) / strip_width).ceil().max(1.0);
                let size = [(end - start) / strips, largest / ROWS];
                PatchPlan {
                    start,
                    before: pair[0].depth,
                    after: Some(pair[1].depth),
                    references: Vec::new(),
                    cells: Cells::new(size, vec![0; strips as usize]),
                }
            })
            .collect()
    }

    /// The grid solver without nodes: what law `love` solves inside the step.
    pub fn into_love(self) -> Unmapped {
        let (mut knots, mut flats) = (Vec::new(), Vec::new());
        for (index, patch) in self.patches.iter().enumerate() {
            if index > 0 {
                flats.push(Some(patch.before));
            }
            knots.push(patch.start);
            knots.push(patch.end());
            flats.push(None);
        }
        Unmapped { contact: self.contact, knots, flats }
    }

    /// Computes nodes and the errors between them, and cuts cells until the accuracy is met or cells are at their
    /// smallest. Of a symmetric defect only the first half is computed.
    ///
    /// # Errors
    /// When a contact cannot be solved.
    pub fn build(mut self, runner: &mut impl Runner) -> Result<ContactMap, ContactError> {
        if !self.symmetric {
            let accuracy = self.refine(runner)?;
            return Ok(ContactMap { accuracy, ..self.map() });
        }
        // Of an odd number of patches the middle one lies across arc 0.
        let whole = self.patches.len();
        let middle = (!whole.is_multiple_of(2)).then_some(whole / 2);
        // The others are mirror images of the first ones, in reverse; the depth of the flat before each is kept.
        let beyond: Vec<f64> = self.patches.drain(whole.div_ceil(2)..).map(|patch| patch.before).collect();
        if let Some(middle) = middle {
            self.patches[middle] = self.patches[middle].halved();
        }
        let accuracy = self.refine(runner)?;
        if let Some(middle) = middle {
            self.patches[middle] = self.patches[middle].with_mirror_image();
        }
        for (k, before) in beyond.into_iter().enumerate() {
            self.patches.push(self.patches[whole / 2 - 1 - k].mirrored(before));
        }
        Ok(ContactMap { accuracy, ..self.map() })
    }

    /// Cuts cells until they are accurate enough; returns how accurate they are.
    fn refine(&mut self, runner: &mut impl Runner) -> Result<Accuracy, ContactError> {
        self.lay_out(runner)?;
        let mut errors: BTreeMap<(usize, Key), Vec<Error>> = BTreeMap::new();
        // Where a neighbour is cut, a cell gets another cubic, and its checks stay.
        let mut checks: BTreeMap<(usize, Key), Vec<Check>> = BTreeMap::new();
        loop {
            self.solve_missing(runner)?;
            let mut stale = Vec::new();
            for (p, patch) in self.patches.iter_mut().enumerate() {
                stale.extend(patch.cells.assemble().into_iter().map(|key| (p, key)));
            }
            let map = self.map();
            let fresh: Vec<(usize, Key)> = stale.iter().copied().filter(|cell| !checks.contains_key(cell)).collect();
            let jobs: Vec<&[(usize, Key)]> = fresh.chunks(JOB).collect();
            let found = runner.run(jobs.len(), &|job| self.checks(jobs[job]))?;
            checks.extend(fresh.iter().copied().zip(found.into_iter().flatten()));
            for cell in stale {
                let found = checks.get(&cell).map_or(&[][..], Vec::as_slice);
                let largest = self.specification.largest_approach;
                let found = found.iter().map(|check| check.error(&map, largest, &|approach| self.grown(approach)));
                let found = found.collect::<Result<Vec<_>, _>>()?;
                errors.insert(cell, found.into_iter().flatten().collect());
            }
            let is_leaf = |(p, key): &(usize, Key)| self.patches[*p].cells.leaves.contains(key);
            errors.retain(|cell, _| is_leaf(cell));
            checks.retain(|cell, _| is_leaf(cell));
            // Better than asked for: the checks do not hit the worst point, least of all in large cells.
            let limit = |key: &Key| if key.level < 2 { 0.5 } else { 0.8 } * self.specification.accuracy;
            let far = |found: &[Error], limit: f64| found.iter().flatten().any(|e| e.abs() > limit);
            let mut poor: Vec<(usize, Key)> = errors
                .iter()
                .filter(|((_, key), found)| key.level < LEVELS && far(found, limit(key)))
                .map(|(&cell, _)| cell)
                .collect();
            let accuracy = summary(&errors);
            let mean = MEAN * self.specification.accuracy;
            if poor.is_empty() && accuracy.rms_normal.max(accuracy.rms_tangential) > 0.85 * mean {
                // Cells that hold more than their share of the mean square, by their area.
                let share = |key: &Key| 1.5 * mean * f64::from(1_u32 << key.level);
                poor = errors
                    .iter()
                    .filter(|((_, key), found)| key.level < LEVELS && far(found, share(key)))
                    .map(|(&cell, _)| cell)
                    .collect();
            }
            if poor.is_empty() {
                return Ok(accuracy);
            }
            for (p, key) in poor {
                self.patches[p].cells.divide(key);
            }
        }
    }

    /// Reference paths and coarse cells, as many above each other as the largest approach needs.
    fn lay_out(&mut self, runner: &mut impl Runner) -> Result<(), ContactError> {
        for p in 0..self.patches.len() {
            let patch = &self.patches[p];
            let (strips, [width, _]) = (patch.cells.rows.len(), patch.cells.size);
            let ends: Vec<[f64; 2]> = (0..=strips)
                .map(|k| match patch.flat_of(k, strips) {
                    Some(depth) => [depth, 0.0],
                    // Where the mirror image begins.
                    None if k == strips => [self.contact.first_touch(patch.end()), 0.0],
                    None => {
                        let (s, h) = (patch.start + k as f64 * width, self.contact.grid().cell()[0]);
                        let touch = |s: f64| self.contact.first_touch(s);
                        [touch(s), (touch(s + h) - touch(s - h)) / (2.0 * h)]
                    }
                })
                .collect();
            self.patches[p].references =
                ends.windows(2).map(|e| hermite::cubic([e[0][0], e[0][1] * width, e[1][0], e[1][1] * width])).collect();
            let columns = runner.run(strips + 1, &|k| self.column(&self.patches[p], k))?;
            let rows = columns.windows(2).map(|pair| pair[0].len().max(pair[1].len()) - 1).collect();
            let mut cells = Cells::new(self.patches[p].cells.size, rows);
            for (k, column) in columns.into_iter().enumerate() {
                cells.nodes.extend((0..).map(|j| LatticeIndex { i: k * FINEST, j: j * FINEST }).zip(column));
            }
            self.patches[p].cells = cells;
        }
        Ok(())
    }

    /// Coarse nodes above the coarse lattice line `k`, up to the largest approach.
    fn column(&self, patch: &PatchPlan, k: usize) -> Result<Vec<Node>, ContactError> {
        self.with_contact(|contact| {
            let mut nodes = Vec::new();
            loop {
                let node = self.node(patch, contact, LatticeIndex { i: k * FINEST, j: nodes.len() * FINEST })?;
                nodes.push(node);
                if node[0] >= self.specification.largest_approach {
                    return Ok(nodes);
                }
            }
        })
    }

    /// Does something with a contact that has forgotten its last one.
    fn with_contact<T>(&self, act: impl FnOnce(&mut LoveContact) -> T) -> T {
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let known = idle().pop();
        let mut contact = known.unwrap_or_else(|| self.contact.clone());
        contact.forget();
        let done = act(&mut contact);
        idle().push(contact);
        done
    }

    fn node(&self, patch: &PatchPlan, contact: &mut LoveContact, at: LatticeIndex) -> Result<Node, ContactError> {
        let height = patch.height(at.j as f64);
        if patch.flat(at.i).is_some() {
            return Ok([height, 0.0, 1.0, 0.0]);
        }
        let Reference { arc, path, slope } = patch.reference(at.i);
        let a = contact.continued_along_path(path + height, arc)?;
        Ok([a.value, a.ds + a.du * slope, a.du, a.dus + a.duu * slope])
    }

    fn solve_missing(&mut self, runner: &mut impl Runner) -> Result<(), ContactError> {
        let missing: Vec<(usize, LatticeIndex)> = (0..self.patches.len())
            .flat_map(|p| self.patches[p].cells.missing().into_iter().map(move |index| (p, index)))
            .collect();
        let jobs: Vec<&[(usize, LatticeIndex)]> = missing.chunks(JOB).collect();
        let solved = runner.run(jobs.len(), &|job| {
            let node = |contact: &mut LoveContact, (p, index): (usize, LatticeIndex)| {
                self.node(&self.patches[p], contact, index)
            };
            self.with_contact(|contact| jobs[job].iter().map(|&one| node(contact, one)).collect())
        })?;
        let solved: Vec<Node> = solved.into_iter().flat_map(|nodes: Vec<Node>| nodes).collect();
        for ((p, index), node) in missing.into_iter().zip(solved) {
            self.patches[p].cells.nodes.insert(index, node);
        }
        Ok(())
    }

    fn map(&self) -> ContactMap {
        let (mut knots, mut stretches) = (Vec::new(), Vec::new());
        for plan in &self.patches {
            let mut first = 0;
            let strips = plan.references.iter().zip(&plan.cells.rows).map(|(&reference, &rows)| {
                let strip = Strip { reference, first, rows: rows as f64 };
                first += rows;
                strip
            });
            let strips = strips.collect();
            let (cells, leaves) = plan.cells.stored();
            let patch = Patch::new(plan.start, plan.cells.size, LOWEST, strips, cells, leaves);
            if !knots.is_empty() {
                stretches.push(Stretch::Flat(plan.before));
            }
            knots.push(plan.start);
            knots.push(plan.end());
            stretches.push(Stretch::Patch(patch));
        }
        ContactMap {
            knots,
            stretches,
            nodes: self.patches.iter().map(|patch| patch.cells.node_count()).sum(),
            largest_approach: self.specification.largest_approach,
            accuracy: Accuracy::default(),
            fingerprint: self.fingerprint,
        }
    }

    /// Checks of some cells: at four points of each large one and two of each small one, except those without contact
    /// and beyond the largest approach.
    fn checks(&self, cells: &[(usize, Key)]) -> Result<Vec<Vec<Check>>, ContactError> {
        let of_cell = |contact: &mut LoveContact, (p, Key { level, i, j }): (usize, Key)| {
            let patch = &self.patches[p];
            let side = (FINEST >> level) as f64;
            let mut found = Vec::new();
            // Points by additive recurrence: they fill the cells evenly as these go by.
            let n = (i * 31 + j * 17) as f64;
            let (q, t) = ((n * 0.754_877_666).fract(), (n * 0.569_840_291).fract());
            let shifts = [(0.0, 0.0), (0.5, 0.5), (0.0, 0.5), (0.5, 0.0)];
            for (dq, dt) in &shifts[..if level < 2 { 4 } else { 2 }] {
                let (q, t) = ((q + dq).fract(), (t + dt).fract());
                let (along, up) = ((i as f64 + q) * side, (j as f64 + t) * side);
                let s = patch.start + along / FINEST as f64 * patch.cells.size[0];
                let u = patch.reference_at(s) + patch.height(up);
                match contact.solve(u, s) {
                    Ok(exact) if exact.value <= self.specification.largest_approach => {
                        found.push(Check { u, s, exact })
                    }
                    Ok(_) | Err(ContactError::OutOfRange { .. }) => {}
                    Err(error) => return Err(error),
                }
            }
            Ok(found)
        };
        self.with_contact(|contact| cells.iter().map(|&cell| of_cell(contact, cell)).collect())
    }
}

impl MapPlan {
    /// The smooth contact's force at an approach (m), except for a factor; of a roller as if it were straight.
    fn grown(&self, approach: f64) -> f64 {
        approach * if self.line { ninth_root(approach) } else { approach.sqrt() }
    }
}
