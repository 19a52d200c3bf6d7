//! The communication step that a host which moves a ring should take.
//!
//! What a coupling loses in a step h is counted in ωh, ω being the fastest mode of the rings against each other on the
//! bearing: ω² = λ (1/m_i + 1/m_o), with the largest eigenvalue λ of the tangent stiffness, a ring that stands having
//! no 1/m. A wiring whose error is of second order (`next_mean_force` held, `mean_force` in sequence, `force` with its
//! derivative, repeated steps that are given their end) is about 1 % off after 20 ms at ωh = [`SECOND_ORDER`], measured
//! with a rotor without a damper on a casing that stands, the worst case; dampers and a soft casing let it be three
//! times that. `force` held is of first order: for 1 % it wants a step a hundred times shorter.
//!
//! The FMU does not know the mass of a ring that the host moves: it takes that of published models, 3.26 kg for a shaft
//! and
//! 6.64 kg for a housing. With m times the mass the step is √m times as long.

use crate::dynamics::parameters::Model;
use crate::dynamics::quasi_static::RingJacobian;
use crate::scene::{Motion, Ring};

/// ωh of a wiring of second order.
const SECOND_ORDER: f64 = 0.1;

/// The step (s) for the tangent ∂F/∂x of all rings.
pub(in crate::simulation) fn suggested_step(model: &Model, tangent: &RingJacobian) -> f64 {
    let of_state = model.supports.inverse_masses();
    let usual = [Ring::default_shaft(), Ring::default_housing()].map(|ring| 1.0 / ring.mass);
    let inverse = |ring: usize| match [model.shaft.motion, model.housing.motion][ring] {
        Motion::Host => usual[ring],
        Motion::Internal => of_state[2 * ring],
        Motion::Fixed => 0.0,
    };
    // Of a symmetric matrix, up to what damping leaves.
    let (xx, yy) = (-tangent[(0, 0)], -tangent[(1, 1)]);
    let xy = -0.5 * (tangent[(0, 1)] + tangent[(1, 0)]);
    let stiffest = 0.5 * (xx + yy) + (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
    // A bearing that carries nothing pushes nobody.
    SECOND_ORDER / (stiffest.max(1.0) * (inverse(0) + inverse(1))).sqrt()
}
