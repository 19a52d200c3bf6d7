//! The trial spall whose simulated passage is most like a measured one.

pub mod ringing;
pub mod synthesis;
mod trial_search;
pub(crate) mod waveform_length;

pub use ringing::Ringing;
pub use synthesis::{CUT, Maps, POINTS, Rig, Trial};
pub use waveform_length::{Mismatch, WaveformLength};
