//! Co-simulation with a host that is a mass on the inner ring: motion in, force out.
//!
//! The host's mass m carries the load F_e, has the damper c of the scene's shaft to the ground and hangs on the
//! bearing; the housing stands. The bearing steps first, from the ring motion that the host gives it; then the host
//! moves under the bearing's force. Three ways:
//!
//! | way | ring motion within a step | bearing's force within a step |
//! |---|---|---|
//! | held | stays where it is | stays what it was at the end of the step |
//! | extrapolated | x + vτ + ½aτ² | the parabola through both ends with the mean force that the FMU gives |
//! | rolled back | as extrapolated, then again: a parabola of the mean that came out | the same, brought to it |
//!
//! To roll back, the state is put back and the step repeated with the parabola that has the same mean as the motion
//! that came out; the FMU's tangent stiffness brings the force to that motion.
//!
//! With F₀ and F₁ at the ends and F̄ as mean, and the velocity running evenly from v₀ to v₁ as far as the damper sees
//! it, the host's motion is
//! ```text
//! v₁ = v₀ + H (F̄ + F_e)/m − c (x₁ − x₀)/m
//! x₁ = x₀ + H v₀ + H²/m (F̄/2 + (F₀ − F₁)/12 + F_e/2 − c (v₀/3 + v₁/6))
//! ```
//! and momentum is kept exactly; the mean position, which the rolled back step needs, is x₀ + H v₀/2 + H²/m (F₀/20 −
//! F₁/30 + 3F̄/20 + F_e/6 − c (v₀/8 + v₁/24)). F₀ is read anew when the host has set where the ring really is; that
//! needs no step. The exact motion is that of one simulation with the mass inside.
//!
//! The run begins in balance under half the load; then the whole load acts, and the ring swings with its own frequency
//! on the bearing.

use brinell::scene::{Motion, Ring, Scene};
use brinell::simulation::Simulation;
use brinell::simulation::SimulationError;
use nalgebra::{Matrix4, Vector4};

/// How the host and the bearing exchange motion and force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coupling {
    /// Motion and force are held during a step.
    Held,
    /// The FMU extrapolates the motion; the host uses mean and end force.
    Extrapolated,
    /// As extrapolated, and each step is repeated once with the motion that came out.
    RolledBack,
}

impl Coupling {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Held, Self::Extrapolated, Self::RolledBack];

    /// Name for tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Held => "held",
            Self::Extrapolated => "extrapolated",
            Self::RolledBack => "rolled back once",
        }
    }
}

/// Outcome of one run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Mass of the host (kg).
    pub host_mass: f64,
    /// Way of coupling.
    pub coupling: Coupling,
    /// Communication step H (s).
    pub step: f64,
    /// Root mean square of the error of the ring's position over that of its distance from the start; `None` if the run
    /// was unstable: the ring was further from its exact position than twice the largest distance, or out of the
    /// bearing.
    pub error: Option<f64>,
}

/// Simulated time (s).
const STOP: f64 = 0.02;
/// Tolerance of the bearing: its errors stay below those of the coupling.
const TOLERANCE: f64 = 1e-9;
const DAMPER_ITERATIONS: usize = 8;
/// Communication steps of the study (s).
pub const STEPS: [f64; 12] = [1e-6, 2e-6, 5e-6, 1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 3e-4, 4e-4, 5e-4, 6e-4];
/// Masses of hosts (kg).
pub const MASSES: [f64; 3] = [0.1, 1.0, 3.0];

/// Runs every coupling with every step for the bearing of `scene` under its own load.
///
/// # Errors
/// A scene that cannot be set up; the exact run failing.
pub fn study(scene: &Scene, masses: &[f64], steps: &[f64]) -> Result<Vec<Row>, SimulationError> {
    let mut rows = Vec::new();
    for &host_mass in masses {
        let finest = steps.iter().copied().fold(f64::INFINITY, f64::min);
        let exact = Exact::new(scene, host_mass, finest)?;
        for coupling in Coupling::ALL {
            for &step in steps {
                rows.push(Row { host_mass, coupling, step, error: exact.error_of(scene, coupling, step)? });
            }
        }
    }
    Ok(rows)
}

/// How far a coupling is stable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// Mass of the host (kg).
    pub host_mass: f64,
    /// The coupling.
    pub coupling: Coupling,
    /// Longest step (s) up to which all shorter ones are stable, too.
    pub longest: Option<f64>,
}

/// One for each mass and coupling, in the rows' order.
pub fn limits(rows: &[Row]) -> Vec<Limit> {
    let mut limits: Vec<Limit> = Vec::new();
    for row in rows {
        let known = limits.iter().any(|l| l.host_mass == row.host_mass && l.coupling == row.coupling);
        if known {
            continue;
        }
        let same = rows.iter().filter(|r| r.host_mass == row.host_mass && r.coupling == row.coupling);
        let (mut stable, mut unstable) = (Vec::new(), f64::INFINITY);
        for r in same {
            match r.error {
                Some(_) => stable.push(r.step),
                None => unstable = unstable.min(r.step),
            }
        }
        let longest = stable.into_iter().filter(|&step| step < unstable).reduce(f64::max);
        limits.push(Limit { host_mass: row.host_mass, coupling: row.coupling, longest });
    }
    limits
}

/// The motion of the ring with the mass inside one simulation.
struct Exact {
    host_mass: f64,
    /// Time between positions (s).
    step: f64,
    /// Positions x, y (m).
    positions: Vec<[f64; 2]>,
    /// Largest distance from the start (m).
    travel: f64,
}

/// The bearing between a housing that stands and a ring that `shaft` describes.
fn bearing(scene: &Scene, shaft: Ring) -> Result<Simulation, SimulationError> {
    let mut scene = scene.clone();
    scene.shaft = shaft;
    scene.housing = Ring::fixed();
    (scene.sensors, scene.defects) = (Vec::new(), Vec::new());
    scene.tolerance = TOLERANCE;
    Simulation::new(scene, None)
}

fn references<const N: usize>(bearing: &Simulation, names: [&str; N]) -> Result<[u32; N], SimulationError> {
    let mut references = [0; N];
    for (reference, name) in references.iter_mut().zip(names) {
        *reference = bearing.reference(name)?;
    }
    Ok(references)
}

impl Exact {
    fn new(scene: &Scene, host_mass: f64, step: f64) -> Result<Self, SimulationError> {
        let half = scene.shaft.load.map(|load| 0.5 * load);
        let damping = scene.shaft.damping;
        let ring = Ring { motion: Motion::Internal, load: half, mass: host_mass, damping, stiffness: 0.0 };
        let mut inside = bearing(scene, ring)?;
        inside.initialize(0.0)?;
        let (load, position) =
            (references(&inside, ["shaft.load.x", "shaft.load.y"])?, references(&inside, ["shaft.x", "shaft.y"])?);
        inside.set_reals(&load, &scene.shaft.load).map_err(SimulationError::from)?;
        let mut positions = Vec::new();
        for i in 0..=(STOP / step).round() as usize {
            if i > 0 {
                inside.step(step)?;
            }
            let mut now = [0.0; 2];
            inside.reals(&position, &mut now)?;
            positions.push(now);
        }
        let start = positions[0];
        let travel = positions.iter().map(|p| (p[0] - start[0]).hypot(p[1] - start[1])).fold(0.0, f64::max);
        Ok(Self { host_mass, step, positions, travel })
    }

    /// As [`Row::error`].
    fn error_of(&self, scene: &Scene, coupling: Coupling, step: f64) -> Result<Option<f64>, SimulationError> {
        let mut host = Host::new(scene, self)?;
        let (mut errors, mut distances) = (0.0, 0.0);
        let stride = (step / self.step).round() as usize;
        for position in self.positions.iter().step_by(stride).skip(1) {
            // A ring that leaves the bearing ends the run with an error of the bearing.
            if host.advance(coupling, step).is_err() {
                return Ok(None);
            }
            let error = (host.x[0] - position[0]).hypot(host.x[1] - position[1]);
            if !(error <= 2.0 * self.travel) {
                return Ok(None);
            }
            errors += error * error;
            distances += (position[0] - self.positions[0][0]).powi(2) + (position[1] - self.positions[0][1]).powi(2);
        }
        Ok(Some(f64::sqrt(errors / distances)))
    }
}

/// A mass on the inner ring.
struct Host {
    bearing: Simulation,
    motion: [u32; 6],
    force: [u32; 2],
    mean_force: [u32; 2],
    stiffness: [u32; 4],
    mass: f64,
    damping: f64,
    load: [f64; 2],
    x: [f64; 2],
    v: [f64; 2],
    /// The bearing's force at the present instant (N).
    now: [f64; 2],
}

impl Host {
    fn new(scene: &Scene, exact: &Exact) -> Result<Self, SimulationError> {
        let ring = Ring::hosted();
        let bearing = bearing(scene, ring)?;
        let mut host = Self {
            motion: references(&bearing, ["shaft.x", "shaft.y", "shaft.vx", "shaft.vy", "shaft.ax", "shaft.ay"])?,
            force: references(&bearing, ["shaft.force.x", "shaft.force.y"])?,
            mean_force: references(&bearing, ["shaft.mean_force.x", "shaft.mean_force.y"])?,
            stiffness: references(
                &bearing,
                ["shaft.stiffness.xx", "shaft.stiffness.xy", "shaft.stiffness.yx", "shaft.stiffness.yy"],
            )?,
            bearing,
            mass: exact.host_mass,
            damping: scene.shaft.damping,
            load: scene.shaft.load,
            x: exact.positions[0],
            v: [0.0; 2],
            now: [0.0; 2],
        };
        host.give([0.0; 2], [0.0; 2])?;
        host.bearing.initialize(0.0)?;
        host.bearing.reals(&host.force, &mut host.now)?;
        Ok(host)
    }

    fn give(&mut self, v: [f64; 2], a: [f64; 2]) -> Result<(), SimulationError> {
        let values = [self.x[0], self.x[1], v[0], v[1], a[0], a[1]];
        self.bearing.set_reals(&self.motion, &values).map_err(SimulationError::from)
    }

    /// The bearing's mean and end force over a step in which the ring moves as x + vτ + ½aτ² (N).
    fn bearing_step(&mut self, v: [f64; 2], a: [f64; 2], step: f64) -> Result<[[f64; 2]; 2], SimulationError> {
        self.give(v, a)?;
        self.bearing.step(step)?;
        let (mut mean, mut end) = ([0.0; 2], [0.0; 2]);
        self.bearing.reals(&self.mean_force, &mut mean)?;
        self.bearing.reals(&self.force, &mut end)?;
        Ok([mean, end])
    }

    fn advance(&mut self, coupling: Coupling, step: f64) -> Result<(), SimulationError> {
        if coupling == Coupling::Held {
            let [_, end] = self.bearing_step([0.0; 2], [0.0; 2], step)?;
            self.now = end;
            (self.x, self.v) = self.moved(end, end, step);
            return Ok(());
        }
        self.give(self.v, [0.0; 2])?;
        self.bearing.reals(&self.force, &mut self.now)?;
        let a = [0, 1].map(|a| (self.load[a] + self.now[a] - self.damping * self.v[a]) / self.mass);
        if coupling == Coupling::Extrapolated {
            let [mean, end] = self.bearing_step(self.v, a, step)?;
            (self.x, self.v) = self.moved(mean, end, step);
            return Ok(());
        }
        let before = self.bearing.save();
        let first = self.bearing_step(self.v, a, step)?;
        let [mean_position, ..] = self.corrected(first, a, step)?;
        self.bearing.restore(&before)?;
        let a = [0, 1].map(|a| 6.0 * (mean_position[a] - self.x[a] - 0.5 * step * self.v[a]) / (step * step));
        let second = self.bearing_step(self.v, a, step)?;
        let [_, x, v] = self.corrected(second, a, step)?;
        (self.x, self.v) = (x, v);
        Ok(())
    }

    /// Position and velocity after a step under the bearing's force.
    fn moved(&self, mean: [f64; 2], end: [f64; 2], step: f64) -> ([f64; 2], [f64; 2]) {
        let (h, c) = (step, self.damping / self.mass);
        let (mut x, mut v) = (self.x, self.v);
        for a in 0..2 {
            // v₁ + c/m x₁ = p and x₁ + c/m H²/6 v₁ = q
            let p = self.v[a] + h * (mean[a] + self.load[a]) / self.mass + c * self.x[a];
            let force = 0.5 * (mean[a] + self.load[a]) + (self.now[a] - end[a]) / 12.0;
            let q = self.x[a] + h * self.v[a] + h * h * (force / self.mass - c * self.v[a] / 3.0);
            let share = c * h * h / 6.0;
            x[a] = (q - share * p) / (1.0 - share * c);
            v[a] = p - c * x[a];
        }
        (x, v)
    }

    /// Mean position, end position and end velocity after a step in which the ring moved with `a`, the forces brought
    /// to where the ring comes by the tangent stiffness K: F̄ falls by K times the distance of the mean positions, F₁
    /// by K times that of the end positions.
    fn corrected(&mut self, [mean, end]: [[f64; 2]; 2], a: [f64; 2], h: f64) -> Result<[[f64; 2]; 3], SimulationError> {
        let mut k = [0.0; 4];
        self.bearing.reals(&self.stiffness, &mut k)?;
        let times = |x: [f64; 2]| [k[0] * x[0] + k[1] * x[1], k[2] * x[0] + k[3] * x[1]];
        let along = |share: f64, bend: f64| [0, 1].map(|i| self.x[i] + h * (share * self.v[i] + bend * h * a[i]));
        let (by_mean, by_end) = (times(along(0.5, 1.0 / 6.0)), times(along(1.0, 0.5)));
        // Forces if the ring had stayed at the origin.
        let mean = [0, 1].map(|i| mean[i] + by_mean[i]);
        let end = [0, 1].map(|i| end[i] + by_end[i]);
        let (g, c) = (h * h / self.mass, self.damping);
        let mut matrix = Matrix4::zeros();
        for i in 0..2 {
            for j in 0..2 {
                let (k, one) = (g * k[2 * i + j], if i == j { 1.0 } else { 0.0 });
                (matrix[(i, j)], matrix[(i, 2 + j)]) = (one + 0.15 * k, -k / 30.0);
                (matrix[(2 + i, j)], matrix[(2 + i, 2 + j)]) = (0.5 * k, one - k / 12.0);
            }
        }
        let factors = matrix.lu();
        let (mut found, mut v) = ([[0.0; 2]; 2], self.v);
        // The damper's end velocity by iteration: c H/m is small.
        for _ in 0..DAMPER_ITERATIONS {
            let mut right = Vector4::zeros();
            for i in 0..2 {
                let (f, load, v_0) = (self.now[i], self.load[i], self.v[i]);
                right[i] = self.x[i]
                    + 0.5 * h * v_0
                    + g * (f / 20.0 - end[i] / 30.0 + 0.15 * mean[i] + load / 6.0 - c * (v_0 / 8.0 + v[i] / 24.0));
                right[2 + i] = self.x[i]
                    + h * v_0
                    + g * (0.5 * (mean[i] + load) + (f - end[i]) / 12.0 - c * (v_0 / 3.0 + v[i] / 6.0));
            }
            let y = factors.solve(&right).unwrap_or_else(|| Vector4::repeat(f64::NAN));
            found = [[y[0], y[1]], [y[2], y[3]]];
            let pull = times(found[0]);
            v = [0, 1].map(|i| {
                let force = mean[i] - pull[i] + self.load[i];
                self.v[i] + (h * force - c * (found[1][i] - self.x[i])) / self.mass
            });
        }
        Ok([found[0], found[1], v])
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn a_host_of_three_kilograms_is_stable_and_exact_as_far_as_the_documentation_says() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/er16k-tb1.toml");
        let scene = brinell_scene_file::from_toml(&std::fs::read_to_string(path).unwrap()).unwrap();
        let rows = study(&scene, &[3.0], &[1e-5, 1e-4, 3e-4, 5e-4]).unwrap();
        let error = |coupling: Coupling, step: f64| {
            rows.iter().find(|row| row.coupling == coupling && row.step == step).unwrap().error
        };
        // The figures of the documentation; measured errors are 1.8e-5 and below.
        assert!(error(Coupling::Extrapolated, 1e-5).unwrap() < 2e-5, "{rows:?}");
        assert!(error(Coupling::Extrapolated, 3e-4).is_some(), "{rows:?}");
        assert!(error(Coupling::RolledBack, 5e-4).is_some(), "{rows:?}");
        assert!(error(Coupling::RolledBack, 1e-5).unwrap() < error(Coupling::Extrapolated, 1e-5).unwrap());
        assert_eq!(error(Coupling::Held, 1e-4), None);
        let limits = limits(&rows);
        assert_eq!(limits[0], Limit { host_mass: 3.0, coupling: Coupling::Held, longest: Some(1e-5) });
        assert_eq!(limits[2].longest, Some(5e-4));
    }
}
