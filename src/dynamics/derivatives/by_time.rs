//! Derivative of the right-hand side by time at constant state: what turns goes on, rings move as they are prescribed,
//! loads and speeds change. A [`Variation`] like any other, of which the equations over dual numbers make the rest.

use super::fastest::BodyIndices;
use super::jacobian::{Jacobian, bodies};
use super::small_change::{Changing, Variation};
use super::variation::changing_vector;
use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::parameters::{
    BODIES, COORDINATES, Cells, Excitation, FramedKinematics, Kinematics, Model, SPATIAL_BODIES, Space,
};
use crate::dynamics::quasi_static::{Rings, in_plane, stacked};
use crate::dynamics::spatial::accelerations;

impl Variation {
    /// Makes it that by time at `tau`, all that has a state standing still.
    fn set_by_time(&mut self, model: &Model, now: &FramedKinematics, excitation: &Excitation, tau: f64) {
        (self.cage_angle, self.cage_speed) = (now.cage.speed, now.cage.acceleration);
        (self.film_speed, self.frames) = (excitation.relative_speed.rate_at(tau), excitation.frame_rates(tau));
        self.rings = [0, 1].map(|ring| model.prescribed_ring_rates(excitation, ring, tau));
    }
}

impl Model {
    /// Puts the derivative of the right-hand side by time at constant state into [`Jacobian::by_time`]. What elements
    /// in balance at every instant make of it is left out: no method asks for it.
    pub fn derivative_by_time(
        &self,
        excitation: &Excitation,
        tau: f64,
        cells: &Cells,
        state: &[f64],
        Jacobian { by_time, time, .. }: &mut Jacobian,
        shortcuts: &mut Shortcuts,
    ) {
        let now = self.kinematics(excitation, tau, state);
        time.set_by_time(self, &now, excitation, tau);
        by_time.fill(0.0);
        let at = ((excitation, tau), &now, (cells, state));
        match &self.space {
            None => self.by_time_in_plane(at, (time, by_time), shortcuts),
            Some(space) => self.by_time_in_space(space, at, (time, by_time), shortcuts),
        }
    }

    fn by_time_in_plane(
        &self,
        ((excitation, tau), now, (cells, state)): ((&Excitation, f64), &FramedKinematics, (&Cells, &[f64])),
        (time, by_time): (&mut Variation, &mut [f64]),
        shortcuts: &mut Shortcuts,
    ) {
        let elements = if self.elements_in_balance() { 0 } else { self.element_count };
        let housing = changing_vector(now.housing.velocity, time.housing_velocity());
        let mut on_rings = Rings::zeros();
        for j in 0..elements {
            let found = self.changing_forces(j, cells, state, now, time, shortcuts);
            let [on_shaft, on_housing] = found.on_rings();
            on_rings += stacked(on_shaft, on_housing).map(|force| force.by[0]);
            let acceleration = self.radial_acceleration(&found.at, found.forces.radial(), housing);
            by_time[j] = found.at.path_rate.by[0];
            by_time[self.layout.radial_velocity + j] = acceleration.by[0];
        }
        // Prescribed rings move the sensors; on the rings themselves nothing but their loads and elements depends on
        // time.
        let [shaft, housing] = time.in_plane();
        let [velocity, acceleration] = Kinematics { shaft, housing, ..**now }.bodies();
        let acting = on_rings + in_plane(&excitation.load.map(|ring| ring.map(|load| load.rate_at(tau))));
        let rates = self.supports.accelerations(&velocity, &acceleration, &acting);
        put(&bodies::<BODIES>(self), rates.iter().copied(), by_time);
    }

    fn by_time_in_space(
        &self,
        space: &Space,
        ((excitation, tau), now, (cells, state)): ((&Excitation, f64), &FramedKinematics, (&Cells, &[f64])),
        (time, by_time): (&mut Variation, &mut [f64]),
        shortcuts: &mut Shortcuts,
    ) {
        let elements = if self.elements_in_balance() { 0 } else { self.element_count };
        let (rings, [v, w_z]) =
            (self.rings_in_space(excitation, tau, state, None), self.layout.axial().unwrap_or_default());
        let gravity = [self.gravity.x, self.gravity.y, space.gravity].map(Changing::constant);
        let [_, mut acting] = excitation.loads_in_space(tau);
        for j in 0..elements {
            let (at, alpha) = self.changing_ball_motion(j, now, &rings, time, shortcuts);
            let found = self.changing_ball_forces(space, (cells, state), (&at, alpha), time, shortcuts);
            let [f_r, _, f_z] = found.force();
            let [w_rate, axial] = accelerations(&found.ball, &at.rings[1], [f_r, f_z], self.per_mass_of(j), gravity);
            let [u_rate, v_rate] = found.ball.rate;
            let slots = [j, v + j, self.layout.radial_velocity + j, w_z + j];
            for (slot, rate) in slots.into_iter().zip([u_rate, v_rate, w_rate, axial]) {
                by_time[slot] = rate.by[0];
            }
            for (sum, force) in acting.iter_mut().zip(found.on_rings().as_flattened()) {
                *sum += force.by[0];
            }
        }
        let [mut moved, mut going] = [[0.0; SPATIAL_BODIES]; 2];
        for (ring, rates) in time.rings.iter().enumerate() {
            moved[COORDINATES * ring..][..COORDINATES].copy_from_slice(&rates.position);
            going[COORDINATES * ring..][..COORDINATES].copy_from_slice(&rates.velocity);
        }
        let found = space.vary_accelerations((&moved, &going), &acting, &rings, excitation.ring_speeds(tau));
        put(&bodies::<SPATIAL_BODIES>(self), found.into_iter(), by_time);
    }
}

/// Puts the bodies' rates in.
fn put(bodies: &[Option<BodyIndices>], rates: impl Iterator<Item = f64>, by_time: &mut [f64]) {
    for (body, rate) in bodies.iter().zip(rates) {
        if let Some(BodyIndices { velocity, .. }) = *body {
            by_time[velocity] = rate;
        }
    }
}
