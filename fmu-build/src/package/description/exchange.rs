//! What Model Exchange adds to a model description: continuous states, their derivatives, and in FMI 3.0 the event
//! indicators, each a variable.
//!
//! In FMI 2.0 the structure counts variables from 1. Those of the table come first, and the references behind it leave
//! one out for the time of FMI 3.0: there a variable's number is its reference, in both versions.

use brinell::simulation::exchange::{ExchangeRole, ExchangeVariable};
use minijinja::{Value, context};

use super::units;
use crate::shared::{Interface, Version};

/// An unknown of the structure: its number, and no list of what it depends on, which means all.
pub(super) type Unknown = (u32, Option<String>, String);

/// The variables, as the template takes them.
pub(super) fn variables(exchanged: &[ExchangeVariable], interface: Interface) -> Vec<Value> {
    let fmi2 = interface.version == Version::Fmi2;
    let is_listed = |row: &&ExchangeVariable| !fmi2 || !matches!(row.role, ExchangeRole::Indicator(_));
    let shown = |row: &ExchangeVariable| {
        let mut attributes = units::attributes(row.unit, row.nominal);
        attributes.push(("nominal", format!("{:?}", row.nominal)));
        if let ExchangeRole::Derivative(number) = row.role {
            attributes.push(("derivative", exchanged[number].reference.to_string()));
        }
        context! {
            type => if fmi2 { "Real" } else { "Float64" },
            name => interface.shown(&row.name),
            reference => row.reference,
            description => &row.description,
            causality => "local",
            variability => "continuous",
            intermediate => false,
            initial => "calculated",
            attributes,
        }
    };
    exchanged.iter().filter(is_listed).map(shown).collect()
}

/// References of those in a role.
pub(super) fn references(exchanged: &[ExchangeVariable], is_wanted: impl Fn(ExchangeRole) -> bool) -> Vec<u32> {
    exchanged.iter().filter(|row| is_wanted(row.role)).map(|row| row.reference).collect()
}

/// The unknowns in a role.
pub(super) fn unknowns(exchanged: &[ExchangeVariable], is_wanted: impl Fn(ExchangeRole) -> bool) -> Vec<Unknown> {
    references(exchanged, is_wanted).into_iter().map(|reference| (reference, None, String::new())).collect()
}
