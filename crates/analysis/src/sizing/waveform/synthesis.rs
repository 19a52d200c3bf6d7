//! What the scene's own rig would sound like with a spall of a given length, and which length sounds most like the
//! recording.
//!
//! Where the scene describes the rig (rings that move, a sensor), the library's own simulation is the model of how an
//! element of finite size rolls in and out: it is run with trial spalls in the load's direction, and the passage it
//! gives, averaged and cut off above the rings' modes, is laid over the measured one:
//! ```text
//! c(L) = max over shift of |⟨measured, simulated(L)⟩| / (‖measured‖ ‖simulated(L)‖)
//! ```
//! The scene's defect is ignored. A rig that is not the scene's gives a low c, and the fit is then not used.
//! Above the cut lies the chatter of unloaded elements, which depends on the last micrometre and is no measure of
//! length.

use crate::sizing::passages::fold;
use crate::spectrum::{Band, Spectrum};
use brinell::geometry::kinematics;
use brinell::scene::{Cage, ContactLaw, Defect, DefectShape, Motion, Scene};
use brinell::simulation::{Simulation, SimulationError};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Points of one passage.
pub const POINTS: usize = 1024;
/// Upper edge of the compared band (Hz): above the rings' modes (0.2–1 kHz), below the chatter of unloaded elements.
pub const CUT: f64 = 2500.0;
/// Time in which the rings' modes decay to a hundredth, with usual supports (s); a long run grants twice that.
const DECAY: f64 = 0.025;
/// Tolerance of short runs: it moves similarity by less than 0.002 and saves a third of the time.
const ROUGH: f64 = 1e-3;

/// How long a trial runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Run {
    /// One passage after the first have rung out: enough to find the direction.
    Short,
    /// The mean of four passages, after twice the time: chatter differs from passage to passage.
    Long,
}

/// A trial spall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trial {
    /// Length [degrees of the outer raceway].
    pub length: f64,
    /// Depth (m).
    pub depth: f64,
    /// Law of the contact near its edges.
    pub law: ContactLaw,
}

/// Where contact maps come from: the bytes of a scene's map, or `None` to have it computed here.
pub type Maps<'a> = &'a (dyn Fn(&Scene) -> Option<Vec<u8>> + Sync);

/// The scene's rig at the recording's speed.
#[derive(Clone)]
pub struct Rig<'a> {
    scene: Scene,
    bpfo: f64,
    rate: f64,
    maps: Maps<'a>,
}

impl<'a> Rig<'a> {
    /// The scene at the speed at which elements pass `bpfo` times a second (Hz); `None` when the scene leaves motion or
    /// sensor to others and cannot be simulated by itself.
    pub fn new(scene: &Scene, bpfo: f64, maps: Maps<'a>) -> Option<Self> {
        let whole = scene.shaft.motion == Motion::Internal && scene.housing.motion != Motion::Host;
        if !whole || scene.sensors.is_empty() || scene.housing.motion != Motion::Internal {
            return None;
        }
        let mut scene = scene.clone();
        // Element 1 starts in the middle of the spall: an entry lies half the spall's length before the passage's
        // start.
        let initial_angle = load_angle(&scene);
        scene.cage = Cage { slip: 0.0, spin_slip: 0.0, initial_angle, irregularity: None };
        scene.shaft_speed = TAU * bpfo / kinematics::frequencies(&scene.bearing, 0.0, 1.0).bpfo;
        scene.recorder = None;
        // Elements ring at 40 to 50 kHz on their contacts: sampled much slower, that would fold below the cut.
        Some(Self { scene, bpfo, rate: 20.0 * CUT, maps })
    }

    /// One passage with a trial spall as the sensor would record it, below the cut, mean 0, norm 1.
    ///
    /// # Errors
    /// Those of the simulation.
    pub fn passage(&self, trial: Trial, run: Run) -> Result<Vec<f64>, SimulationError> {
        self.passage_of(self.with_spall(trial), run)
    }

    /// The same of the rig without a spall.
    ///
    /// # Errors
    /// Those of the simulation.
    pub fn healthy_passage(&self) -> Result<Vec<f64>, SimulationError> {
        let mut scene = self.scene.clone();
        scene.defects.clear();
        scene.contact.law = ContactLaw::Hertz;
        self.passage_of(scene, Run::Long)
    }

    fn passage_of(&self, mut scene: Scene, run: Run) -> Result<Vec<f64>, SimulationError> {
        let count = if run == Run::Short { 1 } else { 4 };
        let decays = if run == Run::Short { 1.0 } else { 2.0 };
        let settling = ((decays * DECAY * self.bpfo).ceil() as usize).max(1);
        let passages = settling..settling + count;
        let map = if scene.contact.law == ContactLaw::Map { (self.maps)(&scene) } else { None };
        if run == Run::Short {
            scene.tolerance = scene.tolerance.max(ROUGH);
        }
        let mut simulation = Simulation::with_map(scene, None, map.as_deref())?;
        let sensor = simulation.scene().sensor_variable(0);
        simulation.initialize(0.0)?;
        let count = (passages.end as f64 * self.rate / self.bpfo) as usize + 4;
        let samples = simulation.samples(&[&sensor], 1.0 / self.rate)?.skip(1).take(count);
        let signal = samples.map(|sample| Ok(sample?.values[0])).collect::<Result<Vec<f64>, SimulationError>>()?;
        let period = self.rate / self.bpfo;
        let starts: Vec<f64> = passages.map(|i| i as f64 * period).collect();
        Ok(below_cut(&fold::mean(&signal, &starts, period, POINTS), self.bpfo))
    }

    /// The rig with the trial spall in the middle of the load zone.
    pub fn with_spall(&self, trial: Trial) -> Scene {
        with_spall(&self.scene, trial)
    }
}

/// The scene with the trial spall in the middle of the load zone.
pub fn with_spall(scene: &Scene, trial: Trial) -> Scene {
    let mut scene = scene.clone();
    let angle = load_angle(&scene);
    let length = trial.length.to_radians() * scene.bearing.outer_raceway_radius();
    let shape = DefectShape::Spall { length, depth: trial.depth, edge_slope: 0.5 * PI };
    scene.defects = vec![Defect::outer(angle, shape)];
    scene.contact.law = trial.law;
    scene
}

/// Direction of the shaft's load; downwards when there is none.
fn load_angle(scene: &Scene) -> f64 {
    let load = scene.shaft.load;
    if load == [0.0; 2] { -FRAC_PI_2 } else { libm::atan2(load[1], load[0]) }
}

/// A passage of [`POINTS`] points without what lies above the cut, mean 0, norm 1; `bpfo` in Hz.
pub fn below_cut(passage: &[f64], bpfo: f64) -> Vec<f64> {
    let mean = crate::statistics::mean(passage);
    let centred: Vec<f64> = passage.iter().map(|x| x - mean).collect();
    let mut passage = Spectrum::of(&centred, bpfo * passage.len() as f64).filtered(Band { low: 0.5 * bpfo, high: CUT });
    let norm = passage.iter().map(|x| x * x).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
    passage.iter_mut().for_each(|x| *x /= norm);
    passage
}

/// Largest magnitude of the circular correlation of two passages from [`below_cut`].
pub fn similarity(measured: &[f64], simulated: &[f64]) -> f64 {
    best_shift(measured, simulated).similarity
}

/// How a simulated passage lies best over a measured one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BestShift {
    /// Share of a period by which it must be moved.
    pub shift: f64,
    /// Their similarity then.
    pub similarity: f64,
}

/// How the simulated passage must be moved to lie over the measured one.
///
/// Between grid points by a parabola: half a point off would cost more similarity than a tenth of the length.
pub fn best_shift(measured: &[f64], simulated: &[f64]) -> BestShift {
    let correlation = crate::spectrum::circular_correlation(measured, simulated);
    let n = correlation.len();
    let Some(best) = (0..n).max_by(|&i, &j| correlation[i].abs().total_cmp(&correlation[j].abs())) else {
        return BestShift::default();
    };
    let at = |i: usize| correlation[i % n].abs();
    let (a, b, c) = (at(best + n - 1), at(best), at(best + 1));
    let shift = crate::statistics::vertex([a, b, c]);
    BestShift { shift: (best as f64 + shift) / n as f64, similarity: b - 0.25 * (a - c) * shift }
}
