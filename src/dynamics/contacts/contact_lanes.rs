//! Contacts of several elements at a time: everything of the right-hand side that is the same for all elements.
//!
//! The equations are those of the `kernel`. An element near the defect, and every element of
//! a bearing whose outer raceway yields, has outer stiffness 0 here; its outer contact has been worked out before.
//!
//! A lane without an element has stiffness 0 and no derivative.

use super::directions::{dot, radial};
use super::kernel::InnerGap;
use crate::contact::law::{DampedLaw, Elastic, Line, Point, SqueezeFilm};
use crate::dynamics::parameters::{ElementBlock, FilmsNow, Kinematics, Model, Space, Stage};
use crate::numerics::lanes::row::Row;
use crate::numerics::lanes::{Kernel, Lanes, WIDEST, Wide, blocks, blocks_mut, handed_on, sum_of};
use crate::numerics::number::Number;
use crate::numerics::plane::{Vector, turned};

/// The smooth contacts of elements at one instant.
struct Smooth<'a, S: Wide, E> {
    model: &'a Model,
    law: DampedLaw<Lanes<S>, E>,
    now: &'a Kinematics,
    offset: Vector,
    drift: Vector,
    /// Acceleration of an element by gravity, and that of its w as the outer ring moves along the raceway (m/s²).
    body: Vector,
    /// As [`Model::nearly_concentric`] has it.
    series: bool,
    /// Time (s) by which paths are still to be moved on along their rates.
    ahead: Option<f64>,
    /// The oil films of the inner and of the outer raceway.
    films: Option<[SqueezeFilm; 2]>,
    clearance: f64,
}

/// What follows for some elements.
struct Found<S: Wide> {
    path_rate: Lanes<S>,
    acceleration: Lanes<S>,
    /// Of the inner contact along x and y, and of the outer one.
    forces: [Lanes<S>; 4],
    inner: Lanes<S>,
    normal: [Lanes<S>; 2],
    outer: Lanes<S>,
    approach: Lanes<S>,
    pushing: [Lanes<S>; 2],
}

/// Sums of `N` forces by lanes: eight sums each, whatever the registers.
///
/// In registers of their own kind: added to a half of eight numbers that is found out late, a sum would be written in
/// quarters and read together, at 15 cycles each.
pub(in crate::dynamics) struct Sums<S: Wide, const N: usize>([[Lanes<S>; 2]; N]);

impl<S: Wide, const N: usize> Sums<S, N> {
    #[inline(always)]
    pub(in crate::dynamics) fn new(simd: S) -> Self {
        Self([[Lanes::splat(simd, 0.0); 2]; N])
    }

    /// Adds forces on the elements of this part of a block.
    #[inline(always)]
    pub(in crate::dynamics) fn add(&mut self, part: usize, forces: &[Lanes<S>]) {
        let half = part % (WIDEST / S::F64_LANES);
        for (lanes, &force) in self.0.iter_mut().zip(forces) {
            lanes[half] = lanes[half] + force;
        }
    }

    /// The sums over all lanes.
    #[inline(always)]
    pub(in crate::dynamics) fn totals(&self) -> [f64; N] {
        let mut totals = [0.0; N];
        for (total, halves) in totals.iter_mut().zip(&self.0) {
            let mut lanes = [0.0; WIDEST];
            for (part, half) in halves.iter().enumerate().take(WIDEST / S::F64_LANES) {
                half.put(&mut lanes, part);
            }
            *total = sum_of(lanes);
        }
        totals
    }
}

impl<S: Wide> Sums<S, 4> {
    /// Force on the inner ring, then on the outer, of the forces on elements that were added: along x and y, of inner
    /// contacts and then of outer ones.
    #[inline(always)]
    pub(in crate::dynamics) fn on_rings(&self) -> [f64; 4] {
        let [shaft_x, shaft_y, housing_x, housing_y] = self.totals();
        [-shaft_x, -shaft_y, housing_x, housing_y]
    }
}

/// Lists of a [`Record`] in the order of [`Record::smooth_contacts`].
type Kept<'a> = [&'a mut [[f64; WIDEST]]; 11];

/// What is kept of each contact, for whoever wants to know more than the sums. Its lists are made once.
#[derive(Debug, Clone, Default)]
pub struct Record {
    /// Force of the inner contact Q_i of each element (N).
    pub inner: Row,
    /// Direction of q of each element, its radial part.
    pub normal_radial: Row,
    /// Direction of q of each element, its tangential part.
    pub normal_tangential: Row,
    /// Force of the outer contact of each element (N).
    pub outer: Row,
    /// Outer contact force on each element, inwards (N).
    pub outer_radial: Row,
    /// Outer contact force on each element, counter-clockwise (N).
    pub outer_tangential: Row,
    /// Approach of the inner contact (m): negative when there is a gap.
    pub inner_approach: Row,
    /// Equivalent approach of the outer contact (m).
    pub outer_approach: Row,
    /// How clearly the inner contact pushes ([`crate::contact::law::ForceLaw::pushing`]) (m).
    pub inner_pushing: Row,
    /// How clearly the outer contact pushes (m).
    pub outer_pushing: Row,
    /// u' of each element (m/s).
    pub path_rate: Row,
    /// Path u (m) and absolute radial velocity w (m/s) of each element that is in balance at every instant; empty for
    /// others, whose state has them.
    pub balanced: [Row; 2],
    /// In space: parts of the direction of the inner contact's force away from the inner ring's axis and along it, then
    /// of the outer contact's from the outer ring's; empty in the plane.
    pub meridians: [Row; 4],
}

impl Record {
    /// Path (m) of each element in `state`, of which these are the contacts: where it is, or where it is in balance.
    /// There may be more slots than elements.
    #[inline]
    pub fn paths<'a>(&'a self, model: &Model, state: &'a [f64]) -> &'a [f64] {
        if model.elements_in_balance() { &self.balanced[0] } else { state }
    }

    /// Axial position (m) of each ball in space; its slots are as those of the [paths](Self::paths).
    pub fn axial_positions<'a>(&'a self, model: &Model, state: &'a [f64]) -> &'a [f64] {
        let start = model.layout.axial().map_or(0, |[v, _]| v);
        &self.paths(model, state)[start..]
    }

    /// Contact angle (rad) of element `j` on the inner (0) or the outer (1) raceway; 0 of a contact without force.
    pub fn contact_angle(&self, space: &Space, j: usize, side: usize) -> f64 {
        if [&self.inner, &self.outer][side][j] > 0.0 {
            space.grooves[side].angle([0, 1].map(|part: usize| self.meridians[2 * side + part][j]))
        } else {
            0.0
        }
    }

    /// θ_s − |α| − a/r_g (rad): the angle from the end of a contact's ellipse to the shoulder; negative where the
    /// shoulder cuts the ellipse. Of a contact without force the angle to the groove's bottom.
    pub fn shoulder_margin(&self, space: &Space, j: usize, side: usize) -> f64 {
        let force = [&self.inner, &self.outer][side][j];
        space.shoulder_margin(side, self.contact_angle(space, j, side), force)
    }

    /// The lists that smooth contacts are kept in, looked up once for all elements.
    #[inline(always)]
    fn smooth_contacts(&mut self) -> Kept<'_> {
        [
            blocks_mut(&mut self.inner),
            blocks_mut(&mut self.normal_radial),
            blocks_mut(&mut self.normal_tangential),
            blocks_mut(&mut self.outer),
            blocks_mut(&mut self.outer_radial),
            blocks_mut(&mut self.outer_tangential),
            blocks_mut(&mut self.inner_approach),
            blocks_mut(&mut self.outer_approach),
            blocks_mut(&mut self.inner_pushing),
            blocks_mut(&mut self.outer_pushing),
            blocks_mut(&mut self.path_rate),
        ]
    }

    /// Room for `slots` elements.
    pub(in crate::dynamics) fn new(slots: usize) -> Self {
        let zeros = || Row::zeros(slots);
        Self {
            inner: zeros(),
            normal_radial: zeros(),
            normal_tangential: zeros(),
            outer: zeros(),
            outer_radial: zeros(),
            outer_tangential: zeros(),
            inner_approach: zeros(),
            outer_approach: zeros(),
            inner_pushing: zeros(),
            outer_pushing: zeros(),
            path_rate: zeros(),
            balanced: [Row::zeros(0), Row::zeros(0)],
            meridians: [(); 4].map(|()| Row::zeros(0)),
        }
    }
}

impl Model {
    /// Smooth contacts of all elements: their part of the derivative, and, if `RECORD`, each of them. Gives their force
    /// on the inner ring and on the outer. If `GENERAL`, each element has a speed and a size of its own and
    /// contacts may have films.
    #[inline(always)]
    pub(in crate::dynamics) fn smooth_contacts<S: Wide, const RECORD: bool, const GENERAL: bool>(
        &self,
        simd: S,
        now: &Kinematics,
        stage: &Stage,
        derivative: &mut [f64],
        (elements, films): (&[ElementBlock], Option<&FilmsNow>),
        contacts: &mut Record,
    ) -> [f64; 4] {
        // A function of its own, so that nothing of it is in the way of balls.
        if let Some(line) = self.inner.contact.law.elasticity.line() {
            return simd.outlined(Rollers::<RECORD, GENERAL> {
                model: self,
                line,
                now: &handed_on(now),
                stage,
                derivative,
                elements,
                films,
                contacts,
            });
        }
        self.contacts_of::<S, Point, RECORD, GENERAL>(simd, Point, now, stage, derivative, (elements, films, contacts))
    }

    /// As [`smooth_contacts`](Self::smooth_contacts), for contacts of one elasticity.
    #[inline(always)]
    fn contacts_of<S: Wide, E: Elastic, const RECORD: bool, const GENERAL: bool>(
        &self,
        simd: S,
        elastic: E,
        now: &Kinematics,
        stage: &Stage,
        derivative: &mut [f64],
        (elements, films, contacts): (&[ElementBlock], Option<&FilmsNow>, &mut Record),
    ) -> [f64; 4] {
        let start = self.layout.radial_velocity;
        let (offset, v, omega) = (now.offset(), now.housing.velocity, now.cage.speed);
        let series = self.nearly_concentric(offset);
        // Of elements with speeds of their own the second part is theirs.
        let omega = if GENERAL { 0.0 } else { omega };
        let body = Vector::new(self.gravity.x + omega * v.y, self.gravity.y - omega * v.x);
        let drift = now.drift();
        let clearance = if GENERAL { self.clearance(films) } else { self.radial_clearance };
        let films = if GENERAL { films.map(|films| films.squeeze) } else { None };
        let ahead = stage.ahead;
        let law = DampedLaw::new(self.inner.contact.law.damping, elastic, |number| Lanes::splat(simd, number));
        let smooth = Smooth { model: self, law, now, offset, drift, body, series, ahead, films, clearance };
        let mut sums = Sums::new(simd);
        let mut kept = RECORD.then(|| contacts.smooth_contacts());
        let (state, derivative) = (blocks(stage.state), blocks_mut(derivative));
        for (k, block) in elements.iter().enumerate() {
            let w = start / WIDEST + k;
            for part in 0..WIDEST / S::F64_LANES {
                if (k * WIDEST + part * S::F64_LANES) >= self.element_count {
                    break;
                }
                let of = |numbers: &[f64; WIDEST]| Lanes::part(simd, numbers, part);
                let found = smooth.contacts::<GENERAL>(simd, of(&state[k]), of(&state[w]), block, of);
                sums.add(part, &found.forces);
                found.path_rate.put(&mut derivative[k], part);
                found.acceleration.put(&mut derivative[w], part);
                if let Some(kept) = &mut kept {
                    found.keep(kept, of(&state[k]), k, part);
                }
            }
        }
        sums.on_rings()
    }
}

impl<S: Wide> Found<S> {
    /// Puts what is kept into its lists; the outer contact is that on the smooth raceway, at path `u`.
    #[inline(always)]
    fn keep(&self, kept: &mut Kept, u: Lanes<S>, block: usize, part: usize) {
        let Self { path_rate, inner, normal: [n_r, n_t], outer, approach, pushing, .. } = *self;
        let across = outer.all(0.0);
        let found = [inner, n_r, n_t, outer, outer, across, approach, u, pushing[0], pushing[1], path_rate];
        for n in 0..found.len() {
            found[n].put(&mut kept[n][block], part);
        }
    }
}

impl<S: Wide, E: Elastic> Smooth<'_, S, E> {
    /// Of elements at the paths `u` (m) and absolute radial velocities `w` (m/s).
    #[inline(always)]
    fn contacts<const GENERAL: bool>(
        &self,
        simd: S,
        u: Lanes<S>,
        w: Lanes<S>,
        block: &ElementBlock,
        of: impl Fn(&[f64; WIDEST]) -> Lanes<S>,
    ) -> Found<S> {
        let (model, now) = (self.model, self.now);
        let present = of(&block.present);
        let e_r = radial(simd, now.cage.direction, block, &of);
        let path_rate = w - dot(simd, now.housing.velocity, e_r);
        let u = self.ahead.map_or(u, |ahead| u + Lanes::splat(simd, ahead) * path_rate);
        let number = |number: f64| Lanes::splat(simd, number);
        let (mut radius, mut clearance) = (number(model.outer_centre_radius), number(self.clearance));
        if GENERAL {
            let larger = of(&block.larger);
            (radius, clearance) = (radius - number(0.5) * larger, clearance - larger);
        }
        let rho = radius + u;
        let offset = [dot(simd, self.offset, e_r), dot(simd, -turned(self.offset), e_r)];
        let gap = InnerGap::of(rho, u, offset, clearance, self.series);
        let (delta, [n_r, n_t]) = (gap.approach, gap.n);
        let pace = number(now.cage.speed);
        let speed = if GENERAL { of(&block.pace) * pace } else { pace };
        let drift = [dot(simd, self.drift, e_r), dot(simd, -turned(self.drift), e_r)];
        let closing = gap.closing(InnerGap::q_rate(drift, path_rate, rho, speed));

        let law = &self.law;
        let mut inner = law.force(of(&block.inner), delta, closing);
        let mut outer = law.force(of(&block.outer), u, path_rate);
        if GENERAL && let Some([inside, outside]) = &self.films {
            // Constants of contacts are far above 1, or 0 for what is no smooth contact.
            let [on_inner, on_outer] = [&block.inner, &block.outer].map(|constant| of(constant).at_most(number(1.0)));
            inner = inner + on_inner * inside.to(number).force(delta, closing);
            outer = outer + on_outer * outside.to(number).force(u, path_rate);
        }
        let mut turning = rho * (speed * speed);
        if GENERAL {
            turning = turning + speed * dot(simd, -turned(now.housing.velocity), e_r);
        }
        let acceleration = (inner * n_r - outer) * of(&block.per_mass)
            + of(&block.other)
            + (dot(simd, self.body, e_r) + turning) * present;

        Found {
            path_rate: path_rate * present,
            acceleration,
            forces: [
                inner * (n_r * e_r[0] - n_t * e_r[1]),
                inner * (n_r * e_r[1] + n_t * e_r[0]),
                outer * e_r[0],
                outer * e_r[1],
            ],
            inner,
            normal: [n_r, n_t],
            outer,
            approach: delta * present,
            pushing: [law.pushing(delta, closing) * present, law.pushing(u, path_rate) * present],
        }
    }
}

/// The smooth contacts of rollers.
struct Rollers<'a, const RECORD: bool, const GENERAL: bool> {
    model: &'a Model,
    line: Line<'a>,
    now: &'a Kinematics,
    stage: &'a Stage<'a>,
    derivative: &'a mut [f64],
    elements: &'a [ElementBlock],
    films: Option<&'a FilmsNow>,
    contacts: &'a mut Record,
}

impl<const RECORD: bool, const GENERAL: bool> Kernel for Rollers<'_, RECORD, GENERAL> {
    type Output = [f64; 4];

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) -> [f64; 4] {
        let Self { model, line, now, stage, derivative, elements, films, contacts } = self;
        model.contacts_of::<S, Line, RECORD, GENERAL>(simd, line, now, stage, derivative, (elements, films, contacts))
    }
}
