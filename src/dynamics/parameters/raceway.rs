//! A raceway as an element meets it, and the defects of a body: where they are, and how an element goes over them.
//!
//! A body that has defects turns with its frame: the inner ring, the outer ring, or an element about its own axis.
//! Around a defect the surface is cut at knots into cells, inside each of which the approach is smooth; a body's cells
//! are counted through all of its defects. How the direction in which two bodies touch, frames, knots and cells belong
//! together stands here and nowhere else. Angles are in radians, counter-clockwise; those from a defect's centre within
//! half a turn.

use super::excitation::Frame;
use crate::contact::error::ContactError;
use crate::contact::law::CompliantContact;
use crate::contact::near_defect::{Approach, LoveSolvers, NearDefect};
use crate::numerics::number::Scalar;
use crate::numerics::wrap;
use crate::surface::Waves;
use std::f64::consts::TAU;

/// Cell of a contact on smooth surfaces, away from any defect.
pub const SMOOTH: u32 = u32::MAX;

/// What stands for [`SMOOTH`] where a contact is computed and the body has waves: no contact on it is that of round
/// surfaces.
const WAVY: u32 = u32::MAX - 1;

/// A raceway.
#[derive(Debug, Clone)]
pub struct Raceway {
    /// Contact on its smooth part, which may yield.
    pub contact: CompliantContact,
    /// Its defects.
    pub defects: Defects,
}

/// A rolling element with a defect or waves, which meets both raceways in turn.
#[derive(Debug, Clone)]
pub struct DefectiveElement {
    /// Number of the element, from 0.
    pub element: usize,
    /// Its defects in contact with the inner and with the outer raceway.
    pub defects: [Defects; 2],
    /// Angle of the centre of the first of them in contact with the outer raceway (rad), from which its spin is
    /// counted.
    pub mark: f64,
}

/// The defects of one body, as one contact meets them; no two of them are under one contact.
#[derive(Debug, Clone)]
pub struct Defects {
    defects: Vec<SurfaceDefect>,
    /// Waves around the body; `None` of a round one.
    waves: Option<Box<Waves>>,
    /// What they turn with.
    pub frame: Frame,
}

/// The surface around a defect, and where on its body it is to be.
#[derive(Debug, Clone)]
pub struct Centred {
    /// The surface under the scene's contact law.
    pub surface: NearDefect,
    /// Angle of the defect's centre (rad) in the body's frame.
    pub centre: f64,
}

/// The surface around a defect on its body, among the others there.
#[derive(Debug, Clone)]
pub struct SurfaceDefect {
    /// The surface under the scene's contact law.
    pub surface: NearDefect,
    /// Angle of the defect's centre (rad) in the body's frame.
    pub centre: f64,
    /// Number of its first cell.
    first: u32,
}

/// The next knot on the way of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ahead {
    /// Angle to it (rad); by rounding it may be a little below 0.
    pub angle: f64,
    /// The cell beyond it.
    pub beyond: u32,
}

/// Cells in which all contacts are.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Cells {
    /// Of the outer raceway, for each element.
    pub outer: Vec<u32>,
    /// Of the inner raceway, for each element.
    pub inner: Vec<u32>,
    /// Of each defective element, in contact with the inner and with the outer raceway.
    pub own: Vec<[u32; 2]>,
}

impl Cells {
    /// All contacts of `count` elements, `own` of them defective, on smooth surfaces.
    pub fn smooth(count: usize, own: usize) -> Self {
        Self { outer: vec![SMOOTH; count], inner: vec![SMOOTH; count], own: vec![[SMOOTH; 2]; own] }
    }

    /// Each of them, in one fixed order.
    pub fn iter(&self) -> impl Iterator<Item = &u32> {
        self.outer.iter().chain(&self.inner).chain(self.own.as_flattened())
    }

    /// As [`iter`](Self::iter).
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut u32> {
        self.outer.iter_mut().chain(&mut self.inner).chain(self.own.as_flattened_mut())
    }

    /// Copies the cells of another state of the same model; allocates nothing.
    pub fn copy_from(&mut self, other: &Self) {
        self.outer.copy_from_slice(&other.outer);
        self.inner.copy_from_slice(&other.inner);
        self.own.copy_from_slice(&other.own);
    }
}

impl Defects {
    /// Defects of a body that turns with `frame`.
    pub fn new(frame: Frame, surfaces: impl IntoIterator<Item = Centred>) -> Self {
        let mut defects = Self { defects: Vec::new(), waves: None, frame };
        surfaces.into_iter().for_each(|one| defects.add(one));
        defects
    }

    /// One more.
    pub fn add(&mut self, Centred { surface, centre }: Centred) {
        let first = self.defects.last().map_or(0, |last| last.first + last.cell_count());
        self.defects.push(SurfaceDefect { surface, centre, first });
    }

    /// Gives the body waves.
    pub(super) fn set_waves(&mut self, waves: Option<Waves>) {
        self.waves = waves.map(Box::new);
    }

    /// Whether the body is round and without defects.
    pub fn is_smooth(&self) -> bool {
        self.is_empty() && self.waves.is_none()
    }

    /// A cell as contacts are computed with it.
    pub(in crate::dynamics) fn met(&self, cell: u32) -> u32 {
        if cell == SMOOTH && self.waves.is_some() { WAVY } else { cell }
    }

    /// Whether there is no defect.
    pub fn is_empty(&self) -> bool {
        self.defects.is_empty()
    }

    /// Each of them.
    pub fn iter(&self) -> impl Iterator<Item = &SurfaceDefect> {
        self.defects.iter()
    }

    /// Number of knots of all of them.
    pub fn knot_count(&self) -> usize {
        self.defects.iter().map(|defect| defect.knots().len()).sum()
    }

    /// Whether there is such a cell.
    pub fn has_cell(&self, cell: u32) -> bool {
        cell == SMOOTH || self.defects.iter().any(|defect| defect.holds(cell))
    }

    /// Cell at a direction (rad) in the body's frame.
    pub fn cell_at(&self, direction: f64) -> u32 {
        self.defects
            .iter()
            .map(|defect| defect.cell_at(defect.angle(direction)))
            .find(|&c| c != SMOOTH)
            .unwrap_or(SMOOTH)
    }

    /// The knot that a contact in `cell` at a direction (rad) in the body's frame meets next, counter-clockwise if
    /// `forward`. `None` without a defect.
    pub fn ahead(&self, cell: u32, direction: f64, forward: bool) -> Option<Ahead> {
        if cell != SMOOTH {
            let defect = self.defects.iter().find(|defect| defect.holds(cell))?;
            return Some(defect.ahead(cell, defect.angle(direction), forward));
        }
        let ahead = self.defects.iter().map(|defect| defect.ahead(SMOOTH, defect.angle(direction), forward));
        ahead.reduce(|near, other| if other.angle < near.angle { other } else { near })
    }

    /// Angle (rad) by which a direction in the body's frame is within `cell`, to the nearer of its ends; negative
    /// outside it. Infinite without a defect.
    pub fn within(&self, cell: u32, direction: f64) -> f64 {
        let holding = |defect: &&SurfaceDefect| cell == SMOOTH || defect.holds(cell);
        let defects = self.defects.iter().filter(holding);
        defects.map(|defect| defect.within(cell, defect.angle(direction))).fold(f64::INFINITY, f64::min)
    }

    /// Approach in `cell`, which is not the smooth one of a round body, at the smooth approach `u` (m), a `direction`
    /// (rad) in the body's frame and a `distance` (m) of the element from the ring's centre; `curved`, `solvers`: see
    /// [`NearDefect::approach`].
    #[inline(always)]
    pub fn approach<T: Scalar>(
        &self,
        cell: u32,
        u: T,
        direction: T,
        distance: T,
        curved: bool,
        solvers: &mut LoveSolvers,
    ) -> Result<Approach<T>, ContactError> {
        match &self.waves {
            None => self.over_defect(cell, u, direction, distance, curved, solvers),
            Some(waves) => self.over_waves(waves, cell, u, direction, distance, curved, solvers),
        }
    }

    /// As [`Self::approach`], of a body without waves.
    #[inline(always)]
    fn over_defect<T: Scalar>(
        &self,
        cell: u32,
        u: T,
        direction: T,
        distance: T,
        curved: bool,
        solvers: &mut LoveSolvers,
    ) -> Result<Approach<T>, ContactError> {
        let Some(defect) = self.holding(cell) else { return Ok(Approach::smooth(u)) };
        let angle = direction.moved_to(defect.angle(direction.value()));
        defect.surface.approach((cell - defect.first) as usize, u, angle, distance, curved, solvers)
    }

    /// As [`Self::approach`], of a body with waves: these change the approach as a clearance does, near a defect too.
    #[inline(never)]
    #[allow(clippy::too_many_arguments)]
    fn over_waves<T: Scalar>(
        &self,
        waves: &Waves,
        cell: u32,
        u: T,
        direction: T,
        distance: T,
        curved: bool,
        solvers: &mut LoveSolvers,
    ) -> Result<Approach<T>, ContactError> {
        let [height, slope] = waves.height(direction);
        let u = u + height;
        let found = match cell {
            SMOOTH | WAVY => Approach::smooth(u),
            _ => self.over_defect(cell, u, direction, distance, curved, solvers)?,
        };
        Ok(found.over_wave(slope, distance))
    }

    /// As [`Self::approach`] at the place `across` (m) the groove, with ∂Δ/∂across.
    pub fn approach_across<T: Scalar>(
        &self,
        cell: u32,
        [u, across]: [T; 2],
        direction: T,
        distance: T,
        curved: bool,
        solvers: &mut LoveSolvers,
    ) -> Result<(Approach<T>, T), ContactError> {
        let Some(defect) = self.holding(cell) else { return Ok((Approach::smooth(u), T::from(0.0))) };
        let [height, slope] = self.waves.as_ref().map_or([T::from(0.0); 2], |waves| waves.height(direction));
        let (angle, of_defect) = (direction.moved_to(defect.angle(direction.value())), (cell - defect.first) as usize);
        let at = ([u + height, across], (angle, distance));
        let (found, by_across) = defect.surface.approach_across(of_defect, at.0, at.1, curved, solvers)?;
        Ok((found.over_wave(slope, distance), by_across))
    }

    /// The surface around the defect of a cell, if it varies across the groove.
    #[inline]
    pub fn varying_across(&self, cell: u32) -> Option<&NearDefect> {
        let surfaces = self.defects.iter().filter(|defect| defect.holds(cell)).map(|defect| &defect.surface);
        surfaces.into_iter().find(|surface| surface.varies_across())
    }

    /// The defect that a cell belongs to.
    #[inline(always)]
    fn holding(&self, cell: u32) -> Option<&SurfaceDefect> {
        match &self.defects[..] {
            [one] => Some(one),
            several => several.iter().find(|defect| defect.holds(cell)),
        }
    }

    /// Angle (rad) of a direction in the body's frame from the centre of the nearest defect, within half a turn; from
    /// the frame's own axis without one.
    pub fn angle(&self, direction: f64) -> f64 {
        let angles = self.defects.iter().map(|defect| defect.angle(direction));
        let nearest = angles.reduce(|near, other| if other.abs() < near.abs() { other } else { near });
        nearest.unwrap_or_else(|| wrap(direction))
    }
}

impl SurfaceDefect {
    /// Angle from the centre of a direction (rad) in the body's frame.
    #[inline]
    pub fn angle(&self, direction: f64) -> f64 {
        wrap(direction - self.centre)
    }

    /// Ends of the cells, ascending.
    pub fn knots(&self) -> &[f64] {
        self.surface.knots()
    }

    fn cell_count(&self) -> u32 {
        self.knots().len() as u32 - 1
    }

    fn holds(&self, cell: u32) -> bool {
        cell >= self.first && cell - self.first < self.cell_count()
    }

    /// Cell at an angle.
    fn cell_at(&self, angle: f64) -> u32 {
        let knots = self.knots();
        match knots.partition_point(|&k| k <= angle) {
            0 => SMOOTH,
            above if above == knots.len() => SMOOTH,
            above => self.first + (above - 1) as u32,
        }
    }

    /// Angle by which `angle` is within `cell`, one of this defect's or smooth; negative outside it.
    fn within(&self, cell: u32, angle: f64) -> f64 {
        let knots = self.knots();
        let last = knots.len() - 1;
        if cell != SMOOTH {
            let here = (cell - self.first) as usize;
            return (angle - knots[here]).min(knots[here + 1] - angle);
        }
        let inside = (angle - knots[0]).min(knots[last] - angle);
        // Around the other side the way to an end may be the shorter one.
        if inside > 0.0 { -inside } else { around(knots[0] - angle).min(around(angle - knots[last])) }
    }

    /// The knot that a contact in `cell`, one of this defect's or smooth, at `angle` meets next.
    fn ahead(&self, cell: u32, angle: f64, forward: bool) -> Ahead {
        let knots = self.knots();
        let last = knots.len() - 1;
        let (angle, beyond) = match (cell == SMOOTH, forward) {
            (true, true) => (around(knots[0] - angle), self.first),
            (true, false) => (around(angle - knots[last]), self.first + last as u32 - 1),
            (false, true) => {
                let next = cell - self.first + 1;
                (knots[next as usize] - angle, if next as usize == last { SMOOTH } else { self.first + next })
            }
            (false, false) => {
                let here = cell - self.first;
                (angle - knots[here as usize], if here == 0 { SMOOTH } else { cell - 1 })
            }
        };
        Ahead { angle, beyond }
    }
}

/// An angle (rad) brought into [0, 2π); one that falls short of 0 by rounding is 0.
fn around(angle: f64) -> f64 {
    let within = angle.rem_euclid(TAU);
    if within > TAU - 1e-9 { 0.0 } else { within }
}
