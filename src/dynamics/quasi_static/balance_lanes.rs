//! Elements without inertia on smooth rigid raceways, several at a time: each in radial balance at every instant.
//!
//! The equations are those of [`super::element_balance`], of which this is the form without defects,
//! ```text
//! R(u) = Q_i(δ_i(u)) n_r − Q_o(u) + B = 0,   δ_i = −G − u − p − …,   B = m (g·e_r + (R_o − r) ω²)
//! ```
//! with the names of [`crate::dynamics::element`]. R falls with u and has its root between the
//! raceways' touching paths, widened on the side to which B pushes by the approach under B; that of a contact of
//! constant K is below (|B|/K)^(1/4) metres. Newton's method from the path last known, halving where it would leave the
//! bracket. An element that has settled stays where it is while others of its register go on, so that the registers'
//! width changes no bit.
//!
//! A lane without an element, or with one that is looked for alone, has constants 0 and no force.

use crate::contact::law::{DampedLaw, Elastic, PUSHING_LENGTH, Point};
use crate::dynamics::contacts::{Forces, InnerGap, Record};
use crate::dynamics::element::{dot, radial};
use crate::dynamics::parameters::{ElementBlock, Kinematics, Model, Stage};
use crate::numerics::lanes::{Kernel, Lanes, QUAD, Sums, WIDEST, Wide, blocks, blocks_mut, largest_of};
use crate::numerics::plane::Vector;
use crate::scene::Damping;

/// Newton's step (m) after which the next is below rounding: what is left is a quarter of its square over the approach,
/// 5e-20 m under load; under an element's own weight, where the approach is 1e-8 m, it is 1e-10 N.
const SETTLED: f64 = 1e-12;
/// Most iterations: halving a millimetre down to the last digit, and some of Newton's.
const MOST_ITERATIONS: usize = 100;
/// Least stiffness (N/m): for an element that touches nothing, where Newton's step is then beyond any bracket.
const NO_STIFFNESS: f64 = 1e-30;

/// All smooth elements of a bearing; gives their force on the inner and on the outer ring. Each contact is kept if
/// `RECORD`.
pub(in crate::dynamics) struct SmoothElements<'a, const RECORD: bool> {
    pub(in crate::dynamics) model: &'a Model,
    pub(in crate::dynamics) now: &'a Kinematics,
    pub(in crate::dynamics) stage: &'a Stage<'a>,
    pub(in crate::dynamics) derivative: &'a mut [f64],
    pub(in crate::dynamics) forces: &'a mut Forces,
}

impl<const RECORD: bool> Kernel for SmoothElements<'_, RECORD> {
    type Output = [f64; 4];

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) -> [f64; 4] {
        match self.model.inner.contact.law.elasticity.line() {
            None => self.elements(simd, Point),
            Some(line) => self.elements(simd, line),
        }
    }
}

impl<const RECORD: bool> SmoothElements<'_, RECORD> {
    #[inline(always)]
    fn elements<S: Wide, E: Elastic>(self, simd: S, elastic: E) -> [f64; 4] {
        let Self { model, now, stage, derivative, forces } = self;
        let shared = Shared::new(model, now, elastic);
        let mut sums = Sums::new(simd);
        let Forces { elements, contacts, .. } = forces;
        if RECORD {
            contacts.outer_tangential.fill(0.0);
        }
        let (state, derivative) = (blocks(stage.state), blocks_mut(derivative));
        let start = model.layout.radial_velocity / WIDEST;
        for (k, block) in elements.iter().enumerate() {
            for part in 0..WIDEST / S::F64_LANES {
                if (k * WIDEST + part * S::F64_LANES) >= model.element_count {
                    break;
                }
                let of = |numbers: &[f64; WIDEST]| Lanes::part(simd, numbers, part);
                let at = shared.element_lanes(simd, block, of);
                let known = [of(&state[k]), of(&state[start + k])];
                let element = shared.balanced(&at, known, stage.ahead).damped(&shared, &at);
                element.path_rate.put(&mut derivative[k], part);
                sums.add(part, &element.forces(&at));
                if RECORD {
                    element.keep(&at, contacts, k, part);
                }
            }
        }
        // Forces on elements were added: of inner contacts, then of outer ones against e_r.
        let [shaft_x, shaft_y, housing_x, housing_y] = sums.totals();
        [-shaft_x, -shaft_y, housing_x, housing_y]
    }
}

/// What all elements share at one instant.
struct Shared<'a, E> {
    model: &'a Model,
    now: &'a Kinematics,
    elastic: E,
    offset: Vector,
    drift: Vector,
    /// As [`Model::nearly_concentric`] has it.
    series: bool,
    damping: Damping,
}

/// Some elements: where they are on their way round, and what their contacts are.
#[derive(Clone, Copy)]
struct ElementLanes<S: Wide> {
    simd: S,
    e_r: [Lanes<S>; 2],
    e_t: [Lanes<S>; 2],
    present: Lanes<S>,
    /// 1 where contacts are smooth, else 0.
    on: Lanes<S>,
    /// Constants of the contacts; 1 where they are not smooth.
    constants: [Lanes<S>; 2],
    /// Along and across e_r.
    offset: [Lanes<S>; 2],
    drift: [Lanes<S>; 2],
    speed: Lanes<S>,
    /// R_o − r and the clearance (m).
    radius: Lanes<S>,
    clearance: Lanes<S>,
    /// Weight and centrifugal force (N), and its rate (N/s).
    body: Lanes<S>,
    body_rate: Lanes<S>,
    /// Velocity of the outer ring along e_r.
    along: Lanes<S>,
}

/// Elements in balance.
#[derive(Clone, Copy)]
struct Balanced<S: Wide> {
    path: Lanes<S>,
    path_rate: Lanes<S>,
    gap: InnerGap<Lanes<S>>,
    /// Forces and stiffnesses of the inner and of the outer contact.
    forces: [Lanes<S>; 2],
    stiffness: [Lanes<S>; 2],
}

impl<'a, E: Elastic> Shared<'a, E> {
    #[inline(always)]
    fn new(model: &'a Model, now: &'a Kinematics, elastic: E) -> Self {
        let offset = now.offset();
        let series = model.nearly_concentric(offset);
        let damping = model.dampers.as_deref().map_or(Damping::HuntCrossley(0.0), |[inner, _]| inner.law.damping);
        Self { model, now, elastic, offset, drift: now.drift(), series, damping }
    }

    #[inline(always)]
    fn element_lanes<S: Wide>(
        &self,
        simd: S,
        block: &ElementBlock,
        of: impl Fn(&[f64; WIDEST]) -> Lanes<S>,
    ) -> ElementLanes<S> {
        let (model, now) = (self.model, self.now);
        let number = |number: f64| Lanes::splat(simd, number);
        let e_r = radial(simd, now.cage.direction, block, &of);
        let e_t = [-e_r[1], e_r[0]];
        let (inner, one) = (of(&block.inner), number(1.0));
        // Constants of contacts are far above 1, or 0 for what is no smooth contact.
        let on = inner.at_most(one);
        let speed = of(&block.pace) * number(now.cage.speed);
        let (mass, larger) = (of(&block.mass), of(&block.larger));
        let radius = number(model.outer_centre_radius) - number(0.5) * larger;
        let nominal = number(now.cage.speed);
        let alpha = of(&block.pace) * number(now.cage.acceleration) + of(&block.pace_by_angle) * (nominal * nominal);
        ElementLanes {
            simd,
            e_r,
            e_t,
            present: of(&block.present),
            on,
            constants: [inner + (one - on), of(&block.outer) + (one - on)],
            offset: [dot(simd, self.offset, e_r), dot(simd, self.offset, e_t)],
            drift: [dot(simd, self.drift, e_r), dot(simd, self.drift, e_t)],
            speed,
            radius,
            clearance: number(model.radial_clearance) - larger,
            body: (dot(simd, model.gravity, e_r) + radius * (speed * speed)) * (mass * on),
            body_rate: (dot(simd, model.gravity, e_t) + number(2.0) * radius * alpha) * (speed * (mass * on)),
            along: dot(simd, now.housing.velocity, e_r),
        }
    }

    /// The inner contact's gap at a path.
    #[inline(always)]
    fn gap<S: Wide>(&self, at: &ElementLanes<S>, u: Lanes<S>) -> InnerGap<Lanes<S>> {
        let gap = InnerGap::of(at.radius + u, u, at.offset, at.clearance, self.series);
        InnerGap { approach: gap.approach * at.on, ..gap }
    }

    /// Force and tangent stiffness of a contact.
    #[inline(always)]
    fn contact<S: Wide>(&self, constant: Lanes<S>, approach: Lanes<S>) -> [Lanes<S>; 2] {
        let approach = approach.or_zero();
        let [secant, order] = self.elastic.secant_and_order(constant, approach);
        [secant * approach, order * secant]
    }

    /// Paths and elastic forces, looked for from what is known of path and radial velocity.
    #[inline(always)]
    fn balanced<S: Wide>(&self, at: &ElementLanes<S>, [u, w]: [Lanes<S>; 2], ahead: Option<f64>) -> Balanced<S> {
        let number = |number: f64| Lanes::splat(at.simd, number);
        let zero = number(0.0);
        let guess = ahead.map_or(u, |ahead| u + number(ahead) * (w - at.along)) * at.on;
        let (mut low, mut high) = self.bracket(at, guess);
        let mut u = guess.at_least(low).at_most(high);
        let (settled, mut iteration) = (number(SETTLED), 0);
        loop {
            iteration += 1;
            let gap = self.gap(at, u);
            let n_r = gap.n[0];
            let [inner, k_i] = self.contact(at.constants[0], gap.approach);
            let [outer, k_o] = self.contact(at.constants[1], u);
            let force = inner * n_r - outer + at.body;
            let (along, slope) = (k_i * n_r, k_i * (n_r * n_r) + k_o);
            let newton = u + force / slope.at_least(number(NO_STIFFNESS));
            let (step, change) = ((newton - u).abs(), newton - u);
            let mut open = [-1.0; QUAD];
            (step - settled).largest_to(&mut open);
            if largest_of(open) <= 0.0 || iteration == MOST_ITERATIONS {
                let unknown = settled.if_less(step, number(f64::NAN), zero);
                let stiffness = [k_i, k_o];
                let forces = [(inner - along * change).or_zero() + unknown, (outer + k_o * change).or_zero() + unknown];
                let gap = InnerGap { approach: gap.approach - n_r * change, ..gap };
                return Balanced { path: newton, path_rate: zero, gap, forces, stiffness };
            }
            low = zero.if_less(force, u, low);
            high = zero.if_less(force, high, u);
            let middle = number(0.5) * (low + high);
            let next = low.if_less(newton, newton.if_less(high, newton, middle), middle);
            u = settled.if_less(step, next, u);
        }
    }

    /// Between which paths the balance is.
    #[inline(always)]
    fn bracket<S: Wide>(&self, at: &ElementLanes<S>, guess: Lanes<S>) -> (Lanes<S>, Lanes<S>) {
        let number = |number: f64| Lanes::splat(at.simd, number);
        // The path at which the inner contact touches, except for what the offset's direction makes of it on the way.
        let touching = (self.gap(at, guess).approach + guess) * number(1.0 + 1e-5);
        let zero = number(0.0);
        let low = touching.at_most(zero) - ((-at.body).or_zero() / at.constants[0]).sqrt().sqrt();
        let high = touching.or_zero() + (at.body.or_zero() / at.constants[1]).sqrt().sqrt();
        (at.body.if_less(zero, low, zero), high)
    }
}

impl<S: Wide> Balanced<S> {
    /// Rates, and what damping changes of the forces.
    #[inline(always)]
    fn damped<E: Elastic>(self, shared: &Shared<E>, at: &ElementLanes<S>) -> Self {
        let number = |number: f64| Lanes::splat(at.simd, number);
        let Self { path, gap, forces: [inner, outer], stiffness: [k_i, k_o], .. } = self;
        let ([n_r, n_t], none) = (gap.n, number(NO_STIFFNESS));
        // While the path stands.
        let q_rate = InnerGap::q_rate(at.drift, number(0.0), at.radius + path, at.speed);
        let (closing, turning) = (gap.closing(q_rate), at.speed - gap.turning(q_rate));
        let push = inner * (n_t * turning) + k_i * (n_r * closing) + at.body_rate;
        let contacts = k_i * (n_r * n_r) + k_o;
        let path_rate = push / (contacts - inner * (n_t * n_t) / gap.distance).at_least(none);
        // Where nothing touches there is no rate.
        let path_rate = none.if_less(contacts, path_rate, number(0.0));

        let law = DampedLaw::new(shared.damping, shared.elastic, number);
        let closing = closing - n_r * path_rate;
        let d_i = law.damping_of(inner, k_i, closing).at_least(-inner);
        let d_o = law.damping_of(outer, k_o, path_rate).at_least(-outer);
        let change = (d_o * (k_i * (n_r * n_r)) + d_i * (n_r * k_o)) / contacts.at_least(none);
        let change = change.at_least(-(inner * n_r).at_most(outer));
        let path_rate = path_rate * at.on;
        Self { path_rate, forces: [(inner + change / n_r) * at.on, (outer + change) * at.on], ..self }
    }

    /// Forces on the element along x and y, of the inner contact and then of the outer.
    #[inline(always)]
    fn forces(&self, at: &ElementLanes<S>) -> [Lanes<S>; 4] {
        let ([inner, outer], [n_r, n_t]) = (self.forces, self.gap.n);
        [
            inner * (n_r * at.e_r[0] + n_t * at.e_t[0]),
            inner * (n_r * at.e_r[1] + n_t * at.e_t[1]),
            outer * at.e_r[0],
            outer * at.e_r[1],
        ]
    }

    /// Puts what is kept into `contacts`.
    #[inline(always)]
    fn keep(&self, at: &ElementLanes<S>, contacts: &mut Record, block: usize, part: usize) {
        let pushing_length = Lanes::splat(at.simd, PUSHING_LENGTH);
        let Self { path, path_rate, gap, forces: [inner, outer], .. } = *self;
        let [known_path, known_velocity] = &mut contacts.balanced;
        for (list, value) in [
            (&mut contacts.inner, inner),
            (&mut contacts.normal_radial, gap.n[0]),
            (&mut contacts.normal_tangential, gap.n[1]),
            (&mut contacts.outer, outer),
            (&mut contacts.outer_radial, outer),
            (&mut contacts.inner_approach, gap.approach),
            (&mut contacts.outer_approach, path),
            (&mut contacts.inner_pushing, gap.approach.at_most(pushing_length)),
            (&mut contacts.outer_pushing, path.at_most(pushing_length)),
            (&mut contacts.path_rate, path_rate),
            (known_path, path),
            (known_velocity, path_rate + at.along),
        ] {
            (value * at.present).put(&mut blocks_mut(list)[block], part);
        }
    }
}
