//! The contacts of several balls at a time on smooth grooves. A ball near a defect has stiffness 0 here.

use super::ball::{Ball, OnBall, Place};
use crate::contact::law::{DampedLaw, Point};
use crate::dynamics::contacts::Record;
use crate::dynamics::contacts::radial;
use crate::dynamics::parameters::{COORDINATES, ElementBlock, Model, RINGS, RingInSpace, Space, Stage};
use crate::numerics::lanes::{Lanes, QUAD, WIDEST, Wide, blocks, blocks_mut, sum_of};
use crate::numerics::plane::Vector;

/// Forces on the rings along their coordinates, by lanes.
#[derive(Default)]
struct RingSums {
    lanes: [[f64; WIDEST]; RINGS],
    /// Where the next group of four belongs.
    upper: bool,
}

impl RingSums {
    #[inline(always)]
    fn add<S: Wide>(&mut self, forces: [[Lanes<S>; COORDINATES]; 2]) {
        for (lanes, force) in self.lanes.iter_mut().zip(forces.as_flattened()) {
            force.add_to(lanes, self.upper);
        }
        self.upper = S::F64_LANES == QUAD && !self.upper;
    }
}

/// What balls on smooth grooves are worked out with.
struct Smooth<'a, S: Wide> {
    model: &'a Model,
    space: &'a Space,
    simd: S,
    cage: Vector,
    speed: f64,
    rings: [RingInSpace<Lanes<S>>; 2],
    /// Time (s) by which positions are still to be moved on along their rates.
    ahead: Option<f64>,
}

impl Model {
    /// Smooth contacts of all balls: their part of the derivative, and, if `RECORD`, each of them. Gives the forces on
    /// both rings along their coordinates.
    #[inline(always)]
    pub(super) fn smooth_balls<S: Wide, const RECORD: bool>(
        &self,
        simd: S,
        space: &Space,
        rings: &[RingInSpace; 2],
        stage: &Stage,
        derivative: &mut [f64],
        (elements, contacts): (&[ElementBlock], &mut Record),
    ) -> [f64; RINGS] {
        let all = |ring: &RingInSpace| RingInSpace {
            position: ring.position.map(|x| Lanes::splat(simd, x)),
            velocity: ring.velocity.map(|v| Lanes::splat(simd, v)),
        };
        let (cage, speed) = (stage.cage.direction, stage.cage.speed);
        let rings = [all(&rings[0]), all(&rings[1])];
        let smooth = Smooth { model: self, space, simd, cage, speed, rings, ahead: stage.ahead };
        let mut sums = RingSums::default();
        let (count, state, derivative) = (elements.len(), blocks(stage.state), blocks_mut(derivative));
        for (k, block) in elements.iter().enumerate() {
            for part in 0..WIDEST / S::F64_LANES {
                if k * WIDEST + part * S::F64_LANES >= self.element_count {
                    break;
                }
                let of = |numbers: &[f64; WIDEST]| Lanes::part(simd, numbers, part);
                // u, v, w and w_z, each in as many blocks as there are of elements.
                let at = std::array::from_fn(|list| of(&state[list * count + k]));
                let (rates, found) = smooth.balls(at, block, &of, &mut sums);
                for (list, rate) in rates.into_iter().enumerate() {
                    (rate * of(&block.present)).put(&mut derivative[list * count + k], part);
                }
                if RECORD {
                    found.keep(contacts, k, part, of(&block.present));
                }
            }
        }
        sums.lanes.map(sum_of)
    }
}

impl<S: Wide> Smooth<'_, S> {
    /// Of balls at u, v, w and w_z: how these change, and their contacts.
    #[inline(always)]
    fn balls(
        &self,
        [u, v, w, w_z]: [Lanes<S>; 4],
        block: &ElementBlock,
        of: &impl Fn(&[f64; WIDEST]) -> Lanes<S>,
        sums: &mut RingSums,
    ) -> ([Lanes<S>; 4], Found<S>) {
        let (model, space, simd) = (self.model, self.space, self.simd);
        let number = |number: f64| Lanes::splat(simd, number);
        let e_r = radial(simd, self.cage, block, of);
        let (omega, radius) = (of(&block.pace) * number(self.speed), number(model.outer_centre_radius));
        let ball = match self.ahead {
            None => Ball::new(&space.grooves, radius, e_r, omega, [u, v, w, w_z], &self.rings),
            Some(ahead) => {
                // Rates do not depend on positions.
                let [_, outer] = &self.rings;
                let rate = w - (outer.velocity[0] * e_r[0] + outer.velocity[1] * e_r[1]);
                let axial = w_z - outer.velocity[2];
                let moved = [u + number(ahead) * rate, v + number(ahead) * axial];
                let [inner, outer] = &self.rings;
                Ball::moving(&space.grooves, radius, e_r, omega, (moved, [rate, axial]), [inner, outer])
            }
        };
        let law = DampedLaw::new(model.inner.contact.law.damping, Point, number);
        let stiffness = [of(&block.inner), of(&block.outer)];
        let one = |side: usize| {
            let place = &ball.places[side];
            let closing = place.closing();
            let force = law.force(stiffness[side], place.contact.approach, closing);
            let on_ball = place.exerts([force, number(0.0)], force, number(space.across_damping));
            let pushing = law.pushing(place.contact.approach, closing);
            Contact { place: *place, on_ball, force, pushing }
        };
        let contacts = [one(0), one(1)];
        let total = |i: usize| contacts[0].on_ball.force[i] + contacts[1].on_ball.force[i];
        let gravity = [model.gravity.x, model.gravity.y, space.gravity].map(number);
        let [radial, axial] = ball.accelerations([total(0), total(2)], of(&block.per_mass), gravity);
        sums.add([ball.on_ring(&contacts[0].on_ball), ball.on_ring(&contacts[1].on_ball)]);
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
        let [[inner_e, inner_a], [outer_e, outer_a]] = [inner, outer].map(|of| of.place.contact.meridian);
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
