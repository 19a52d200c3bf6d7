//! The contacts of several balls at a time on smooth grooves. A ball near a defect has stiffness 0 here.

use super::{Ball, OnBall, Place, axis_of};
use crate::contact::groove::{Axis, Concentric, RingAxis, Upright};
use crate::contact::law::{DampedLaw, Point};
use crate::dynamics::contacts::{Record, Sums, radial};
use crate::dynamics::parameters::{COORDINATES, ElementBlock, Model, RINGS, RingInSpace, Space, Stage};
use crate::numerics::lanes::{Lanes, WIDEST, Wide, blocks, blocks_mut};
use crate::numerics::plane::Vector;

/// What balls on smooth grooves are worked out with.
struct Smooth<'a, S: Wide, I, O> {
    model: &'a Model,
    space: &'a Space,
    simd: S,
    cage: Vector,
    speed: f64,
    rings: [RingInSpace<Lanes<S>>; 2],
    axes: (I, O),
    /// Time (s) by which positions are still to be moved on along their rates.
    ahead: Option<f64>,
}

impl Model {
    /// Smooth contacts of all balls: their part of the derivative, and, if `RECORD`, each of them. Gives the forces on
    /// both rings along their coordinates.
    #[inline(always)]
    pub(in crate::dynamics::spatial) fn smooth_balls<S: Wide, const RECORD: bool>(
        &self,
        simd: S,
        space: &Space,
        rings: &[RingInSpace; 2],
        stage: &Stage,
        derivative: &mut [f64],
        kept: (&[ElementBlock], &mut Record),
    ) -> [f64; RINGS] {
        if space.tilts {
            let axes = (axis_everywhere(simd, &axis_of(&rings[0])), axis_everywhere(simd, &axis_of(&rings[1])));
            return self.balls_between::<S, RECORD, _, _>(simd, space, (rings, axes), stage, derivative, kept);
        }
        let axes = (Upright, Concentric);
        self.balls_between::<S, RECORD, _, _>(simd, space, (rings, axes), stage, derivative, kept)
    }

    /// The same between rings of these axes.
    #[inline(always)]
    fn balls_between<S: Wide, const RECORD: bool, I: RingAxis<Lanes<S>>, O: RingAxis<Lanes<S>>>(
        &self,
        simd: S,
        space: &Space,
        (rings, axes): (&[RingInSpace; 2], (I, O)),
        stage: &Stage,
        derivative: &mut [f64],
        (elements, contacts): (&[ElementBlock], &mut Record),
    ) -> [f64; RINGS] {
        let (cage, speed) = (stage.cage.direction, stage.cage.speed);
        let rings = [everywhere(simd, &rings[0]), everywhere(simd, &rings[1])];
        let smooth = Smooth { model: self, space, simd, cage, speed, rings, axes, ahead: stage.ahead };
        let mut sums = Sums::new(simd);
        let (count, state, derivative) = (elements.len(), blocks(stage.state), blocks_mut(derivative));
        for (k, block) in elements.iter().enumerate() {
            for part in 0..WIDEST / S::F64_LANES {
                if k * WIDEST + part * S::F64_LANES >= self.element_count {
                    break;
                }
                let of = |numbers: &[f64; WIDEST]| Lanes::part(simd, numbers, part);
                // u, v, w and w_z, each in as many blocks as there are of elements.
                let at = [of(&state[k]), of(&state[count + k]), of(&state[2 * count + k]), of(&state[3 * count + k])];
                let (rates, found) = smooth.balls(at, block, &of, (part, &mut sums));
                for list in 0..rates.len() {
                    (rates[list] * of(&block.present)).put(&mut derivative[list * count + k], part);
                }
                if RECORD {
                    found.keep(contacts, k, part, of(&block.present));
                }
            }
        }
        sums.totals()
    }
}

/// A ring's coordinates in all lanes.
#[inline(always)]
fn everywhere<S: Wide>(simd: S, ring: &RingInSpace) -> RingInSpace<Lanes<S>> {
    let none = Lanes::splat(simd, 0.0);
    let mut all = RingInSpace { position: [none; COORDINATES], velocity: [none; COORDINATES] };
    for k in 0..COORDINATES {
        all.position[k] = Lanes::splat(simd, ring.position[k]);
        all.velocity[k] = Lanes::splat(simd, ring.velocity[k]);
    }
    all
}

/// An axis in all lanes.
#[inline(always)]
fn axis_everywhere<S: Wide>(simd: S, axis: &Axis<f64>) -> Axis<Lanes<S>> {
    let number = |number: f64| Lanes::splat(simd, number);
    let ([a_x, a_y, a_z], [t_x, t_y, t_z]) = (axis.direction, axis.turning);
    Axis { direction: [number(a_x), number(a_y), number(a_z)], turning: [number(t_x), number(t_y), number(t_z)] }
}

impl<S: Wide, I: RingAxis<Lanes<S>>, O: RingAxis<Lanes<S>>> Smooth<'_, S, I, O> {
    /// One contact of some balls.
    #[inline(always)]
    fn contact(&self, place: Place<Lanes<S>>, law: &DampedLaw<Lanes<S>>, stiffness: Lanes<S>) -> Contact<S> {
        let (simd, closing) = (self.simd, place.closing());
        let force = law.force(stiffness, place.contact.approach, closing);
        let on_ball = place.presses(force, force, Lanes::splat(simd, self.space.across_damping));
        Contact { place, on_ball, force, pushing: law.pushing(place.contact.approach, closing) }
    }

    /// Of balls at u, v, w and w_z: how these change, and their contacts.
    #[inline(always)]
    fn balls(
        &self,
        [u, v, w, w_z]: [Lanes<S>; 4],
        block: &ElementBlock,
        of: &impl Fn(&[f64; WIDEST]) -> Lanes<S>,
        (part, sums): (usize, &mut Sums<S, RINGS>),
    ) -> ([Lanes<S>; 4], Found<S>) {
        let (model, space, simd) = (self.model, self.space, self.simd);
        let number = |number: f64| Lanes::splat(simd, number);
        let e_r = radial(simd, self.cage, block, of);
        let (omega, radius) = (of(&block.pace) * number(self.speed), number(model.outer_centre_radius));
        let [inner, outer] = &self.rings;
        let rates = Ball::<Lanes<S>>::rates(e_r, [w, w_z], outer);
        // Rates do not depend on positions.
        let at = match self.ahead {
            None => [u, v],
            Some(ahead) => [u + number(ahead) * rates[0], v + number(ahead) * rates[1]],
        };
        let ball = Ball::new(radius, e_r, omega, (at, rates), [inner, outer], (&self.axes.0, &self.axes.1));
        let law = DampedLaw::new(model.inner.contact.law.damping, Point, number);
        let stiffness = [of(&block.inner), of(&block.outer)];
        let contacts = [
            self.contact(Place::of(&space.grooves[0], &ball.seen.0), &law, stiffness[0]),
            self.contact(Place::of(&space.grooves[1], &ball.seen.1), &law, stiffness[1]),
        ];
        let total = |i: usize| contacts[0].on_ball.force[i] + contacts[1].on_ball.force[i];
        let gravity = [number(model.gravity.x), number(model.gravity.y), number(space.gravity)];
        let [radial, axial] = ball.accelerations([total(0), total(2)], of(&block.per_mass), gravity);
        let on_rings = [ball.on_ring(&contacts[0].on_ball), ball.on_ring(&contacts[1].on_ball)];
        sums.add(part, on_rings.as_flattened());
        ([ball.rates[0], ball.rates[1], radial, axial], Found { path_rate: ball.rates[0], around: total(1), contacts })
    }
}

/// One contact of some balls.
#[derive(Clone, Copy)]
struct Contact<S: Wide> {
    place: Place<Lanes<S>>,
    on_ball: OnBall<Lanes<S>>,
    force: Lanes<S>,
    pushing: Lanes<S>,
}

/// What follows for some balls.
struct Found<S: Wide> {
    path_rate: Lanes<S>,
    /// Force of both contacts along e_t.
    around: Lanes<S>,
    contacts: [Contact<S>; 2],
}

impl<S: Wide> Found<S> {
    /// Puts what is kept into `record`. All that pushes along e_t stands with the outer contact.
    #[inline(always)]
    fn keep(&self, record: &mut Record, block: usize, part: usize, present: Lanes<S>) {
        let [inner, outer] = &self.contacts;
        let ([inner_e, inner_a], [outer_e, outer_a]) = (inner.place.contact.meridian, outer.place.contact.meridian);
        let [meridian_ie, meridian_ia, meridian_oe, meridian_oa] = &mut record.meridians;
        for (list, value) in [
            (&mut record.inner, inner.force),
            (&mut record.outer, outer.force),
            (&mut record.outer_tangential, self.around),
            (&mut record.inner_approach, inner.place.contact.approach * present),
            (&mut record.outer_approach, outer.place.contact.approach * present),
            (&mut record.inner_pushing, inner.pushing * present),
            (&mut record.outer_pushing, outer.pushing * present),
            (&mut record.path_rate, self.path_rate),
            (meridian_ie, inner_e),
            (meridian_ia, inner_a),
            (meridian_oe, outer_e),
            (meridian_oa, outer_a),
        ] {
            value.put(&mut blocks_mut(list)[block], part);
        }
    }
}
