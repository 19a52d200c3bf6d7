//! What an evaluation of the equations of motion finds on its way: forces on the rings, and each contact if asked for.

use super::record::Record;
use super::shortcuts::Shortcuts;
use crate::contact::error::ContactError;
use crate::dynamics::parameters::{Cells, Defects, ElementBlock, FilmsNow, Frame, Frames, Lead, Model, SMOOTH};
use crate::numerics::lanes::row::Row;
use crate::numerics::lanes::{Each, Lanes, Lists, QUAD, WIDEST, Wide, largest_of, padded};
use crate::numerics::plane::Vector;

/// Forces and moments of the contacts on both rings, as [`Forces::rings`] says.
pub type RingForces = [f64; 10];

/// What the right-hand side found on its way. Its lists are made once.
#[derive(Debug, Default)]
pub struct Forces {
    /// Each contact, where the right-hand side was asked to keep them.
    pub contacts: Record,
    /// The elements, with what follows from the raceway that each is on.
    pub(in crate::dynamics) elements: Vec<ElementBlock>,
    /// What an uneven cage itself is ahead.
    pub(crate) cage_lead: Lead,
    /// Outer contacts that are not those of the smooth rigid raceway.
    pub(in crate::dynamics) non_smooth_outer: Vec<NonSmooth>,
    /// Inner contacts near defects.
    pub(in crate::dynamics) non_smooth_inner: Vec<NonSmooth>,
    /// What was found of the inner ones and of the outer ones.
    pub(super) non_smooth_contacts: [Vec<NonSmoothContact>; 2],
    /// Elements whose balance is looked for one by one: those of which a contact is in one of these lists.
    pub(in crate::dynamics) searched: Vec<Searched>,
    /// Number of elements.
    count: usize,
    /// The bearing's force on the inner ring along x and y, then on the outer (N); in space also its force along z and
    /// its moments about x and y (N m) on the inner ring, then on the outer, which are 0 in the plane.
    pub rings: RingForces,
    /// The frames of defects, where any contact asks for them.
    pub(in crate::dynamics) frames: Frames,
    /// The oil films.
    pub(in crate::dynamics) films: Option<FilmsNow>,
    /// Torques of contacts near defects on the bodies that have them (N m): on the inner ring, on the outer ring, each
    /// about its centre, and on elements about their own axes.
    pub(in crate::dynamics) torques: [f64; 3],
    /// Shortcuts.
    pub shortcuts: Shortcuts,
    /// Number of approaches near the defect that were asked for.
    pub defect_lookups: u64,
    /// The last contact near a defect that could not be computed, of an element whose position is a number.
    pub unsolved: Option<UnsolvedContact>,
}

/// A contact near a defect that could not be computed.
#[derive(Debug, Clone, PartialEq)]
pub struct UnsolvedContact {
    /// The element, from 0.
    pub element: usize,
    /// Its angle from the defect's centre (rad).
    pub angle: f64,
    /// Position of the outer ring's centre seen from the inner's (m).
    pub offset: [f64; 2],
    /// Why.
    pub cause: ContactError,
}

impl Clone for Forces {
    /// With the room that the lists have: a copy allocates no more in a step than the original.
    fn clone(&self) -> Self {
        Self {
            contacts: self.contacts.clone(),
            elements: self.elements.clone(),
            shortcuts: self.shortcuts.clone(),
            unsolved: self.unsolved.clone(),
            non_smooth_outer: with_its_room(&self.non_smooth_outer),
            non_smooth_inner: with_its_room(&self.non_smooth_inner),
            non_smooth_contacts: [0, 1].map(|side: usize| with_its_room(&self.non_smooth_contacts[side])),
            searched: with_its_room(&self.searched),
            ..*self
        }
    }
}

fn with_its_room<T: Copy>(list: &Vec<T>) -> Vec<T> {
    let mut copy = Vec::with_capacity(list.capacity());
    copy.extend_from_slice(list);
    copy
}

impl Forces {
    /// Room for the contacts of a model, which is less where it has no defect inside.
    pub fn of(model: &Model) -> Self {
        let mut forces = Self { shortcuts: Shortcuts::of(model), ..Self::new(model.element_count) };
        if !model.may_have_inner_defects {
            (forces.non_smooth_inner, forces.non_smooth_contacts[0]) = (Vec::new(), Vec::new());
        }
        if model.elements_in_balance() {
            forces.contacts.balanced = [(); 2].map(|()| Row::zeros(model.layout.radial_velocity));
        }
        if model.elements_in_balance() || model.space.is_some() {
            forces.searched = Vec::with_capacity(model.element_count);
        }
        if model.space.is_some() {
            forces.contacts.meridians = [(); 4].map(|()| Row::zeros(padded(model.element_count)));
        }
        forces
    }

    /// Room for `count` elements.
    pub fn new(count: usize) -> Self {
        let slots = padded(count);
        Self {
            count,
            contacts: Record::new(slots),
            elements: vec![ElementBlock::default(); slots / WIDEST],
            non_smooth_outer: Vec::with_capacity(count),
            non_smooth_inner: Vec::with_capacity(count),
            non_smooth_contacts: [(); 2].map(|()| Vec::with_capacity(count)),
            ..Self::default()
        }
    }

    /// Sorts the elements by the surfaces they are on. What follows inside kernels is for these cells.
    pub(crate) fn enter(&mut self, model: &Model, cells: &Cells) {
        let rigid = model.outer.contact.compliance == 0.0;
        self.non_smooth_outer.clear();
        self.non_smooth_inner.clear();
        for contacts in &mut self.non_smooth_contacts {
            contacts.clear();
        }
        self.torques = [0.0; 3];
        self.searched.clear();
        self.elements.copy_from_slice(&model.elements);
        if rigid && model.all_defects().all(Defects::is_smooth) {
            return;
        }
        for j in 0..model.element_count {
            let [inner, outer] = model.cells_of(cells, j);
            let block = &mut self.elements[j / WIDEST];
            if inner != [SMOOTH; 2] {
                block.inner[j % WIDEST] = 0.0;
                self.non_smooth_inner.push(NonSmooth { element: j, cells: inner });
            }
            if !rigid || outer != [SMOOTH; 2] {
                block.outer[j % WIDEST] = 0.0;
                self.non_smooth_outer.push(NonSmooth { element: j, cells: outer });
            }
            if (model.elements_in_balance() || model.space.is_some()) && (!rigid || [inner, outer] != [[SMOOTH; 2]; 2])
            {
                let block = &mut self.elements[j / WIDEST];
                (block.inner[j % WIDEST], block.outer[j % WIDEST]) = (0.0, 0.0);
                self.searched.push(Searched { element: j, cells: [inner, outer] });
            }
        }
    }

    /// Puts where elements in balance are, and how fast they move, into their slots of a state; elements with inertia
    /// have their own.
    #[inline]
    pub(crate) fn settle(&self, model: &Model, state: &mut [f64]) {
        if model.elements_in_balance() {
            let slots = model.layout.radial_velocity;
            for (to, from) in state.chunks_mut(slots.max(1)).zip(&self.contacts.balanced) {
                to.copy_from_slice(from);
            }
        }
    }

    /// Puts what [`non_smooth_contacts`](super::non_smooth_contacts) found among the contacts that are kept.
    pub(in crate::dynamics) fn record_non_smooth(&mut self) {
        let record = &mut self.contacts;
        let [inner, outer] = &self.non_smooth_contacts;
        for other in inner {
            let j = other.element;
            record.inner_approach[j] = other.approach;
            record.inner_pushing[j] = other.pushing;
            let [magnitude, radial, tangential] = other.force;
            record.inner[j] = magnitude;
            if magnitude > 0.0 {
                (record.normal_radial[j], record.normal_tangential[j]) = (radial / magnitude, tangential / magnitude);
            }
        }
        for other in outer {
            let j = other.element;
            record.outer_approach[j] = other.approach;
            record.outer_pushing[j] = other.pushing;
            [record.outer[j], record.outer_radial[j], record.outer_tangential[j]] = other.force;
        }
    }

    /// Angle (rad) by which element `j` is ahead of its position in a cage that turns evenly.
    pub(crate) fn element_lead(&self, j: usize) -> f64 {
        self.elements[j / WIDEST].lead[j % WIDEST]
    }

    /// The bearing's force on the inner ring (N).
    pub fn shaft(&self) -> Vector {
        Vector::new(self.rings[0], self.rings[1])
    }

    /// The bearing's force on the outer ring (N).
    pub fn housing(&self) -> Vector {
        Vector::new(self.rings[2], self.rings[3])
    }

    /// Torque of contacts near defects on the bodies that turn with a frame and have them (N m).
    pub fn torque_on(&self, frame: Frame) -> f64 {
        self.torques[frame as usize]
    }

    /// Notes which contacts push: 1 for those that do, −1 for the others, the inner contacts before the outer.
    pub fn note_pushing(&self, sides: &mut [f64]) {
        let lengths = self.contacts.inner_pushing.iter().chain(&*self.contacts.outer_pushing);
        for (side, &length) in sides.iter_mut().zip(lengths) {
            *side = if length > 0.0 { 1.0 } else { -1.0 };
        }
    }

    /// How far the contact that has changed most since `sides` were noted is beyond its change (m); negative while none
    /// has.
    pub fn beyond_change(&self, sides: &[f64]) -> f64 {
        let slots = self.contacts.inner_pushing.len();
        let (inner, outer) = sides.split_at(slots);
        let mut most = f64::NEG_INFINITY;
        for (sides, lengths) in [(inner, &self.contacts.inner_pushing), (outer, &self.contacts.outer_pushing)] {
            for (side, length) in sides.iter().zip(lengths.iter()).take(self.count) {
                most = most.max(-side * length);
            }
        }
        most
    }

    /// Whether any contact has changed since `sides` were noted, inside a kernel.
    #[inline(always)]
    pub(crate) fn pushing_differs_on<S: Wide>(&self, simd: S, sides: &[f64]) -> bool {
        let slots = self.contacts.inner_pushing.len();
        let (inner, outer) = sides.split_at(slots);
        let from = [inner, &self.contacts.inner_pushing, outer, &self.contacts.outer_pushing];
        let mut most = [0.0; QUAD];
        Lists { from, to: [] }.for_each(simd, slots, &BeyondChange, &mut most);
        largest_of(most) > 0.0
    }

    /// Largest approach of any contact (m), 0 if there is none, inside a kernel.
    #[inline(always)]
    pub(crate) fn largest_approach_on<S: Wide>(&self, simd: S) -> f64 {
        let (mut most, approach) = ([0.0; QUAD], [&self.contacts.inner_approach[..], &self.contacts.outer_approach]);
        Lists { from: approach, to: [] }.for_each(simd, approach[0].len(), &Largest, &mut most);
        largest_of(most)
    }
}

/// A contact that is not one of smooth rigid raceways, and where it is.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct NonSmooth {
    pub(in crate::dynamics) element: usize,
    /// Cells of the raceway and of the element's own defect.
    pub(in crate::dynamics) cells: [u32; 2],
}

/// An element whose balance is looked for alone.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Searched {
    pub(in crate::dynamics) element: usize,
    /// Cells of its inner and of its outer contact: of the raceway, and of its own defect.
    pub(in crate::dynamics) cells: [[u32; 2]; 2],
}

/// A contact that is not one of smooth rigid raceways.
#[derive(Debug, Clone, Copy)]
pub(super) struct NonSmoothContact {
    pub(in crate::dynamics) element: usize,
    pub(in crate::dynamics) approach: f64,
    pub(super) pushing: f64,
    /// Magnitude (N); then the parts on the element: of an inner contact outwards and counter-clockwise, as seen from
    /// the outer ring's centre, of an outer contact inwards and counter-clockwise.
    pub(in crate::dynamics) force: [f64; 3],
}

/// How far the contact that has changed most is beyond its change.
struct BeyondChange;

impl Each<4, 0> for BeyondChange {
    type Sum = [f64; QUAD];

    #[inline(always)]
    fn each<S: Wide>(&self, _: S, from: [Lanes<S>; 4], most: &mut [f64; QUAD]) -> [Lanes<S>; 0] {
        let [inner_side, inner, outer_side, outer] = from;
        (-(inner_side * inner)).at_least(-(outer_side * outer)).largest_to(most);
        []
    }
}

/// The largest approach.
struct Largest;

impl Each<2, 0> for Largest {
    type Sum = [f64; QUAD];

    #[inline(always)]
    fn each<S: Wide>(&self, _: S, approach: [Lanes<S>; 2], most: &mut [f64; QUAD]) -> [Lanes<S>; 0] {
        approach[0].at_least(approach[1]).largest_to(most);
        []
    }
}
