//! Model Exchange: a bearing that somebody else integrates.
//!
//! The continuous states are those that [`crate::simulation::integration`] integrates, each a variable of its own:
//! paths and absolute radial velocities of elements with inertia, internal rings, sensors, the modes under sensors; and
//! the angles that the speeds turn, of the nominal cage and, where anything turns with them, of both rings and of an
//! element's spin. With elements without inertia and both rings moved by the host the angles are all that is left: a
//! force element.
//!
//! Two kinds of instants are shown by event indicators. A contact's *onset*, where its approach passes 0 and the force
//! has a corner: nothing is to be done, the integrator begins anew behind it. And the end of its *cell* of a defect, a
//! whole number: beyond it the contact enters the next one, in event mode and never in between, so that all is smooth
//! for the integrator. There is no event at a time known beforehand, for speeds are inputs and may change.
//!
//! What belongs to communication steps does not change here but at events: `mean_force` and `next_mean_force` are the
//! force at the last one. The recorder does not run.

mod dependencies;
mod derivatives;
mod events;
mod part;
mod states;
mod variables;

pub use variables::{ExchangeRole, ExchangeVariable};
