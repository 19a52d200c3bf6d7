//! What more than one command needs.

pub mod contact_map;
pub mod csv;
pub mod ending;
pub mod fmi_version;
pub mod grid;
pub mod numbers;
pub mod project;
pub mod python;
pub mod shipped;
pub(crate) mod talk;
pub mod whole_file;

pub use ending::program;
pub use fmi_version::{Interface, Kind, Names, Version};
pub use grid::Grid;
pub use project::Project;
pub use python::Python;
pub use talk::bar;
pub use whole_file::NotWritten;

pub(crate) use numbers::{delimiter, digits, gigapascals, html_file, number, rate, seed, speed, whole};
pub(crate) use python::Drawn;
pub(crate) use talk::{detail, note};
