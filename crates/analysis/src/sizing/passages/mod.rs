//! The passages of elements over a spall: found, laid over each other, and their events read.

pub(crate) mod continuity;
pub(crate) mod entry;
pub(crate) mod events;
pub mod fold;
pub(crate) mod linear_prediction;
mod load_zone;

pub use entry::Entry;
pub use events::{Classified, Impact};
pub use fold::Passages;

pub(crate) use continuity::Break;
pub(crate) use fold::RESAMPLINGS;
pub(crate) use load_zone::{LoadZone, MODULATED};
