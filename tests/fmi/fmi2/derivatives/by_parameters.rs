//! Derivatives by parameters, which are knowns in initialization mode.

use super::by_inputs::{SCENES, outputs, references};
use crate::two::Host;
use crate::two::any_host::is_real;
use brinell::simulation::interface::table::{Causality, Kind, Variable};
use brinell_fmi::fmi2::*;

/// How far a parameter is moved from where it is: other ways than those of the derivative itself.
fn nudge_of(parameter: &Variable) -> f64 {
    match (&*parameter.name, &parameter.kind) {
        ("bearing.internal_clearance", _) => 6e-9,
        ("defect.length" | "defect.depth", _) => 3e-9,
        ("contact.damping", Kind::Real { nominal, .. }) => 0.03 * nominal,
        ("cage.slip" | "element.spin_slip", _) => 2e-3,
        (name, _) if name.ends_with("stiffness") => 3e3,
        _ => 3e-6,
    }
}

#[test]
fn derivatives_by_every_known_listed_of_initial_unknowns_are_differences_of_two_starts() {
    for scene in SCENES {
        let (host, other) = (Host::of(scene), Host::of(scene));
        // Off the limits of what may be set, for differences on both sides.
        let prepared = [("cage.slip", 0.02), ("shaft.stiffness", 2e5), ("element.spin_slip", 0.01)];
        for host in [&host, &other] {
            for (name, value) in prepared {
                if host.table().iter().any(|v| v.name == name && v.causality == Causality::Parameter) {
                    assert_eq!(host.set(&[host.reference(name)], &[value]), Status::Ok);
                }
            }
            host.press();
            assert_eq!(host.begin(None, 0.0, None), Status::Ok);
        }
        let table = host.table();
        let unknowns = references(&outputs(table));
        let middle = host.get(&unknowns).unwrap();
        let dependencies = host.simulation().dependencies();
        let mut compared = 0;
        for known in table.iter().filter(|v| v.causality == Causality::Parameter && is_real(v)) {
            let listed =
                |unknown: u32| dependencies.iter().any(|d| d.output == unknown && d.initial.contains(&known.reference));
            let given = host.directional(&unknowns, &[known.reference], &[1.0]).unwrap();
            let (at, step) = (host.get(&[known.reference]).unwrap()[0], nudge_of(known));
            let look = |value: f64| {
                assert_eq!(other.set(&[known.reference], &[value]), Status::Ok, "{}", known.name);
                other.get(&unknowns).unwrap()
            };
            let (below, above) = (look(at - step), look(at + step));
            look(at);
            for (i, &unknown) in unknowns.iter().enumerate() {
                let name = &table[unknown as usize].name;
                if !listed(unknown) {
                    assert_eq!(given[i], 0.0, "{scene}: {name} by {} is not listed", known.name);
                    continue;
                }
                let found = (above[i] - below[i]) / (2.0 * step);
                let Kind::Real { nominal, .. } = table[unknown as usize].kind else { panic!() };
                // Both are differences, of errors that go with the square of the steps; rounding as in `compare`, over
                // a third of the step here.
                let allowed = 1e-4 * given[i].abs() + 1e-11 * middle[i].abs().max(nominal) / step;
                assert!(
                    (found - given[i]).abs() <= allowed,
                    "{scene}: {name} by {}: {} given, {found} found, allowed {allowed:e}",
                    known.name,
                    given[i]
                );
                compared += usize::from(given[i] != 0.0);
            }
        }
        assert!(compared > 50, "{scene}: {compared}");
        // The law is NaN: there is no derivative, and the run goes on.
        let law = [host.reference("contact.law")];
        assert_eq!(host.directional(&unknowns, &law, &[1.0]), Err(Status::Discard));
        assert_eq!(host.get(&unknowns).unwrap(), middle, "{scene}");
    }
}

#[test]
fn a_parameter_at_its_limit_has_a_derivative_into_what_may_be_set() {
    let host = Host::initializing("er16k-tb1");
    let [slip, speed, stiffness, y] =
        ["cage.slip", "cage.speed", "shaft.stiffness", "shaft.y"].map(|name| host.reference(name));
    let at = host.get(&[slip, stiffness, speed, y]).unwrap();
    assert_eq!(at[..2], [0.0, 0.0]);
    // Of pure rolling the slip takes its share.
    let found = host.directional(&[speed], &[slip], &[1.0]).unwrap()[0];
    assert!((found + at[2]).abs() < 1e-9 * at[2].abs(), "{found} {}", at[2]);
    // A spring of 1 N/m takes 1 N/m times the ring's position off the load.
    let [by_spring, by_load] =
        [stiffness, host.reference("shaft.load.y")].map(|known| host.directional(&[y], &[known], &[1.0]).unwrap()[0]);
    assert!((by_spring + at[3] * by_load).abs() < 1e-5 * by_spring.abs(), "{by_spring} {}", at[3] * by_load);
}
