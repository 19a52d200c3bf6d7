//! Balls on smooth grooves to first order, several side by side, by few numbers: the inner contact by the inner ring's
//! own coordinates and velocities, the outer one by the ball's.
//!
//! All else is sign and turning. With D the derivatives of a force of the inner contact by x_i and v_i, with e_r and
//! e_t the ball's directions and E = ∂(e_r·v_o, ż_o)/∂v_o what the outer ring carries it with,
//! ```text
//! ∂u = −e_r·D_x − ω e_t·D_v   ∂v = −D_z   ∂u' = −e_r·D_v   ∂v' = −D_ż        ∂x_o = −D_x   ∂v_o = −D_v − E (∂u', ∂v')
//! ```
//! as q_i = q_o + x_o − x_i, q̇_o = (u', ρ ω, v') and u' = w − e_r·v_o, v' = w_z − ż_o. The outer ring does not tilt.

use crate::contact::law::{DampedLaw, Point};
use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::derivatives::arrow::{ArrowJacobian, Block};
use crate::dynamics::element::{Element, GrooveCircle, Meridian, Raceway, Shifted, Tilted, View};
use crate::dynamics::parameters::{COORDINATES, FramedKinematics, Model, RINGS, RingInSpace, Space};
use crate::dynamics::spatial::rates;
use crate::numerics::lanes::{Kernel, Lanes, WIDEST, Wide};
use crate::numerics::number::Dual;

/// Coordinates of a ring that does not tilt, and the derivatives by those and their velocities, and by all.
const SHIFTS: usize = 3;
const BY_SHIFTS: usize = 2 * SHIFTS;
const BY_ALL: usize = 2 * COORDINATES;
/// Derivatives by u, v and their rates.
const BY_BALL: usize = 4;

/// Forces of the inner contact on the ball along e_r and z, and along the ring's coordinates.
const INNER: usize = 2 + COORDINATES;

/// The smooth balls of a bearing.
pub(super) struct SmoothBalls<'a, F, const B: usize> {
    pub(super) model: &'a Model,
    pub(super) space: &'a Space,
    pub(super) now: &'a FramedKinematics,
    pub(super) rings: &'a [RingInSpace; 2],
    pub(super) state: &'a [f64],
    /// Which balls they are.
    pub(super) is_smooth: F,
    pub(super) inverse_inertia: &'a [f64; RINGS],
    pub(super) jacobian: &'a mut ArrowJacobian<2, RINGS, B>,
    pub(super) shortcuts: &'a mut Shortcuts,
}

/// Numbers of several balls, ball by ball last.
type Rows<const ROWS: usize, const COLUMNS: usize> = [[[f64; WIDEST]; COLUMNS]; ROWS];

/// Some balls.
struct Group {
    e_r: [[f64; WIDEST]; 2],
    omega: [f64; WIDEST],
    /// u, v, u', v'
    at: [[f64; WIDEST]; BY_BALL],
}

/// Their forces to first order.
struct FirstOrder<const K: usize> {
    inner: Rows<INNER, K>,
    outer: Rows<2, BY_BALL>,
}

impl<F: Fn(usize) -> bool, const B: usize> Kernel for SmoothBalls<'_, F, B> {
    type Output = ();

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) {
        if self.space.tilts {
            self.tilted(simd);
        } else {
            let [offset, drift] = apart::<S, BY_SHIFTS>(simd, self.rings);
            self.seen(simd, &Shifted::<_, SHIFTS, false> { offset, drift });
        }
    }
}

/// Offset and drift of the outer ring from the inner one, by the inner one's coordinates and velocities.
#[inline(always)]
fn apart<S: Wide, const K: usize>(simd: S, [inner, outer]: &[RingInSpace; 2]) -> [[Dual<Lanes<S>, K>; SHIFTS]; 2] {
    let by_own = |between: f64, direction: usize| {
        let mut number = Dual::constant(Lanes::splat(simd, between));
        number.by[direction] = Lanes::splat(simd, -1.0);
        number
    };
    [
        [0, 1, 2].map(|k: usize| by_own(outer.position[k] - inner.position[k], k)),
        [0, 1, 2].map(|k: usize| by_own(outer.velocity[k] - inner.velocity[k], K / 2 + k)),
    ]
}

impl<F: Fn(usize) -> bool, const B: usize> SmoothBalls<'_, F, B> {
    #[inline(always)]
    fn tilted<S: Wide>(self, simd: S) {
        let variable = |of: &[f64; COORDINATES], first: usize| {
            [0, 1].map(|k: usize| Dual::variable(Lanes::splat(simd, of[SHIFTS + k]), first + k))
        };
        let inner = &self.rings[0];
        let (tilt, tilting) = (variable(&inner.position, SHIFTS), variable(&inner.velocity, COORDINATES + SHIFTS));
        let view = Tilted::new(apart::<S, BY_ALL>(simd, self.rings), tilt, tilting);
        self.seen(simd, &view);
    }

    /// As the inner ring sees them.
    #[inline(always)]
    fn seen<S: Wide, const K: usize, V>(mut self, simd: S, view: &V)
    where
        V: View<Dual<Lanes<S>, K>, 2, COORDINATES>,
    {
        let mut rest = 0..self.model.element_count;
        loop {
            let (mut balls, mut count) = ([0; WIDEST], 0);
            for j in rest.by_ref().filter(|&j| (self.is_smooth)(j)).take(WIDEST) {
                (balls[count], count) = (j, count + 1);
            }
            let balls = &balls[..count];
            if balls.is_empty() {
                break;
            }
            let group = self.gathered(balls);
            let mut found = FirstOrder { inner: [[[0.0; WIDEST]; K]; INNER], outer: [[[0.0; WIDEST]; BY_BALL]; 2] };
            for part in 0..balls.len().div_ceil(S::F64_LANES) {
                self.to_first_order(simd, view, &group, part, &mut found);
            }
            for (i, &ball) in balls.iter().enumerate() {
                self.put(ball, i, &group, &found);
            }
        }
    }

    fn gathered(&mut self, balls: &[usize]) -> Group {
        let (model, state) = (self.model, self.state);
        let ([_, v], [w, w_z]) = (self.jacobian.starts[0], self.jacobian.starts[1]);
        // What is no ball is where another is: no number there is infinite.
        let mut group =
            Group { e_r: [[1.0; WIDEST], [0.0; WIDEST]], omega: [0.0; WIDEST], at: [[0.0; WIDEST]; BY_BALL] };
        for (i, &j) in balls.iter().enumerate() {
            let lead = model.lead_with(j, self.now.cage_angle(), &mut self.shortcuts.leads);
            let e_r: [f64; 2] = model.direction_with(j, &self.now.cage, &lead).into();
            let [u_rate, v_rate] = rates(e_r, [state[w + j], state[w_z + j]], &self.rings[1]);
            (group.e_r[0][i], group.e_r[1][i]) = (e_r[0], e_r[1]);
            [group.omega[i], _] = lead.speed(&self.now.cage);
            for (list, value) in group.at.iter_mut().zip([state[j], state[v + j], u_rate, v_rate]) {
                list[i] = value;
            }
        }
        group
    }

    /// Some balls' contacts.
    #[inline(always)]
    fn to_first_order<S: Wide, const K: usize, V>(
        &self,
        simd: S,
        view: &V,
        group: &Group,
        part: usize,
        found: &mut FirstOrder<K>,
    ) where
        V: View<Dual<Lanes<S>, K>, 2, COORDINATES>,
    {
        let (model, space) = (self.model, self.space);
        let (number, of) =
            (|number: f64| Lanes::splat(simd, number), |list: &[f64; WIDEST]| Lanes::part(simd, list, part));
        let law = DampedLaw::new(model.inner.contact.law.damping, Point, number);
        let groove = |side: usize| GrooveCircle {
            groove: &space.grooves[side],
            law,
            across_damping: number(space.across_damping),
        };
        let constant = |side: usize| number([&model.inner, &model.outer][side].contact.law.stiffness);
        let [u, v, u_rate, v_rate] = [0, 1, 2, 3].map(|k: usize| of(&group.at[k]));
        let still = Dual::constant;
        let ball = Element {
            e_r: [still(of(&group.e_r[0])), still(of(&group.e_r[1]))],
            at: [still(u), still(v)],
            rate: [still(u_rate), still(v_rate)],
            rho: still(number(model.outer_centre_radius) + u),
            omega: still(of(&group.omega)),
        };
        let (at, seen) = view.see(&ball);
        let force = groove(0).contact(constant(0), &at).force;
        let ([radial, axial], _) = V::on_element(&seen, force);
        let on_ring = V::along_ring(&ball, &seen, force);
        for (row, force) in found.inner.iter_mut().zip([radial, axial].iter().chain(&on_ring)) {
            (0..K).for_each(|k| force.by[k].put(&mut row[k], part));
        }
        let at = Meridian {
            at: [Dual::<_, BY_BALL>::variable(u, 0), Dual::variable(v, 1)],
            rate: [Dual::variable(u_rate, 2), Dual::variable(v_rate, 3)],
        };
        let force = groove(1).contact(constant(1), &at).force;
        for (row, force) in found.outer.iter_mut().zip(&force) {
            (0..BY_BALL).for_each(|k| force.by[k].put(&mut row[k], part));
        }
    }

    /// Puts ball `j`, number `i` of its group, in.
    fn put<const K: usize>(&mut self, j: usize, i: usize, group: &Group, found: &FirstOrder<K>) {
        let (e, omega, per_mass) = ([group.e_r[0][i], group.e_r[1][i]], group.omega[i], self.model.per_mass_of(j));
        let own = |row: usize| Inner::<K> { by: [0.0; K], e, omega }.of(&found.inner[row], i);
        let outer = |row: usize| found.outer[row].map(|column| column[i]);
        let ArrowJacobian { elements, by_position, by_velocity, .. } = &mut *self.jacobian;
        let block = &mut elements[j];
        *block = Block::none();
        (block.carried[(0, COORDINATES)], block.carried[(0, COORDINATES + 1)]) = (e[0], e[1]);
        block.carried[(1, COORDINATES + 2)] = 1.0;
        for n in 0..2 {
            let inner = own(n);
            let (of_inner, of_outer) = (inner.by_ball(), outer(n));
            let by_ball = [0, 1, 2, 3].map(|k: usize| per_mass * (of_inner[k] + of_outer[k]));
            for m in 0..2 {
                (block.by_place[(n, m)], block.by_rate[(n, m)]) = (by_ball[m], by_ball[2 + m]);
            }
            for k in 0..K / 2 {
                (block.by_position[(n, k)], block.by_velocity[(n, k)]) =
                    (per_mass * inner.by[k], per_mass * inner.by[K / 2 + k]);
            }
            for k in 0..SHIFTS {
                let outer = COORDINATES + k;
                block.by_position[(n, outer)] = -block.by_position[(n, k)];
                block.by_velocity[(n, outer)] = -block.by_velocity[(n, k)] - carried(e, k, [by_ball[2], by_ball[3]]);
            }
        }
        block.by_place[(0, 0)] += omega * omega;
        (block.by_velocity[(0, COORDINATES)], block.by_velocity[(0, COORDINATES + 1)]) = (
            block.by_velocity[(0, COORDINATES)] - omega * e[1],
            block.by_velocity[(0, COORDINATES + 1)] + omega * e[0],
        );
        for i in 0..COORDINATES {
            let (inverse, inner) = (-self.inverse_inertia[i], own(2 + i));
            let by_ball = inner.by_ball().map(|by| inverse * by);
            for n in 0..2 {
                (block.rings_by_place[(i, n)], block.rings_by_rate[(i, n)]) = (by_ball[n], by_ball[2 + n]);
            }
            for k in 0..K / 2 {
                by_position[(i, k)] += inverse * inner.by[k];
                by_velocity[(i, k)] += inverse * inner.by[K / 2 + k];
            }
            for k in 0..SHIFTS {
                by_position[(i, COORDINATES + k)] -= inverse * inner.by[k];
                by_velocity[(i, COORDINATES + k)] -=
                    inverse * inner.by[K / 2 + k] + carried(e, k, [by_ball[2], by_ball[3]]);
            }
        }
        let [radial, axial] = [outer(0), outer(1)];
        for k in 0..SHIFTS {
            let row = COORDINATES + k;
            let inverse = -self.inverse_inertia[row];
            let by_ball = [0, 1, 2, 3].map(|n: usize| inverse * carried(e, k, [radial[n], axial[n]]));
            for n in 0..2 {
                (block.rings_by_place[(row, n)], block.rings_by_rate[(row, n)]) = (by_ball[n], by_ball[2 + n]);
            }
            for k in 0..SHIFTS {
                by_velocity[(row, COORDINATES + k)] -= carried(e, k, [by_ball[2], by_ball[3]]);
            }
        }
    }
}

/// The part along x, y or z of what has these parts along e_r and z.
fn carried(e_r: [f64; 2], k: usize, [radial, axial]: [f64; 2]) -> f64 {
    if k < 2 { e_r[k] * radial } else { axial }
}

/// Derivatives of a force of the inner contact, by the inner ring's coordinates and velocities.
struct Inner<const K: usize> {
    by: [f64; K],
    e: [f64; 2],
    omega: f64,
}

impl<const K: usize> Inner<K> {
    /// That of ball `i`.
    fn of(mut self, row: &[[f64; WIDEST]; K], i: usize) -> Self {
        (0..K).for_each(|k| self.by[k] = row[k][i]);
        self
    }

    /// The same by u, v, u' and v'.
    fn by_ball(&self) -> [f64; BY_BALL] {
        let (by, [e_x, e_y], going) = (&self.by, self.e, K / 2);
        let around = e_x * by[going + 1] - e_y * by[going];
        [
            -(e_x * by[0] + e_y * by[1] + self.omega * around),
            -by[2],
            -(e_x * by[going] + e_y * by[going + 1]),
            -by[going + 2],
        ]
    }
}
