//! The smooth contacts of several elements at a time: everything of the right-hand side that is the same for all
//! elements, of rings of two, three and five degrees of freedom.
//!
//! An element near a defect has constant 0 for that contact here, as has every element of a bearing whose outer raceway
//! yields for the outer one: those contacts are worked out by themselves. A lane without an element has constant 0 and
//! no derivative.

mod balls;
mod plane;

use super::record::{Lists, Record};
use crate::contact::law::{DampedLaw, Elastic};
use crate::dynamics::element::{Contact, Element, Raceway, View, dot, radial};
use crate::dynamics::parameters::{CageState, ElementBlock, FilmsNow, Model};
use crate::numerics::lanes::{Lanes, Sums, WIDEST, Wide, blocks, blocks_mut};
use crate::numerics::number::Number;
use crate::numerics::plane::{Vector, turned};

/// The elements, the films between their surfaces, and what is kept of their contacts.
pub(in crate::dynamics) type Kept<'a> = (&'a [ElementBlock], Option<&'a FilmsNow>, &'a mut Record);

/// What acts on both rings along their coordinates (N, N m).
pub(in crate::dynamics) type OnRings<const C: usize> = [[f64; C]; 2];

/// Smooth elements at one instant, as the inner and the outer ring see them.
struct Smooth<'a, S: Wide, E, VI, VO, RI, RO> {
    model: &'a Model,
    simd: S,
    cage: &'a CageState,
    /// Velocity of the outer ring (m/s).
    carrier: [f64; 3],
    /// Gravity along z (m/s²).
    axial_gravity: f64,
    /// Time (s) by which positions are still to be moved on along their rates.
    ahead: Option<f64>,
    law: DampedLaw<Lanes<S>, E>,
    views: (VI, VO),
    raceways: (RI, RO),
}

/// What follows for some elements.
struct Found<S: Wide, const P: usize> {
    rates: [Lanes<S>; P],
    accelerations: [Lanes<S>; P],
    contacts: [Contact<Lanes<S>, P>; 2],
    pushing: [Lanes<S>; 2],
    /// Direction of the inner contact in the plane, along e_r and e_t.
    direction: [Lanes<S>; 2],
    /// Force of both contacts along e_t.
    around: Lanes<S>,
}

impl<S: Wide, E: Elastic, VI, VO, RI, RO> Smooth<'_, S, E, VI, VO, RI, RO> {
    /// All elements: their part of the derivative, and, if `RECORD`, each contact. If `GENERAL`, each element has a
    /// speed and a size of its own.
    #[inline(always)]
    fn all<const P: usize, const C: usize, const RECORD: bool, const GENERAL: bool>(
        &self,
        state: &[f64],
        derivative: &mut [f64],
        elements: &[ElementBlock],
        record: &mut Record,
    ) -> OnRings<C>
    where
        VI: View<Lanes<S>, P, C>,
        VO: View<Lanes<S>, P, C>,
        RI: Raceway<Lanes<S>, P>,
        RO: Raceway<Lanes<S>, P>,
    {
        let (simd, count) = (self.simd, elements.len());
        let mut sums = (Sums::<S, C>::new(simd), Sums::<S, C>::new(simd));
        // u and v, then w and w_z, each in as many blocks as there are of elements.
        let (positions, rest) = lists::<P>(blocks(state), count);
        let (velocities, _) = lists::<P>(rest, count);
        let (rates, rest) = lists_mut::<P>(blocks_mut(derivative), count);
        let (accelerations, _) = lists_mut::<P>(rest, count);
        let mut kept = RECORD.then(|| record.smooth_contacts::<P>());
        for (k, block) in elements.iter().enumerate() {
            for part in 0..WIDEST / S::F64_LANES {
                if k * WIDEST + part * S::F64_LANES >= self.model.element_count {
                    break;
                }
                let of = |numbers: &[f64; WIDEST]| Lanes::part(simd, numbers, part);
                let (mut at, mut going) = ([of(&block.present); P], [of(&block.present); P]);
                for i in 0..P {
                    (at[i], going[i]) = (of(&positions[i][k]), of(&velocities[i][k]));
                }
                let found = self.some::<P, C, RECORD, GENERAL>([at, going], block, &of, (part, &mut sums));
                for i in 0..P {
                    found.rates[i].put(&mut rates[i][k], part);
                    found.accelerations[i].put(&mut accelerations[i][k], part);
                }
                if let Some(kept) = &mut kept {
                    found.keep(kept, k, part, of(&block.present));
                }
            }
        }
        // The opposite of what acts on elements.
        [sums.0.totals().map(|total| -total), sums.1.totals().map(|total| -total)]
    }

    /// Of elements at these places and velocities.
    #[inline(always)]
    fn some<const P: usize, const C: usize, const RECORD: bool, const GENERAL: bool>(
        &self,
        [at, going]: [[Lanes<S>; P]; 2],
        block: &ElementBlock,
        of: &impl Fn(&[f64; WIDEST]) -> Lanes<S>,
        (part, sums): (usize, &mut (Sums<S, C>, Sums<S, C>)),
    ) -> Found<S, P>
    where
        VI: View<Lanes<S>, P, C>,
        VO: View<Lanes<S>, P, C>,
        RI: Raceway<Lanes<S>, P>,
        RO: Raceway<Lanes<S>, P>,
    {
        let element = self.element::<P, GENERAL>(at, going, block, of);
        let (present, per_mass) = (of(&block.present), of(&block.per_mass));

        let (inside, seen_inside) = self.views.0.see(&element);
        let inner = if GENERAL {
            self.raceways.0.beside(of(&block.larger)).contact(of(&block.inner), &inside)
        } else {
            self.raceways.0.contact(of(&block.inner), &inside)
        };
        let (outside, seen_outside) = self.views.1.see(&element);
        let outer = self.raceways.1.contact(of(&block.outer), &outside);
        sums.0.add(part, &VI::along_ring(&element, &seen_inside, inner.force));
        sums.1.add(part, &VO::along_ring(&element, &seen_outside, outer.force));
        let (of_inner, inner_around) = VI::on_element(&seen_inside, inner.force);
        let (of_outer, outer_around) = VO::on_element(&seen_outside, outer.force);

        let turning = self.turning::<P, GENERAL>(&element);
        let mut accelerations = [turning * present; P];
        accelerations[0] = (of_inner[0] + of_outer[0]) * per_mass + of(&block.other) + accelerations[0];
        for k in 1..P {
            accelerations[k] =
                ((of_inner[k] + of_outer[k]) * per_mass + Lanes::splat(self.simd, self.axial_gravity)) * present;
        }
        let mut rates = element.rate;
        for k in 0..P {
            rates[k] = rates[k] * present;
        }
        let none = present.all(0.0);
        let mut found = Found {
            rates,
            accelerations,
            contacts: [inner, outer],
            pushing: [none; 2],
            direction: [none; 2],
            around: none,
        };
        if RECORD {
            // Written out: a closure would be a function of its own, without the machine's registers.
            found.pushing =
                [self.law.pushing(inner.approach, inner.closing), self.law.pushing(outer.approach, outer.closing)];
            let (unit, around) = VI::on_element(&seen_inside, [present.all(1.0); P]);
            found.direction = [unit[0], around.unwrap_or(none)];
            found.around = inner_around.unwrap_or(none) + outer_around.unwrap_or(none);
        }
        found
    }
}

impl<S: Wide, E, VI, VO, RI, RO> Smooth<'_, S, E, VI, VO, RI, RO> {
    /// Elements at these places, their absolute velocities being these.
    #[inline(always)]
    fn element<const P: usize, const GENERAL: bool>(
        &self,
        mut at: [Lanes<S>; P],
        mut rate: [Lanes<S>; P],
        block: &ElementBlock,
        of: &impl Fn(&[f64; WIDEST]) -> Lanes<S>,
    ) -> Element<Lanes<S>, P> {
        let (simd, [v_x, v_y, v_z]) = (self.simd, self.carrier);
        let number = |number: f64| Lanes::splat(simd, number);
        let e_r = radial(simd, self.cage.direction, block, of);
        rate[0] = rate[0] - dot(simd, Vector::new(v_x, v_y), e_r);
        for k in 1..P {
            rate[k] = rate[k] - number(v_z);
        }
        if let Some(ahead) = self.ahead {
            // Rates do not depend on positions.
            for k in 0..P {
                at[k] = at[k] + number(ahead) * rate[k];
            }
        }
        let mut radius = number(self.model.outer_centre_radius);
        if GENERAL {
            radius = radius - number(0.5) * of(&block.larger);
        }
        let pace = number(self.cage.speed);
        let omega = if GENERAL { of(&block.pace) * pace } else { pace };
        Element { e_r, at, rate, rho: radius + at[0], omega }
    }

    /// What gravity and turning add to w' (m/s²).
    #[inline(always)]
    fn turning<const P: usize, const GENERAL: bool>(&self, of: &Element<Lanes<S>, P>) -> Lanes<S> {
        let (simd, gravity, [v_x, v_y, _]) = (self.simd, self.model.gravity, self.carrier);
        let turning = of.rho * (of.omega * of.omega);
        if GENERAL {
            let carried = of.omega * dot(simd, -turned(Vector::new(v_x, v_y)), of.e_r);
            return dot(simd, gravity, of.e_r) + (turning + carried);
        }
        let speed = self.cage.speed;
        dot(simd, Vector::new(gravity.x + speed * v_y, gravity.y - speed * v_x), of.e_r) + turning
    }
}

impl<S: Wide, const P: usize> Found<S, P> {
    /// Puts what is kept into its lists. Of balls in space all that pushes along e_t stands with the outer contact.
    #[inline(always)]
    fn keep(&self, lists: &mut Lists, block: usize, part: usize, present: Lanes<S>) {
        let [inner, outer] = &self.contacts;
        let around = if P == 1 { self.around.all(0.0) } else { self.around };
        let (approaches, pushing) = ([inner.approach * present, outer.approach * present], self.pushing);
        let [a, b, c, d] = if P == 1 {
            [self.direction[0], self.direction[1], outer.magnitude, outer.magnitude]
        } else {
            [inner.normal[0], inner.normal[P - 1], outer.normal[0], outer.normal[P - 1]]
        };
        let found = [
            inner.magnitude,
            outer.magnitude,
            around,
            approaches[0],
            approaches[1],
            pushing[0] * present,
            pushing[1] * present,
            self.rates[0],
            a,
            b,
            c,
            d,
        ];
        for n in 0..if P == 1 { found.len() - 1 } else { found.len() } {
            found[n].put(&mut lists[n][block], part);
        }
    }
}

/// `P` lists of `count` blocks each, and what comes after them.
#[inline(always)]
fn lists<const P: usize>(mut from: &[[f64; WIDEST]], count: usize) -> ([&[[f64; WIDEST]]; P], &[[f64; WIDEST]]) {
    let mut lists = [&[][..]; P];
    for list in &mut lists {
        (*list, from) = from.split_at(count);
    }
    (lists, from)
}

/// The same to write.
#[inline(always)]
fn lists_mut<const P: usize>(
    mut from: &mut [[f64; WIDEST]],
    count: usize,
) -> ([&mut [[f64; WIDEST]]; P], &mut [[f64; WIDEST]]) {
    let mut lists = [(); P].map(|()| Default::default());
    for list in &mut lists {
        (*list, from) = from.split_at_mut(count);
    }
    (lists, from)
}
