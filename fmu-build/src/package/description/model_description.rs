//! `modelDescription.xml` of FMI 2.0 and 3.0 co-simulation: `assets/modelDescription.xml`, filled from the variable
//! table and nothing else.
//!
//! Rules beyond the schema: every unit that is used is defined by its base units; every variable that is not real says
//! its variability; outputs and initial unknowns ascend, and carry their dependencies, because a missing list means
//! "depends on everything" and makes an importer see algebraic loops. The file holds no date: equal scenes give equal
//! bytes.
//!
//! Names are the same in both versions. In FMI 3.0 what every element has is one array with an entry for each; its
//! reference is that of the first. The time is a variable of its own there. Outputs depend on inputs; parameters are
//! fixed, so none of them can move an output after initialization, and they are listed for the initial unknowns only.

use std::collections::{BTreeMap, BTreeSet};

use anyhow::Result;
use brinell::simulation::Simulation;
use brinell::simulation::exchange::{ExchangeRole, ExchangeVariable};
use brinell::simulation::interface::table::{Causality, Dependencies, Kind, Unit, Variability, Variable};
use brinell::simulation::interface::{Category, ElementArray, of_all_elements};
use minijinja::{Value, context};

use super::{exchange, units};
use crate::package::model::Model;
use crate::package::render;
use crate::shared::{Interface, Names, Version};

/// The model description of a scene.
///
/// # Errors
/// Of its template.
pub fn model_description(model: &Model, interface: impl Into<Interface>) -> Result<String> {
    let interface = interface.into();
    let version = interface.version;
    let scene = &model.scene;
    let table = model.simulation.table();
    let prefix = if version == Version::Fmi2 { "fmi2" } else { "fmi3" };
    let categories = Category::LIST.map(|category| (category.name(), category.description(prefix)));
    let exchanged = if interface.exchanges() { model.simulation.exchange_variables() } else { Vec::new() };
    let mut variables: Vec<Value> =
        listed(&model.simulation, interface).iter().map(|row| variable(row, interface)).collect();
    variables.extend(exchange::variables(&exchanged, interface));
    let indicators = exchanged.iter().filter(|row| matches!(row.role, ExchangeRole::Indicator(_))).count();
    let values = context! {
        fmi2 => version == Version::Fmi2,
        fmi => version.number(),
        name => &scene.name,
        guid => model.guid(),
        description => &scene.description,
        program => env!("CARGO_PKG_VERSION"),
        license => env!("CARGO_PKG_LICENSE"),
        identifier => scene.model_identifier(),
        units => unit_definitions(table, &exchanged),
        flat => interface.names == Names::Flat,
        exchanges => interface.exchanges(),
        steps => interface.steps(),
        indicators,
        enumerations => enumerations(table),
        categories => categories.to_vec(),
        stop => number(scene.experiment.stop),
        tolerance => number(scene.tolerance),
        step => number(scene.experiment.step),
        time => table.len(),
        variables,
        structure => structure(&model.simulation, &exchanged, interface),
    };
    render("modelDescription.xml", include_str!("../../../assets/modelDescription.xml"), values)
}

/// The shortest text that reads back to the same number; `xs:double` takes Rust's form.
fn number(value: f64) -> String {
    format!("{value:?}")
}

/// Every unit that is used, by its base units.
fn unit_definitions(table: &[Variable], exchanged: &[ExchangeVariable]) -> Vec<Value> {
    let unit = |variable: &Variable| match variable.kind {
        Kind::Real { unit, .. } => Some(unit),
        _ => None,
    };
    let used: BTreeSet<Unit> =
        table.iter().filter_map(unit).chain(exchanged.iter().map(|variable| variable.unit)).collect();
    let definition = |unit| {
        let exponents: Vec<_> = units::base_units(unit).into_iter().filter(|(_, exponent)| *exponent != 0).collect();
        let shown: Vec<_> = units::display_units(unit).iter().map(|&(name, factor)| (name, number(factor))).collect();
        context! { name => units::name(unit), quantity => units::quantity(unit), exponents, shown }
    };
    used.into_iter().map(definition).collect()
}

/// The enumeration types that are used, with name and description of each item.
fn enumerations(table: &[Variable]) -> Vec<(&'static str, Vec<(&'static str, &'static str)>)> {
    let of = |variable: &Variable| match variable.kind {
        Kind::Enumeration { type_name, items, .. } => Some((type_name, items.to_vec())),
        _ => None,
    };
    table.iter().filter_map(of).collect::<BTreeMap<_, _>>().into_iter().collect()
}

/// A variable as a version has it.
#[derive(Debug, Clone)]
pub(crate) struct Listed {
    /// The variable, of an array with the name and the description of the array.
    pub(crate) variable: Variable,
    /// Number of elements, of an array.
    pub(crate) elements: Option<usize>,
}

/// The variables as the version has them.
pub(crate) fn listed(simulation: &Simulation, interface: Interface) -> Vec<Listed> {
    let table = simulation.table().iter();
    // A host that shows structured names as a tree has groups; of flat ones the description begins with the group.
    let described = |row: &Variable, text: &str| match row.name.split(['.', '[']).next() {
        Some(group) if interface.names == Names::Flat => format!("{group}: {text}"),
        _ => text.to_owned(),
    };
    let named = |row: &Variable, text: &str| Variable {
        name: interface.shown(&row.name),
        description: described(row, text),
        ..row.clone()
    };
    if interface.version == Version::Fmi2 {
        return table.map(|row| Listed { variable: named(row, &row.description), elements: None }).collect();
    }
    let arrays = if interface.scalars { Vec::new() } else { simulation.arrays() };
    let shown = |row: &Variable| match arrays.iter().find(|array| array.rows.contains(&row.reference)) {
        None => Some(Listed { variable: named(row, row.meaning()), elements: None }),
        Some(array) if array.rows[0] == row.reference => {
            let (name, description) = of_all_elements(row);
            let (name, description) = (interface.shown(&name), described(row, &description));
            Some(Listed { variable: Variable { name, description, ..row.clone() }, elements: Some(array.rows.len()) })
        }
        Some(_) => None,
    };
    table.filter_map(shown).collect()
}

fn variable(listed: &Listed, interface: Interface) -> Value {
    let Listed { variable, elements } = listed;
    let (fmi2, mut attributes, mut text) = (interface.version == Version::Fmi2, Vec::new(), None);
    match &variable.kind {
        Kind::Real { unit, start, min, max, nominal } => {
            // A moment per displacement has the unit of a force and is none.
            let is_named = *unit != Unit::Newton || !variable.name.contains("stiffness");
            attributes
                .extend(units::attributes(*unit, *nominal).into_iter().filter(|(key, _)| is_named || *key == "unit"));
            let numbers = [("min", *min), ("max", *max), ("nominal", Some(*nominal)), ("start", *start)];
            attributes.extend(numbers.into_iter().filter_map(|(key, value)| Some((key, number(value?)))));
        }
        Kind::Integer => {}
        Kind::Enumeration { type_name, items, start } => attributes.extend([
            ("declaredType", (*type_name).to_owned()),
            ("min", "1".to_owned()),
            ("max", items.len().to_string()),
            ("start", start.to_string()),
        ]),
        Kind::Whole { start } => {
            attributes.extend([("min", "0".to_owned()), ("max", i32::MAX.to_string()), ("start", start.to_string())])
        }
        Kind::Text { start } if fmi2 => attributes.push(("start", start.clone())),
        Kind::Text { start } => text = Some(start),
    }
    context! {
        type => match &variable.kind {
            Kind::Real { .. } => if fmi2 { "Real" } else { "Float64" },
            Kind::Integer | Kind::Whole { .. } if fmi2 => "Integer",
            Kind::Whole { .. } => "Int64",
            Kind::Integer => if interface.scalars { "Int64" } else { "UInt64" },
            Kind::Enumeration { .. } => "Enumeration",
            Kind::Text { .. } => "String",
        },
        name => &variable.name,
        reference => variable.reference,
        description => &variable.description,
        causality => causality(variable.causality),
        variability => match variable.variability {
            Variability::Fixed => "fixed",
            Variability::Discrete => "discrete",
            Variability::Continuous => "continuous",
        },
        intermediate => variable.changes_within_steps(),
        // The standard forbids `initial` for inputs: theirs is exact.
        initial => match variable.causality {
            Causality::Parameter => "exact",
            Causality::Output | Causality::Local => "calculated",
            Causality::Input => "",
        },
        attributes,
        elements,
        text,
    }
}

/// Outputs and initial unknowns, each with what it depends on.
fn structure(simulation: &Simulation, exchanged: &[ExchangeVariable], interface: Interface) -> Vec<Value> {
    let version = interface.version;
    let outputs = match version {
        Version::Fmi2 => simulation.dependencies(),
        Version::Fmi3 if interface.scalars => simulation.dependencies(),
        Version::Fmi3 => merged(&simulation.dependencies(), &simulation.arrays()),
    };
    // The structure of FMI 2.0 counts variables from 1, the table from 0.
    let first = u32::from(version == Version::Fmi2);
    let rows = simulation.table().len() as u32;
    // Those behind the table leave one out, for the time of FMI 3.0.
    let number = |reference: u32| if reference < rows { reference + first } else { reference };
    let unknown = |output: &Dependencies, known: &[u32], more: &[u32]| {
        let references: Vec<String> = known.iter().chain(more).map(|&of| number(of).to_string()).collect();
        (number(output.output), Some(references.join(" ")), vec!["dependent"; references.len()].join(" "))
    };
    let of_exchange = if interface.exchanges() { simulation.exchange_dependencies() } else { Vec::new() };
    // Whatever an output shows may follow from any state.
    let states = exchange::references(exchanged, |role| matches!(role, ExchangeRole::State(_)));
    let direct: Vec<_> = outputs.iter().map(|output| unknown(output, &output.direct, &states)).collect();
    let mut initial: Vec<_> = outputs.iter().map(|output| unknown(output, &output.initial, &[])).collect();
    initial.extend(of_exchange.iter().map(|of| unknown(of, &of.initial, &[])));
    let mut lists = vec![context! { name => "Output", unknowns => direct }];
    if interface.exchanges() {
        let name = if version == Version::Fmi2 { "Derivative" } else { "ContinuousStateDerivative" };
        let derivatives = exchange::references(exchanged, |role| matches!(role, ExchangeRole::Derivative(_)));
        let unknowns = of_exchange.iter().filter(|of| derivatives.contains(&of.output));
        let unknowns: Vec<_> = unknowns.map(|of| unknown(of, &of.direct, &[])).collect();
        lists.push(context! { name, unknowns });
    }
    lists.push(context! { name => "InitialUnknown", unknowns => initial });
    if interface.exchanges() && version == Version::Fmi3 {
        let unknowns = exchange::unknowns(exchanged, |role| matches!(role, ExchangeRole::Indicator(_)));
        lists.push(context! { name => "EventIndicator", unknowns });
    }
    lists
}

/// One entry for each variable: an array depends on whatever one of its elements depends on.
fn merged(outputs: &[Dependencies], arrays: &[ElementArray]) -> Vec<Dependencies> {
    let of = |rows: &[u32], list: fn(&Dependencies) -> &Vec<u32>| {
        let known: BTreeSet<u32> =
            outputs.iter().filter(|output| rows.contains(&output.output)).flat_map(list).copied().collect();
        known.into_iter().collect()
    };
    outputs
        .iter()
        .filter_map(|output| match arrays.iter().find(|array| array.rows.contains(&output.output)) {
            None => Some(output.clone()),
            Some(array) if array.rows[0] == output.output => Some(Dependencies {
                output: output.output,
                direct: of(&array.rows, |of| &of.direct),
                initial: of(&array.rows, |of| &of.initial),
            }),
            Some(_) => None,
        })
        .collect()
}

/// The standard's word.
pub(crate) fn causality(causality: Causality) -> &'static str {
    match causality {
        Causality::Parameter => "parameter",
        Causality::Input => "input",
        Causality::Output => "output",
        Causality::Local => "local",
    }
}
