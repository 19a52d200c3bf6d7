//! `modelDescription.xml` of FMI 2.0 co-simulation, written from the variable table and nothing else.
//!
//! Rules beyond the schema that this file keeps: every unit that is used is defined by its base units; every
//! variable that is not real says its variability; `Outputs` and `InitialUnknowns` ascend, and carry their
//! dependencies, because a missing list means "depends on everything" and makes an importer see algebraic loops.
//! The file holds no date: equal scenes give equal bytes.

use std::collections::{BTreeMap, BTreeSet};
use std::io;

use brinell::scene::Scene;
use brinell::simulation::interface::Category;
use brinell::simulation::interface::table::{Causality, Dependencies, Kind, Unit, Variability, Variable};

use super::units;
use crate::package::model::Model;
use crate::package::xml::{Attributes, Xml, number};

/// What the compiled library declares that it can do beyond the least of co-simulation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Capabilities {
    /// Communication steps may differ.
    pub variable_step: bool,
    /// Input derivatives are used within the step.
    pub interpolates_inputs: bool,
    /// Highest order of output derivatives.
    pub output_derivative_order: u32,
    /// The state can be taken and put back.
    pub state: bool,
    /// The state can be turned into bytes.
    pub serialized_state: bool,
    /// Directional derivatives are computed.
    pub directional_derivatives: bool,
    /// The host's memory functions are never called.
    pub own_memory: bool,
}

/// What the library can do now. The C interface answers `fmi2Error` to what is absent here.
pub const CAPABILITIES: Capabilities = Capabilities {
    variable_step: true,
    interpolates_inputs: true,
    output_derivative_order: 1,
    state: true,
    serialized_state: true,
    directional_derivatives: true,
    own_memory: true,
};

/// Writes the model description of a scene.
pub fn write(model: &Model, capabilities: &Capabilities) -> io::Result<String> {
    let scene = &model.scene;
    let root: Attributes = vec![
        ("fmiVersion", "2.0".into()),
        ("modelName", scene.name.clone()),
        ("guid", model.guid()),
        ("description", scene.description.clone()),
        ("version", env!("CARGO_PKG_VERSION").into()),
        ("copyright", "The Brinell developers".into()),
        ("license", env!("CARGO_PKG_LICENSE").into()),
        ("generationTool", concat!("Brinell ", env!("CARGO_PKG_VERSION")).into()),
        ("variableNamingConvention", "structured".into()),
        ("numberOfEventIndicators", "0".into()),
    ];
    let table = model.simulation.table();
    let mut xml = Xml::new()?;
    xml.element("fmiModelDescription", root, |xml| {
        xml.empty("CoSimulation", co_simulation(&scene.model_identifier(), capabilities))?;
        unit_definitions(xml, table)?;
        type_definitions(xml, table)?;
        log_categories(xml, "fmi2")?;
        default_experiment(xml, scene)?;
        xml.element("ModelVariables", vec![], |xml| {
            table.iter().try_for_each(|variable| scalar_variable(xml, variable))
        })?;
        model_structure(xml, &model.simulation.dependencies())
    })?;
    xml.finish()
}

fn co_simulation(identifier: &str, capabilities: &Capabilities) -> Attributes {
    vec![
        ("modelIdentifier", identifier.into()),
        ("needsExecutionTool", false.to_string()),
        ("canHandleVariableCommunicationStepSize", capabilities.variable_step.to_string()),
        ("canInterpolateInputs", capabilities.interpolates_inputs.to_string()),
        ("maxOutputDerivativeOrder", capabilities.output_derivative_order.to_string()),
        ("canRunAsynchronuously", false.to_string()),
        ("canBeInstantiatedOnlyOncePerProcess", false.to_string()),
        ("canNotUseMemoryManagementFunctions", capabilities.own_memory.to_string()),
        ("canGetAndSetFMUstate", capabilities.state.to_string()),
        ("canSerializeFMUstate", capabilities.serialized_state.to_string()),
        ("providesDirectionalDerivative", capabilities.directional_derivatives.to_string()),
    ]
}

/// The categories of messages; `prefix` is that of the standard's names.
pub(crate) fn log_categories(xml: &mut Xml, prefix: &str) -> io::Result<()> {
    xml.element("LogCategories", vec![], |xml| {
        Category::LIST.iter().try_for_each(|category| {
            let (name, description) = (category.name().into(), category.description(prefix));
            xml.empty("Category", vec![("name", name), ("description", description)])
        })
    })
}

pub(crate) fn default_experiment(xml: &mut Xml, scene: &Scene) -> io::Result<()> {
    let times = vec![
        ("startTime", number(0.0)),
        ("stopTime", number(scene.experiment.stop)),
        ("tolerance", number(scene.tolerance)),
        ("stepSize", number(scene.experiment.step)),
    ];
    xml.empty("DefaultExperiment", times)
}

/// Every unit that is used, by its base units.
pub(crate) fn unit_definitions(xml: &mut Xml, table: &[Variable]) -> io::Result<()> {
    let used: BTreeSet<Unit> = table.iter().filter_map(|variable| unit(&variable.kind)).collect();
    if used.is_empty() {
        return Ok(());
    }
    xml.element("UnitDefinitions", vec![], |xml| {
        used.iter().try_for_each(|&unit| {
            xml.element("Unit", vec![("name", units::name(unit).into())], |xml| {
                let base = units::base_unit(unit);
                let exponents = [("kg", base.kg), ("m", base.m), ("s", base.s), ("rad", base.rad)];
                let written = exponents.iter().filter(|(_, e)| *e != 0).map(|(name, e)| (*name, e.to_string()));
                xml.empty("BaseUnit", written.collect())?;
                match units::display_unit(unit) {
                    Some(shown) => {
                        xml.empty("DisplayUnit", vec![("name", shown.name.into()), ("factor", number(shown.factor))])
                    }
                    None => Ok(()),
                }
            })
        })
    })
}

fn type_definitions(xml: &mut Xml, table: &[Variable]) -> io::Result<()> {
    let used = enumerations(table);
    if used.is_empty() {
        return Ok(());
    }
    xml.element("TypeDefinitions", vec![], |xml| {
        used.iter().try_for_each(|(type_name, list)| {
            xml.element("SimpleType", vec![("name", type_name.to_string())], |xml| {
                xml.element("Enumeration", vec![], |xml| items(xml, list))
            })
        })
    })
}

/// Name and description of each item of an enumeration.
pub(crate) type Items = &'static [(&'static str, &'static str)];

/// The enumeration types that are used.
pub(crate) fn enumerations(table: &[Variable]) -> BTreeMap<&'static str, Items> {
    let of = |variable: &Variable| match variable.kind {
        Kind::Enumeration { type_name, items, .. } => Some((type_name, items)),
        _ => None,
    };
    table.iter().filter_map(of).collect()
}

/// The items of an enumeration, counted from 1.
pub(crate) fn items(xml: &mut Xml, list: Items) -> io::Result<()> {
    (1..).zip(list).try_for_each(|(value, (name, description)): (usize, _)| {
        let attributes =
            vec![("name", name.to_string()), ("value", value.to_string()), ("description", description.to_string())];
        xml.empty("Item", attributes)
    })
}

fn scalar_variable(xml: &mut Xml, variable: &Variable) -> io::Result<()> {
    let mut attributes: Attributes = vec![
        ("name", variable.name.clone()),
        ("valueReference", variable.reference.to_string()),
        ("description", variable.description.clone()),
        ("causality", causality(variable.causality).into()),
        ("variability", variability(variable.variability).into()),
    ];
    // The standard forbids `initial` for inputs: theirs is exact.
    match variable.causality {
        Causality::Parameter => attributes.push(("initial", "exact".into())),
        Causality::Output | Causality::Local => attributes.push(("initial", "calculated".into())),
        Causality::Input => {}
    }
    let (kind, values) = typed(&variable.kind);
    xml.element("ScalarVariable", attributes, |xml| xml.empty(kind, values))
}

/// What belongs to a real variable.
pub(crate) fn real(kind: &Kind) -> Attributes {
    let Kind::Real { unit, start, min, max, nominal } = kind else { return vec![] };
    let mut values: Attributes = vec![("unit", units::name(*unit).into())];
    values.extend(units::display_unit(*unit).map(|shown| ("displayUnit", shown.name.into())));
    values.extend(min.map(|min| ("min", number(min))));
    values.extend(max.map(|max| ("max", number(max))));
    values.push(("nominal", number(*nominal)));
    values.extend(start.map(|start| ("start", number(start))));
    values
}

/// The type's word and what belongs to it.
fn typed(kind: &Kind) -> (&'static str, Attributes) {
    match kind {
        Kind::Real { .. } => ("Real", real(kind)),
        Kind::Integer => ("Integer", vec![]),
        Kind::Enumeration { type_name, items, start } => (
            "Enumeration",
            vec![
                ("declaredType", type_name.to_string()),
                ("min", "1".into()),
                ("max", items.len().to_string()),
                ("start", start.to_string()),
            ],
        ),
        Kind::Text { start } => ("String", vec![("start", start.clone())]),
    }
}

fn model_structure(xml: &mut Xml, outputs: &[Dependencies]) -> io::Result<()> {
    xml.element("ModelStructure", vec![], |xml| {
        xml.element("Outputs", vec![], |xml| {
            outputs.iter().try_for_each(|output| unknown(xml, output.output, &output.direct))
        })?;
        xml.element("InitialUnknowns", vec![], |xml| {
            outputs.iter().try_for_each(|output| unknown(xml, output.output, &output.initial))
        })
    })
}

fn unknown(xml: &mut Xml, output: u32, depends_on: &[u32]) -> io::Result<()> {
    // The structure counts variables from 1, the table from 0.
    let indices: Vec<String> = depends_on.iter().map(|reference| (reference + 1).to_string()).collect();
    xml.empty(
        "Unknown",
        vec![
            ("index", (output + 1).to_string()),
            ("dependencies", indices.join(" ")),
            ("dependenciesKind", vec!["dependent"; indices.len()].join(" ")),
        ],
    )
}

fn unit(kind: &Kind) -> Option<Unit> {
    match kind {
        Kind::Real { unit, .. } => Some(*unit),
        _ => None,
    }
}

/// The standard's word.
pub fn causality(causality: Causality) -> &'static str {
    match causality {
        Causality::Parameter => "parameter",
        Causality::Input => "input",
        Causality::Output => "output",
        Causality::Local => "local",
    }
}

/// The standard's word.
pub(crate) fn variability(variability: Variability) -> &'static str {
    match variability {
        Variability::Fixed => "fixed",
        Variability::Discrete => "discrete",
        Variability::Continuous => "continuous",
    }
}
