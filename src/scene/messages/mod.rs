//! How ranges and numbers are shown in messages.

mod display_number;
mod limits;

pub use display_number::Plain;
pub use limits::{Bound, Limits};
