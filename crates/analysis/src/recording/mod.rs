//! A recording of a machine's vibration: read from a file and checked.

mod array;
pub mod checked;
pub(crate) mod csv;
mod error;
mod file;
mod hdf5;
mod mat;
mod npy;
mod sampling_times;

pub use checked::{Recording, Source, Speed};
pub use csv::TextFormat;
pub use error::SizingError;
pub use sampling_times::Uneven;

pub(crate) use checked::{equal_turns, turned, value_at};
