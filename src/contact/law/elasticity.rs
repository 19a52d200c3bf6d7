//! How the force of a contact without damping grows with its approach, for one contact or for several side by side.
//!
//! ```text
//! point    Q = K δ^(3/2)           a ball in a groove (Hertz)
//! line     Q = K δ^(10/9)          a straight roller (ISO/TS 16281)
//! crowned  Q = K δ^(10/9) c(δ)     a crowned roller (super::crown)
//! ```
//! All are Q = S δ with the secant stiffness S, and δ Q′ = n Q with the order n: 3/2, 10/9, or what the crown makes of
//! it.

use super::crown::Crown;
use crate::geometry::line_contact::LINE_ORDER;
use crate::numerics::number::Number;
use std::sync::Arc;

/// Growth of a contact's force, chosen where code is compiled.
pub trait Elastic: Copy {
    /// Secant stiffness Q/δ (N/m) and order δ Q′/Q of a contact of this constant K at an approach (m) that is not
    /// negative.
    fn secant_and_order<T: Number>(&self, stiffness: T::Plain, delta: T) -> [T; 2];
}

/// A ball in a groove.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point;

/// A roller, crowned or straight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line<'c>(pub Option<&'c Crown>);

impl Elastic for Point {
    #[inline(always)]
    fn secant_and_order<T: Number>(&self, stiffness: T::Plain, delta: T) -> [T; 2] {
        [delta.sqrt() * stiffness, delta.all(1.5)]
    }
}

impl Elastic for Line<'_> {
    #[inline(always)]
    fn secant_and_order<T: Number>(&self, stiffness: T::Plain, delta: T) -> [T; 2] {
        let straight = delta.ninth_root() * stiffness;
        match self.0 {
            None => [straight, delta.all(LINE_ORDER)],
            Some(crown) => {
                let [part, order] = delta.pair(0, crown);
                [straight * part, order]
            }
        }
    }
}

/// Growth of a contact's force.
#[derive(Debug, Clone, PartialEq)]
pub enum Elasticity {
    /// A ball in a groove.
    Point,
    /// A straight roller.
    Line,
    /// A crowned roller.
    Crowned(Arc<Crown>),
}

impl Elasticity {
    /// That of a roller; `None` of a ball.
    #[inline(always)]
    pub fn line(&self) -> Option<Line<'_>> {
        match self {
            Self::Point => None,
            Self::Line => Some(Line(None)),
            Self::Crowned(crown) => Some(Line(Some(crown))),
        }
    }

    /// Secant stiffness (N/m) and order, as [`Elastic::secant_and_order`].
    #[inline(always)]
    pub fn secant_and_order<T: Number>(&self, stiffness: T::Plain, delta: T) -> [T; 2] {
        match self.line() {
            None => Point.secant_and_order(stiffness, delta),
            Some(line) => line.secant_and_order(stiffness, delta),
        }
    }
}
