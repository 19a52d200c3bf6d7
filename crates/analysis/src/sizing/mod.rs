//! Which part of a bearing is damaged, and how long is its spall, from recordings.

mod combined;
pub mod event_length;
mod kind;
mod measured;
pub mod passages;
mod raceway;
mod report;
mod sized;
mod spall_size;
mod unresolved;
pub mod waveform;

pub use crate::spectra::{Fault, Grade};
pub use measured::Measured;
pub use raceway::Raceway;
pub use report::{Figure, Kind, Method, RecordingReport, Report, Standing, Verdict};
pub use spall_size::{size, size_with};
pub use unresolved::Unresolved;
pub use waveform::Ringing;
