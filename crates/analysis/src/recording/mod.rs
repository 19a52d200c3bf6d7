//! A recording of a machine's vibration: read from a file and checked.

pub mod checked;
pub(crate) mod csv;
mod error;
mod file;
mod interleaving;
mod npy;
mod npy_header;
mod sampling_times;

pub use checked::{Recording, Source, Speed};
pub use error::SizingError;
pub use sampling_times::Uneven;

pub(crate) use checked::value_at;
