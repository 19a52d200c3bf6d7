//! Numbers in messages.

use std::fmt;

/// A number as people write it: large and small ones with a power of ten, whole ones without a decimal point.
///
/// ```
/// use brinell::scene::Plain;
///
/// assert_eq!([1000.0, 1e300, -2.5e-7].map(|number| Plain(number).to_string()), ["1000", "1e300", "-2.5e-7"]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plain(pub f64);

impl fmt::Display for Plain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0 == 0.0 || !self.0.is_finite() || (1e-4..1e6).contains(&self.0.abs()) {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}
