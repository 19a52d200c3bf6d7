//! What is possible in a scene and hardly meant: a measured surface as an instrument leaves it, a surface beside the
//! track, a defect at which nothing presses. It is computed, and asked about.

mod beside_track;
mod measured;
mod not_pressed;

pub use beside_track::BesideTrack;
pub use measured::{AsMeasured, as_measured};
pub use not_pressed::NotPressed;
