//! Ranges of quantities.

use super::Plain;
use std::fmt;

/// Limits of a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Smallest value.
    pub low: Bound,
    /// Largest value.
    pub high: Bound,
}

/// One end of a range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    /// The bound itself is allowed.
    Inclusive(f64),
    /// The bound itself is not allowed.
    Exclusive(f64),
}

impl Limits {
    /// Whether the value lies within; NaN never does.
    pub fn hold(&self, value: f64) -> bool {
        let above = match self.low {
            Bound::Inclusive(bound) => value >= bound,
            Bound::Exclusive(bound) => value > bound,
        };
        let below = match self.high {
            Bound::Inclusive(bound) => value <= bound,
            Bound::Exclusive(bound) => value < bound,
        };
        above && below
    }
}

impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.low {
            Bound::Inclusive(bound) => write!(f, "at least {} ", Plain(bound))?,
            Bound::Exclusive(bound) => write!(f, "above {} ", Plain(bound))?,
        }
        match self.high {
            Bound::Inclusive(bound) => write!(f, "and at most {}", Plain(bound)),
            Bound::Exclusive(bound) => write!(f, "and below {}", Plain(bound)),
        }
    }
}
