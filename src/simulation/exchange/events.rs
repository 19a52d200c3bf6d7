//! Event indicators, and what happens at an event.

use crate::simulation::integration::Problem;
use crate::simulation::integration::landing::watched;
use crate::simulation::run::{Run, UpToDate};
use crate::simulation::{Simulation, SimulationError};

/// How far (rad) a contact goes beyond the end of its cell before the indicator changes its sign: 2 pm on a raceway. In
/// the next cell it is then as far within, and no rounding makes a second event of the first.
const BEYOND: f64 = 1e-10;
/// What the indicators count in: approaches in µm, angles in hundredths of a radian, so that they are of order one.
const APPROACH: f64 = 1e-6;
const ANGLE: f64 = 1e-2;
/// The most that an indicator of angles shows (rad), as where waves are all that a contact meets and no cell ends.
const WIDEST: f64 = std::f64::consts::TAU;

impl Simulation {
    /// Number of event indicators: two onsets of each element, and each contact that defects concern.
    pub fn event_indicator_count(&self) -> usize {
        2 * self.run.model.element_count + watched(&self.run.model, &self.run.state.progress.cells, true).count()
    }

    /// The event indicators: approaches of inner contacts and of outer ones (µm); then the angles (0.01 rad) that
    /// contacts have left to the nearer end of their cell.
    ///
    /// # Errors
    /// Before `initialize`: an equilibrium that does not exist.
    pub fn event_indicators(&mut self, values: &mut [f64]) -> Result<(), SimulationError> {
        self.refresh()?;
        let count = self.run.model.element_count;
        let contacts = &self.present.evaluation.forces.contacts;
        let approaches = contacts.inner_approach[..count].iter().chain(&contacts.outer_approach[..count]);
        values.iter_mut().zip(approaches).for_each(|(value, approach)| *value = approach / APPROACH);
        let mut rest = values.iter_mut().skip(2 * count);
        self.each_cell(|within, _, _| {
            if let Some(value) = rest.next() {
                *value = (within + BEYOND).min(WIDEST) / ANGLE;
            }
        });
        Ok(())
    }

    /// Handles an event: contacts beyond the ends of their cells enter those where they are. Gives whether any did.
    ///
    /// # Errors
    /// As [`event_indicators`](Self::event_indicators).
    pub fn handle_event(&mut self) -> Result<bool, SimulationError> {
        self.refresh()?;
        let mut entered = Vec::new();
        self.each_cell(|within, cell, contact| {
            if within < 0.0 {
                entered.push((contact, cell));
            }
        });
        for &(contact, cell) in &entered {
            contact.enter(cell, &mut self.run.state.progress.cells);
        }
        if !entered.is_empty() {
            self.invalidate(UpToDate::State);
            self.refresh()?;
        }
        self.run.state.progress.mean_force = self.present.evaluation.forces.rings;
        Ok(!entered.is_empty())
    }

    /// Shows of each contact that defects concern the angle by which it is within its cell, the cell that it is over,
    /// and which it is.
    fn each_cell(&mut self, mut see: impl FnMut(f64, u32, crate::simulation::integration::landing::Contact)) {
        let excitation = self.excitation(false);
        let (forces, Run { model, state, .. }) = (&mut self.present.evaluation.forces, &*self.run);
        let progress = &state.progress;
        let now = model.kinematics(&excitation, 0.0, &progress.state);
        let paths = forces.contacts.paths(model, &progress.state);
        let problem = Problem { model, excitation: &excitation };
        for at in watched(model, &progress.cells, true) {
            let lead = at.lead(problem, (0.0, paths), &now, &mut forces.shortcuts.leads);
            let frame = now.frames.of(at.defects.frame).angle;
            let direction = now.cage.angle + model.element_offset(at.element) + lead - frame;
            see(at.defects.within(at.cell, direction), at.defects.cell_at(direction), at.contact);
        }
    }
}
