//! First-order change of forces and accelerations for a small change of state and inputs.
//!
//! An element's contacts change with everything they see by the one rule of `linearized`, where
//! ```text
//! u' = w − e_r·v_o                  du' = dw − e_r·dv_o − e_t·v_o dθ
//! ```
//! With it the derivative of any output follows: by an input at fixed state, by an input through the static
//! equilibrium, and by time along the motion. Derivatives are those of the branch that each contact is in; at the
//! onset of a contact there are two.

use crate::contact::rolling::RacewaySide;
use crate::dynamics::contacts::{Bends, DIFFERENCE, ElementChange, ElementVariation, Linearized};
use crate::dynamics::parameters::FilmsNow;
use crate::dynamics::parameters::{
    CageState, Cells, Excitation, Frame, FramedKinematics, Lead, Model, PathMotion, RingState, SMOOTH,
};
use crate::dynamics::quasi_static::Rings;
use crate::numerics::plane::{Matrix, Vector, turned};

/// A small change of state and inputs.
#[derive(Debug, Clone, Default)]
pub struct Variation {
    /// Of the nominal cage angle (rad).
    pub cage_angle: f64,
    /// Of the nominal cage speed (rad/s).
    pub cage_speed: f64,
    /// Of the speed that oil films follow (rad/s).
    pub film_speed: f64,
    /// Of angle (rad) and speed (rad/s) of the frames of defects, in the order of
    /// [`crate::dynamics::parameters::Frame`].
    pub frames: [[f64; 2]; 3],
    /// Of the inner ring.
    pub shaft: RingState,
    /// Of the outer ring.
    pub housing: RingState,
    /// Of the element paths u (m).
    pub path: Vec<f64>,
    /// Of the elements' absolute radial velocities w (m/s).
    pub radial_velocity: Vec<f64>,
}

/// What contact forces make of a [`Variation`].
#[derive(Debug, Clone, Default)]
pub struct ForceChange {
    /// Of each inner contact's force (N).
    pub inner: Vec<f64>,
    /// Of each outer contact's force (N).
    pub outer: Vec<f64>,
    /// Of the force on the inner ring (N).
    pub shaft: Vector,
    /// Of the force on the outer ring (N).
    pub housing: Vector,
    /// Of the cage torque (N m) while the outer ring's acceleration does not change.
    pub cage_torque: f64,
    /// Of the torque of contacts near its defects on the inner ring (N m).
    pub shaft_torque: f64,
    /// Cage torque by the outer ring's acceleration (kg m).
    pub torque_by_acceleration: Vector,
}

impl Variation {
    /// No change, with room for `count` elements.
    pub fn new(count: usize) -> Self {
        Self { path: vec![0.0; count], radial_velocity: vec![0.0; count], ..Self::default() }
    }

    /// Makes it no change again; allocates nothing.
    pub fn clear(&mut self) {
        (self.cage_angle, self.cage_speed, self.frames) = (0.0, 0.0, [[0.0; 2]; 3]);
        self.film_speed = 0.0;
        (self.shaft, self.housing) = (RingState::default(), RingState::default());
        self.path.fill(0.0);
        self.radial_velocity.fill(0.0);
    }

    /// Of the outer ring's position less that of the inner (m).
    pub(in crate::dynamics) fn offset(&self) -> Vector {
        self.housing.position - self.shaft.position
    }

    /// Moves both rings further (m).
    pub(in crate::dynamics) fn move_rings(&mut self, motion: &Rings) {
        self.shaft.position += Vector::new(motion[0], motion[1]);
        self.housing.position += Vector::new(motion[2], motion[3]);
    }

    /// Of the outer ring's velocity less that of the inner (m/s).
    pub(in crate::dynamics) fn drift(&self) -> Vector {
        self.housing.velocity - self.shaft.velocity
    }
}

impl ForceChange {
    /// Room for `count` elements.
    pub fn new(count: usize) -> Self {
        Self { inner: vec![0.0; count], outer: vec![0.0; count], ..Self::default() }
    }
}

/// How an element goes round with the cage, to first order.
pub(in crate::dynamics) struct Going {
    /// Change of its angle (rad).
    turn: f64,
    /// Change of its speed (rad/s).
    pub(in crate::dynamics) speed: f64,
    /// Its acceleration (rad/s²).
    alpha: f64,
    /// Change of its acceleration (rad/s²).
    alpha_change: f64,
}

impl Model {
    /// How element `j` goes round as the nominal cage's angle and speed change.
    pub(in crate::dynamics) fn going(&self, j: usize, cage: &CageState, by: &Variation) -> Going {
        let Lead { rate, second, third, .. } = self.lead(j, cage);
        let (omega, share) = (cage.speed, 1.0 + rate);
        Going {
            turn: share * by.cage_angle,
            speed: share * by.cage_speed + second * omega * by.cage_angle,
            alpha: self.element_speed(j, cage)[1],
            alpha_change: (cage.acceleration * second + omega * omega * third) * by.cage_angle
                + 2.0 * omega * second * by.cage_speed,
        }
    }

    /// Change of the contact forces under `excitation` at τ = 0 for a small change. `acceleration` is the outer ring's.
    pub fn vary(
        &self,
        excitation: &Excitation,
        cells: &Cells,
        state: &[f64],
        acceleration: Vector,
        by: &Variation,
        change: &mut ForceChange,
    ) {
        let now = self.kinematics(excitation, 0.0, state);
        let none = Vector::zeros();
        (change.shaft, change.housing, change.torque_by_acceleration) = (none, none, none);
        (change.cage_torque, change.shaft_torque) = (0.0, 0.0);
        let moves = by.cage_angle != 0.0 || by.frames.iter().any(|turn| turn[0] != 0.0);
        for j in 0..self.element_count {
            let in_cells = self.cells_of(cells, j);
            let rings_move = in_cells[0] != [SMOOTH; 2] && by.offset() != none;
            let bends = if moves || rings_move || by.path[j] != 0.0 { Bends::Wanted } else { Bends::LeftOut };
            let (u, w) = (state[j], state[self.layout.radial_velocity + j]);
            let element = self.linearized(j, in_cells, u, w, &now, bends);
            let Linearized { e_r, e_t, rho, omega, .. } = element;
            let Going { turn, speed: speed_change, alpha, alpha_change } = self.going(j, &now.cage, by);
            let path_rate =
                by.radial_velocity[j] - by.housing.velocity.dot(&e_r) - now.housing.velocity.dot(&e_t) * turn;
            let seen = ElementVariation {
                offset: by.offset(),
                drift: by.drift(),
                path: by.path[j],
                path_rate,
                cage_angle: turn,
                cage_speed: speed_change,
                film_speed: by.film_speed,
                frames: by.frames,
            };
            let d = element.change(&seen);
            let amount = element.inner.norm();
            change.inner[j] = if amount > 0.0 { element.inner.dot(&d.inner) / amount } else { 0.0 };
            change.outer[j] = element.outer_amount(&seen);
            change.shaft -= d.inner;
            change.housing += d.on_housing(&element) + (e_r * element.outer.y + e_t * element.outer.x) * turn;
            change.torque_by_acceleration -= e_t * (rho * self.element_mass);
            let body = self.gravity - acceleration;
            let inertia = body.dot(&e_t) - 2.0 * element.path_rate * omega - rho * alpha;
            let force = element.inner.dot(&e_t) + element.outer.y + self.element_mass * inertia;
            let inertia_change = -body.dot(&e_r) * turn
                - 2.0 * (path_rate * omega + element.path_rate * speed_change)
                - by.path[j] * alpha
                - rho * alpha_change;
            let force_change =
                d.inner.dot(&e_t) - element.inner.dot(&e_r) * turn + d.outer.y + self.element_mass * inertia_change;
            change.cage_torque += by.path[j] * force + rho * force_change;
            self.vary_torques(&element, &seen, &d, change);
        }
    }

    /// Adds the change of the torques on bodies with defects: on the inner ring, and on elements, whose spin the cage
    /// forces.
    fn vary_torques(&self, element: &Linearized, seen: &ElementVariation, d: &ElementChange, change: &mut ForceChange) {
        let Linearized { n, distance, .. } = *element;
        let t = turned(n);
        let q = seen.offset + element.e_r * seen.path + element.e_t * (element.rho * seen.cage_angle);
        // −|q| f·t, of which t turns by t·dq/|q|.
        let inner =
            -(n.dot(&q) * element.inner.dot(&t) - element.inner.dot(&n) * t.dot(&q) + distance * d.inner.dot(&t));
        match element.frames[0] {
            Frame::Shaft => change.shaft_torque += inner,
            Frame::Spin => change.cage_torque += inner,
            Frame::Housing => {}
        }
        if element.frames[1] == Frame::Spin {
            change.cage_torque -= seen.path * element.outer.y + element.rho * d.outer.y;
        }
    }

    /// Change of the inner ring's elastic force by its own position, [`Model::ring_jacobian`]'s first block (N/m), for
    /// a small change at the instant τ = 0 of `excitation`.
    pub fn vary_stiffness(&self, excitation: &Excitation, cells: &Cells, state: &[f64], by: &Variation) -> Matrix {
        let now = self.kinematics(excitation, 0.0, state);
        let still = now.standing();
        // What films gain a gap loses.
        let narrower = still.films.as_ref().map_or(0.0, FilmsNow::together_by_speed) * by.film_speed;
        let mut sum = Matrix::zeros();
        for j in 0..self.element_count {
            let (in_cells, u) = (self.cells_of(cells, j), state[j]);
            let turn = self.going(j, &now.cage, by).turn;
            let rho = self.outer_centre_radius + u;
            let element = self.at_rest(j, in_cells, u, &still);
            let radial = self.radial_balance(&element).slope;
            if radial == 0.0 {
                continue;
            }
            let Linearized { e_r, e_t, by_q: g, .. } = element;
            let q = by.offset() + e_r * by.path[j] + e_t * (rho * turn);
            let dg = match in_cells[0] {
                [SMOOTH, SMOOTH] => self.vary_inner_stiffness(u, &still, e_r, q - element.n * narrower),
                _ => self.vary_near_inner_stiffness(j, in_cells, u, &still, by, element.n * -narrower),
            };
            // G is symmetric but where a law directs the force otherwise than its energy does.
            let (down, along) = (g * e_r, g.tr_mul(&e_r));
            let (d_down, d_along) = (dg * e_r + g * e_t * turn, dg.tr_mul(&e_r) + g.tr_mul(&e_t) * turn);
            let d_radial =
                e_t.dot(&down) * turn + e_r.dot(&d_down) - self.vary_outer_stiffness(j, in_cells, u, &still, by, turn);
            sum += dg - (d_down * along.transpose() + down * d_along.transpose()) / radial
                + down * along.transpose() * (d_radial / (radial * radial));
        }
        sum
    }

    /// As [`Self::vary_inner_stiffness`] near a defect, by a central difference along the change, in which the gap gets
    /// `wider` (m) along its normal.
    fn vary_near_inner_stiffness(
        &self,
        j: usize,
        cells: [[u32; 2]; 2],
        u: f64,
        still: &FramedKinematics,
        by: &Variation,
        wider: Vector,
    ) -> Matrix {
        // As long as a change of any part of it stays within a difference.
        let turns = by.frames.iter().map(|turn| turn[0].abs()).fold(by.cage_angle.abs(), f64::max);
        let offset = by.offset() + wider;
        let length = offset.norm() + by.path[j].abs() + self.outer_centre_radius * turns;
        if length == 0.0 {
            return Matrix::zeros();
        }
        let step = DIFFERENCE / length;
        let at = |share: f64| {
            let mut moved = *still;
            let angle = still.cage.angle + share * by.cage_angle;
            moved.cage = CageState::at_rest(angle);
            moved.housing.position += offset * share;
            for (turn, by) in moved.frames.0.iter_mut().zip(by.frames) {
                turn.angle += share * by[0];
            }
            self.at_rest(j, cells, u + share * by.path[j], &moved).by_q
        };
        (at(step) - at(-step)) / (2.0 * step)
    }

    /// Change of G = −(k + Q/|q|) n nᵀ + Q/|q| of an inner contact when the element moves by `q` from the inner ring.
    fn vary_inner_stiffness(&self, u: f64, still: &FramedKinematics, e_r: Vector, q: Vector) -> Matrix {
        let gap = self.inner_gap(u, still.offset(), e_r, self.clearance(still.films.as_ref()));
        if gap.approach <= 0.0 {
            return Matrix::zeros();
        }
        let n = e_r * gap.n.x + turned(e_r) * gap.n.y;
        let away = n.dot(&q);
        let (force, k) =
            (self.inner.contact.law.elastic(gap.approach), self.inner.contact.law.elastic_stiffness(gap.approach));
        let c = force / gap.distance;
        let dk = -self.inner.contact.law.hardening(gap.approach) * away;
        let dc = -(k + c) * away / gap.distance;
        let dn = (q - n * away) / gap.distance;
        let mixed = dn * n.transpose();
        Matrix::from_diagonal_element(dc) - n * n.transpose() * (dk + dc) - (mixed + mixed.transpose()) * (k + c)
    }

    /// Change of an outer contact's radial tangent stiffness by path and frames of a variation and as the element's
    /// angle changes by `turn` (rad); near a defect and where the raceway yields by central differences, like the
    /// second derivatives of the approach.
    fn vary_outer_stiffness(
        &self,
        j: usize,
        cells: [[u32; 2]; 2],
        u: f64,
        still: &FramedKinematics,
        by: &Variation,
        turn: f64,
    ) -> f64 {
        let path = by.path[j];
        if cells[1] == [SMOOTH; 2] && self.outer.contact.compliance == 0.0 {
            return if u > 0.0 { self.outer.contact.law.hardening(u) * path } else { 0.0 };
        }
        let radial = |u: f64, angle: f64| {
            // Nothing moves and the rings' offset does not matter to the outer contact.
            let still = FramedKinematics { frames: still.frames, ..FramedKinematics::at_rest(angle, Vector::zeros()) };
            let element = self.linearized_at(j, cells, PathMotion::at_rest(u), &still, Bends::LeftOut);
            element.change(&ElementVariation::of_path()).outer.x
        };
        let angle = still.cage.angle;
        let mut change = 0.0;
        if path != 0.0 {
            let (inside, outside) = (radial(u - DIFFERENCE, angle), radial(u + DIFFERENCE, angle));
            change += (outside - inside) / (2.0 * DIFFERENCE) * path;
        }
        if cells[1] == [SMOOTH; 2] {
            return change;
        }
        let at = self.outer_meeting(j, cells[1], u, &still.cage);
        let turn = turn - by.frames[self.approach(RacewaySide::Outer, &at, &still.frames).frame as usize][0];
        if turn != 0.0 {
            let step = DIFFERENCE / self.outer_centre_radius;
            let (behind, ahead) = (radial(u, angle - step), radial(u, angle + step));
            // The difference is by the nominal angle, over which the element goes a little more or less.
            let share = 1.0 + self.lead(j, &still.cage).rate;
            change += (ahead - behind) / (2.0 * step) * turn / share;
        }
        change
    }
}
