//! The tables of variables.

use brinell::simulation::Simulation;
use brinell::simulation::interface::table::{Causality, Kind, Variable};
use brinell::simulation::run::of_all_elements;
use minijinja::{Value, context};

use crate::package::description::fmi2::causality;
use crate::package::description::units;
use crate::shared::Version;

/// The variables as the version has them: in FMI 3.0 what every element has is an array.
fn listed(simulation: &Simulation, version: Version) -> Vec<Variable> {
    let table = simulation.table();
    if version == Version::Fmi2 {
        return table.to_vec();
    }
    let arrays = simulation.arrays();
    let shown = |row: &Variable| match arrays.iter().find(|array| array.rows.contains(&row.reference)) {
        None => Some(Variable { description: row.meaning().to_owned(), ..row.clone() }),
        Some(array) if array.rows[0] == row.reference => {
            let (name, description) = of_all_elements(row);
            Some(Variable { name: format!("{name}[{}]", array.rows.len()), description, ..row.clone() })
        }
        Some(_) => None,
    };
    table.iter().filter_map(shown).collect()
}

/// The variables of each kind that there are.
pub(super) fn variables(simulation: &Simulation, version: Version) -> Vec<Value> {
    let table = listed(simulation, version);
    let kinds = [
        (Causality::Input, "Inputs"),
        (Causality::Parameter, "Parameters, fixed after initialization"),
        (Causality::Output, "Outputs"),
        (Causality::Local, "Counters, local"),
    ];
    let of_kind = |(kind, title): (Causality, &str)| {
        let rows: Vec<Value> = table.iter().filter(|variable| variable.causality == kind).map(row).collect();
        let starts = matches!(kind, Causality::Input | Causality::Parameter);
        (!rows.is_empty()).then(|| context! { id => causality(kind), title, starts, rows })
    };
    kinds.into_iter().filter_map(of_kind).collect()
}

fn row(variable: &Variable) -> Value {
    let (unit, start) = match &variable.kind {
        Kind::Real { unit, start, .. } => (units::name(*unit), start.map(|value| format!("{value:?}"))),
        Kind::Integer => ("", None),
        Kind::Enumeration { items, start, .. } => {
            let index = usize::try_from(*start - 1).unwrap_or(usize::MAX);
            ("", items.get(index).map(|(name, _)| (*name).to_owned()))
        }
        Kind::Text { start } => ("", Some(start.clone())),
    };
    let start = start.unwrap_or_default();
    context! { name => &variable.name, unit, start, description => &variable.description }
}
