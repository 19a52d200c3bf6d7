//! A rotor of 3 kg on 1e7 N/m in a host, in every way in which hosts step and wire it, against one simulation that
//! holds mass and spring: the cells of `docs/how-to/systems.md`.
//!
//! The rotor rests under half of 500 N; at the start the other half is added.

use crate::support::differences::{reals, references};
use crate::support::shipped;
use brinell::scene::{AxialSupport, Motion, Ring, Scene};
use brinell::simulation::Simulation;

pub(super) type Pair = [f64; 2];
pub(super) const LOAD: f64 = -500.0;
/// Between positions that are compared (s).
pub(super) const GRID: f64 = 1e-4;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Casing {
    /// On its support, with its damper.
    Free,
    /// The same without the damper.
    NoDamper,
    /// It stands.
    Fixed,
}

impl Casing {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::NoDamper => "no damper",
            Self::Fixed => "fixed",
        }
    }
}

/// The mass of a host with its spring and damper (kg, N/m, N s/m).
#[derive(Clone, Copy, Debug)]
pub(super) struct Rotor {
    pub(super) mass: f64,
    pub(super) stiffness: f64,
}

pub(super) const ROTOR: Rotor = Rotor { mass: 3.0, stiffness: 1e7 };

/// How the host steps, and which force the rotor gets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Wiring {
    /// All units at once; the force of this kind is held.
    Parallel(&'static str),
    /// The same, with `force` and its derivative.
    Derivative,
    /// Bearing first; the force of this kind is held.
    Sequential(&'static str),
    /// Bearing first; `force` goes straight from the start of the step to its end.
    Interpolated,
    /// Each step four times from the same point, with what came out.
    Iterated,
}

pub(super) const WIRINGS: [Wiring; 8] = [
    Wiring::Parallel("mean_"),
    Wiring::Parallel(""),
    Wiring::Parallel("next_mean_"),
    Wiring::Derivative,
    Wiring::Iterated,
    Wiring::Sequential(""),
    Wiring::Interpolated,
    Wiring::Sequential("mean_"),
];

impl std::fmt::Display for Wiring {
    fn fmt(&self, to: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Parallel(kind) => write!(to, "parallel {kind}force held"),
            Self::Derivative => to.write_str("parallel force and its derivative"),
            Self::Sequential(kind) => write!(to, "sequential {kind}force held"),
            Self::Interpolated => to.write_str("sequential force interpolated"),
            Self::Iterated => to.write_str("iterated mean_force held; the end repeated"),
        }
    }
}

pub(super) fn scene(spalled: bool, casing: Casing) -> Scene {
    let mut scene = shipped("er16k-tb1-hosted-shaft");
    (scene.shaft_speed, scene.tolerance) = (30.0 * std::f64::consts::TAU, 1e-9);
    scene.housing.load = [0.0; 2];
    if !spalled {
        scene.defects.clear();
    }
    match casing {
        Casing::Free => {}
        Casing::NoDamper => scene.housing.damping = 0.0,
        Casing::Fixed => {
            scene.housing = Ring::fixed();
            scene.sensors.clear();
        }
    }
    scene
}

/// Positions of the rotor inside a simulation of this bearing, every grid step until `stop` (s).
pub(super) fn whole(mut scene: Scene, rotor: Rotor, stop: f64) -> Vec<Pair> {
    scene.shaft = Ring {
        motion: Motion::Internal,
        load: [0.0, 0.5 * LOAD],
        mass: rotor.mass,
        damping: 0.0,
        stiffness: rotor.stiffness,
        axial: AxialSupport::NONE,
        ..scene.shaft
    };
    let mut simulation = Simulation::new(scene, None).unwrap();
    simulation.initialize(0.0).unwrap();
    simulation.set("shaft.load.y", LOAD).unwrap();
    let samples = simulation.samples(&["shaft.x", "shaft.y"], GRID).unwrap();
    samples.take((stop / GRID).round() as usize + 1).map(|s| s.unwrap().values.try_into().unwrap()).collect()
}

impl Rotor {
    /// Its place and velocity after `h` under a force that goes straight, exactly.
    fn moved(&self, x: Pair, v: Pair, force: Pair, slope: Pair, h: f64) -> [Pair; 2] {
        let (k, rate) = (self.stiffness, (self.stiffness / self.mass).sqrt());
        let (sin, cos) = (rate * h).sin_cos();
        let mut after = [[0.0; 2]; 2];
        for i in 0..2 {
            let load = [0.0, LOAD][i] + force[i];
            let (a, b) = (x[i] - load / k, (v[i] - slope[i] / k) / rate);
            after[0][i] = (load + slope[i] * h) / k + a * cos + b * sin;
            after[1][i] = slope[i] / k + rate * (b * cos - a * sin);
        }
        after
    }

    fn acceleration(&self, x: Pair, force: Pair) -> Pair {
        [0, 1].map(|i| (force[i] + [0.0, LOAD][i] - self.stiffness * x[i]) / self.mass)
    }
}

/// A bearing and a rotor in a host.
pub(super) struct Host {
    pub(super) bearing: Simulation,
    rotor: Rotor,
    wiring: Wiring,
    motion: Vec<u32>,
    forces: [Vec<u32>; 3],
    x: Pair,
    v: Pair,
    /// The force that the rotor was given last.
    given: Pair,
}

impl Host {
    /// Begins where the rotor rests.
    pub(super) fn new(mut bearing: Simulation, rotor: Rotor, wiring: Wiring, start: Pair) -> Self {
        let motion = references(&bearing, &["shaft.x", "shaft.y", "shaft.vx", "shaft.vy", "shaft.ax", "shaft.ay"]);
        let forces = ["", "mean_", "next_mean_"].map(|kind| {
            ["x", "y"].map(|axis| bearing.reference(&format!("shaft.{kind}force.{axis}")).unwrap()).to_vec()
        });
        if wiring == Wiring::Iterated {
            let repeated = bearing.reference("host.repeated_inputs").unwrap();
            bearing.set_integers(&[repeated], &[2]).unwrap();
        }
        bearing.set_reals(&motion[..2], &start).unwrap();
        bearing.initialize(0.0).unwrap();
        let mut host = Self { bearing, rotor, wiring, motion, forces, x: start, v: [0.0; 2], given: [0.0; 2] };
        host.given = host.read("");
        host
    }

    fn read(&mut self, kind: &str) -> Pair {
        let which = ["", "mean_", "next_mean_"].iter().position(|name| *name == kind).unwrap();
        reals(&mut self.bearing, &self.forces[which]).try_into().unwrap()
    }

    fn tell(&mut self, x: Pair, v: Pair, a: Pair) {
        self.bearing.set_reals(&self.motion, &[x, v, a].concat()).unwrap();
    }

    /// Takes a step, or says why the bearing does not.
    pub(super) fn step(&mut self, h: f64) -> Result<Pair, String> {
        let (x, v) = (self.x, self.v);
        let take = |bearing: &mut Simulation| bearing.step(h).map_err(|error| error.to_string());
        let a = self.rotor.acceleration(x, self.given);
        let (mut force, mut slope) = (self.given, [0.0; 2]);
        match self.wiring {
            Wiring::Parallel(kind) => force = self.read(kind),
            Wiring::Interpolated => force = self.read(""),
            Wiring::Derivative => {
                force = self.read("");
                self.bearing.output_derivatives(&self.forces[0], &[1, 1], &mut slope).unwrap();
            }
            Wiring::Sequential(_) | Wiring::Iterated => {}
        }
        let before = (self.wiring == Wiring::Iterated).then(|| self.bearing.save());
        self.tell(x, v, a);
        take(&mut self.bearing)?;
        match self.wiring {
            Wiring::Sequential(kind) => force = self.read(kind),
            Wiring::Interpolated => {
                let end = self.read("");
                slope = [0, 1].map(|i| (end[i] - force[i]) / h);
            }
            _ => {}
        }
        if let Some(before) = before {
            // All units in parallel: the rotor gets what came out the time before.
            for _ in 1..4 {
                force = self.read("mean_");
                let [x1, v1] = self.rotor.moved(x, v, force, [0.0; 2], h);
                self.bearing.restore(&before).unwrap();
                self.tell(x1, v1, a);
                take(&mut self.bearing)?;
            }
            force = self.read("mean_");
        }
        [self.x, self.v] = self.rotor.moved(x, v, force, slope, h);
        self.given = [0, 1].map(|i| force[i] + slope[i] * h);
        if self.x.iter().all(|x| x.abs() < 1e-3) { Ok(self.x) } else { Err("beyond 1 mm".to_owned()) }
    }
}

/// A cell: error of the rotor's place, rms over rms of its way, infinite if it goes astray, and what the bearing told.
pub(super) struct Cell {
    pub(super) error: f64,
    pub(super) told: f64,
}

pub(super) fn cell(bearing: &Simulation, rotor: Rotor, wiring: Wiring, h: f64, exact: &[Pair]) -> Cell {
    let mut host = Host::new(bearing.clone(), rotor, wiring, exact[0]);
    let (mut off, mut way, mut error) = (0.0, 0.0, None);
    let every = (GRID / h).round() as usize;
    for place in &exact[1..] {
        let found = (0..every).map(|_| host.step(h)).find(Result::is_err).unwrap_or(Ok(host.x));
        if found.is_err() {
            error = Some(f64::INFINITY);
            break;
        }
        let square = |a: Pair, b: Pair| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2);
        off += square(host.x, *place);
        way += square(*place, exact[0]);
    }
    let told = host.bearing.get("host.largest_coupling_error").unwrap();
    Cell { error: error.unwrap_or((off / way).sqrt()), told }
}
