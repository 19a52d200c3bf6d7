//! The tables of variables.

use brinell::simulation::Simulation;
use brinell::simulation::interface::table::{Causality, Kind, Variable};
use brinell::simulation::run::of_all_elements;
use quick_xml::escape::escape;

use crate::package::description::fmi2::causality;
use crate::package::description::units;
use crate::package::documentation::line;
use crate::shared::Version;

/// The variables as the version has them: in FMI 3.0 what every element has is an array.
pub(super) fn listed(simulation: &Simulation, version: Version) -> Vec<Variable> {
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

/// Those of one kind, if there are any.
pub(super) fn variables(page: &mut String, table: &[Variable], kind: Causality) {
    let mut rows = table.iter().filter(|variable| variable.causality == kind).peekable();
    if rows.peek().is_none() {
        return;
    }
    let word = match kind {
        Causality::Input => "Inputs",
        Causality::Parameter => "Parameters, fixed after initialization",
        Causality::Output => "Outputs",
        Causality::Local => "Counters, local",
    };
    let computed = matches!(kind, Causality::Output | Causality::Local);
    let start = if computed { "" } else { "<th>Start</th>" };
    line(
        page,
        format_args!(
            "<h3 id=\"{}\">{word}</h3>\n<table>\n<tr><th>Name</th><th>Unit</th>{start}<th>Meaning</th></tr>",
            causality(kind)
        ),
    );
    for variable in rows {
        let (unit, start) = match &variable.kind {
            Kind::Real { unit, start, .. } => (units::name(*unit), start.map(|value| format!("{value:?}"))),
            Kind::Integer => ("", None),
            Kind::Enumeration { items, start, .. } => {
                let index = usize::try_from(*start - 1).unwrap_or(usize::MAX);
                ("", items.get(index).map(|(name, _)| (*name).to_owned()))
            }
            Kind::Text { start } => ("", Some(start.clone())),
        };
        let start = match computed {
            true => String::new(),
            false => format!("<td class=\"n\">{}</td>", escape(start.unwrap_or_default())),
        };
        line(
            page,
            format_args!(
                "<tr><td class=\"n\"><code>{}</code></td><td class=\"n\">{unit}</td>{start}<td>{}</td></tr>",
                escape(&variable.name),
                escape(&variable.description)
            ),
        );
    }
    page.push_str("</table>\n");
}
