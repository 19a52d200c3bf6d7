//! How ranges, numbers and words are shown in messages.

mod display_number;
mod limits;
mod spelling;

pub use display_number::Plain;
pub use limits::{Bound, Limits};
pub use spelling::nearest;
