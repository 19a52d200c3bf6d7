//! The recorder: outputs sampled inside the step, at a rate of its own, so that a host may take long steps.
//!
//! Samples are taken from the dense output of each accepted integration step. They neither shorten a step nor change
//! what is integrated. The next instant is kept as the time from the communication point, as all time is; a rewound
//! simulation takes back the samples of the time that it takes back.

use super::outputs::Outputs;
use super::table::Quantity;
use super::variables::{Causality, Variable};

/// Share of a sampling period by which an instant may lie before the end of a step and still be left to the next one:
/// far above the rounding of the instants, far below what a sampled signal could show.
const ROUNDING: f64 = 1e-9;

/// The instants at which samples are due. Part of the state.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Due {
    /// Time from the communication point to the next sample [s].
    pub delay: f64,
    /// Samples taken since the start.
    pub count: u64,
}

/// Takes samples and keeps them until they are fetched. All but [`Due`] is workspace.
#[derive(Debug, Clone)]
pub struct Recorder {
    period: f64,
    /// References and quantities of the recorded outputs.
    signals: Vec<(u32, Quantity)>,
    /// Number of the first row kept.
    first: u64,
    /// Rows of the time and the signals.
    values: Vec<f64>,
    /// Folder that the host wants the recording in; empty for no recording.
    pub(super) folder: String,
    /// Time and cage angle at the communication point.
    start: (f64, f64),
}

/// Samples that have not been fetched yet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Samples<'a> {
    /// Number of the first row, counted from the start of the run.
    pub first: u64,
    /// Values in a row: the time [s] and one for each signal.
    pub width: usize,
    /// The rows, one after the other.
    pub values: &'a [f64],
}

impl Recorder {
    /// A recorder of accelerations, forces and paths at `rate` [Hz].
    pub(super) fn new(rate: f64, table: &[Variable], quantities: &[Quantity]) -> Self {
        let signals = table
            .iter()
            .zip(quantities)
            .filter(|(row, quantity)| row.causality == Causality::Output && is_recorded(**quantity))
            .map(|(row, &quantity)| (row.reference, quantity))
            .collect();
        Self { period: 1.0 / rate, signals, first: 0, values: Vec::new(), folder: String::new(), start: (0.0, 0.0) }
    }

    /// References of the recorded outputs, in the order of the columns after the time.
    pub fn references(&self) -> impl Iterator<Item = u32> {
        self.signals.iter().map(|(reference, _)| *reference)
    }

    /// Time between two samples [s].
    pub(super) fn period(&self) -> f64 {
        self.period
    }

    /// Samples that have not been fetched yet.
    pub fn samples(&self) -> Samples<'_> {
        Samples { first: self.first, width: 1 + self.signals.len(), values: &self.values }
    }

    /// Folder that the host wants the recording in.
    pub fn folder(&self) -> &str {
        &self.folder
    }

    pub(super) fn is_on(&self) -> bool {
        !self.folder.is_empty()
    }

    /// Drops the samples kept; the next row is number `count`.
    pub(super) fn forget(&mut self, count: u64) {
        self.values.clear();
        self.first = count;
    }

    /// Takes back the samples from number `count` on.
    pub(super) fn rewind(&mut self, count: u64) {
        let rows = self.values.len() as u64 / (1 + self.signals.len()) as u64;
        match count.checked_sub(self.first) {
            Some(kept) if kept <= rows => self.values.truncate(kept as usize * (1 + self.signals.len())),
            _ => self.forget(count),
        }
    }

    /// A communication step begins at `time` [s] and `cage_angle` [rad].
    pub(super) fn begin(&mut self, time: f64, cage_angle: f64) {
        self.start = (time, cage_angle);
    }

    /// A communication step of `step` [s] is done.
    pub(super) fn end(&self, due: &mut Due, step: f64) {
        due.delay -= step;
    }

    /// The next sample's time since the communication point, if it comes before `end`, both in [s].
    pub(super) fn due_before(&self, due: &Due, end: f64) -> Option<f64> {
        (due.delay < end - ROUNDING * self.period).then(|| due.delay.max(0.0))
    }

    /// Cage angle at the communication point [rad], all turns counted.
    pub(super) fn cage_angle(&self) -> f64 {
        self.start.1
    }

    /// Takes the sample that is due.
    pub(super) fn take(&mut self, due: &mut Due, outputs: &Outputs) {
        self.values.push(self.start.0 + due.delay);
        self.values.extend(self.signals.iter().map(|(_, quantity)| outputs.value(*quantity).unwrap_or(f64::NAN)));
        due.delay += self.period;
        due.count += 1;
    }
}

/// What a vibration engineer looks at. Positions and velocities of rings and angles of elements follow from it or from
/// the cage angle.
fn is_recorded(quantity: Quantity) -> bool {
    matches!(
        quantity,
        Quantity::SensorAcceleration
            | Quantity::Acceleration(..)
            | Quantity::Force(..)
            | Quantity::CageAngle
            | Quantity::ElementPath(_)
            | Quantity::ElementInnerForce(_)
            | Quantity::ElementOuterForce(_)
    )
}
