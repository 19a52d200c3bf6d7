//! What rings, the sensor and its modes do under the forces of the contacts.

use crate::bearing::Bearing;
use crate::case::Motion;
use crate::instant::{Acting, Outside, SENSOR};
use crate::turning::quadratic;
use std::f64::consts::TAU;

impl Bearing {
    /// Modes of a structure that the sensor's own acceleration shakes, and what it measures on top of them.
    fn mode_rates(&self, y: &[f64], rates: &mut [f64], acting: &mut Acting) {
        acting.measured = acting.sensor;
        for (mode, at) in self.modes.iter().zip((self.first_mode()..).step_by(2)) {
            let omega = TAU * mode.frequency_hz;
            let [z, rate] = [y[at], y[at + 1]];
            let acceleration = -acting.sensor - 2.0 * mode.damping_ratio * omega * rate - omega * omega * z;
            (rates[at], rates[at + 1]) = (rate, acceleration);
            acting.measured += mode.gain * acceleration + mode.quadrature_gain * omega * rate;
        }
    }

    pub(super) fn ring_rates(
        &self,
        outside: &Outside,
        t: f64,
        y: &[f64],
        motions: &[[[f64; 3]; 2]; 2],
        rates: &mut [f64],
        acting: &mut Acting,
    ) {
        let mut reaction = 0.0;
        (rates[SENSOR], rates[SENSOR + 1]) = (0.0, 0.0);
        acting.sensor = 0.0;
        if let Some([mass, stiffness, damping]) = self.sensor {
            reaction = stiffness * (y[SENSOR] - motions[1][1][0]) + damping * (y[SENSOR + 1] - motions[1][1][1]);
            acting.sensor = -reaction / mass;
            (rates[SENSOR], rates[SENSOR + 1]) = (y[SENSOR + 1], acting.sensor);
        }
        self.mode_rates(y, rates, acting);
        for which in 0..2 {
            let ring = &self.rings[which];
            for a in 0..2 {
                let [x, v, prescribed] = motions[which][a];
                acting.accelerations[which][a] = prescribed;
                (rates[4 * which + a], rates[4 * which + 2 + a]) = (0.0, 0.0);
                if ring.motion == Motion::Internal {
                    let load = quadratic(outside.rings[which][a], t)[0];
                    let own = load + acting.rings[which][a] - ring.damping * v - ring.stiffness * x;
                    let own = if which == 1 && a == 1 { own + reaction } else { own };
                    acting.accelerations[which][a] = own / ring.mass;
                    (rates[4 * which + a], rates[4 * which + 2 + a]) = (v, own / ring.mass);
                }
            }
        }
    }
}
