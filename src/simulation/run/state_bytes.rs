//! A [`State`] as bytes, little-endian, in one fixed order; and back, if the bytes have the shape of this model's
//! state.
//!
//! Numbers are written bit by bit, so a state that went through bytes continues with the same bits, also in another
//! process. The bytes carry no version and no checksum: whoever stores them adds both.

use super::life::Simulation;
use super::state::{FirstInputs, History, State};
use crate::dynamics::parameters::WholeAngle;
use crate::numerics::bytes::Reader;
use crate::simulation::interface::Parameter;
use crate::simulation::interface::table::{Causality, Kind, Variable};
use crate::simulation::recorder::Recorder;
use crate::simulation::setup;
use crate::simulation::step_error::SMALLEST_STEP;

impl State {
    /// The state as bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut copy = self.clone();
        // The visitor wants to be able to change what it sees; writing changes only the copy, with its own values.
        let written: Option<()> = copy.visit(&mut |field| {
            bytes.extend_from_slice(field);
            Some(())
        });
        assert!(written.is_some(), "nothing refuses to be written");
        bytes
    }

    /// Shows every field as bytes to `field`, and takes what `field` has made of them. `None` as soon as `field`
    /// gives `None` or a field cannot have that value.
    fn visit(&mut self, field: &mut impl FnMut(&mut [u8]) -> Option<()>) -> Option<()> {
        let progress = &mut self.progress;
        real(&mut self.time, field)?;
        flag(&mut self.started, field)?;
        for angle in [&mut self.cage].into_iter().chain(&mut self.frames) {
            let mut turns = angle.turns.to_le_bytes();
            field(&mut turns)?;
            angle.turns = i64::from_le_bytes(turns);
            real(&mut angle.rest, field)?;
        }
        let [x, y] = &mut self.ended.housing;
        for value in [&mut self.ended.cage, x, y] {
            real(value, field)?;
        }
        for value in [&mut progress.next_step, &mut progress.last_error, &mut progress.due.delay] {
            real(value, field)?;
        }
        let choice = &mut progress.choice;
        flag(&mut choice.implicit, field)?;
        for count in [&mut choice.tried, &mut choice.limited, &mut choice.wait, &mut choice.patience] {
            count32(count, field)?;
        }
        real(&mut choice.gained, field)?;
        real(&mut choice.stable_step, field)?;
        flag(&mut choice.damped, field)?;
        let lists = [
            &mut progress.mean_force[..],
            &mut progress.state,
            &mut progress.sensor_modes,
            &mut progress.under_way,
            &mut self.reals,
        ];
        for value in lists.into_iter().flatten() {
            real(value, field)?;
        }
        for rate in self.input_rates.as_flattened_mut() {
            let (mut given, mut value) = (rate.is_some(), rate.unwrap_or(0.0));
            flag(&mut given, field)?;
            real(&mut value, field)?;
            *rate = given.then_some(value);
        }
        visit_steps(&mut self.first, &mut self.history, field)?;
        let mut coupling = self.coupling.iter_mut().flat_map(|coupling| coupling.numbers());
        coupling.try_for_each(|number| real(number, field))?;
        for cell in progress.cells.iter_mut() {
            count32(cell, field)?;
        }
        for integer in &mut self.integers {
            let mut bytes = integer.to_le_bytes();
            field(&mut bytes)?;
            *integer = i32::from_le_bytes(bytes);
        }
        for side in progress.pushing.iter_mut() {
            let mut pushes = *side > 0.0;
            flag(&mut pushes, field)?;
            *side = if pushes { 1.0 } else { -1.0 };
        }
        for count in progress.counts() {
            let mut bytes = count.to_le_bytes();
            field(&mut bytes)?;
            *count = u64::from_le_bytes(bytes);
        }
        Some(())
    }
}

/// As [`State::visit`], of the steps that were taken.
fn visit_steps(
    first: &mut FirstInputs,
    history: &mut History,
    field: &mut impl FnMut(&mut [u8]) -> Option<()>,
) -> Option<()> {
    flag(&mut first.given, field)?;
    let first = std::iter::once(&mut first.time).chain(&mut first.values);
    history.numbers().chain(first).try_for_each(|number| real(number, field))
}

impl State {
    /// Whether a variable's value is one that can be set.
    fn is_in_range(&self, variable: &Variable) -> bool {
        let (value, integer) = (self.reals[variable.reference as usize], self.integers[variable.reference as usize]);
        match variable.kind {
            // What inputs have reached since they were set may be beyond what can be set.
            Kind::Real { min, max, .. } if variable.causality == Causality::Parameter => {
                min.is_none_or(|min| value >= min) && max.is_none_or(|max| value <= max)
            }
            Kind::Whole { .. } => integer >= 0,
            Kind::Enumeration { items, .. } => integer >= 1 && integer as usize <= items.len(),
            _ => true,
        }
    }
}

impl Simulation {
    /// The state in bytes that [`State::to_bytes`] made of a state of this same model.
    ///
    /// # Errors
    /// What about the bytes no run of this model can have left behind, in words.
    pub fn state_from_bytes(&self, bytes: &[u8]) -> Result<State, &'static str> {
        const SHAPE: &str = "they are not of the shape that this model's have";
        let mut state = self.save();
        let mut rest = Reader(bytes);
        let read = state.visit(&mut |field| {
            field.copy_from_slice(rest.bytes(field.len())?);
            Some(())
        });
        if read.is_none() || !rest.0.is_empty() {
            return Err(SHAPE);
        }
        match self.flaw(&state) {
            Some(flaw) => Err(flaw),
            None => Ok(state),
        }
    }

    /// Why a state of the right shape cannot have come about.
    fn flaw(&self, state: &State) -> Option<&'static str> {
        let progress = &state.progress;
        let numbers = [
            &[state.time, state.cage.rest, progress.last_error][..],
            &[state.ended.cage],
            &state.frames.map(|frame| frame.rest),
            &state.ended.housing,
            &[progress.choice.gained, progress.choice.stable_step],
            &[progress.next_step, progress.due.delay],
            &progress.mean_force,
            &progress.state,
            &progress.sensor_modes,
            &progress.under_way,
            &state.reals,
        ];
        let rates = state.input_rates.as_flattened().iter().flatten();
        if !numbers.into_iter().flatten().chain(rates).all(|number| number.is_finite()) {
            return Some("a number is not finite");
        }
        if !state.steps_are_possible() {
            return Some("the steps before are none that can have been taken");
        }
        // A step that is rejected is at least a tenth as long afterwards, one that is taken a fifth.
        if progress.next_step < 0.1 * SMALLEST_STEP {
            return Some("the integration step is shorter than error control ever makes it");
        }
        if !(1e-4..=1.0).contains(&progress.last_error) {
            return Some("the error of the last integration step is not one that error control accepts");
        }
        if !progress.choice.is_possible() {
            return Some("the choice of the integration method is not one that could have been made");
        }
        if !self.interface.table.iter().all(|variable| state.is_in_range(variable)) {
            return Some("a parameter is beyond its limits");
        }
        // A sample that is overdue by ages would be made up for, period by period; the state has a rate of its own.
        let rate = setup::parameter(&self.interface.quantities, &state.reals, Parameter::RecorderRate);
        let possible = |recorder: &Recorder| {
            let interval = recorder.interval_at(rate.unwrap_or_default());
            progress.due.delay.abs() <= 2.0 * interval && progress.due.taken < MOST_SAMPLES
        };
        if !self.run.recorder.as_ref().is_none_or(possible) {
            return Some("the next sample is due at no time at which one can be");
        }
        let possible =
            |angle: &WholeAngle| angle.rest.abs() <= std::f64::consts::PI && angle.turns.unsigned_abs() < MOST_TURNS;
        if !possible(&state.cage) || !state.frames.iter().all(possible) {
            return Some("cage, ring or element have an angle that they cannot have");
        }
        let model = &self.run.model;
        let paths = &progress.state[..model.element_count];
        if paths.iter().any(|path| path.abs() > model.element_radius) {
            return Some("an element is outside the bearing");
        }
        let layout = &model.layout;
        if (0..layout.len).any(|i| !layout.is_used(i) && progress.state[i] != 0.0) {
            return Some("a number that is no state's is not 0");
        }
        if (0..layout.len).any(|i| !layout.is_position(i) && progress.state[i].abs() > LARGEST_VELOCITY) {
            return Some("a velocity is one that no part can have");
        }
        None
    }
}

/// Ten times the velocity (m/s) that a host may prescribe for a ring.
const LARGEST_VELOCITY: f64 = 1e4;
/// Samples of the recorder in ten thousand years.
const MOST_SAMPLES: u64 = 1 << 60;
/// Turns beyond which the angle has no digits left behind the point.
const MOST_TURNS: u64 = 1 << 50;

fn real(value: &mut f64, field: &mut impl FnMut(&mut [u8]) -> Option<()>) -> Option<()> {
    let mut bytes = value.to_le_bytes();
    field(&mut bytes)?;
    *value = f64::from_le_bytes(bytes);
    Some(())
}

fn count32(value: &mut u32, field: &mut impl FnMut(&mut [u8]) -> Option<()>) -> Option<()> {
    let mut bytes = value.to_le_bytes();
    field(&mut bytes)?;
    *value = u32::from_le_bytes(bytes);
    Some(())
}

fn flag(value: &mut bool, field: &mut impl FnMut(&mut [u8]) -> Option<()>) -> Option<()> {
    let mut byte = [u8::from(*value)];
    field(&mut byte)?;
    *value = match byte {
        [0] => false,
        [1] => true,
        _ => return None,
    };
    Some(())
}
