//! A ball in balance between both grooves, and what that makes of the forces on the rings.
//!
//! With F the force of both contacts on the ball and ω its speed about the outer ring's centre,
//! ```text
//! R_r = F·e_r + m (g·e_r + ρ ω²) = 0     R_z = F_z + m g_z = 0
//! ```
//! *There is one balance* of a ball that touches a groove. At rest both contacts' energies are convex in (u, v), as a
//! distance from a point is; that the grooves' centres form circles and that the centrifugal force grows outwards
//! changes that by d/R_o, a hundredth, of the weakest of it. R_r therefore falls with u at each v, and along the u
//! where it vanishes R_z falls with v: two searches for a zero of a falling function, one within the other, find it
//! from anywhere. Newton's method in both finds it in a twentieth of the time, nearly always, and is tried first.
//!
//! A ball that nothing touches or moves rests against the outer groove without force where it is. One
//! that nothing touches and whose weight and centrifugal force cancel within its clearance, to 1e-3 of either, has two
//! balances: on either groove, under no force to speak of.
//!
//! With the ball in balance the forces f on the rings by the rings' positions x are
//! ```text
//! df/dx = f_x − f_b R_b⁻¹ R_x          b = (u, v)
//! ```

use super::Spatial;
use super::chained::{MOVING, STANDING};
use super::contacts::{BallForces, BallMotion};
use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::element::{Element, views};
use crate::dynamics::parameters::{COORDINATES, Model, RINGS, Space};
use crate::dynamics::quasi_static::PathSearch;
use crate::numerics::number::{Dual, Scalar};

/// Rounding of distances of some 20 mm (m): a step shorter than this is none.
const ROUNDING: f64 = 2e-18;
/// First step of a search that nothing brackets (m); each next one is twice as long.
const FIRST_STRIDE: f64 = 1e-6;
/// Longest of Newton's steps (m).
const LONGEST_STEP: f64 = 20e-6;
/// Most steps of a search.
const MOST_STEPS: usize = 200;
/// Most steps of Newton's method in u and v, and the step from which on the next one is exact to rounding (m).
const MOST_NEWTON_STEPS: usize = 16;
const SETTLED: f64 = 1e-14;

/// A ball in balance.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct BalancedBall {
    /// u and v (m).
    pub(in crate::dynamics) at: [f64; 2],
    /// R_r and R_z that are left (N).
    pub(in crate::dynamics) residual: [f64; 2],
    /// Its contacts.
    pub(in crate::dynamics) forces: BallForces,
}

/// Derivatives of a ball's forces on the rings, by coordinates of both rings, the ball keeping its balance.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct BallTangent<T: Scalar = f64> {
    pub(in crate::dynamics) by_position: [[T; RINGS]; RINGS],
    /// Of u and v, by the rings' positions.
    pub(in crate::dynamics) ball: [[T; RINGS]; 2],
    /// Of the forces by u and v, the rings standing.
    pub(in crate::dynamics) by_ball: [[T; 2]; RINGS],
    residual_by_ball: [[T; 2]; 2],
}

/// A number with derivatives by u and v.
type ByBall = Dual<f64, 2>;

impl Model {
    /// R_r and R_z (N) of a ball at u and v that keeps there, and its contacts; it feels the centrifugal force of
    /// `omega` (rad/s).
    pub(in crate::dynamics) fn ball_residual<T: Scalar>(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        at: &BallMotion<T>,
        place: [T; 2],
        omega: T,
        shortcuts: &mut Shortcuts,
    ) -> ([T; 2], BallForces<T>) {
        let none = T::from(0.0);
        let ball = at.ball_moving(self, place, [none; 2]);
        let mut found = self.ball_forces(space, cells, at, &ball, shortcuts);
        self.add_couple(space, omega, &mut found);
        (self.left_on_ball(space, &ball, omega, found.force()), found)
    }

    /// R_r and R_z (N) of a ball on which the contacts exert these forces along e_r, e_t and z.
    fn left_on_ball<T: Scalar>(
        &self,
        space: &Space,
        ball: &Element<T, 2>,
        omega: T,
        [f_r, _, f_z]: Spatial<T>,
    ) -> [T; 2] {
        let mass = T::Plain::from(self.element_mass);
        let [g_x, g_y] = [self.gravity.x, self.gravity.y].map(T::Plain::from);
        let body = ball.e_r[0] * g_x + ball.e_r[1] * g_y + ball.rho * omega * omega;
        [f_r + body * mass, f_z + T::from(space.gravity * self.element_mass)]
    }

    /// Ball `at` in balance, looked for from `guess` on; it feels the centrifugal force of `omega` (rad/s).
    pub(in crate::dynamics) fn balanced_ball(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        guess: [f64; 2],
        at: &BallMotion,
        omega: f64,
        shortcuts: &mut Shortcuts,
    ) -> BalancedBall {
        let at = &BallMotion { curved: false, ..*at };
        let tried = BallMotion { tried: true, ..*at };
        let [u, v] = self
            .newton_place(space, cells, guess, (&tried, omega), shortcuts)
            .unwrap_or_else(|| self.searched_place(space, cells, guess, (&tried, omega), shortcuts));
        let u = self.touching_u(space, cells, [u, v], at, omega, shortcuts);
        let (residual, forces) = self.ball_residual(space, cells, at, [u, v], omega, shortcuts);
        BalancedBall { at: [u, v], residual, forces }
    }

    /// R_r and R_z (N) at a place with their derivatives by u and v.
    fn residual_by_place(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        [u, v]: [f64; 2],
        (at, omega): (&BallMotion, f64),
        shortcuts: &mut Shortcuts,
    ) -> [ByBall; 2] {
        let place = [ByBall::variable(u, 0), ByBall::variable(v, 1)];
        self.ball_residual(space, cells, &at.lifted(), place, ByBall::constant(omega), shortcuts).0
    }

    /// u and v (m) of a ball in balance by Newton's method from `guess` on; `None` where that does not lead there.
    pub(super) fn newton_place(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        guess: [f64; 2],
        ball: (&BallMotion, f64),
        shortcuts: &mut Shortcuts,
    ) -> Option<[f64; 2]> {
        let mut place = guess;
        for _ in 0..MOST_NEWTON_STEPS {
            let residual = self.residual_by_place(space, cells, place, ball, shortcuts);
            if residual.iter().all(|of| of.value == 0.0) {
                return Some(place);
            }
            let matrix = residual.map(|of| of.by);
            let step = solved(matrix, residual.map(|of| of.value));
            let length = step[0].abs().max(step[1].abs());
            if !(matrix[0][0] < 0.0 && matrix[1][1] < 0.0 && length > 0.0 && length.is_finite()) {
                return None;
            }
            let share = (LONGEST_STEP / length).min(1.0);
            place = [place[0] - share * step[0], place[1] - share * step[1]];
            if length < SETTLED {
                return Some(place);
            }
        }
        None
    }

    /// The same by two searches, one within the other.
    fn searched_place(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        guess: [f64; 2],
        ball: (&BallMotion, f64),
        shortcuts: &mut Shortcuts,
    ) -> [f64; 2] {
        let mut u = guess[0];
        let mut along_valley = |v: f64| {
            let mut residual = |u: f64| self.residual_by_place(space, cells, [u, v], ball, shortcuts);
            u = falling_zero(u, |u| {
                let [r, _] = residual(u);
                [r.value, r.by[0]]
            });
            let [r, z] = residual(u);
            // Along the valley du/dv = −R_r,v/R_r,u.
            let slope = if r.by[0] < 0.0 { z.by[1] - z.by[0] * r.by[1] / r.by[0] } else { z.by[1] };
            [z.value, slope]
        };
        let v = falling_zero(guess[1], &mut along_valley);
        along_valley(v);
        [u, v]
    }

    /// u (m) of a ball, or of one that nothing touches or moves that at which it rests against the outer groove.
    fn touching_u(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        [mut u, v]: [f64; 2],
        at: &BallMotion,
        omega: f64,
        shortcuts: &mut Shortcuts,
    ) -> f64 {
        let (residual, found) = self.ball_residual(space, cells, at, [u, v], omega, shortcuts);
        if found.contacts.iter().any(|contact| contact.magnitude != 0.0) || residual != [0.0; 2] {
            return u;
        }
        for _ in 0..20 {
            let place = [ByBall::variable(u, 0), ByBall::variable(v, 1)];
            let none = ByBall::constant(0.0);
            let (_, found) = self.ball_residual(space, cells, &at.lifted(), place, none, shortcuts);
            let step = found.contacts[1].approach.value / found.contacts[1].approach.by[0];
            u -= step;
            if step.abs() <= ROUNDING {
                break;
            }
        }
        u
    }

    /// What a ball in balance at `place` makes of the forces on the rings; it feels the centrifugal force of `omega`
    /// (rad/s). By the first coordinates of the rings alone, two fewer than `K`.
    pub(in crate::dynamics) fn ball_tangent<T: Scalar, const K: usize>(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        place: [T; 2],
        at: &BallMotion<T>,
        omega: T,
        shortcuts: &mut Shortcuts,
    ) -> BallTangent<T> {
        let (residual, rings) = if T::CHANGES || space.couple_shares != [0.0; 2] {
            self.one_by_one_to_first_order(space, cells, place, (at, omega), shortcuts)
        } else {
            let mut seeded: BallMotion<Dual<T, K>> = at.lifted();
            let coordinates = seeded.rings.iter_mut().flat_map(|ring| &mut ring.position);
            for (k, x) in coordinates.enumerate().take(K - 2) {
                *x = Dual::variable(x.value, 2 + k);
            }
            let seeds = [Dual::variable(place[0], 0), Dual::variable(place[1], 1)];
            let (speed, none) = (Dual::constant(omega), Dual::constant(T::from(0.0)));
            let ball = seeded.ball_moving(self, seeds, [none; 2]);
            let seen = (&views(&seeded.rings), &ball);
            let [inner, outer] = if at.stands() {
                self.chained_on_ball::<_, STANDING, _>(space, cells, at, seen, shortcuts)
            } else {
                self.chained_on_ball::<_, MOVING, _>(space, cells, at, seen, shortcuts)
            };
            let force = [0, 1, 2].map(|i: usize| inner.force[i] + outer.force[i]);
            (self.left_on_ball(space, &ball, speed, force), [inner.on_ring(ball.e_r), outer.on_ring(ball.e_r)])
        };
        let rings = rings.as_flattened();
        let mut tangent = BallTangent {
            by_position: [[T::from(0.0); RINGS]; RINGS],
            ball: [[T::from(0.0); RINGS]; 2],
            by_ball: std::array::from_fn(|i| [rings[i].by[0], rings[i].by[1]]),
            residual_by_ball: [[residual[0].by[0], residual[0].by[1]], [residual[1].by[0], residual[1].by[1]]],
        };
        for i in 0..K - 2 {
            let [u, v] = tangent.answer([residual[0].by[2 + i], residual[1].by[2 + i]]);
            (tangent.ball[0][i], tangent.ball[1][i]) = (u, v);
            for (row, force) in tangent.by_position.iter_mut().zip(rings) {
                row[i] = force.by[2 + i] + force.by[0] * u + force.by[1] * v;
            }
        }
        tangent
    }

    /// R_r and R_z and the forces on the rings with derivatives by u, v and the first coordinates of the rings, one
    /// coordinate after the other: where the contacts hold the couple of the spin, or all of it has derivatives itself,
    /// each contact would be a quarter of a megabyte of code with all of them at once.
    fn one_by_one_to_first_order<T: Scalar, const K: usize>(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        place: [T; 2],
        (at, omega): (&BallMotion<T>, T),
        shortcuts: &mut Shortcuts,
    ) -> ([Dual<T, K>; 2], [[Dual<T, K>; COORDINATES]; 2]) {
        let none = Dual::constant(T::from(0.0));
        let (mut left, mut on_rings) = ([none; 2], [[none; COORDINATES]; 2]);
        for k in 2..K {
            let mut seeded: BallMotion<Dual<T, 3>> = at.lifted();
            let x = &mut seeded.rings[(k - 2) / COORDINATES].position[(k - 2) % COORDINATES];
            *x = Dual::variable(x.value, 2);
            let seeds = [Dual::variable(place[0], 0), Dual::variable(place[1], 1)];
            let (residual, found) = self.ball_residual(space, cells, &seeded, seeds, Dual::constant(omega), shortcuts);
            let found = found.on_rings();
            let all = left.iter_mut().chain(on_rings.as_flattened_mut());
            for (of, found) in all.zip(residual.iter().chain(found.as_flattened())) {
                of.value = found.value;
                (of.by[0], of.by[1], of.by[k]) = (found.by[0], found.by[1], found.by[2]);
            }
        }
        (left, on_rings)
    }
}

impl<T: Scalar> BallTangent<T> {
    /// Where u and v go until they balance a change of R_r and R_z; nowhere if nothing holds the ball.
    pub(in crate::dynamics) fn answer(&self, residual: [T; 2]) -> [T; 2] {
        solved(self.residual_by_ball, residual).map(|place| -place)
    }
}

/// M⁻¹ x of two by two; 0 of a matrix that holds nothing.
pub(super) fn solved<T: Scalar>([[a, b], [c, d]]: [[T; 2]; 2], [x, y]: [T; 2]) -> [T; 2] {
    let determinant = a * d - b * c;
    if determinant.value() == 0.0 {
        return [T::from(0.0); 2];
    }
    [(d * x - b * y) / determinant, (a * y - c * x) / determinant]
}

/// Zero of a falling function, of which `of` gives value and slope, by Newton's method within the bracket that the
/// signs give; without one walking on to where the sign says. Where the value is 0 on the way it stays there.
fn falling_zero(guess: f64, mut of: impl FnMut(f64) -> [f64; 2]) -> f64 {
    let (mut search, mut x) = (PathSearch::between(f64::NEG_INFINITY, f64::INFINITY, FIRST_STRIDE), guess);
    for _ in 0..MOST_STEPS {
        let [value, slope] = of(x);
        if value == 0.0 || value.is_nan() {
            break;
        }
        let newton = x - value / slope;
        let newton = if slope < 0.0 && (newton - x).abs() < LONGEST_STEP { newton } else { f64::NAN };
        match search.next(x, value, newton) {
            Some(next) if (next - x).abs() > ROUNDING => x = next,
            _ => break,
        }
    }
    x
}
