//! One element's contacts to first order: the one source of their derivatives.
//!
//! From it are assembled the [Jacobian](crate::dynamics::derivatives::jacobian) of stiff steps, the elements' and
//! rings' balance of the [start](crate::dynamics::equilibrium::search) and how that
//! moves, the tangent stiffness,
//! and the derivatives of [outputs](crate::dynamics::derivatives::variation).
//!
//! With f the inner contact's force on the element,
//! ```text
//! f = Q(δ, δ̇) n,   q = x_o + ρ e_r − x_i,   q̇ = v_o + u' e_r + ρ ω e_t − v_i,   δ̇ = −n·q̇
//! G = ∂f/∂q = −n (Q_δ nᵀ + Q_δ̇ q̇ᵀP/|q|) + Q P/|q|,   P = 1 − n nᵀ
//! D = ∂f/∂q̇ = −Q_δ̇ n nᵀ
//! ```
//! and, d standing for a small change of all that an element sees,
//! ```text
//! dq  = dx_o − dx_i + e_r du + ρ e_t dθ
//! dq̇  = dv_o − dv_i + e_r du' + (u' e_t − ρ ω e_r) dθ + e_t (ω du + ρ dω)
//! df  = G dq + D dq̇
//! dF  = (Q_Δ dΔ + Q_Δ̇ dΔ̇) (radial, tangential) + Q d(radial, tangential)
//! dΔ  = Δ_u du + Δ_ψ dθ              dΔ̇ = Δ_u du' + Δ_ψ dω + (Δ_uu u' + Δ_uψ ω) du + (Δ_uψ u' + Δ_ψψ ω) dθ
//! ```
//! F is the outer contact's force, inwards and counter-clockwise, at the equivalent approach Δ(u, ψ). Near a defect of
//! the inner raceway, or of the element on its inner side, with v_n = n·q̇, v_t = t·q̇ and the frame's speed ω_f,
//! ```text
//! f = Q(Δ, Δ̇) (R n + T t),   Δ(δ, ψ),   dδ = −n·dq,   dψ = t·dq/|q| − dα,   dn = t (t·dq)/|q|,   dt = −n (t·dq)/|q|
//! dδ̇ = −n·dq̇ − v_t (t·dq)/|q|,   dψ̇ = t·dq̇/|q| − v_t (n·dq)/|q|² − v_n (t·dq)/|q|² − dω_f
//! ```
//! Where Δ is not u itself, its second derivatives and derivatives of the direction by the angle are central
//! differences over [`DIFFERENCE`], wrong by less than 1e-6 of themselves.
//!
//! Oil films add what resists to Q. Derivatives are those of the branch that each contact is in; at the onset of a
//! contact there are two, and where a film's gap ceases to close. At rest all of it is elastic: G is symmetric, and no
//! damping enters.

use super::element_contacts::DIFFERENCE;
use super::element_variation::ElementVariation;
use crate::contact::law::{CompliantContact, ForceLaw};
use crate::contact::near_defect::Approach;
use crate::contact::rolling::RacewaySide;
use crate::dynamics::contacts::{InnerGap, Meeting};
use crate::dynamics::parameters::{FilmsNow, Resistance, resistance};
use crate::dynamics::parameters::{Frame, FramedKinematics, Model, Near, PathMotion, SMOOTH};
use crate::numerics::plane::{Matrix, Vector, turned};

/// Whether second derivatives of the outer approach are wanted, which the change of path or position needs while
/// something moves; each costs four more samples at the defect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::dynamics) enum Bends {
    /// They are.
    Wanted,
    /// They count for nothing, or an approximate derivative will do.
    LeftOut,
}

/// One element's contacts to first order. Vectors are in x and y unless they say otherwise.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Linearized {
    pub(in crate::dynamics) e_r: Vector,
    pub(in crate::dynamics) e_t: Vector,
    pub(in crate::dynamics) rho: f64,
    pub(in crate::dynamics) omega: f64,
    pub(in crate::dynamics) path_rate: f64,
    /// Force of the inner contact on the element (N), and its derivatives G, D.
    pub(in crate::dynamics) inner: Vector,
    pub(in crate::dynamics) by_q: Matrix,
    pub(in crate::dynamics) by_q_rate: Matrix,
    /// Its derivatives by angle and speed of the body that bears the defect.
    by_inner_frame: [Vector; 2],
    /// Derivatives of the inner force, and of the outer per unit of direction, by the speed that oil films follow.
    by_film_speed: (Vector, f64),
    /// The frames of the bodies that bear the defects under the inner and the outer contact.
    pub(in crate::dynamics) frames: [Frame; 2],
    /// Direction and length of q (m).
    pub(in crate::dynamics) n: Vector,
    pub(in crate::dynamics) distance: f64,
    /// Force of the outer contact on the element, inwards and counter-clockwise (N).
    pub(in crate::dynamics) outer: Vector,
    /// Direction of the outer force, inwards and counter-clockwise, and its derivatives by path and angle.
    direction: Vector,
    direction_by_path: Vector,
    direction_by_angle: Vector,
    /// Outer force per unit of direction, and its derivatives by u, u', cage angle and cage speed.
    amount: f64,
    /// Equivalent approach of the inner and of the outer contact (m).
    pub(in crate::dynamics) approaches: [f64; 2],
    by_path: f64,
    by_path_rate: f64,
    by_angle: f64,
    by_speed: f64,
}

/// Change of one element's contact forces, in the directions of [`Linearized::inner`] and [`Linearized::outer`].
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::dynamics) struct ElementChange {
    pub(in crate::dynamics) inner: Vector,
    pub(in crate::dynamics) outer: Vector,
}

/// Second derivatives of an approach, and of its direction by the angle.
#[derive(Debug, Clone, Copy, Default)]
struct Bend {
    path_path: f64,
    path_angle: f64,
    angle_angle: f64,
    direction_by_angle: Vector,
}

impl ElementChange {
    /// Change of the force on the outer ring while the element's directions stay.
    pub(in crate::dynamics) fn on_housing(&self, element: &Linearized) -> Vector {
        element.e_r * self.outer.x - element.e_t * self.outer.y
    }

    /// Change of the radial force of both contacts on the element (N).
    #[inline]
    pub(in crate::dynamics) fn radial(&self, element: &Linearized) -> f64 {
        self.inner.dot(&element.e_r) - self.outer.x
    }
}

impl Linearized {
    /// The forces' change.
    #[inline]
    pub(in crate::dynamics) fn change(&self, by: &ElementVariation) -> ElementChange {
        let Self { e_r, e_t, rho, omega, .. } = *self;
        let turned = rho * by.cage_angle;
        let radial = by.path_rate - rho * omega * by.cage_angle;
        let around = self.path_rate * by.cage_angle + omega * by.path + rho * by.cage_speed;
        let q = by.offset + e_r * by.path + e_t * turned;
        let q_rate = by.drift + e_r * radial + e_t * around;
        let (amount, turn) = self.outer_change(by);
        let [angle, speed] = by.frames[self.frames[0] as usize];
        ElementChange {
            inner: self.by_q * q
                + self.by_q_rate * q_rate
                + (self.by_inner_frame[0] * angle + self.by_inner_frame[1] * speed)
                + self.by_film_speed.0 * by.film_speed,
            outer: self.direction * amount + turn * self.amount,
        }
    }

    /// Force on the outer ring (N).
    pub(in crate::dynamics) fn on_housing(&self) -> Vector {
        self.e_r * self.outer.x - self.e_t * self.outer.y
    }

    /// The change of the outer force's magnitude (N).
    pub(in crate::dynamics) fn outer_amount(&self, by: &ElementVariation) -> f64 {
        let (amount, turn) = self.outer_change(by);
        let length = self.direction.norm().max(f64::MIN_POSITIVE);
        amount * length + self.amount * self.direction.dot(&turn) / length
    }

    /// Change of the outer force per unit of direction, and of the direction.
    #[inline]
    fn outer_change(&self, by: &ElementVariation) -> (f64, Vector) {
        let [angle, speed] = by.frames[self.frames[1] as usize];
        let (angle, speed) = (by.cage_angle - angle, by.cage_speed - speed);
        let amount = self.by_path * by.path
            + self.by_path_rate * by.path_rate
            + self.by_angle * angle
            + self.by_speed * speed
            + self.by_film_speed.1 * by.film_speed;
        let turn = self.direction_by_path * by.path + self.direction_by_angle * angle;
        (amount, turn)
    }
}

impl Model {
    /// Element `j` at path `u` and absolute radial velocity `w`, its contacts in these cells (see `Model::cells_of`).
    pub(in crate::dynamics) fn linearized(
        &self,
        j: usize,
        cells: [[u32; 2]; 2],
        u: f64,
        w: f64,
        now: &FramedKinematics,
        bends: Bends,
    ) -> Linearized {
        let rate = w - now.housing.velocity.dot(&self.direction(j, &now.cage));
        self.linearized_at(j, cells, PathMotion { path: u, rate }, now, bends)
    }

    /// The same at this motion along its path.
    pub(in crate::dynamics) fn linearized_at(
        &self,
        j: usize,
        cells: [[u32; 2]; 2],
        along: PathMotion,
        now: &FramedKinematics,
        bends: Bends,
    ) -> Linearized {
        self.linearized_with([&self.inner.contact, &self.outer.contact], j, cells, along, now, bends)
    }

    /// As [`linearized_at`](Self::linearized_at), with these contacts instead of the raceways'.
    pub(in crate::dynamics) fn linearized_with(
        &self,
        contacts: [&CompliantContact; 2],
        j: usize,
        cells: [[u32; 2]; 2],
        PathMotion { path: u, rate: path_rate }: PathMotion,
        now: &FramedKinematics,
        bends: Bends,
    ) -> Linearized {
        let e_r = self.direction(j, &now.cage);
        let e_t = turned(e_r);
        let [omega, _] = self.element_speed(j, &now.cage);
        let rho = self.outer_centre_radius + u;

        let gap = self.inner_gap(u, now.offset(), e_r, self.clearance(now.films.as_ref()));
        let n = e_r * gap.n.x + e_t * gap.n.y;
        let q_rate = now.drift() + e_r * path_rate + e_t * (rho * omega);
        let inner = match cells[0] {
            [SMOOTH, SMOOTH] => self.smooth_inner(&contacts[0].law, &gap, n, q_rate, now.films.as_ref()),
            cells => self.near_inner(
                &contacts[0].law,
                &self.inner_meeting(j, cells, &gap, self.element_angle(j, &now.cage)),
                n,
                q_rate,
                now,
                bends,
            ),
        };

        let at = self.outer_meeting(j, cells[1], u, &now.cage);
        let bent = bends == Bends::Wanted && cells[1] != [SMOOTH; 2];
        let bend = if bent { self.bend(RacewaySide::Outer, &at, now) } else { Bend::default() };
        let Near { approach: near, frame_speed, frame } = self.approach(RacewaySide::Outer, &at, &now.frames);
        let turning = omega - frame_speed;
        let rate = near.by_path * path_rate + near.by_angle * turning;
        let Resistance { force: film, by_speed: film_by_speed } =
            resistance(now.films.as_ref(), RacewaySide::Outer, near.value, rate);
        let law = contacts[1].with_derivatives(near.value, rate).plus(film);
        let direction = Vector::new(near.radial, near.tangential);
        Linearized {
            e_r,
            e_t,
            rho,
            omega,
            path_rate,
            inner: inner.force,
            by_q: inner.by_q,
            by_q_rate: inner.by_q_rate,
            by_inner_frame: inner.by_frame,
            by_film_speed: (inner.by_film_speed, film_by_speed),
            frames: [inner.frame, frame],
            n,
            distance: gap.distance,
            outer: direction * law.value,
            direction,
            direction_by_path: Vector::new(near.radial_by_path, near.tangential_by_path),
            direction_by_angle: bend.direction_by_angle,
            amount: law.value,
            approaches: [inner.approach, near.value],
            by_path: law.by_approach * near.by_path
                + law.by_rate * (bend.path_path * path_rate + bend.path_angle * turning),
            by_path_rate: law.by_rate * near.by_path,
            by_angle: law.by_approach * near.by_angle
                + law.by_rate * (bend.path_angle * path_rate + bend.angle_angle * turning),
            by_speed: law.by_rate * near.by_angle,
        }
    }

    /// The inner contact of an element on the smooth raceway, q changing at `q_rate`.
    fn smooth_inner(
        &self,
        law: &ForceLaw,
        gap: &InnerGap,
        n: Vector,
        q_rate: Vector,
        films: Option<&FilmsNow>,
    ) -> InnerContact {
        let rate = -n.dot(&q_rate);
        let film = resistance(films, RacewaySide::Inner, gap.approach, rate);
        let force = law.with_derivatives(gap.approach, rate).plus(film.force);
        let thicker = films.map_or(0.0, FilmsNow::together_by_speed);
        // P q̇/|q| and Q/|q|
        let turn = (q_rate + n * rate) / gap.distance;
        let across = force.value / gap.distance;
        InnerContact {
            approach: gap.approach,
            force: n * force.value,
            by_q: Matrix::from_diagonal_element(across)
                - n * (n * (force.by_approach + across) + turn * force.by_rate).transpose(),
            by_q_rate: n * n.transpose() * -force.by_rate,
            by_frame: [Vector::zeros(); 2],
            by_film_speed: n * (force.by_approach * thicker + film.by_speed),
            frame: Frame::Shaft,
        }
    }

    /// The inner contact of an element near a defect, q in direction `n` changing at `q_rate`.
    fn near_inner(
        &self,
        law: &ForceLaw,
        at: &Meeting,
        n: Vector,
        q_rate: Vector,
        now: &FramedKinematics,
        bends: Bends,
    ) -> InnerContact {
        let (t, distance) = (turned(n), at.distance);
        let (v_n, v_t) = (n.dot(&q_rate), t.dot(&q_rate));
        let bend = if bends == Bends::Wanted { self.bend(RacewaySide::Inner, at, now) } else { Bend::default() };
        let Near { approach: near, frame_speed, frame } = self.approach(RacewaySide::Inner, at, &now.frames);
        let turning = v_t / distance - frame_speed;
        let rate = -near.by_path * v_n + near.by_angle * turning;
        let film = resistance(now.films.as_ref(), RacewaySide::Inner, near.value, rate);
        let law = law.with_derivatives(near.value, rate).plus(film.force);
        // Films take from the gap while the element stays where it is.
        let thicker = now.films.as_ref().map_or(0.0, FilmsNow::together_by_speed);
        let turns = if thicker == 0.0 { Vector::zeros() } else { self.direction_by_gap(at, &now.frames) };
        // Δ̇ by the approach and by the angle at constant rates of both.
        let rate_by_approach = -bend.path_path * v_n + bend.path_angle * turning;
        let rate_by_angle = -bend.path_angle * v_n + bend.angle_angle * turning;
        let per_length = 1.0 / distance;
        // dΔ, dΔ̇ and the force's amount as rows by dq.
        let value = n * -near.by_path + t * (near.by_angle * per_length);
        let rate = n * (-rate_by_approach - near.by_angle * v_t * per_length * per_length)
            + t * (per_length * (rate_by_angle - near.by_path * v_t - near.by_angle * v_n * per_length));
        let amount = value * law.by_approach + rate * law.by_rate;
        let direction = n * near.radial + t * near.tangential;
        // What turns the direction: the approach, the angle, and n and t themselves.
        let by_approach = n * near.radial_by_path + t * near.tangential_by_path;
        let by_angle = n * bend.direction_by_angle.x + t * bend.direction_by_angle.y;
        let turned = by_angle + t * near.radial - n * near.tangential;
        let by_q = direction * amount.transpose() - by_approach * n.transpose() * law.value
            + turned * t.transpose() * (law.value * per_length);
        let along = n * -near.by_path + t * (near.by_angle * per_length);
        let by_turn = law.by_approach * near.by_angle + law.by_rate * rate_by_angle;
        InnerContact {
            approach: near.value,
            force: direction * law.value,
            by_q,
            by_q_rate: direction * along.transpose() * law.by_rate,
            by_film_speed: direction
                * ((law.by_approach * near.by_path + law.by_rate * rate_by_approach) * thicker + film.by_speed)
                + (n * turns.x + t * turns.y) * (law.value * thicker),
            by_frame: [-(direction * by_turn + by_angle * law.value), -direction * (law.by_rate * near.by_angle)],
            frame,
        }
    }

    /// Second derivatives of the approach of a contact near a defect.
    fn bend(&self, side: RacewaySide, at: &Meeting, now: &FramedKinematics) -> Bend {
        let angle = DIFFERENCE / self.outer_centre_radius;
        let sample = |du: f64, turn: f64| {
            let u = at.u + du;
            let (direction, distance) = match side {
                RacewaySide::Inner => (at.direction + turn, at.distance - du),
                RacewaySide::Outer => {
                    let lead = self.lead(at.element, &now.cage).angle;
                    ((now.cage.angle + turn) + self.element_offset(at.element) + lead, self.outer_centre_radius + u)
                }
            };
            self.approach(side, &Meeting { u, distance, direction, ..*at }, &now.frames).approach
        };
        let (inside, outside) = (sample(-DIFFERENCE, 0.0), sample(DIFFERENCE, 0.0));
        let (behind, ahead) = (sample(0.0, -angle), sample(0.0, angle));
        let by_path = |of: fn(&Approach) -> f64| (of(&outside) - of(&inside)) / (2.0 * DIFFERENCE);
        let by_angle = |of: fn(&Approach) -> f64| (of(&ahead) - of(&behind)) / (2.0 * angle);
        Bend {
            path_path: by_path(|near| near.by_path),
            path_angle: by_path(|near| near.by_angle),
            angle_angle: by_angle(|near| near.by_angle),
            direction_by_angle: Vector::new(by_angle(|near| near.radial), by_angle(|near| near.tangential)),
        }
    }
}

/// The inner contact of an element to first order.
struct InnerContact {
    approach: f64,
    force: Vector,
    by_q: Matrix,
    pub(in crate::dynamics) by_q_rate: Matrix,
    by_frame: [Vector; 2],
    by_film_speed: Vector,
    frame: Frame,
}
