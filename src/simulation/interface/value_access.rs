//! What reading and setting a variable asks of the table, in as few bytes as possible.
//!
//! A host may read and set twenty variables at every communication point. A row of the variable table is several cache
//! lines long and is only needed to word an error; here a variable takes 24 bytes. Everything follows from the table.

use super::quantity::Quantity;
use crate::simulation::interface::table::{Causality, Kind, Variable};

/// One variable's rules, as far as the good path needs them.
#[derive(Debug, Clone, Copy)]
pub(in crate::simulation) struct Access {
    min: f64,
    max: f64,
    class: u8,
}

/// A real input.
pub(in crate::simulation) const INPUT: u8 = 1;
/// A real parameter.
pub(in crate::simulation) const PARAMETER: u8 = 2;
/// A real output.
pub(in crate::simulation) const OUTPUT: u8 = 4;
/// A real output that is computed only when it is read.
pub(in crate::simulation) const STIFFNESS: u8 = 8;
/// A real output that is computed by a step ahead when it is read.
pub(in crate::simulation) const AHEAD: u8 = 16;
/// A force of an instant on a ring.
pub(in crate::simulation) const FORCE: u8 = 32;
/// What makes a coupling one of second order: a force over a step, or how the force changes.
pub(in crate::simulation) const SECOND: u8 = 64;
/// Half of a parameter.
pub(in crate::simulation) const HALF: u8 = 128;
/// Any real variable.
const REAL: u8 = INPUT | PARAMETER | OUTPUT | HALF;

impl Access {
    /// Whether the variable is of one of these classes.
    #[inline]
    pub(in crate::simulation) fn is(&self, classes: u8) -> bool {
        self.class & classes != 0
    }

    /// The rules of a row of the table.
    pub(in crate::simulation) fn new(variable: &Variable, quantity: Quantity) -> Self {
        let Kind::Real { min, max, .. } = variable.kind else {
            return Self { min: f64::INFINITY, max: f64::NEG_INFINITY, class: 0 };
        };
        let class = match variable.causality {
            Causality::Input => INPUT,
            Causality::Parameter => PARAMETER,
            Causality::Output | Causality::Local => match quantity {
                Quantity::Stiffness(..) => OUTPUT | STIFFNESS | SECOND,
                Quantity::SuggestedStep => OUTPUT | STIFFNESS,
                Quantity::NextMeanForce(..) => OUTPUT | AHEAD | SECOND,
                Quantity::MeanForce(..) => OUTPUT | SECOND,
                Quantity::Force(..) => OUTPUT | FORCE,
                Quantity::RadialClearance => HALF,
                _ => OUTPUT,
            },
        };
        Self { min: min.unwrap_or(f64::MIN), max: max.unwrap_or(f64::MAX), class }
    }
}

/// All classes that occur among the references, if every one is a real variable of a class in `writable` and every
/// value is in its range.
#[inline]
pub(in crate::simulation) fn can_set(
    access: &[Access],
    writable: u8,
    references: &[u32],
    values: &[f64],
) -> Option<u8> {
    let mut classes = 0;
    for (&reference, &value) in references.iter().zip(values) {
        let rule = access.get(reference as usize)?;
        // Hosts set what they may: three branches foretold cost less than three comparisons put together.
        if rule.class & writable == 0 || !(value >= rule.min) || !(value <= rule.max) {
            return None;
        }
        classes |= rule.class;
    }
    Some(classes)
}

/// All classes that occur among the references; `None` if one is unknown or not real.
#[inline]
pub(in crate::simulation) fn classes(access: &[Access], references: &[u32]) -> Option<u8> {
    let mut classes = 0;
    for &reference in references {
        let class = access.get(reference as usize)?.class;
        if class & REAL == 0 {
            return None;
        }
        classes |= class;
    }
    Some(classes)
}
