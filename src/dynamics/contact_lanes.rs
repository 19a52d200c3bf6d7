//! Contacts of several elements at a time: everything of the right-hand side that is the same for all elements.
//!
//! The equations are those of [`super::forces`], in the same grouping. An element near the defect, and every element of
//! a bearing whose outer raceway yields, has outer stiffness 0 here; its outer contact has been worked out before.
//!
//! Both damping laws are one expression without a branch:
//! ```text
//! Q = K √δ max(0, δ + (a δ + b) δ̇),   a = χ, b = 0 (Hunt–Crossley)   a = 0, b = 1.5 τ (proportional)
//! ```
//! A place without an element has stiffness 0 and no derivative.

use super::forces::{Forces, Moment};
use super::model::Model;
use crate::contact::force_law::PUSHING_LENGTH;
use crate::numerics::lanes::{Each, Lanes, Lists, QUAD, Wide, sum_of};
use crate::scene::Damping;

/// The smooth contacts of elements at one instant.
struct Smooth<'a> {
    model: &'a Model,
    at: &'a Moment,
}

/// Lists that are read: cos, sin, whether there is an element, 1/mass, Hertz constants of both contacts, acceleration by other
/// outer contacts, u, w.
const FROM: usize = 9;

/// What follows for some elements.
struct Found<S: Wide> {
    path_rate: Lanes<S>,
    acceleration: Lanes<S>,
    inner: Lanes<S>,
    normal: [Lanes<S>; 2],
    outer: Lanes<S>,
    approach: Lanes<S>,
    pushing: [Lanes<S>; 2],
}

/// Forces on the inner ring along x and y, then on the outer, by lanes.
type Sums = [[f64; QUAD]; 4];

/// u' and w' only.
struct Rates<'a>(Smooth<'a>);

/// u' and w', and then what is kept: both forces, the direction of q, both approaches, both lengths that tell whether a
/// contact pushes.
struct Everything<'a>(Smooth<'a>);

/// What is kept of each contact, for whoever wants to know more than the sums. Its lists are made once.
#[derive(Debug, Clone, Default)]
pub struct Record {
    /// Force of the inner contact Q_i of each element [N].
    pub inner: Vec<f64>,
    /// Direction of q of each element, its radial part.
    pub normal_radial: Vec<f64>,
    /// Direction of q of each element, its tangential part.
    pub normal_tangential: Vec<f64>,
    /// Force of the outer contact of each element [N].
    pub outer: Vec<f64>,
    /// Outer contact force on each element, inwards [N].
    pub outer_radial: Vec<f64>,
    /// Outer contact force on each element, counter-clockwise [N].
    pub outer_tangential: Vec<f64>,
    /// Approach of the inner contact [m]: negative when there is a gap.
    pub inner_approach: Vec<f64>,
    /// Equivalent approach of the outer contact [m].
    pub outer_approach: Vec<f64>,
    /// How clearly the inner contact pushes ([`crate::contact::force_law::ForceLaw::pushing`]) [m].
    pub inner_pushing: Vec<f64>,
    /// How clearly the outer contact pushes [m].
    pub outer_pushing: Vec<f64>,
    /// u' of each element [m/s].
    pub path_rate: Vec<f64>,
}

impl Record {
    /// Room for `places` elements.
    pub(super) fn new(places: usize) -> Self {
        let zeros = || vec![0.0; places];
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
        }
    }
}

impl Model {
    /// Smooth contacts of all elements: their part of the derivative, and, if `RECORD`, each of them. Gives their force on the
    /// inner ring and on the outer.
    #[inline(always)]
    pub(super) fn smooth_contacts<S: Wide, const RECORD: bool>(
        &self,
        simd: S,
        at: &Moment,
        state: &[f64],
        derivative: &mut [f64],
        forces: &mut Forces,
    ) -> [f64; 4] {
        let (count, start) = (self.element_count, self.layout.radial_velocity);
        let (each, outer, others) = (&self.each, &forces.smooth_outer[..], &forces.other_outer[..]);
        let from =
            [&each.cos, &each.sin, &each.present, &each.per_mass, &each.inner, outer, others, state, &state[start..]];
        let (path_rate, acceleration) = derivative.split_at_mut(start);
        let (smooth, mut sums) = (Smooth { model: self, at }, [[0.0; QUAD]; 4]);
        if RECORD {
            let Record {
                inner,
                normal_radial,
                normal_tangential,
                outer_radial,
                inner_approach,
                inner_pushing,
                outer_pushing,
                outer,
                outer_tangential,
                outer_approach,
                path_rate: kept_rate,
            } = &mut forces.contacts;
            outer_tangential.fill(0.0);
            let to = [
                &mut *path_rate,
                acceleration,
                inner,
                normal_radial,
                normal_tangential,
                outer,
                inner_approach,
                inner_pushing,
                outer_pushing,
            ];
            Lists { from, to }.for_each(simd, count, &Everything(smooth), &mut sums);
            outer_radial.copy_from_slice(outer);
            outer_approach.copy_from_slice(&state[..start]);
            kept_rate.copy_from_slice(path_rate);
        } else {
            Lists { from, to: [path_rate, acceleration] }.for_each(simd, count, &Rates(smooth), &mut sums);
        }
        let [shaft_x, shaft_y, housing_x, housing_y] = sums;
        [-sum_of(shaft_x), -sum_of(shaft_y), sum_of(housing_x), sum_of(housing_y)]
    }
}

impl Smooth<'_> {
    #[inline(always)]
    fn contacts<S: Wide>(
        &self,
        simd: S,
        [cos, sin, present, per_mass, inner, outer, other, u, w]: [Lanes<S>; FROM],
        sums: &mut Sums,
    ) -> Found<S> {
        let (model, at) = (self.model, self.at);
        let (cage_cos, cage_sin) = (Lanes::splat(simd, at.cage.0), Lanes::splat(simd, at.cage.1));
        let e_r = [cage_cos * cos - cage_sin * sin, cage_sin * cos + cage_cos * sin];
        let rho = Lanes::splat(simd, model.outer_centre_radius) + u;
        let path_rate = w - dot(simd, at.housing.velocity, e_r);

        // |q| = √((ρ+p)² + t²), written so that δ_i loses no digits to the radii's 20 mm.
        let (p, t) = (dot(simd, at.offset, e_r), dot(simd, turned(at.offset), e_r));
        let (q_r, square) = (rho + p, t * t);
        let distance = (q_r * q_r + square).sqrt();
        let per_distance = Lanes::splat(simd, 1.0) / distance;
        let delta = Lanes::splat(simd, -model.radial_clearance) - u - p - square / (distance + q_r);
        let (n_r, n_t) = (q_r * per_distance, t * per_distance);
        let along = dot(simd, turned(at.drift), e_r) + rho * Lanes::splat(simd, at.omega);
        let opening = n_r * (dot(simd, at.drift, e_r) + path_rate) + n_t * along;

        let law = Law { a: Lanes::splat(simd, at.damping[0]), b: Lanes::splat(simd, at.damping[1]) };
        let inner = law.force(inner, delta, -opening);
        let outer = law.force(outer, u, path_rate);
        let turning = rho * Lanes::splat(simd, at.omega * at.omega);
        let acceleration = (inner * n_r - outer) * per_mass + other + (dot(simd, at.body, e_r) + turning) * present;

        (inner * (n_r * e_r[0] - n_t * e_r[1])).add_to(&mut sums[0]);
        (inner * (n_r * e_r[1] + n_t * e_r[0])).add_to(&mut sums[1]);
        (outer * e_r[0]).add_to(&mut sums[2]);
        (outer * e_r[1]).add_to(&mut sums[3]);

        let damping = model.inner.damping;
        Found {
            path_rate: path_rate * present,
            acceleration,
            inner,
            normal: [n_r, n_t],
            outer,
            approach: delta * present,
            pushing: [
                law.pushing(simd, damping, delta, -opening) * present,
                law.pushing(simd, damping, u, path_rate) * present,
            ],
        }
    }
}

impl Each<FROM, 2> for Rates<'_> {
    type Sum = Sums;

    #[inline(always)]
    fn places<S: Wide>(&self, simd: S, from: [Lanes<S>; FROM], sums: &mut Sums) -> [Lanes<S>; 2] {
        let found = self.0.contacts(simd, from, sums);
        [found.path_rate, found.acceleration]
    }
}

impl Each<FROM, 9> for Everything<'_> {
    type Sum = Sums;

    #[inline(always)]
    fn places<S: Wide>(&self, simd: S, from: [Lanes<S>; FROM], sums: &mut Sums) -> [Lanes<S>; 9] {
        let Found { path_rate, acceleration, inner, normal, outer, approach, pushing } =
            self.0.contacts(simd, from, sums);
        [path_rate, acceleration, inner, normal[0], normal[1], outer, approach, pushing[0], pushing[1]]
    }
}

/// a·e with the same vector for all lanes.
#[inline(always)]
fn dot<S: Wide>(simd: S, a: [f64; 2], e: [Lanes<S>; 2]) -> Lanes<S> {
    Lanes::splat(simd, a[0]) * e[0] + Lanes::splat(simd, a[1]) * e[1]
}

/// A vector whose component along e_r is that of `a` along e_t.
#[inline(always)]
fn turned(a: [f64; 2]) -> [f64; 2] {
    [a[1], -a[0]]
}

/// a and b of the damping law in all lanes.
struct Law<S: Wide> {
    a: Lanes<S>,
    b: Lanes<S>,
}

impl<S: Wide> Law<S> {
    #[inline(always)]
    fn force(&self, stiffness: Lanes<S>, delta: Lanes<S>, rate: Lanes<S>) -> Lanes<S> {
        let delta = delta.or_zero();
        stiffness * delta.sqrt() * (delta + (self.a * delta + self.b) * rate).or_zero()
    }

    #[inline(always)]
    fn pushing(&self, simd: S, damping: Damping, delta: Lanes<S>, rate: Lanes<S>) -> Lanes<S> {
        match damping {
            Damping::HuntCrossley(_) => {
                delta.at_most(Lanes::splat(simd, PUSHING_LENGTH) * (Lanes::splat(simd, 1.0) + self.a * rate))
            }
            Damping::Proportional(_) => delta + (self.b * rate).at_most(Lanes::splat(simd, 0.0)),
        }
    }
}
