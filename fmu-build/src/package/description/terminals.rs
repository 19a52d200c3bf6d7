//! `terminalsAndIcons/terminalsAndIcons.xml` of FMI 3.0, and of 2.0.4, which took it over: a terminal for each ring,
//! where a rotor or a casing is connected, and the icon.
//!
//! A terminal holds what its ring exchanges with a body outside: motion, loads and the bearing's force in the plane,
//! with three degrees of freedom those along the axis, with five tilts and moments, and speed and torque about the
//! axis. All of it is `signal`: the standard keeps `inflow` and `outflow` for scalars that
//! sum to zero, and says that forces in space are none. Matching is by member name, and a host may leave out what it
//! has no use for (`bus`): accelerations are optional, and either of two forces goes to the ring's body.
//!
//! Inside it is a terminal for each axis with the names that the Modelica Standard Library's mechanical flanges have
//! and its adaptors for FMUs add, s v a f, and one about each axis: phi w tau about that of rotation, phi w a tau for
//! tilts. Forces and torques are those of the bearing on the ring.

use anyhow::Result;
use brinell::simulation::interface::table::{Causality, Variable};
use minijinja::context;

use crate::package::render;
use crate::shared::Interface;

/// Version of the standard that the file keeps to: FMI 2.0.4 refers to that of 3.0, whose schema knows no other.
const VERSION: &str = "3.0";

/// What a terminal shows, by the member's name.
#[rustfmt::skip]
const MEMBERS: [&str; 38] = [
    "speed", "angle", "torque",
    "x", "y", "z", "vx", "vy", "vz", "ax", "ay", "az",
    "tilt.x", "tilt.y", "tilt.vx", "tilt.vy", "tilt.ax", "tilt.ay",
    "load.x", "load.y", "load.z", "load_moment.x", "load_moment.y",
    "force.x", "force.y", "force.z", "moment.x", "moment.y",
    "mean_force.x", "mean_force.y", "mean_force.z", "mean_moment.x", "mean_moment.y",
    "next_mean_force.x", "next_mean_force.y", "next_mean_force.z", "next_mean_moment.x", "next_mean_moment.y",
];

/// A terminal inside that of a ring, as a flange of the Modelica Standard Library: name, kind, description, and its
/// members with the ring's variable for each.
type Flange = (&'static str, &'static str, &'static str, &'static [(&'static str, &'static str)]);

const FLANGES: [Flange; 6] = [
    ("x", TRANSLATIONAL, ALONG, &[("s", "x"), ("v", "vx"), ("a", "ax"), ("f", "force.x")]),
    ("y", TRANSLATIONAL, ALONG, &[("s", "y"), ("v", "vy"), ("a", "ay"), ("f", "force.y")]),
    ("z", TRANSLATIONAL, ALONG, &[("s", "z"), ("v", "vz"), ("a", "az"), ("f", "force.z")]),
    ("tilt_x", ROTATIONAL, TILTED, &[("phi", "tilt.x"), ("w", "tilt.vx"), ("a", "tilt.ax"), ("tau", "moment.x")]),
    ("tilt_y", ROTATIONAL, TILTED, &[("phi", "tilt.y"), ("w", "tilt.vy"), ("a", "tilt.ay"), ("tau", "moment.y")]),
    ("rotation", ROTATIONAL, "Rotation; tau is what the bearing does to the ring", &ROTATION),
];
const TRANSLATIONAL: &str = "_brinell_mechanical_translational";
const ROTATIONAL: &str = "_brinell_mechanical_rotational";
const ALONG: &str = "Motion along an axis; f is what the bearing does to the ring";
const TILTED: &str = "Tilt about an axis; tau is what the bearing does to the ring";
const ROTATION: [(&str, &str); 3] = [("phi", "angle"), ("w", "speed"), ("tau", "torque")];

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
        let members = |names: &[(&str, &str)]| -> Vec<_> {
            let present = names.iter().filter(|(_, of_ring)| is_signal(&name(of_ring)));
            present.map(|&(member, of_ring)| context! { member, variable => interface.shown(&name(of_ring)) }).collect()
        };
        let parts = FLANGES.iter().map(|&(part, kind, description, names)| {
            context! { name => part, kind, description, members => members(names) }
        });
        let parts: Vec<_> = parts.collect();
        let members = members(&MEMBERS.map(|member| (member, member)));
        let description = format!("{which} ring: motion, loads and the bearing's force on it");
        let kind =
            if is_signal(&name("force.z")) { "_brinell_mechanical_spatial" } else { "_brinell_mechanical_planar" };
        context! { ring, kind, members, parts, description }
    });
    let template = include_str!("../../../assets/terminalsAndIcons.xml");
    render("terminalsAndIcons.xml", template, context! { version => VERSION, terminals => terminals.to_vec() })
}
