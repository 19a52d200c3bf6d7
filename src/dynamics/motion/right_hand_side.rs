//! The right-hand side of the equations of motion.
//!
//! With e_r, e_t the radial and tangential directions of an element, q from the inner ring's centre to the element's,
//! n = q/|q|, v_o, v_i the rings' velocities and ω the cage speed:
//! ```text
//! u'  = w − e_r·v_o
//! w'  = (Q_i n·e_r − F_r)/m + g·e_r + ω (v_o·e_t + ρ ω)
//! δ_i = R_i + r − |q|,   δ̇_i = −n·(v_o + u' e_r + ρ ω e_t − v_i)
//! m_i x_i'' = F_i − Σ Q_i n − c_s v_i − k_s x_i
//! m_o x_o'' = F_o + Σ (F_r e_r − F_t e_t) − c_p v_o − k_p x_o + Σ f_s e_s,   m_s s'' = −f_s
//! ```
//! F_r and F_t are what the outer raceway exerts on the element, inwards and counter-clockwise; on the smooth raceway
//! F_r = Q(u, u') and F_t = 0. Near a defect of the inner raceway, or of the element on its inner side, Q_i n gives way
//! to Q (R n + T t), with the direction (R, T) of that contact and t = ẑ×n. As w is the element's *absolute* radial
//! velocity, no ring acceleration enters, and ω (v_o·e_t + ρ ω) is all that turning adds: ω² ρ is the centrifugal
//! acceleration. The cage is kinematic: it takes up every tangential force on the elements, Coriolis' too. What it
//! takes is the cage torque.

use crate::dynamics::contacts::{Forces, NonSmoothOuter};
use crate::dynamics::parameters::{Cells, Excitation, Frame, Model, Stage};
use crate::numerics::lanes::{Kernel, Lanes, WIDEST, Wide, dispatch, handed_on};
use crate::numerics::plane::{Vector, turned, turned_by};

impl Model {
    /// Derivative of `state` at `tau`, and each contact; `cells` says in which cell each contact is.
    pub fn derivative(
        &self,
        excitation: &Excitation,
        tau: f64,
        cells: &Cells,
        state: &[f64],
        derivative: &mut [f64],
        forces: &mut Forces,
    ) {
        forces.enter(self, cells);
        let stage = Stage { excitation, cage: &excitation.cage_at(tau), state, ahead: None };
        dispatch(Derivative { model: self, stage, derivative, forces });
    }

    /// The right-hand side at one stage within kernels, for the cells that `forces` have last seen. Each contact is
    /// kept only if `RECORD`, which takes a stage whose positions are not still to be moved on.
    #[inline(always)]
    pub(crate) fn derivative_on<S: Wide, const RECORD: bool>(
        &self,
        simd: S,
        stage: Stage,
        derivative: &mut [f64],
        forces: &mut Forces,
    ) {
        debug_assert!(!RECORD || stage.ahead.is_none());
        let model = self;
        // Each written out: one that is made elsewhere and moved here is written in parts and read at once.
        if self.needs_general_form() {
            simd.outlined(Evaluation::<RECORD, true> { model, stage, derivative, forces });
        } else {
            simd.outlined(Evaluation::<RECORD, false> { model, stage, derivative, forces });
        }
    }

    /// Torque of the elements on the cage about the outer ring's centre (N m), counter-clockwise.
    ///
    /// It also takes up the torque of an element's defect on that element, whose spin is forced as well. `acceleration`
    /// is the outer ring's (m/s²).
    pub fn cage_torque(
        &self,
        excitation: &Excitation,
        tau: f64,
        state: &[f64],
        acceleration: Vector,
        forces: &Forces,
    ) -> f64 {
        let (cage, contacts) = (excitation.cage_at(tau), &forces.contacts);
        let paths = contacts.paths(self, state);
        let of_paths: f64 = (0..self.element_count)
            .map(|j| {
                let (block, i) = (&forces.elements[j / WIDEST], j % WIDEST);
                let e_t = turned(turned_by(cage.direction, block.sin[i], block.cos[i]));
                let turning = block.turning(i, &cage);
                let around = contacts.inner[j] * contacts.normal_tangential[j] + contacts.outer_tangential[j];
                self.torque_on_cage(j, e_t, turning, [paths[j], contacts.path_rate[j]], around, acceleration)
            })
            .sum();
        of_paths + forces.torque_on(Frame::Spin)
    }
}

/// The right-hand side from outside of kernels.
struct Derivative<'a> {
    model: &'a Model,
    stage: Stage<'a>,
    derivative: &'a mut [f64],
    forces: &'a mut Forces,
}

impl Kernel for Derivative<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) {
        let Self { model, stage, derivative, forces } = self;
        model.derivative_on::<S, true>(simd, stage, derivative, forces);
    }
}

/// The right-hand side as it is compiled, each kind without the others' work; if `GENERAL`, in an uneven cage, with oil
/// films, of elements in balance or in space.
struct Evaluation<'a, const RECORD: bool, const GENERAL: bool> {
    model: &'a Model,
    stage: Stage<'a>,
    derivative: &'a mut [f64],
    forces: &'a mut Forces,
}

impl<const RECORD: bool, const GENERAL: bool> Kernel for Evaluation<'_, RECORD, GENERAL> {
    type Output = ();

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) {
        let Self { model, stage, derivative, forces } = self;
        let Stage { excitation, cage, state, ahead } = stage;
        if GENERAL {
            if let Some(space) = &model.space {
                return model.spatial_derivative::<S, RECORD>(simd, space, &stage, derivative, forces);
            }
            let angle = excitation.cage_angle_of(cage);
            forces.cage_lead = model.update_uneven(angle, &mut forces.elements, &mut forces.shortcuts.leads);
            if model.elements_in_balance() {
                return model.balanced_derivative::<S, RECORD>(simd, &stage, derivative, forces);
            }
            if let Some(films) = &model.films {
                films.renew(&mut forces.films, excitation.relative_speed.at(cage.tau));
            }
        }
        let now = model.kinematics_of(&stage);
        let [outer, inner] = [forces.non_smooth_outer.is_empty(), forces.non_smooth_inner.is_empty()].map(|none| !none);
        let (mut on_shaft, mut on_housing) = (Vector::zeros(), Vector::zeros());
        if outer || inner {
            if model.has_frames {
                forces.frames = excitation.frames_at(cage.tau);
            }
            if RECORD {
                forces.torques = [0.0; 3];
            }
            if outer {
                let now = &handed_on(&now);
                on_housing = simd.outlined(NonSmoothOuter::<RECORD> { model, now, state, ahead, forces: &mut *forces });
            }
            if inner {
                on_shaft = model.non_smooth_inner_contacts::<RECORD>(&handed_on(&now), state, ahead, forces);
            }
        }
        let kept = (&forces.elements[..], forces.films.as_ref(), &mut forces.contacts);
        let [[shaft_x, shaft_y], [housing_x, housing_y]] =
            model.smooth_contacts::<S, RECORD, GENERAL>(simd, &now, &stage, derivative, kept);
        let (shaft_x, shaft_y) = (shaft_x + on_shaft.x, shaft_y + on_shaft.y);
        let (housing_x, housing_y) = (housing_x + on_housing.x, housing_y + on_housing.y);
        if RECORD && (outer || inner) {
            forces.record_non_smooth();
        }
        let rings = [shaft_x, shaft_y, housing_x, housing_y];
        Lanes::of(simd, rings).store(&mut forces.rings, 0);
        model.body_rates(simd, &stage, &now, rings, derivative);
    }
}
