//! The couple that turns the spin axis of a ball with the cage, held by the contacts' friction: of balls without
//! inertia only, as nothing here says who would hold it in motion.
//!
//! ```text
//! M_g = 2/5 m r² ω_R ω_c sin β     tan β = sin α_o/(cos α_o + γ')     γ' = D/D_pw
//! ω_R = ω_i/{[(cos α_o + tan β sin α_o)/(1 + γ' cos α_o) + (cos α_i + tan β sin α_i)/(1 − γ' cos α_i)] γ' cos β}
//! ```
//! with the ball's angular momentum H = 2/5 m r² ω_R about an axis at β, dH/dt = ω_c ẑ × H (Jones 1959; signs by that
//! equation). A contact holds the share λ/2 of it by λ M_g/D across the groove, at the point where it touches. The
//! outer ring stands.

use super::OnBall;
use super::contacts::{BallContact, BallForces};
use crate::dynamics::parameters::{Model, Space};
use crate::numerics::number::Scalar;

impl Model {
    /// Adds what holds the couple to the forces on a ball that both contacts carry.
    pub(super) fn add_couple<T: Scalar>(&self, space: &Space, omega: T, found: &mut BallForces<T>) {
        if space.couple_shares == [0.0; 2] || found.contacts.iter().any(|of| !(of.magnitude.value() > 0.0)) {
            return;
        }
        let diameter = 2.0 * self.element_radius;
        let per_diameter = self.gyroscopic_couple(space, found, omega) * T::Plain::from(1.0 / diameter);
        for side in 0..2 {
            let share = per_diameter * T::Plain::from(space.couple_shares[side]);
            let BallContact { seen, normal: [n_x, n_h], on_ball: OnBall { force, moment }, .. } =
                &mut found.contacts[side];
            let held = OnBall::of(seen, [-*n_h * share, *n_x * share], None);
            // It acts at q − r n, and n × t = −t_φ.
            let about = seen.around().map(|part| part * share * T::Plain::from(self.element_radius));
            for i in 0..3 {
                force[i] += held.force[i];
                moment[i] += held.moment[i] - about[i];
            }
        }
    }

    /// M_g (N m) of a ball that goes round with `omega` (rad/s).
    fn gyroscopic_couple<T: Scalar>(&self, space: &Space, of: &BallForces<T>, omega: T) -> T {
        let (plain, r) = (T::Plain::from, self.element_radius);
        let gamma = plain(r / space.pitch_radius);
        let [[cos_i, sin_i], [inwards, along]] = [0, 1].map(|side: usize| of.contacts[side].normal);
        let (cos_o, sin_o) = (-inwards, -along);
        let one = T::from(1.0);
        let tan = sin_o / (cos_o + gamma);
        let cos = one / (one + tan * tan).sqrt();
        let outer = (cos_o + tan * sin_o) / (one + cos_o * gamma);
        let inner = (cos_i + tan * sin_i) / (one - cos_i * gamma);
        let shaft = omega * plain(1.0 / self.ratios.cage[0]);
        let spin = shaft / ((outer + inner) * cos * gamma);
        spin * omega * (tan * cos) * plain(0.4 * self.element_mass * r * r)
    }
}
