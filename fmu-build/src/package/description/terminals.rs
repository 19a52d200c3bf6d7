//! `terminalsAndIcons/terminalsAndIcons.xml` of FMI 3.0: a terminal for each ring, where a rotor or a casing is
//! connected, and the icon.
//!
//! A terminal holds what its ring exchanges with a body outside: motion, loads and the bearing's force in the plane,
//! speed and torque about the axis. All of it is `signal`: the standard keeps `inflow` and `outflow` for scalars that
//! sum to zero, and says that forces in space are none. Matching is by member name, and a host may leave out what it
//! has no use for (`bus`): accelerations are optional, and either of two forces goes to the ring's body.

use std::io;

use brinell::simulation::interface::table::{Causality, Variable};

use crate::package::xml::{Attributes, Xml};

/// The rings, by the first part of their variables' names.
const RINGS: [(&str, &str); 2] = [
    ("shaft", "Inner ring: motion, loads and the bearing's force on it"),
    ("housing", "Outer ring: motion, loads and the bearing's force on it"),
];
/// A mechanical connection in the plane of the bearing, as these terminals understand it.
const KIND: &str = "_brinell_mechanical_planar";
/// What a terminal shows, by the member's name.
const MEMBERS: [&str; 15] = [
    "speed",
    "angle",
    "torque",
    "x",
    "y",
    "vx",
    "vy",
    "ax",
    "ay",
    "load.x",
    "load.y",
    "force.x",
    "force.y",
    "mean_force.x",
    "mean_force.y",
];

/// Writes the file.
pub fn write(table: &[Variable]) -> io::Result<String> {
    let mut xml = Xml::new()?;
    xml.element("fmiTerminalsAndIcons", vec![("fmiVersion", "3.0".into())], |xml| {
        xml.element("GraphicalRepresentation", vec![], |xml| {
            let mut system = square();
            system.push(("suggestedScalingFactorTo_mm", "0.1".into()));
            xml.empty("CoordinateSystem", system)?;
            xml.empty("Icon", square())
        })?;
        xml.element("Terminals", vec![], |xml| {
            RINGS.iter().try_for_each(|(ring, description)| terminal(xml, table, ring, description))
        })
    })?;
    xml.finish()
}

/// The standard's own extent.
fn square() -> Attributes {
    vec![("x1", "-100".into()), ("y1", "-100".into()), ("x2", "100".into()), ("y2", "100".into())]
}

fn terminal(xml: &mut Xml, table: &[Variable], ring: &str, description: &str) -> io::Result<()> {
    let attributes = vec![
        ("name", ring.to_owned()),
        ("matchingRule", "bus".into()),
        ("terminalKind", KIND.into()),
        ("description", description.to_owned()),
    ];
    xml.element("Terminal", attributes, |xml| {
        MEMBERS.iter().try_for_each(|member| {
            let name = format!("{ring}.{member}");
            let is_it =
                |row: &&Variable| row.name == name && matches!(row.causality, Causality::Input | Causality::Output);
            match table.iter().find(is_it) {
                None => Ok(()),
                Some(_) => xml.empty(
                    "TerminalMemberVariable",
                    vec![
                        ("variableName", name.clone()),
                        ("memberName", (*member).to_owned()),
                        ("variableKind", "signal".into()),
                    ],
                ),
            }
        })
    })
}
