//! A ball in balance between both grooves, and what that makes of the forces on the rings.
//!
//! With F the force of both contacts on the ball and ω its speed about the outer ring's centre,
//! ```text
//! R_r = F·e_r + m (g·e_r + ρ ω²) = 0     R_z = F_z + m g_z = 0
//! ```
//! *There is one balance.* At rest both contacts' energies are convex in (u, v), as a distance from a point is; that the
//! grooves' centres form circles and that the centrifugal force grows outwards changes that by d/R_o, a hundredth, of
//! the weakest of it. R_r therefore falls with u at each v, and along the u where it vanishes R_z falls with v: two
//! searches for a zero of a falling function, one within the other, find it from anywhere. A ball that nothing touches
//! or moves rests against the outer groove without force where it is.
//!
//! With the ball in balance the forces f on the rings by the rings' positions x are
//! ```text
//! df/dx = f_x − f_b R_b⁻¹ R_x          b = (u, v)
//! ```

use super::ball_contacts::{BallForces, BallMotion};
use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::parameters::{COORDINATES, Frames, Model, RINGS, RingInSpace, Space};
use crate::numerics::number::{Dual, Scalar};

/// Rounding of distances of some 20 mm (m): a step shorter than this is none.
const ROUNDING: f64 = 2e-18;
/// First step of a search that nothing brackets (m); each next one is twice as long.
const FIRST_STRIDE: f64 = 1e-6;
/// Longest of Newton's steps (m).
const LONGEST_STEP: f64 = 20e-6;
/// Most steps of a search.
const MOST_STEPS: usize = 200;

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

/// A number with derivatives by u and v.
type ByBall = Dual<f64, 2>;
/// A number with derivatives by u, v and both rings' coordinates.
type ByAll = Dual<f64, { 2 + RINGS }>;

impl BallMotion {
    /// The same with numbers of another kind, none of which changes.
    pub(in crate::dynamics) fn constant<T: Scalar>(&self) -> BallMotion<T> {
        let frame = |turn: crate::dynamics::parameters::Turn| crate::dynamics::parameters::Turn {
            angle: T::from(turn.angle),
            speed: T::from(turn.speed),
        };
        BallMotion {
            element: self.element,
            e_r: self.e_r.map(T::from),
            angle: T::from(self.angle),
            omega: T::from(self.omega),
            rings: self.rings.map(|ring| RingInSpace {
                position: ring.position.map(T::from),
                velocity: ring.velocity.map(T::from),
            }),
            frames: Frames(self.frames.0.map(frame)),
            curved: self.curved,
        }
    }

    /// The same positions with nothing moving.
    pub(in crate::dynamics) fn standing(&self) -> Self {
        let rings = self.rings.map(|ring| RingInSpace { velocity: [0.0; COORDINATES], ..ring });
        Self { omega: 0.0, rings, frames: self.frames.at_rest(), ..*self }
    }
}

impl Model {
    /// R_r and R_z (N) of a ball at u and v that keeps there, and its contacts; it feels the centrifugal force of
    /// `omega` (rad/s).
    #[inline(always)]
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
        let ball = at.ball_moving(self, space, place, [none; 2]);
        let found = self.ball_forces(space, cells, at, &ball, shortcuts);
        let ([f_r, _, f_z], mass) = (found.force(), T::Plain::from(self.element_mass));
        let [g_x, g_y, g_z] = [self.gravity.x, self.gravity.y, space.gravity].map(T::Plain::from);
        let body = at.e_r[0] * g_x + at.e_r[1] * g_y + ball.rho * omega * omega;
        ([f_r + body * mass, f_z + T::from(1.0) * g_z * mass], found)
    }

    /// Ball `at` in balance, looked for from `guess` on.
    pub(in crate::dynamics) fn balanced_ball(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        guess: [f64; 2],
        at: &BallMotion,
        shortcuts: &mut Shortcuts,
    ) -> BalancedBall {
        let at = &BallMotion { curved: false, ..*at };
        let mut u = guess[0];
        let mut along_valley = |v: f64| {
            let mut residual = |u: f64| {
                let place = [ByBall::variable(u, 0), ByBall::variable(v, 1)];
                self.ball_residual(space, cells, &at.constant(), place, ByBall::constant(at.omega), shortcuts).0
            };
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
        let u = self.touching_u(space, cells, [u, v], at, shortcuts);
        let (residual, forces) = self.ball_residual(space, cells, at, [u, v], at.omega, shortcuts);
        BalancedBall { at: [u, v], residual, forces }
    }

    /// u (m) of a ball, or of one that nothing touches or moves that at which it rests against the outer groove.
    fn touching_u(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        [mut u, v]: [f64; 2],
        at: &BallMotion,
        shortcuts: &mut Shortcuts,
    ) -> f64 {
        let (residual, found) = self.ball_residual(space, cells, at, [u, v], at.omega, shortcuts);
        if found.contacts.iter().any(|contact| contact.magnitude != 0.0) || residual != [0.0; 2] {
            return u;
        }
        for _ in 0..20 {
            let place = [ByBall::variable(u, 0), ByBall::variable(v, 1)];
            let none = ByBall::constant(0.0);
            let (_, found) = self.ball_residual(space, cells, &at.constant(), place, none, shortcuts);
            let step = found.contacts[1].approach.value / found.contacts[1].approach.by[0];
            u -= step;
            if step.abs() <= ROUNDING {
                break;
            }
        }
        u
    }

    /// Derivatives of the forces on both rings, of a ball in balance at `place`, by the rings' positions; all stands where
    /// it is.
    pub(in crate::dynamics) fn ball_tangent(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        place: [f64; 2],
        at: &BallMotion,
        shortcuts: &mut Shortcuts,
    ) -> [[f64; RINGS]; RINGS] {
        let mut seeded: BallMotion<ByAll> = at.standing().constant();
        for (ring, of) in seeded.rings.iter_mut().enumerate() {
            for (k, x) in of.position.iter_mut().enumerate() {
                *x = ByAll::variable(x.value, 2 + COORDINATES * ring + k);
            }
        }
        let (place, omega) = ([0, 1].map(|k| ByAll::variable(place[k], k)), ByAll::constant(at.omega));
        let (residual, found) = self.ball_residual(space, cells, &seeded, place, omega, shortcuts);
        let rings = found.on_rings();
        // R_b, and where nothing holds the ball no answer of it.
        let [[a, b], [c, d]] = residual.map(|of| [of.by[0], of.by[1]]);
        let determinant = a * d - b * c;
        let mut ball = [[0.0; RINGS]; 2];
        if determinant != 0.0 {
            for i in 0..RINGS {
                let [r, z] = residual.map(|of| of.by[2 + i]);
                (ball[0][i], ball[1][i]) = ((b * z - d * r) / determinant, (c * r - a * z) / determinant);
            }
        }
        let mut by_position = [[0.0; RINGS]; RINGS];
        for (row, force) in by_position.iter_mut().zip(rings.as_flattened()) {
            for (i, by) in row.iter_mut().enumerate() {
                *by = force.by[2 + i] + force.by[0] * ball[0][i] + force.by[1] * ball[1][i];
            }
        }
        by_position
    }
}

/// Zero of a falling function, of which `of` gives value and slope, by Newton's method within the bracket that the
/// signs give; without one walking on to where the sign says. Where the value is 0 on the way it stays there.
fn falling_zero(guess: f64, mut of: impl FnMut(f64) -> [f64; 2]) -> f64 {
    let (mut low, mut high, mut stride, mut x) = (f64::NEG_INFINITY, f64::INFINITY, FIRST_STRIDE, guess);
    for _ in 0..MOST_STEPS {
        let [value, slope] = of(x);
        if value == 0.0 || value.is_nan() {
            break;
        }
        if value > 0.0 {
            low = x
        } else {
            high = x
        }
        let newton = x - value / slope;
        let next = if slope < 0.0 && newton > low && newton < high && (newton - x).abs() < LONGEST_STEP {
            newton
        } else if low.is_finite() && high.is_finite() {
            0.5 * (low + high)
        } else {
            stride *= 2.0;
            if value > 0.0 { x + stride } else { x - stride }
        };
        let step = next - x;
        if step.abs() <= ROUNDING || !(next > low && next < high) || stride > 1.0 {
            break;
        }
        x = next;
    }
    x
}
