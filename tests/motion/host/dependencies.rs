//! What every initial unknown depends on, held against differences of starts in both directions: outputs, continuous
//! states and their derivatives, by every input and parameter, in every shipped scene.

use crate::support::{Named, shipped};
use brinell::scene::{DefectOn, DegreesOfFreedom, Motion, Ring, Scene};
use brinell::simulation::Simulation;
use brinell::simulation::exchange::ExchangeRole;
use brinell::simulation::interface::table::{Causality, Kind, Variable};
use std::collections::{BTreeMap, BTreeSet};

/// An initial unknown.
struct Unknown {
    reference: u32,
    name: String,
    nominal: f64,
}

fn unknowns(simulation: &Simulation) -> Vec<Unknown> {
    let outputs = simulation.table().iter().filter(|row| row.causality == Causality::Output);
    let outputs = outputs.filter_map(|row| match row.kind {
        Kind::Real { nominal, .. } => Some(Unknown { reference: row.reference, name: row.name.clone(), nominal }),
        _ => None,
    });
    let exchanged = simulation.exchange_variables().into_iter();
    let exchanged = exchanged.filter(|row| !matches!(row.role, ExchangeRole::Indicator(_)));
    outputs
        .chain(exchanged.map(|row| Unknown { reference: row.reference, name: row.name, nominal: row.nominal }))
        .collect()
}

/// A name that all elements share: what depends on where one element is is seen at another.
fn family(name: &str) -> String {
    match (name.find('['), name.find(']')) {
        (Some(from), Some(to)) => format!("{}{}", &name[..from], &name[to + 1..]),
        _ => name.to_owned(),
    }
}

/// Values of a known beside the one at which it is, small enough that contacts stay and large enough to be seen.
fn beside(known: &Variable, at: f64) -> Option<f64> {
    let Kind::Real { min, max, nominal, .. } = known.kind else { return None };
    let step = match &*known.name {
        name if name.ends_with("internal_clearance") || name.contains("length") || name.contains("depth") => 1e-8,
        name if name.contains("viscosity") => 1e-2 * at,
        name if name.contains("stiffness") => 1e4,
        name if name.contains("load") || name.contains("preload") => 0.1,
        name if name.contains("tilt") => 1e-6,
        name if [".x", ".y", ".z"].iter().any(|axis| name.ends_with(axis)) => 1e-9,
        name if name.contains("angle") || name.contains("slip") => 1e-3,
        _ => 1e-2 * nominal,
    };
    let fits = |value: &f64| min.is_none_or(|min| *value >= min) && max.is_none_or(|max| *value <= max);
    [at + step, at - step].into_iter().find(fits)
}

fn all(simulation: &mut Simulation, unknowns: &[Unknown]) -> Option<Vec<f64>> {
    let references: Vec<u32> = unknowns.iter().map(|unknown| unknown.reference).collect();
    let mut values = vec![f64::NAN; references.len()];
    simulation.exchange_reals(&references, &mut values).ok()?;
    Some(values)
}

/// A start, and what its unknowns are there.
struct Start {
    simulation: Simulation,
    here: Vec<f64>,
}

/// Which unknowns a change of a known moves from a start; `None` of a known that is not moved.
fn moved(start: &Start, unknowns: &[Unknown], known: &Variable) -> Option<Vec<bool>> {
    let mut there = start.simulation.clone();
    match known.kind {
        Kind::Real { .. } => {
            let mut at = [0.0];
            there.reals(&[known.reference], &mut at).ok()?;
            there.set_reals(&[known.reference], &[beside(known, at[0])?]).ok()?;
        }
        Kind::Whole { .. } => there.set_integers(&[known.reference], &[77]).ok()?,
        _ => return None,
    }
    let there = all(&mut there, unknowns)?;
    let differ = |((unknown, a), b): ((&Unknown, &f64), &f64)| {
        // The equilibrium is known to 1e-12 of an output's magnitude; forces on an element of some grams to 1e-9 N.
        let share = if unknown.name.contains("velocity)") { 1e-6 } else { 1e-12 };
        (a - b).abs() > 1e-10 * a.abs().max(b.abs()).max(share * 1e10 * unknown.nominal)
    };
    Some(unknowns.iter().zip(&start.here).zip(&there).map(differ).collect())
}

/// The scene from several sides: with its elements elsewhere, beside its defect, pressed and turning.
fn starts(scene: &Scene) -> (Vec<Unknown>, Vec<Start>) {
    let (mut found, mut of) = (Vec::new(), Vec::new());
    let towards = match scene.defects.first() {
        Some(defect) if defect.on == DefectOn::Outer => defect.angle,
        _ => -std::f64::consts::FRAC_PI_2,
    };
    for lead in [0.0, 0.07, 0.3] {
        let mut simulation = Named::new(scene.clone()).0;
        let set = |simulation: &mut Simulation, name: &str, value: f64| {
            // What a scene does not have need not be set.
            let _ = simulation.set(name, value);
        };
        set(&mut simulation, "cage.initial_angle", towards + lead);
        for defect in &scene.defects {
            match defect.on {
                DefectOn::Inner => set(&mut simulation, "shaft.initial_angle", towards - defect.angle),
                // It faces the outer raceway.
                DefectOn::Element { .. } => set(&mut simulation, "defect.angle", 0.0),
                DefectOn::Outer => {}
            }
        }
        set(&mut simulation, "cage.slip", 0.02);
        set(&mut simulation, "element.spin_slip", 0.01);
        set(&mut simulation, "shaft.stiffness", 2e7);
        set(&mut simulation, "housing.stiffness", 3e7);
        // Held along the axis as well, so that what acts on the one ring reaches the other.
        set(&mut simulation, "shaft.axial_stiffness", 1e7);
        set(&mut simulation, "housing.axial_stiffness", 2e7);
        set(&mut simulation, "housing.initial_angle", 0.0);
        if lead > 0.0 {
            // A floor that elements touch.
            set(&mut simulation, "defect.depth", 3e-6);
        }
        let hosted = |ring: &Ring| ring.motion == Motion::Host;
        let push = scene.bearing.radial_clearance.max(0.0) + 15e-6;
        for (name, ring, sign) in [("shaft", &scene.shaft, -1.0), ("housing", &scene.housing, 0.3)] {
            if hosted(ring) {
                set(&mut simulation, &format!("{name}.x"), 0.2 * sign * push);
                set(&mut simulation, &format!("{name}.y"), sign * push);
                if scene.bearing.degrees_of_freedom != DegreesOfFreedom::Two {
                    set(&mut simulation, &format!("{name}.z"), 10e-6);
                }
            }
        }
        of = unknowns(&simulation);
        let here = all(&mut simulation, &of).unwrap();
        found.push(Start { simulation, here });
    }
    (of, found)
}

#[test]
fn every_initial_unknown_depends_on_what_is_declared_and_on_nothing_else() {
    let (mut faults, mut seen, mut listed) = (Vec::new(), BTreeSet::new(), BTreeSet::new());
    for name in names() {
        let (unknowns, starts) = starts(&shipped(&name));
        let simulation = &starts[0].simulation;
        let mut declared = simulation.dependencies();
        declared.extend(simulation.exchange_dependencies());
        let initial: BTreeMap<u32, BTreeSet<u32>> =
            declared.into_iter().map(|of| (of.output, of.initial.into_iter().collect())).collect();
        let knowns = simulation.table().iter();
        for known in knowns.filter(|row| matches!(row.causality, Causality::Input | Causality::Parameter)) {
            for moved in starts.iter().filter_map(|start| moved(start, &unknowns, known)) {
                for (unknown, moved) in unknowns.iter().zip(moved) {
                    let is_listed = initial[&unknown.reference].contains(&known.reference);
                    let pair = (family(&known.name), family(&unknown.name));
                    if moved && !is_listed {
                        faults.push(format!("{name}: {} moves {}, not declared", known.name, unknown.name));
                    }
                    for (set, is) in [(&mut seen, moved), (&mut listed, is_listed)] {
                        if is {
                            set.insert(pair.clone());
                        }
                    }
                }
            }
        }
    }
    let idle = listed.difference(&seen).filter(|(known, unknown)| !is_rare(known, unknown));
    faults.extend(idle.map(|(known, unknown)| format!("{known} is declared for {unknown} and moves it in no scene")));
    faults.dedup();
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// Whether it takes more than these starts to show the one by the other: an element exactly on a wall or a floor, the
/// rate of a tilt, a probe in a bearing that is symmetric about it, an outer ring that a host moves.
fn is_rare(known: &str, unknown: &str) -> bool {
    ["defect.", "spin_slip", "initial_angle", "tilt.v"].iter().any(|part| known.contains(part))
        || unknown.starts_with("probe.")
        || unknown.contains("element.radial_velocity")
}

/// Of every shipped scene.
fn names() -> Vec<String> {
    let files = brinell_tests::files_below(&brinell_tests::root().join("scenes"), "toml");
    files.iter().map(|file| file.file_stem().unwrap().to_string_lossy().into_owned()).collect()
}
