//! The motion of rings and sensors under the forces of the contacts, of supports and of what acts from outside.

use crate::dynamics::parameters::{CageState, Kinematics, Model, Stage, moved};
use crate::numerics::lanes::Wide;
use crate::numerics::plane::Vector;

impl Model {
    /// Derivatives of rings and sensors under the contacts' forces on the rings.
    #[inline(always)]
    pub(super) fn body_rates<S: Wide>(
        &self,
        simd: S,
        stage: &Stage,
        now: &Kinematics,
        [shaft_x, shaft_y, housing_x, housing_y]: [f64; 4],
        derivative: &mut [f64],
    ) {
        let Stage { excitation, cage: &CageState { tau, .. }, state, ahead } = *stage;
        let supports = &self.supports;
        if let Some(i) = self.layout.shaft {
            let load = &excitation.load[0];
            let force = Vector::new(load[0].at(tau) + shaft_x, load[1].at(tau) + shaft_y);
            supports.shaft.ring_rates(simd, &now.shaft, force).store(derivative, i);
        }
        let mut reaction = Vector::zeros();
        for (sensor, i) in supports.sensors.iter().zip(self.layout.sensor_indices()) {
            let v = state[i + 1];
            let force = sensor.force(moved(state[i], v, ahead), v, &now.housing);
            reaction += sensor.direction * force;
            sensor.rates(simd, v, force).store(derivative, i);
        }
        if let Some(i) = self.layout.housing {
            let load = &excitation.load[1];
            let force =
                Vector::new(load[0].at(tau) + (housing_x + reaction.x), load[1].at(tau) + (housing_y + reaction.y));
            supports.housing.ring_rates(simd, &now.housing, force).store(derivative, i);
        }
    }
}
