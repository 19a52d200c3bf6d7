//! The part of the state that the integration owns: plain numbers, all that its future depends on.

use super::switching::Choice;
use crate::dynamics::contacts::RingForces;
use crate::dynamics::parameters::{Cells, Model};
use crate::numerics::lanes::padded;
use crate::numerics::lanes::row::Row;
use crate::simulation::interface::Count;
use crate::simulation::recorder::Due;

/// Step tried first (s): far below the period of an element on its contacts, and grown at once if that was too timid.
const FIRST_STEP: f64 = 1e-6;

/// Accepted integration steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StepCounts {
    /// Of all methods.
    pub all: u64,
    /// How many of them the implicit method took.
    pub implicit: u64,
}

/// The part of the state that the integration owns.
#[derive(Debug, Clone, PartialEq)]
pub struct Progress {
    /// State vector, as [`crate::dynamics::parameters::Layout`] lays it out.
    pub state: Row,
    /// State of the modes between outer ring and sensors, z and z' of each; of no length without any.
    pub sensor_modes: Row,
    /// Cells of defects in which all contacts are.
    pub cells: Cells,
    /// 1 where a contact pushes and −1 where it does not, the inner ones and then the outer; each list filled up to a
    /// multiple of eight.
    pub pushing: Row,
    /// Step that error control would like next (s).
    pub next_step: f64,
    /// Error of the last accepted step, per tolerance.
    pub last_error: f64,
    /// Which method steps, and what it was chosen on.
    pub choice: Choice,
    /// When the recorder takes its next sample.
    pub due: Due,
    /// The recorder's rows under way; of no length where the scene has no recorder.
    pub under_way: Row,
    /// Mean forces and moments on both rings over the last communication step (N, N m).
    pub mean_force: RingForces,
    /// Accepted steps.
    pub steps: u64,
    /// Accepted steps among them of the implicit method.
    pub implicit_steps: u64,
    /// Steps that were tried again with a shorter one, for error or to land.
    pub rejected_steps: u64,
    /// Approaches near the defect that were computed.
    pub defect_lookups: u64,
    /// Ends of steps at which a shoulder cuts a contact.
    pub truncated_contacts: u64,
    /// Ends of steps at which a contact is beside what is prepared of a surface that varies across the groove.
    pub off_track_contacts: u64,
}

impl Progress {
    /// A model's state at rest, with so many slots for rows of the recorder.
    pub fn new(model: &Model, under_way: usize) -> Self {
        let count = model.element_count;
        Self {
            state: Row::zeros(model.layout.len),
            sensor_modes: Row::zeros(model.sensor_modes.state_len()),
            cells: Cells::smooth(count, model.defective.len()),
            pushing: Row::from_fn(2 * padded(count), |_| -1.0),
            next_step: FIRST_STEP,
            last_error: 1.0,
            choice: Choice::default(),
            due: Due::default(),
            under_way: Row::zeros(under_way),
            mean_force: [0.0; 10],
            steps: 0,
            implicit_steps: 0,
            rejected_steps: 0,
            defect_lookups: 0,
            truncated_contacts: 0,
            off_track_contacts: 0,
        }
    }

    /// What the solver has counted. Approaches near the defect are looked up or, where the law `solves_grids`, solved
    /// for.
    pub(in crate::simulation) fn count(&self, count: Count, solves_grids: bool) -> u64 {
        match count {
            Count::Steps => self.steps,
            Count::RejectedSteps => self.rejected_steps,
            Count::ContactSolves if solves_grids => self.defect_lookups,
            Count::MapLookups if !solves_grids => self.defect_lookups,
            Count::TruncatedContacts => self.truncated_contacts,
            Count::OffTrackContacts => self.off_track_contacts,
            Count::ContactSolves | Count::MapLookups => 0,
        }
    }

    /// All that is counted, samples of the recorder last.
    pub(in crate::simulation) fn counts(&mut self) -> [&mut u64; 7] {
        [
            &mut self.steps,
            &mut self.implicit_steps,
            &mut self.rejected_steps,
            &mut self.defect_lookups,
            &mut self.truncated_contacts,
            &mut self.off_track_contacts,
            &mut self.due.taken,
        ]
    }

    /// Copies the progress of another state of the same model; allocates nothing.
    pub fn copy_from(&mut self, other: &Progress) {
        let Self { state, sensor_modes, cells, pushing, under_way, .. } = self;
        sensor_modes.copy_from_slice(&other.sensor_modes);
        state.copy_from_slice(&other.state);
        cells.copy_from(&other.cells);
        pushing.copy_from_slice(&other.pushing);
        under_way.copy_from_slice(&other.under_way);
        (self.next_step, self.last_error, self.choice) = (other.next_step, other.last_error, other.choice);
        (self.due, self.mean_force) = (other.due, other.mean_force);
        (self.steps, self.implicit_steps) = (other.steps, other.implicit_steps);
        (self.rejected_steps, self.defect_lookups) = (other.rejected_steps, other.defect_lookups);
        (self.truncated_contacts, self.off_track_contacts) = (other.truncated_contacts, other.off_track_contacts);
    }
}
