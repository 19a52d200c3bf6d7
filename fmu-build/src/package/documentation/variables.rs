//! The tables of variables.

use brinell::simulation::Simulation;
use brinell::simulation::interface::table::{Causality, Kind};
use minijinja::{Value, context};

use crate::package::description::{Listed, causality, listed, units};
use crate::shared::Interface;

/// The variables of each kind that there are.
pub(super) fn variables(simulation: &Simulation, interface: Interface) -> Vec<Value> {
    let table = listed(simulation, interface);
    let kinds = [
        (Causality::Input, "Inputs"),
        (Causality::Parameter, "Parameters, fixed after initialization"),
        (Causality::Output, "Outputs"),
        (Causality::Local, "Local: only to be read"),
    ];
    let of_kind = |(kind, title): (Causality, &str)| {
        let rows: Vec<Value> = table.iter().filter(|row| row.variable.causality == kind).map(row).collect();
        let starts = matches!(kind, Causality::Input | Causality::Parameter);
        (!rows.is_empty()).then(|| context! { id => causality(kind), title, starts, rows })
    };
    kinds.into_iter().filter_map(of_kind).collect()
}

fn row(Listed { variable, elements }: &Listed) -> Value {
    let name = format!("{}{}", variable.name, elements.map_or(String::new(), |count| format!("[{count}]")));
    let (unit, start) = match &variable.kind {
        Kind::Real { unit, start, .. } => (units::name(*unit), start.map(|value| format!("{value:?}"))),
        Kind::Integer => ("", None),
        Kind::Whole { start } => ("", Some(start.to_string())),
        Kind::Enumeration { items, start, .. } => {
            let index = usize::try_from(*start - 1).unwrap_or(usize::MAX);
            ("", items.get(index).map(|(name, _)| (*name).to_owned()))
        }
        Kind::Text { start } => ("", Some(start.clone())),
    };
    let start = start.unwrap_or_default();
    context! { name, unit, start, description => &variable.description }
}
