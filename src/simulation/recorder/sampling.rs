//! The recorder: outputs sampled inside the step, at a rate of its own, so that a host may take long steps.
//!
//! Samples are taken from the dense output of each accepted integration step. They neither shorten a step nor change
//! what is integrated. The next instant is kept as the time from the communication point, as all time is; a rewound
//! simulation takes back the samples of the time that it takes back.
//!
//! Of the accelerations and the rings' forces a spectrum is wanted: they are sampled faster than rows are, and filtered
//! (`decimation`). Of an element one wants to know where it is, when it touches and how hard, so its path and forces
//! are those at the row's time, as is the cage's angle. A row is complete, and seen, when the filter has gone past it.

use std::f64::consts::TAU;

use super::decimation::{Decimation, HALF, RATE_PER_PASS, RowPhase, UNDER_WAY, slot};
use crate::contact::law::smooth_laws;
use crate::scene::{self, RecorderFilter, Scene};
use crate::simulation::interface::table::{Causality, Variable};
use crate::simulation::interface::{Angles, Outputs, Quantity};
use crate::simulation::setup::largest_force;

/// Share of a sampling period by which an instant may lie before the end of a step and still be left to the next one:
/// far above the rounding of the instants, far below what a sampled signal could show.
const ROUNDING: f64 = 1e-9;

/// Samples in a period of the fastest oscillation, that of an element between its raceways. Beyond it forces and
/// accelerations fall by 50 dB per decade, as impacts do that begin with a force ∝ t^1.5; what is left to fold at six
/// times its frequency is 80 dB and more below the signal (docs/how-to/sensors.md has the measured levels).
const OVERSAMPLING: f64 = 6.0;
/// Highest sampling rate (Hz): that of a recorder without a filter.
const HIGHEST_RATE: f64 = 1e7;

/// The instants at which samples are due. Part of the state, as are the rows under way.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Due {
    /// Time from the communication point to the next sample (s).
    pub delay: f64,
    /// Samples taken since the start.
    pub taken: u64,
}

/// Takes samples, filters them and keeps rows until they are fetched. All but [`Due`] and the rows under way is
/// workspace.
#[derive(Debug, Clone)]
pub struct Recorder {
    /// Rows per second.
    rate: f64,
    /// Time between two samples (s).
    interval: f64,
    /// Rate that shows the fastest oscillation (Hz).
    fastest: f64,
    /// `None` where every sample is a row.
    decimation: Option<Decimation>,
    /// References and quantities of the recorded outputs, those that are filtered first.
    signals: Vec<Signal>,
    /// Values of those in one sample.
    sample: Vec<f64>,
    /// Number of the first row kept.
    first: u64,
    /// Rows of the time and the signals.
    values: Vec<f64>,
    /// Folder that the host wants the recording in; empty for no recording.
    pub(in crate::simulation) folder: String,
    /// Time (s) and angles at the communication point.
    start_time: f64,
    start_angles: Angles,
}

/// Rows that have not been fetched yet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Samples<'a> {
    /// Number of the first row, counted from the start of the run.
    pub first: u64,
    /// Values in a row: the time (s) and one for each signal.
    pub width: usize,
    /// The rows, one after the other.
    pub values: &'a [f64],
}

impl Recorder {
    /// The recorder that a scene asks for, if it does.
    pub(in crate::simulation) fn of(scene: &Scene, table: &[Variable], quantities: &[Quantity]) -> Option<Self> {
        let scene::Recorder { rate, filter } = scene.recorder?;
        let fastest = (OVERSAMPLING * element_frequency(scene)).min(HIGHEST_RATE);
        let decimation = match filter {
            RecorderFilter::LinearPhase => Some(decimation(fastest, rate)),
            RecorderFilter::None => None,
        };
        let recorded = |as_wanted: Recorded| {
            let rows = table.iter().zip(quantities).filter(|(row, _)| row.causality == Causality::Output);
            rows.map(|(row, &quantity)| Signal { reference: row.reference, quantity })
                .filter(move |signal| as_recorded(signal.quantity) == as_wanted)
        };
        let signals: Vec<_> = recorded(Recorded::Vibration).chain(recorded(Recorded::Instant)).collect();
        let filtered = if decimation.is_some() { recorded(Recorded::Vibration).count() } else { 0 };
        Some(Self {
            rate,
            interval: interval(rate, decimation.as_ref()),
            fastest,
            decimation,
            signals,
            sample: vec![0.0; filtered],
            first: 0,
            values: Vec::new(),
            folder: String::new(),
            start_time: 0.0,
            start_angles: Angles::default(),
        })
    }

    /// References of the recorded outputs, in the order of the columns after the time.
    pub fn references(&self) -> impl Iterator<Item = u32> {
        self.signals.iter().map(|signal| signal.reference)
    }

    /// Time by which rows are seen later than they are (s): the filter's reach.
    pub fn lag(&self) -> f64 {
        if self.decimation.is_some() { HALF as f64 / self.rate } else { 0.0 }
    }

    /// What is recorded, in words.
    pub fn description(&self) -> String {
        let rate = self.rate;
        if self.decimation.is_none() {
            return format!("{rate} samples/s, not filtered: what is faster than {} Hz is folded below it", 0.5 * rate);
        }
        let pass = rate / RATE_PER_PASS;
        format!(
            "{rate} samples/s; accelerations and forces on rings are filtered without delay, flat to {pass} Hz and \
             nothing from {} Hz on; the last row is {:.3} ms before the end of the run",
            rate - pass,
            1e3 * self.lag()
        )
    }

    /// Time between two samples (s) where so many rows per second are recorded (Hz).
    pub(in crate::simulation) fn interval_at(&self, rate: f64) -> f64 {
        if rate == self.rate { self.interval } else { interval(rate, self.decimation_at(rate).as_ref()) }
    }

    fn decimation_at(&self, rate: f64) -> Option<Decimation> {
        self.decimation.as_ref().map(|_| decimation(self.fastest, rate))
    }

    /// Records so many rows per second (Hz) from now on; what was sampled at another rate is dropped.
    pub(in crate::simulation) fn set_rate(&mut self, rate: f64, due: &Due) {
        if rate == self.rate {
            return;
        }
        self.rate = rate;
        self.decimation = self.decimation_at(rate);
        self.interval = interval(rate, self.decimation.as_ref());
        self.forget(due);
    }

    /// Length of the rows under way.
    pub(in crate::simulation) fn under_way(&self) -> usize {
        if self.decimation.is_some() { UNDER_WAY * self.width() } else { 0 }
    }

    /// Rows that are complete when so many samples have been taken.
    fn complete(&self, samples: u64) -> u64 {
        self.decimation.as_ref().map_or(samples, |decimation| decimation.complete(samples))
    }

    /// Rows that have not been fetched yet.
    pub fn samples(&self) -> Samples<'_> {
        Samples { first: self.first, width: self.width(), values: &self.values }
    }

    fn width(&self) -> usize {
        1 + self.signals.len()
    }

    /// Folder that the host wants the recording in.
    pub fn folder(&self) -> &str {
        &self.folder
    }

    pub(in crate::simulation) fn is_on(&self) -> bool {
        !self.folder.is_empty()
    }

    /// Drops the rows kept.
    pub(in crate::simulation) fn forget(&mut self, due: &Due) {
        self.values.clear();
        self.first = self.complete(due.taken);
    }

    /// Takes back the rows that were not complete when a state was taken.
    pub(in crate::simulation) fn rewind(&mut self, due: &Due) {
        let rows = (self.values.len() / self.width()) as u64;
        match self.complete(due.taken).checked_sub(self.first) {
            Some(kept) if kept <= rows => self.values.truncate(kept as usize * self.width()),
            _ => self.forget(due),
        }
    }

    /// A communication step begins at `time` (s) and these angles.
    pub(in crate::simulation) fn begin(&mut self, time: f64, angles: Angles) {
        (self.start_time, self.start_angles) = (time, angles);
    }

    /// A communication step of `step` (s) is done.
    pub(in crate::simulation) fn end(&self, due: &mut Due, step: f64) {
        due.delay -= step;
    }

    /// The next sample's time since the communication point, if it comes before `end`, both in (s).
    pub(in crate::simulation) fn due_before(&self, due: &Due, end: f64) -> Option<f64> {
        (due.delay < end - ROUNDING * self.interval).then(|| due.delay.max(0.0))
    }

    /// Angles at the communication point.
    pub(in crate::simulation) fn angles(&self) -> Angles {
        self.start_angles
    }

    /// Takes the sample that is due.
    pub(in crate::simulation) fn take(&mut self, due: &mut Due, under_way: &mut [f64], outputs: &Outputs) {
        let time = self.start_time + due.delay;
        if let Some(decimation) = &self.decimation {
            let at = decimation.row_phase(due.taken);
            let (vibrations, others) = self.signals.split_at(self.sample.len());
            fill(&mut self.sample, vibrations, outputs);
            // First the sums of what is filtered, then the time and the rest.
            let (sums, plain) = under_way.split_at_mut(UNDER_WAY * self.sample.len());
            decimation.add(at, &self.sample, sums);
            if let RowPhase { row, phase: 0 } = at {
                let width = 1 + others.len();
                let middle = &mut plain[slot(row) * width..][..width];
                middle[0] = time;
                fill(&mut middle[1..], others, outputs);
                if let Some(complete) = row.checked_sub(HALF as u64).map(slot) {
                    let plain = &plain[complete * width..][..width];
                    self.values.push(plain[0]);
                    self.values.extend(sums.chunks_exact(UNDER_WAY).map(|slots| slots[complete]));
                    self.values.extend(&plain[1..]);
                }
            }
        } else {
            let start = self.values.len();
            self.values.resize(start + self.width(), time);
            fill(&mut self.values[start + 1..], &self.signals, outputs);
        }
        due.delay += self.interval;
        due.taken += 1;
    }
}

/// The filter for so many rows per second, where the fastest oscillation asks for so many samples (Hz).
fn decimation(fastest: f64, rate: f64) -> Decimation {
    // No filter without at least two samples for a row.
    Decimation::new((fastest / rate).ceil().max(2.0) as u64)
}

/// Time between two samples (s).
fn interval(rate: f64, decimation: Option<&Decimation>) -> f64 {
    1.0 / (rate * decimation.map_or(1, Decimation::factor) as f64)
}

/// Puts the values of signals at an instant into as many values.
fn fill(values: &mut [f64], signals: &[Signal], outputs: &Outputs) {
    for (value, signal) in values.iter_mut().zip(signals) {
        *value = outputs.value(signal.quantity).unwrap_or(f64::NAN);
    }
}

/// Frequency of an element between its raceways when the largest force presses on it (Hz): the fastest oscillation of a
/// bearing.
fn element_frequency(scene: &Scene) -> f64 {
    let force = largest_force(scene);
    let [inner, outer] = smooth_laws(&scene.bearing, scene.contact.damping).map(|law| law.stiffness_under(force));
    ((inner + outer) / scene.bearing.mass_of_element()).sqrt() / TAU
}

/// An output that is recorded.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Signal {
    /// Its value reference.
    reference: u32,
    quantity: Quantity,
}

/// How an output is recorded.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Recorded {
    /// What a measuring chain could show.
    Vibration,
    /// What is sampled instant by instant.
    Instant,
    /// Not at all: what follows from the others or is constant over a step.
    Left,
}

/// Positions and velocities of rings and angles of elements follow from the vibrations or from the cage angle.
fn as_recorded(output: Quantity) -> Recorded {
    match output {
        Quantity::SensorAcceleration(_) | Quantity::Acceleration(..) | Quantity::Force(..) => Recorded::Vibration,
        Quantity::CageAngle
        | Quantity::ElementPath(_)
        | Quantity::ElementAxial(_)
        | Quantity::ContactAngle(..)
        | Quantity::Probe(_)
        | Quantity::ElementInnerForce(_)
        | Quantity::ElementOuterForce(_) => Recorded::Instant,
        Quantity::Speed(_)
        | Quantity::RingAngle(_)
        | Quantity::ShaftTorque
        | Quantity::Load(..)
        | Quantity::Position(..)
        | Quantity::Velocity(..)
        | Quantity::MeanForce(..)
        | Quantity::NextMeanForce(..)
        | Quantity::SuggestedStep
        | Quantity::CouplingError
        | Quantity::LargestCouplingError
        | Quantity::Stiffness(..)
        | Quantity::CageSpeed
        | Quantity::CageTorque
        | Quantity::ElementAngle(_)
        | Quantity::ElementSpinAngle(_)
        | Quantity::ShoulderMargin(..)
        | Quantity::Count(_)
        | Quantity::RadialClearance
        | Quantity::Parameter(_) => Recorded::Left,
    }
}
