//! Fixed-step methods, for comparison: what a program does that has no error control.
//!
//! Classical Runge–Kutta of order 4, and velocity Verlet in the form for forces that depend on the velocity (half a
//! kick with the force at the start, drift, half a kick with the force at the new position and the half velocity), of
//! order 1 in the damping. Neither lands on contact changes or on the edges of the defect.

use brinell::dynamics::contacts::Forces;
use brinell::dynamics::parameters::{Cells, Drive, Model};
use brinell::simulation::Simulation;

use super::run::{RATE, Signals};

/// A fixed-step method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FixedStep {
    /// Classical Runge–Kutta of order 4.
    RungeKutta4,
    /// Velocity Verlet.
    Verlet,
}

/// A simulation that was initialized, taken over by a fixed-step method.
#[derive(Debug, Clone)]
pub(super) struct FixedRun {
    model: Model,
    drive: Drive,
    cells: Cells,
    forces: Forces,
    state: Vec<f64>,
    moved: Vec<f64>,
    slopes: [Vec<f64>; 4],
}

impl FixedRun {
    /// Starts where the simulation does. Inputs stay at their start values, which one polynomial in time describes.
    pub(super) fn new(simulation: &Simulation) -> Self {
        let (model, drive) = simulation.equations();
        let state = simulation.state_vector().to_vec();
        let zeros = vec![0.0; state.len()];
        Self {
            model: model.clone(),
            drive,
            cells: Cells::smooth(model.element_count, model.defective.len()),
            forces: Forces::of(model),
            moved: zeros.clone(),
            slopes: [zeros.clone(), zeros.clone(), zeros.clone(), zeros],
            state,
        }
    }

    /// Integrates to `stop` (s) in steps of 1/(`RATE`·`per_sample`); with signals if they are wanted. Stops early when
    /// a state is no number any more.
    pub(super) fn run(&mut self, method: FixedStep, per_sample: usize, stop: f64, wanted: bool) -> Signals {
        let mut signals = Signals { acceleration: Vec::new(), paths: Vec::new() };
        let h = 1.0 / (RATE * per_sample as f64);
        for sample in 0..(stop * RATE).round() as usize {
            if wanted && !self.sample(sample as f64 / RATE, &mut signals) {
                break;
            }
            for step in 0..per_sample {
                let tau = (sample * per_sample + step) as f64 * h;
                match method {
                    FixedStep::RungeKutta4 => self.runge_kutta(tau, h),
                    FixedStep::Verlet => self.verlet(tau, h),
                }
            }
        }
        signals
    }

    fn sample(&mut self, tau: f64, signals: &mut Signals) -> bool {
        self.moved.clone_from(&self.state);
        self.slope(0, tau);
        let z = self.model.element_count;
        let acceleration = match self.model.layout.housing {
            Some(housing) => self.slopes[0][housing + 3],
            None => self.forces.shaft()[1],
        };
        signals.acceleration.push(acceleration);
        signals.paths.extend(&self.state[..z]);
        acceleration.is_finite()
    }

    /// Derivative of `moved` at `tau` into slope `k`.
    fn slope(&mut self, k: usize, tau: f64) {
        self.cells = self.model.cells_at(&self.drive, tau, &self.moved);
        self.model.derivative(&self.drive, tau, &self.cells, &self.moved, &mut self.slopes[k], &mut self.forces);
    }

    fn runge_kutta(&mut self, tau: f64, h: f64) {
        self.moved.clone_from(&self.state);
        self.slope(0, tau);
        for (k, share) in [(1, 0.5), (2, 0.5), (3, 1.0)] {
            for i in 0..self.state.len() {
                self.moved[i] = self.state[i] + share * h * self.slopes[k - 1][i];
            }
            self.slope(k, tau + share * h);
        }
        let [a, b, c, d] = &self.slopes;
        for (i, value) in self.state.iter_mut().enumerate() {
            *value += h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]);
        }
    }

    fn verlet(&mut self, tau: f64, h: f64) {
        let layout = self.model.layout;
        let kick = |state: &mut [f64], slope: &[f64]| {
            for (i, value) in state.iter_mut().enumerate().filter(|(i, _)| !layout.is_position(*i)) {
                *value += 0.5 * h * slope[i];
            }
        };
        self.moved.clone_from(&self.state);
        self.slope(0, tau);
        kick(&mut self.state, &self.slopes[0]);
        self.moved.clone_from(&self.state);
        self.slope(1, tau + 0.5 * h);
        for i in (0..self.state.len()).filter(|&i| layout.is_position(i)) {
            self.state[i] += h * self.slopes[1][i];
        }
        self.moved.clone_from(&self.state);
        self.slope(2, tau + h);
        kick(&mut self.state, &self.slopes[2]);
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use brinell::simulation::Method;

    use crate::report::integration::scene_file;
    use crate::report::run::STEP;

    /// A preloaded bearing whose contacts always push: the equations are smooth.
    fn preloaded() -> Simulation {
        let text = std::fs::read_to_string(scene_file("6205-healthy")).unwrap();
        let mut scene = brinell_scene_file::from_toml(&text).unwrap();
        scene.bearing.radial_clearance = -10e-6;
        scene.tolerance = 1e-11;
        scene.sensors.clear();
        let mut simulation = Simulation::new(scene, None).unwrap();
        simulation.initialize(0.0).unwrap();
        // The load grows by half at the start, so that something moves.
        let load = simulation.reference("shaft.load.y").unwrap();
        simulation.set_reals(&[load], &[-700.0]).unwrap();
        simulation
    }

    fn errors(method: FixedStep, steps: [usize; 2]) -> [f64; 2] {
        const STOP: f64 = 2e-3;
        let mut exact = preloaded();
        let start = FixedRun::new(&exact);
        exact.set_method(Method::DormandPrince);
        for _ in 0..(STOP / STEP).round() as usize {
            exact.step(STEP).unwrap();
        }
        steps.map(|per_sample| {
            let mut run = start.clone();
            run.run(method, per_sample, STOP, false);
            let z = run.model.element_count;
            run.state[..z].iter().zip(exact.state_vector()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        })
    }

    #[test]
    fn runge_kutta_converges_with_order_4_to_what_error_control_finds() {
        let [coarse, fine] = errors(FixedStep::RungeKutta4, [10, 20]);
        // 2⁴ as the step goes to 0; the next order of the error and the reference's own leave a sixth.
        assert!((coarse / fine / 16.0 - 1.0).abs() < 1.0 / 6.0, "{coarse:e} m, {fine:e} m with half the step");
    }

    #[test]
    fn verlet_converges_to_what_error_control_finds() {
        let [coarse, fine] = errors(FixedStep::Verlet, [50, 100]);
        // Order 2 in the forces, 1 in the little damping.
        let ratio = coarse / fine;
        assert!((1.8..4.4).contains(&ratio), "{coarse:e} m, {fine:e} m with half the step");
    }
}
