//! What a run is warned of after a step: results that are less than they seem.

use super::Instance;
use crate::c_interface::Status;
use crate::instance::failure::Failure;

/// Error of a coupling from which on it is warned of.
const LARGE_ERROR: f64 = 0.05;
/// Its growth from which on it is warned of again.
const GROWTH: f64 = 4.0;

impl Instance {
    /// Warns of what there is to be warned of after a step of `step` (s) to `time`.
    #[inline]
    pub(super) fn warn(&mut self, time: f64, step: f64) -> Result<(), Failure> {
        if !self.warned.of_shoulders && self.simulation.has_truncated_contacts() {
            self.warn_of_shoulders(time);
        }
        if !self.warned.of_track && self.simulation.has_off_track_contacts() {
            self.warn_of_track(time);
        }
        let Some(coupling) = self.simulation.coupling() else { return Ok(()) };
        if coupling.lacks_velocity() {
            if !self.warned.of_velocity {
                self.warn_of_velocity(step);
            }
        } else if let Some(jump) = coupling.jump().filter(|_| !self.warned.of_jump) {
            self.warn_of_jump(time, step, jump);
        } else if coupling.errors()[0] > LARGE_ERROR.max(GROWTH * self.warned.of_error) {
            self.warn_of_error(time, step)?;
        }
        Ok(())
    }

    /// Says that the coupling is far off, which force the host takes, and what would be better.
    #[cold]
    fn warn_of_error(&mut self, time: f64, step: f64) -> Result<(), Failure> {
        let Some(&coupling) = self.simulation.coupling() else { return Ok(()) };
        let [error, _] = coupling.errors();
        self.warned.of_error = error;
        let suggested = self.simulation.suggested_step()?.unwrap_or(step);
        self.logger.line(Status::Warning, || {
            let hosts = [("inner", 0), ("outer", 1)].into_iter().filter_map(|(name, ring)| {
                let mass = coupling.mass(ring)?;
                Some(format!("{mass:.2} kg of the host on the {name} ring, which gets {}", coupling.force(ring)))
            });
            let hosts: Vec<_> = hosts.collect();
            format!(
                "communication step of {step:e} s: until {time:?} s the coupling has put hosted rings off by {:.0} % \
                 of their way (host.coupling_error), with {}. As it is wired it wants steps of {suggested:.1e} s \
                 (solver.suggested_step); next_mean_force held, or mean_force where the bearing steps first, bears the \
                 longest.",
                100.0 * error,
                hosts.join(" and "),
            )
        });
        Ok(())
    }

    /// Says once that positions come without velocities.
    #[cold]
    fn warn_of_velocity(&mut self, step: f64) {
        self.warned.of_velocity = true;
        self.logger.line(Status::Warning, || {
            format!(
                "communication step of {step:e} s: positions of a hosted ring change and its velocities are 0: inside \
                 each step it stands, and between steps it jumps. Set the velocities (shaft.vx, shaft.vy, \
                 housing.vx …) with the positions, and the accelerations if they are known; until then \
                 host.coupling_error is of the jumps."
            )
        });
    }

    /// Says once that a ring has jumped.
    #[cold]
    fn warn_of_jump(&mut self, time: f64, step: f64, jump: f64) {
        self.warned.of_jump = true;
        self.logger.line(Status::Warning, || {
            format!(
                "communication step of {step:e} s: in the step before {time:?} s a hosted ring was moved by \
                 {jump:.1e} m that its velocities do not explain, an impact. Set position and velocity of the same \
                 instant, and in initialization mode the position at which the run begins."
            )
        });
    }

    /// Says once that forces are no longer those of whole ellipses.
    #[cold]
    fn warn_of_shoulders(&mut self, time: f64) {
        self.warned.of_shoulders = true;
        self.logger.line(Status::Warning, || {
            format!(
                "until {time:?} s a raceway's shoulder has cut the contact of an element \
                 (solver.truncated_contacts, element[j].shoulder): forces stay those of whole ellipses, up to 2 % too \
                 large with an eighth of the ellipse cut off and 9 % with a quarter."
            )
        });
    }

    /// Says once that a topography is no longer met where a ball is.
    #[cold]
    fn warn_of_track(&mut self, time: f64) {
        self.warned.of_track = true;
        self.logger.line(Status::Warning, || {
            format!(
                "until {time:?} s a contact was beside the slices across the groove for which the map of a topography \
                 is made, by more than a quarter of its ellipse's half-length (solver.off_track_contacts): it meets \
                 the outermost of them instead. bearing.operating_angle_deg says where they are; contact.law = \
                 \"love\" has no such bounds."
            )
        });
    }
}
