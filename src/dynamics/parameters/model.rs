//! The parameters of the equations of motion, worked out once from a scene.

use super::element_block::{ElementBlock, OwnElement, blocks};
use super::excitation::{Excitation, Frame, WholeAngle};
use super::film::{Films, FilmsNow};
use super::irregularity::{Irregularity, Lead, LeadPieces};
use super::kinematics::{CageState, FramedKinematics};
use super::layout::Layout;
use super::raceway::{Cells, DefectiveElement, Defects, Raceway};
use super::spatial::Space;
use super::supports::{SensorModes, Supports};
use crate::contact::law::{CompliantContact, smooth_laws};
use crate::contact::near_defect::{LoveSolvers, NearDefect};
use crate::geometry::kinematics::Ratios;
use crate::numerics::lanes::WIDEST;
use crate::numerics::plane::{Vector, turned_by};
use crate::numerics::sin_cos;
use crate::scene::{Damping, ElementInertia, Ring, Scene, WavyBody};
use crate::surface::Waves;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Parameters of the equations of motion. What an instant or a solution needs besides is with those who ask.
#[derive(Debug, Clone)]
pub struct Model {
    /// Number of elements Z.
    pub element_count: usize,
    /// Mass of a nominal element (kg).
    pub element_mass: f64,
    /// Radius of a nominal element (m).
    pub element_radius: f64,
    /// R_o − r (m), the distance ρ of a nominal element that touches the smooth outer raceway.
    pub outer_centre_radius: f64,
    /// Radial clearance G_r (m) without oil films, which take some of it ([`Self::clearance`]).
    pub radial_clearance: f64,
    /// The inner raceway.
    pub inner: Raceway,
    /// The outer raceway.
    pub outer: Raceway,
    /// Elements with defects or waves.
    pub defective: Vec<DefectiveElement>,
    /// Gravity on the elements (m/s²).
    pub gravity: Vector,
    /// The inner ring.
    pub shaft: Ring,
    /// The outer ring.
    pub housing: Ring,
    /// What holds rings and sensor.
    pub supports: Supports,
    /// What lies between the outer ring and the sensors.
    pub sensor_modes: SensorModes,
    /// Speeds of cage and elements per speed of the rings.
    pub ratios: Ratios,
    /// Layout of the state vector.
    pub layout: Layout,
    /// Whether the scene has a defect or waves that contacts with the inner raceway meet, be they computed yet or not.
    pub may_have_inner_defects: bool,
    /// Angle of each element ahead of the cage (rad).
    offsets: Vec<f64>,
    /// How elements and cage run ahead and lag behind; `None` where each keeps its angle ahead of a cage that turns
    /// evenly.
    pub(super) irregularity: Option<Box<Irregularity>>,
    /// Oil films; `None` for dry contacts.
    pub films: Option<Box<Films>>,
    /// The contacts with the raceways with their damping, of elements that are in balance without it at every instant;
    /// `None` for elements with inertia, whose contacts are damped themselves.
    pub(in crate::dynamics) dampers: Option<Box<[CompliantContact; 2]>>,
    /// What rings and balls have beyond the plane; `None` where rings stay in it.
    pub space: Option<Box<Space>>,
    /// Whether any contact asks for the frames of defects: all but those of an outer ring that does not turn.
    pub has_frames: bool,
    /// What differs from element to element, eight at a time.
    pub(in crate::dynamics) elements: Arc<[ElementBlock]>,
    /// Each element by itself; none of a bearing of equal ones.
    pub(in crate::dynamics) own: Box<[OwnElement]>,
}

/// It is parameters and nothing else, so that one serves all that runs in a process.
const _: fn() = || {
    fn shared<T: Send + Sync>() {}
    shared::<Model>();
};

impl Model {
    /// Works the parameters out. `defects` are those of the inner and of the outer raceway, under the scene's contact
    /// law, and of `defective` elements.
    pub fn new(scene: &Scene, [inner, outer]: [Defects; 2], defective: Vec<DefectiveElement>) -> Self {
        let bearing = &scene.bearing;
        let in_balance = bearing.element_inertia == ElementInertia::None;
        let damped = smooth_laws(bearing, scene.contact.damping);
        let dampers = in_balance.then(|| {
            let [inner, outer] = damped.clone();
            let compliance = bearing.outer_compliance;
            Box::new([CompliantContact { law: inner, compliance: 0.0 }, CompliantContact { law: outer, compliance }])
        });
        let [inner_law, outer_law] = if in_balance { smooth_laws(bearing, Damping::HuntCrossley(0.0)) } else { damped };
        let stiffness = [inner_law.stiffness, outer_law.stiffness];
        let contact = |law, compliance| CompliantContact { law, compliance };
        let (inside, outside) = (contact(inner_law, 0.0), contact(outer_law, bearing.outer_compliance));
        let own = OwnElement::all(bearing, [&inside, &outside], dampers.as_deref());
        let element_radius = bearing.element_radius();
        let (turns, layout) = (scene.turns(), Layout::new(scene));
        let count = bearing.element_count;
        let mut offsets: Vec<f64> = (0..count).map(|j| j as f64 * TAU / count as f64).collect();
        if let Some(cage) = &scene.cage.irregularity {
            offsets.iter_mut().zip(&cage.offsets).for_each(|(offset, by)| *offset += by);
        }
        let irregularity = scene.cage.irregularity.as_ref();
        let irregularity =
            irregularity.and_then(|cage| Irregularity::new(cage, count, scene.cage.initial_angle)).map(Box::new);
        let mut model = Self {
            element_count: bearing.element_count,
            element_mass: bearing.mass_of_element(),
            element_radius,
            outer_centre_radius: bearing.outer_raceway_radius() - element_radius,
            radial_clearance: bearing.radial_clearance,
            inner: Raceway { contact: inside, defects: inner },
            outer: Raceway { contact: outside, defects: outer },
            defective,
            gravity: scene.gravity.into(),
            shaft: scene.shaft,
            housing: scene.housing,
            supports: Supports::new(scene),
            sensor_modes: SensorModes::new(scene, layout.sensors),
            ratios: Ratios::new(bearing, scene.cage.slip, scene.cage.spin_slip),
            layout,
            may_have_inner_defects: scene.has_defect_inside() || scene.is_wavy_inside(),
            has_frames: false,
            elements: blocks(&offsets, bearing.mass_of_element(), stiffness, &own).into(),
            own,
            offsets,
            irregularity,
            films: Films::of(scene).map(Box::new),
            dampers,
            space: Space::of(scene),
        };
        model.put_waves(scene);
        model.has_frames = turns && !model.all_defects().all(Defects::is_smooth);
        model
    }

    /// Puts the waves of the scene's bodies where contacts meet them.
    fn put_waves(&mut self, scene: &Scene) {
        self.inner.defects.set_waves(Waves::of(scene, WavyBody::Inner, 0.0));
        self.outer.defects.set_waves(Waves::of(scene, WavyBody::Outer, 0.0));
        let start = WholeAngle::in_first_turn(scene.cage.initial_angle);
        for element in 0..self.element_count {
            // At the start an element's angle 0 faces the outer raceway, and its other side the inner one.
            let facing = self.element_angle(element, start);
            let waves = [facing - PI, facing].map(|zero| Waves::of(scene, WavyBody::Element(element), zero));
            if waves[0].is_none() {
                continue;
            }
            let known = self.defective.iter().position(|own| own.element == element);
            let at = known.unwrap_or(self.defective.len());
            if known.is_none() {
                let defects = [(); 2].map(|()| Defects::new(Frame::Spin, []));
                self.defective.push(DefectiveElement { element, defects, mark: facing });
            }
            self.defective[at].defects.iter_mut().zip(waves).for_each(|(defects, waves)| defects.set_waves(waves));
        }
    }

    /// The scene's model without its defects.
    pub fn smooth(scene: &Scene) -> Self {
        Self::new(scene, [Frame::Shaft, Frame::Housing].map(|frame| Defects::new(frame, [])), Vec::new())
    }

    /// Where contacts of law `love` are solved, with the room that they need.
    pub fn love_solvers(&self) -> LoveSolvers {
        LoveSolvers::new(self.all_defects().flat_map(Defects::iter).map(|defect| &defect.surface))
    }

    /// The defects of all bodies.
    pub fn all_defects(&self) -> impl Iterator<Item = &Defects> {
        [&self.inner.defects, &self.outer.defects]
            .into_iter()
            .chain(self.defective.iter().flat_map(|element| &element.defects))
    }

    /// Whether contacts near any defect are solved on grids inside the step.
    pub fn solves_grids(&self) -> bool {
        self.all_defects().flat_map(Defects::iter).any(|defect| defect.surface.solves_grids())
    }

    /// Whether elements roll over all defects as rigid ones, law `hertz`.
    pub fn rolls_rigidly(&self) -> bool {
        self.all_defects().flat_map(Defects::iter).all(|defect| matches!(defect.surface, NearDefect::Hertz(_)))
    }

    /// Whether the model has all of these cells.
    pub fn has_cells(&self, cells: &Cells) -> bool {
        let own = self.defective.iter().zip(&cells.own);
        cells.inner.iter().all(|&cell| self.inner.defects.has_cell(cell))
            && cells.outer.iter().all(|&cell| self.outer.defects.has_cell(cell))
            && own.into_iter().all(|(own, cells)| own.defects.iter().zip(cells).all(|(on, &cell)| on.has_cell(cell)))
    }

    /// Number of contacts of elements with raceways.
    pub fn contact_count(&self) -> usize {
        2 * self.element_count
    }

    /// Whether what a defect meets depends on where the rings are, and not on time alone.
    pub fn has_inner_defects(&self) -> bool {
        !self.inner.defects.is_empty() || !self.defective.is_empty()
    }

    /// Whether passages over defects have to be found within steps: inside, and in an uneven cage everywhere.
    pub fn watches_contacts(&self) -> bool {
        self.has_inner_defects() || (self.is_uneven() && !self.outer.defects.is_empty())
    }

    /// Angle of element `j` (from 0) ahead of the cage (rad), except for what moves in it ([`lead`](Self::lead)).
    pub fn element_offset(&self, j: usize) -> f64 {
        self.offsets[j]
    }

    /// Whether elements are alike and evenly spaced on a cage that turns evenly.
    pub fn is_even(&self) -> bool {
        self.irregularity.is_none()
            && !self.is_unequal()
            && self.offsets.iter().enumerate().all(|(j, &offset)| offset == j as f64 * TAU / self.element_count as f64)
    }

    /// Whether elements are unequal.
    #[inline(always)]
    pub fn is_unequal(&self) -> bool {
        !self.own.is_empty()
    }

    /// Whether elements move against each other on the cage, or the cage's speed wanders.
    pub fn is_uneven(&self) -> bool {
        self.irregularity.is_some()
    }

    /// Whether each element needs what the plain bearing of equal elements, dry contacts, in an even cage and in the
    /// plane does not.
    #[inline(always)]
    pub(in crate::dynamics) fn needs_general_form(&self) -> bool {
        self.irregularity.is_some()
            || self.films.is_some()
            || self.dampers.is_some()
            || self.space.is_some()
            || self.is_unequal()
    }

    /// Whether elements are in radial balance at every instant, without inertia.
    #[inline(always)]
    pub fn elements_in_balance(&self) -> bool {
        self.dampers.is_some()
    }

    /// The oil films at `tau`; `None` of dry contacts.
    #[inline(always)]
    pub fn films_at(&self, excitation: &Excitation, tau: f64) -> Option<FilmsNow> {
        self.films.as_ref().map(|films| films.at(excitation.relative_speed.at(tau)))
    }

    /// What separates a raceway from a nominal element pressed to the other (m), films included.
    #[inline(always)]
    pub fn clearance(&self, films: Option<&FilmsNow>) -> f64 {
        films.map_or(self.radial_clearance, |films| self.radial_clearance - films.together())
    }

    /// What element `j` is ahead of its position in a cage that turns evenly and is at this angle.
    #[inline]
    pub fn lead(&self, j: usize, cage: WholeAngle) -> Lead {
        self.irregularity.as_ref().map_or(Lead::default(), |uneven| uneven.of_element(j, cage))
    }

    /// The same for those who ask often, with `pieces` at hand.
    #[inline]
    pub(crate) fn lead_with(&self, j: usize, cage: WholeAngle, pieces: &mut LeadPieces) -> Lead {
        self.irregularity.as_ref().map_or(Lead::default(), |uneven| uneven.of_element_with(j, cage, pieces))
    }

    /// What the cage itself is ahead of one that turns evenly.
    pub fn cage_lead(&self, cage: WholeAngle) -> Lead {
        self.irregularity.as_ref().map_or(Lead::default(), |uneven| uneven.of_cage(cage))
    }

    /// Angle of element `j` about the outer ring's centre (rad), the cage's whole turns left out.
    #[inline]
    pub fn element_angle(&self, j: usize, cage: WholeAngle) -> f64 {
        cage.rest + self.element_offset(j) + self.lead(j, cage).angle
    }

    /// Angle (rad) by which elements spin while the cage turns by `cage` (rad) and the rings as they must for it, the
    /// outer one standing.
    pub fn spin_with_cage(&self, cage: f64) -> f64 {
        let Ratios { cage: [by_shaft, _], spin: [spin, _] } = self.ratios;
        if by_shaft == 0.0 { 0.0 } else { cage / by_shaft * spin }
    }

    /// Angle χ (rad) by which the first defect of element `j` has turned from the direction of the element's centre,
    /// for the angles of frames and that of the element; 0 where it faces the outer raceway, the turns since then
    /// counted.
    pub fn spin_angle(&self, j: usize, spin: f64, element: f64) -> f64 {
        let own = self.defective.iter().find(|defective| defective.element == j);
        own.map_or(0.0, |own| own.mark) + spin - element
    }

    /// Radial direction of element `j`.
    #[inline]
    pub(in crate::dynamics) fn direction(&self, j: usize, now: &FramedKinematics) -> Vector {
        self.direction_with(j, &now.cage, &self.lead(j, now.cage_angle()))
    }

    /// The same for a known lead.
    #[inline(always)]
    pub(in crate::dynamics) fn direction_with(&self, j: usize, cage: &CageState, lead: &Lead) -> Vector {
        let (sin, cos) = match &self.irregularity {
            None => (self.elements[j / WIDEST].sin[j % WIDEST], self.elements[j / WIDEST].cos[j % WIDEST]),
            Some(_) => sin_cos(self.element_offset(j) + lead.angle),
        };
        turned_by(cage.direction, sin, cos)
    }

    /// Radial direction of element `j` and its speed about the outer ring's centre (rad/s), with `pieces` at hand.
    #[inline(always)]
    pub(in crate::dynamics) fn direction_and_speed(
        &self,
        j: usize,
        excitation: &Excitation,
        cage: &CageState,
        pieces: &mut LeadPieces,
    ) -> (Vector, f64) {
        let Some(uneven) = &self.irregularity else {
            // Without a lead of 0, which would cost half as much again.
            return (self.direction_with(j, cage, &Lead::default()), cage.speed);
        };
        let lead = uneven.of_element_with(j, excitation.cage_angle_of(cage), pieces);
        (self.direction_with(j, cage, &lead), cage.speed * (1.0 + lead.rate))
    }

    /// Puts where all elements of an uneven cage are at an instant, and how fast they go, into `elements`; nothing in
    /// an even one. Gives the lead of the cage itself.
    #[inline(always)]
    pub(in crate::dynamics) fn update_uneven(
        &self,
        cage: WholeAngle,
        elements: &mut [ElementBlock],
        pieces: &mut LeadPieces,
    ) -> Lead {
        let Some(uneven) = &self.irregularity else { return Lead::default() };
        let lead = uneven.update_all(cage, elements, pieces);
        for (block, offsets) in elements.iter_mut().zip(self.offsets.chunks(WIDEST)) {
            for (i, &offset) in offsets.iter().enumerate() {
                (block.sin[i], block.cos[i]) = sin_cos(offset + block.lead[i]);
            }
        }
        lead
    }
}
