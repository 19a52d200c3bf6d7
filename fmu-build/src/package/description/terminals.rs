//! `terminalsAndIcons/terminalsAndIcons.xml` of FMI 3.0, and of 2.0.4, which took it over: a terminal for each ring,
//! where a rotor or a casing is connected, and the icon.
//!
//! A terminal holds what its ring exchanges with a body outside: motion, loads and the bearing's force in the plane,
//! speed and torque about the axis. All of it is `signal`: the standard keeps `inflow` and `outflow` for scalars that
//! sum to zero, and says that forces in space are none. Matching is by member name, and a host may leave out what it
//! has no use for (`bus`): accelerations are optional, and either of two forces goes to the ring's body.

use anyhow::Result;
use brinell::simulation::interface::table::{Causality, Variable};
use minijinja::context;

use crate::package::render;
use crate::shared::Interface;

/// What a terminal shows, by the member's name.
const MEMBERS: [&str; 17] = [
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
    "next_mean_force.x",
    "next_mean_force.y",
];

/// The file's text.
///
/// # Errors
/// Of its template.
pub fn terminals(table: &[Variable], interface: Interface) -> Result<String> {
    let is_signal = |name: &str| {
        let is_signal = |row: &Variable| matches!(row.causality, Causality::Input | Causality::Output);
        table.iter().any(|row| row.name == name && is_signal(row))
    };
    // The first part of their variables' names.
    let terminals = [("shaft", "Inner"), ("housing", "Outer")].map(|(ring, which)| {
        let name = |member: &str| format!("{ring}.{member}");
        let members = MEMBERS.into_iter().filter(|member| is_signal(&name(member)));
        let members: Vec<_> =
            members.map(|member| context! { member, variable => interface.shown(&name(member)) }).collect();
        context! { ring, members, description => format!("{which} ring: motion, loads and the bearing's force on it") }
    });
    let template = include_str!("../../../assets/terminalsAndIcons.xml");
    let version = interface.version.number();
    render("terminalsAndIcons.xml", template, context! { version, terminals => terminals.to_vec() })
}
