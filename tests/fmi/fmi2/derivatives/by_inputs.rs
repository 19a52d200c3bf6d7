//! Derivatives by inputs: what the functions give is what a host finds by differences.

use crate::two::Host;
use crate::two::any_host::is_real;
use brinell::simulation::interface::table::{Causality, Dependencies, Kind, Unit, Variable};
use brinell_fmi::fmi2::*;

/// All that may move: rings inside, one ring or both from the host, sound, spalled, spalled in oil, spalled and
/// compliant.
pub(crate) const SCENES: [&str; 7] = [
    "6205-healthy",
    "6205-hosted",
    "6205-epps",
    "er16k-tb1",
    "er16k-tb1-hosted-shaft",
    "er16k-tb1-oil",
    "er16k-tb2-compliant",
];

pub(crate) fn inputs(table: &[Variable]) -> Vec<&Variable> {
    table.iter().filter(|v| v.causality == Causality::Input).collect()
}

pub(crate) fn outputs(table: &[Variable]) -> Vec<&Variable> {
    table.iter().filter(|v| v.causality == Causality::Output && is_real(v)).collect()
}

pub(crate) fn references(variables: &[&Variable]) -> Vec<u32> {
    variables.iter().map(|v| v.reference).collect()
}

impl Host {
    /// An instance at its first communication point, pressed.
    pub(crate) fn pressed(scene: &str) -> Self {
        let host = Self::of(scene);
        host.press();
        host.start();
        host
    }

    /// Presses the inner ring into the elements, moving and sliding a little, where the host moves it.
    pub(crate) fn press(&self) {
        let table = self.table();
        let values = [
            ("shaft.x", 3e-6),
            ("shaft.y", -18e-6),
            ("shaft.vx", -4e-4),
            ("shaft.vy", 7e-4),
            ("shaft.ax", 0.3),
            ("shaft.ay", -0.2),
            ("housing.x", 1e-6),
            ("housing.y", 1e-6),
            ("housing.vx", 5e-4),
            ("housing.vy", -3e-4),
            ("housing.ax", -0.1),
            ("housing.ay", 0.4),
        ];
        for (name, value) in values {
            if let Some(input) = inputs(table).into_iter().find(|v| v.name == name) {
                assert_eq!(self.set(&[input.reference], &[value]), Status::Ok);
            }
        }
    }
}

/// A change of an input that is small against what it sits on and large against rounding.
fn nudge(input: &Variable) -> f64 {
    match input.kind {
        // Paths are some micrometres, loads hundreds of newtons.
        Kind::Real { unit: Unit::Metre, .. } => 1e-11,
        Kind::Real { unit: Unit::MetrePerSecond, .. } => 1e-6,
        Kind::Real { unit: Unit::MetrePerSecondSquared, .. } => 1.0,
        // 0.1 nm of way, where an oil film of 0.1 µm changes the slope of its force.
        Kind::Real { unit: Unit::Newton, .. } => 0.01,
        _ => 1e-3,
    }
}

/// Differences of all outputs by each input, against the derivatives given; and whether each output moved.
fn compare(host: &Host, moment: &str) -> Vec<Vec<bool>> {
    let table = host.table();
    let (inputs, outputs) = (inputs(table), outputs(table));
    let unknowns = references(&outputs);
    let middle = host.get(&unknowns).unwrap();
    let mut moved = Vec::new();
    for input in &inputs {
        let reference = input.reference;
        let given = host.directional(&unknowns, &[reference], &[1.0]).unwrap();
        let at = host.get(&[reference]).unwrap()[0];
        let step = nudge(input);
        let look = |value: f64| {
            assert_eq!(host.set(&[reference], &[value]), Status::Ok);
            host.get(&unknowns).unwrap()
        };
        let (below, above, back) = (look(at - step), look(at + step), look(at));
        assert_eq!(back, middle, "{moment}: outputs follow the inputs alone");
        moved.push((0..outputs.len()).map(|i| below[i] != middle[i] || above[i] != middle[i]).collect());
        for (i, output) in outputs.iter().enumerate() {
            let difference = (above[i] - below[i]) / (2.0 * step);
            let Kind::Real { nominal, .. } = output.kind else { panic!() };
            // Truncation: a contact's curvature over a ten-thousandth of its approach. Rounding: 1e-12 of an output's
            // magnitude is what the equilibrium's residual leaves.
            let tolerance = 2e-6 * given[i].abs() + 2e-12 * middle[i].abs().max(nominal) / step;
            assert!(
                (given[i] - difference).abs() <= tolerance,
                "{moment}: {} by {}: {} given, {difference} found, allowed {tolerance:e}",
                output.name,
                input.name,
                given[i]
            );
        }
    }
    moved
}

/// Outputs that moved against outputs that are said to depend. An element that is never loaded never moves, so what is
/// said of elements must be true of one.
fn check_dependencies(host: &Host, moved: &[Vec<bool>], listed: impl Fn(&Dependencies) -> &[u32], moment: &str) {
    let (table, dependencies) = (host.table(), host.simulation().dependencies());
    let outputs = outputs(table);
    let kind = |name: &str| name.split_once(']').map_or(name, |(_, kind)| kind).to_owned();
    for (i, output) in outputs.iter().enumerate() {
        let found_at = |i: usize| {
            inputs(table).into_iter().zip(moved).filter(move |(_, moved)| moved[i]).map(|(v, _)| v.reference)
        };
        let found: Vec<u32> = found_at(i).collect();
        let of_kind = (0..outputs.len()).filter(|&k| kind(&outputs[k].name) == kind(&output.name));
        let found_of_kind: Vec<u32> = of_kind.flat_map(found_at).collect();
        let said: Vec<u32> = listed(dependencies.iter().find(|d| d.output == output.reference).unwrap())
            .iter()
            .copied()
            .filter(|&r| table[r as usize].causality == Causality::Input)
            .collect();
        for reference in &found {
            let input = &table[*reference as usize].name;
            assert!(said.contains(reference), "{moment}: {} follows {input}, which is not listed", output.name);
        }
        for reference in said {
            let input = &table[reference as usize].name;
            assert!(
                found_of_kind.contains(&reference),
                "{moment}: {} is said to follow {input} but never did",
                output.name
            );
        }
    }
}

fn merge(all: &mut Vec<Vec<bool>>, more: Vec<Vec<bool>>) {
    if all.is_empty() {
        *all = more;
        return;
    }
    for (all, more) in all.iter_mut().flatten().zip(more.into_iter().flatten()) {
        *all |= more;
    }
}

#[test]
fn directional_derivatives_at_communication_points_are_central_differences() {
    for scene in SCENES {
        let host = Host::pressed(scene);
        let mut moved = Vec::new();
        let mut time = 0.0;
        for point in 0..50 {
            merge(&mut moved, compare(&host, &format!("{scene} at {time} s")));
            // Through the defect, where there is one, and not always from a resting ring.
            let step = 2.5e-4 + 1e-6 * f64::from(point);
            assert_eq!(host.step(time, step), Status::Ok, "{:?}", host.lines());
            time += step;
            host.press();
        }
        check_dependencies(&host, &moved, |d| &d.direct, scene);
    }
}

#[test]
fn directional_derivatives_in_initialization_mode_are_central_differences() {
    for scene in SCENES {
        let mut moved = Vec::new();
        // Element 1 in the middle of the load zone, beside it, and, where there is a defect, at its edge.
        for angle in [-1.9, -std::f64::consts::FRAC_PI_2, -1.72, -1.3] {
            let host = Host::of(scene);
            host.press();
            assert_eq!(host.set(&[host.reference("cage.initial_angle")], &[angle]), Status::Ok);
            assert_eq!(host.begin(None, 0.0, None), Status::Ok);
            merge(&mut moved, compare(&host, &format!("{scene}, initial angle {angle}")));
        }
        let host = Host::of(scene);
        let loose = ["shaft.stiffness", "housing.stiffness"];
        // A ring without a spring to ground passes its load on, so that its neighbour's forces do not see it.
        for name in loose {
            if host.table().iter().any(|v| v.name == name) {
                assert_eq!(host.set(&[host.reference(name)], &[2e7]), Status::Ok);
            }
        }
        host.press();
        assert_eq!(host.begin(None, 0.0, None), Status::Ok);
        merge(&mut moved, compare(&host, &format!("{scene}, both rings held")));
        check_dependencies(&host, &moved, |d| &d.initial, &format!("{scene}, start"));
    }
}

#[test]
fn a_directional_derivative_is_linear_in_its_seed() {
    let host = Host::pressed("er16k-tb1-hosted-shaft");
    assert_eq!(host.step(0.0, 6e-3), Status::Ok);
    host.press();
    let table = host.table();
    let (knowns, unknowns) = (references(&inputs(table)), references(&outputs(table)));
    let seed: Vec<f64> = (0..knowns.len()).map(|i| 0.5 - i as f64).collect();
    let together = host.directional(&unknowns, &knowns, &seed).unwrap();
    let mut sum = vec![0.0; unknowns.len()];
    let mut size = vec![0.0f64; unknowns.len()];
    for (&known, &seed) in knowns.iter().zip(&seed) {
        for (i, part) in host.directional(&unknowns, &[known], &[seed]).unwrap().into_iter().enumerate() {
            sum[i] += part;
            size[i] += part.abs();
        }
    }
    for i in 0..sum.len() {
        // Rounding of some tens of terms.
        assert!((together[i] - sum[i]).abs() <= 1e-12 * size[i], "{}", table[unknowns[i] as usize].name);
    }
    // A known given twice counts twice; no knowns, no change.
    let y = host.reference("shaft.y");
    let twice = host.directional(&unknowns, &[y, y], &[1.0, 1.0]).unwrap();
    let once = host.directional(&unknowns, &[y], &[2.0]).unwrap();
    assert_eq!(twice, once);
    assert_eq!(host.directional(&unknowns, &[], &[]).unwrap(), vec![0.0; unknowns.len()]);
    assert_eq!(host.directional(&[], &knowns, &seed).unwrap(), Vec::<f64>::new());
}

#[test]
fn what_is_no_unknown_or_no_known_is_refused_and_the_run_goes_on() {
    let host = Host::started("er16k-tb1");
    let state = host.save();
    let count = host.table().len() as u32;
    let (speed, force, steps) =
        (host.reference("shaft.speed"), host.reference("shaft.force.y"), host.reference("solver.steps"));
    let mass = host.reference("shaft.mass");
    let cases = [
        (speed, speed, "no real output"),
        (mass, speed, "no real output"),
        (steps, speed, "no real output"),
        (count, speed, "unknown"),
        (force, force, "no real input"),
        (force, mass, "no real input"),
        (force, steps, "no real input"),
        (force, u32::MAX, "unknown"),
    ];
    for (unknown, known, words) in cases {
        host.lines();
        let expected = if words == "unknown" { Status::Error } else { Status::Discard };
        assert_eq!(host.directional(&[unknown], &[known], &[1.0]), Err(expected), "{words}");
        assert!(host.lines()[0].message.contains(words), "{words}");
        if expected == Status::Error {
            assert_eq!(host.restore(state), Status::Ok);
        }
        assert!(host.directional(&[force], &[speed], &[1.0]).is_ok(), "{words}");
    }
    for seed in [f64::NAN, f64::INFINITY] {
        assert_eq!(host.directional(&[force], &[speed], &[seed]), Err(Status::Discard));
    }
}

#[test]
fn a_loose_ring_has_an_output_but_no_derivative_in_initialization_mode() {
    // No load, no spring: the inner ring floats in the clearance.
    let host = Host::of("6205-healthy");
    for axis in ["shaft.load.x", "shaft.load.y"] {
        assert_eq!(host.set(&[host.reference(axis)], &[0.0]), Status::Ok);
    }
    assert_eq!(host.begin(None, 0.0, None), Status::Ok);
    let (load, y) = (host.reference("shaft.load.y"), host.reference("shaft.y"));
    assert!(host.get(&[y]).is_ok());
    assert_eq!(host.directional(&[y], &[load], &[1.0]), Err(Status::Discard));
    assert!(host.lines().pop().unwrap().message.contains("no derivative"));
    assert!(host.get(&[y]).is_ok());
}

#[test]
fn asking_for_derivatives_changes_nothing_that_follows() {
    for scene in SCENES {
        let (asked, silent) = (Host::pressed(scene), Host::pressed(scene));
        let table = asked.table();
        let (knowns, unknowns) = (references(&inputs(table)), references(&outputs(table)));
        let seed = vec![1.0; knowns.len()];
        for n in 0..40 {
            let time = f64::from(n) * 2e-4;
            asked.directional(&unknowns, &knowns, &seed).unwrap();
            asked.by_time(&unknowns, 1).unwrap();
            for host in [&asked, &silent] {
                assert_eq!(host.step(time, 2e-4), Status::Ok);
            }
            // But for the error of the coupling: who asks for rates of forces is taken to use them.
            let follows: Vec<_> = outputs(table).into_iter().filter(|v| !v.name.ends_with("coupling_error")).collect();
            let follows = references(&follows);
            assert_eq!(asked.get(&follows).unwrap(), silent.get(&follows).unwrap(), "{scene}");
        }
    }
}
