//! `modelDescription.xml` of FMI 3.0 co-simulation, written from the same variable table as that of FMI 2.0.
//!
//! Names are the same. What every element has is one array with an entry for each; its reference is that of the first.
//! The time is a variable of its own, after all others. Outputs depend on inputs; parameters are fixed, so none of them
//! can move an output after initialization, and they are listed for the initial unknowns only.

use std::collections::BTreeSet;
use std::io;

use brinell::simulation::interface::table::{Causality, Dependencies, Kind, Variable};
use brinell::simulation::run::{ElementArray, of_all_elements};

use super::fmi2::{
    causality, default_experiment, enumerations, items, log_categories, real, unit_definitions, variability,
};
use crate::package::model::Model;
use crate::package::xml::{Attributes, Xml};

/// Writes the model description of a scene.
pub fn write(model: &Model) -> io::Result<String> {
    let scene = &model.scene;
    let root: Attributes = vec![
        ("fmiVersion", "3.0".into()),
        ("modelName", scene.name.clone()),
        ("instantiationToken", model.guid()),
        ("description", scene.description.clone()),
        ("version", env!("CARGO_PKG_VERSION").into()),
        ("copyright", "The Brinell developers".into()),
        ("license", env!("CARGO_PKG_LICENSE").into()),
        ("generationTool", concat!("Brinell ", env!("CARGO_PKG_VERSION")).into()),
        ("variableNamingConvention", "structured".into()),
    ];
    let table = model.simulation.table();
    let arrays = model.simulation.arrays();
    let mut xml = Xml::new()?;
    xml.element("fmiModelDescription", root, |xml| {
        xml.empty("CoSimulation", co_simulation(&scene.model_identifier()))?;
        unit_definitions(xml, table)?;
        type_definitions(xml, table)?;
        log_categories(xml, "fmi3")?;
        default_experiment(xml, scene)?;
        xml.element("ModelVariables", vec![], |xml| variables(xml, table, &arrays))?;
        xml.element("ModelStructure", vec![], |xml| model_structure(xml, &model.simulation.dependencies(), &arrays))
    })?;
    xml.finish()
}

fn co_simulation(identifier: &str) -> Attributes {
    let mut attributes: Attributes = vec![("modelIdentifier", identifier.into())];
    // What the library can do; the C interface answers fmi3Error to what is absent here.
    let flags = [
        ("canGetAndSetFMUState", true),
        ("canSerializeFMUState", true),
        ("providesDirectionalDerivatives", true),
        ("providesAdjointDerivatives", true),
        ("providesPerElementDependencies", true),
        ("canHandleVariableCommunicationStepSize", true),
        ("providesIntermediateUpdate", true),
        ("canReturnEarlyAfterIntermediateUpdate", true),
        // Only the host ends a step early.
        ("mightReturnEarlyFromDoStep", false),
        // Contacts begin and cease inside the step, located there; no host has to handle them.
        ("hasEventMode", false),
    ];
    attributes.extend(flags.map(|(name, value)| (name, value.to_string())));
    attributes.push(("maxOutputDerivativeOrder", "1".into()));
    attributes
}

fn type_definitions(xml: &mut Xml, table: &[Variable]) -> io::Result<()> {
    let used = enumerations(table);
    if used.is_empty() {
        return Ok(());
    }
    xml.element("TypeDefinitions", vec![], |xml| {
        used.iter().try_for_each(|(type_name, list)| {
            xml.element("EnumerationType", vec![("name", type_name.to_string())], |xml| items(xml, list))
        })
    })
}

fn variables(xml: &mut Xml, table: &[Variable], arrays: &[ElementArray]) -> io::Result<()> {
    let time = vec![
        ("name", "time".into()),
        ("valueReference", table.len().to_string()),
        ("description", "Time".into()),
        ("causality", "independent".into()),
        ("variability", "continuous".into()),
    ];
    xml.empty("Float64", time)?;
    for row in table {
        match arrays.iter().find(|array| array.rows.contains(&row.reference)) {
            None => variable(xml, row, row.name.clone(), row.meaning().to_owned(), None)?,
            Some(array) if array.rows[0] == row.reference => {
                let (name, description) = of_all_elements(row);
                variable(xml, row, name, description, Some(array.rows.len()))?;
            }
            Some(_) => {}
        }
    }
    Ok(())
}

/// A variable with its name and description; with its number of elements if it is an array.
fn variable(
    xml: &mut Xml,
    row: &Variable,
    name: String,
    description: String,
    elements: Option<usize>,
) -> io::Result<()> {
    let mut attributes: Attributes = vec![
        ("name", name),
        ("valueReference", row.reference.to_string()),
        ("description", description),
        ("causality", causality(row.causality).into()),
        ("variability", variability(row.variability).into()),
    ];
    if row.changes_within_steps() {
        attributes.push(("intermediateUpdate", true.to_string()));
    }
    // Of inputs `initial` is exact, and not written.
    match row.causality {
        Causality::Parameter => attributes.push(("initial", "exact".into())),
        Causality::Output | Causality::Local => attributes.push(("initial", "calculated".into())),
        Causality::Input => {}
    }
    match &row.kind {
        Kind::Real { .. } => {
            attributes.extend(real(&row.kind));
            match elements {
                None => xml.empty("Float64", attributes),
                Some(count) => {
                    xml.element("Float64", attributes, |xml| xml.empty("Dimension", vec![("start", count.to_string())]))
                }
            }
        }
        Kind::Integer => xml.empty("UInt64", attributes),
        Kind::Enumeration { type_name, items, start } => {
            attributes.extend([
                ("declaredType", type_name.to_string()),
                ("min", "1".into()),
                ("max", items.len().to_string()),
                ("start", start.to_string()),
            ]);
            xml.empty("Enumeration", attributes)
        }
        Kind::Text { start } => {
            xml.element("String", attributes, |xml| xml.empty("Start", vec![("value", start.clone())]))
        }
    }
}

fn model_structure(xml: &mut Xml, outputs: &[Dependencies], arrays: &[ElementArray]) -> io::Result<()> {
    let merged = merged(outputs, arrays);
    merged.iter().try_for_each(|output| unknown(xml, "Output", output.output, &output.direct))?;
    merged.iter().try_for_each(|output| unknown(xml, "InitialUnknown", output.output, &output.initial))
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

fn unknown(xml: &mut Xml, element: &str, output: u32, depends_on: &[u32]) -> io::Result<()> {
    let references: Vec<String> = depends_on.iter().map(u32::to_string).collect();
    let attributes = vec![
        ("valueReference", output.to_string()),
        ("dependencies", references.join(" ")),
        ("dependenciesKind", vec!["dependent"; references.len()].join(" ")),
    ];
    xml.empty(element, attributes)
}
