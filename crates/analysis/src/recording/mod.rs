//! A recording of a machine's vibration: read from a file and checked.

pub mod checked;
mod error;
mod file;
mod formats;
mod sampling_times;
mod source;
mod stated;

pub use checked::Recording;
pub use error::SizingError;
pub use formats::{ENDINGS, TextFormat};
pub use sampling_times::Uneven;
pub use source::{Source, Speed};
pub use stated::Stated;

pub(crate) use checked::{equal_turns, turned, value_at};
pub(crate) use formats::csv;
