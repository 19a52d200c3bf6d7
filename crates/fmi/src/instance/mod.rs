//! One instance: its life, its mode, its clock, its saved states.

mod addressing;
pub(crate) mod blob;
mod clock;
mod failure;
pub(crate) mod handles;
mod intermediate_updates;
mod life;
mod mode;
mod snapshot;
pub(crate) mod snapshots;
pub(crate) mod values;

pub(crate) use addressing::{Addressing, Listing, ValueCount};
pub(crate) use clock::Clock;
pub(crate) use failure::Failure;
pub(crate) use handles::{Borrowed, GivenUp};
pub(crate) use intermediate_updates::IntermediateUpdates;
pub(crate) use life::{Instance, finite};
pub(crate) use mode::{Function, Mode, Modes, Version, modes};
pub(crate) use values::PerItem;
