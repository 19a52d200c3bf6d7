//! Model Exchange: integrated by somebody else a bearing moves as by itself, and its Jacobian is that of differences.

use crate::support::differences::reals;
use crate::support::{runge_kutta, shipped};
use brinell::scene::{ContactLaw, ElementInertia, Motion, Ring, Scene};
use brinell::simulation::Simulation;
use brinell::simulation::exchange::ExchangeRole;

/// A host that integrates: Runge and Kutta's classical method with steps of one length, which ends on events.
struct Host {
    simulation: Simulation,
    time: f64,
    states: Vec<f64>,
    indicators: Vec<f64>,
    events: usize,
    cells_entered: usize,
}

impl Host {
    fn new(mut simulation: Simulation) -> Self {
        let mut states = vec![0.0; simulation.continuous_state_count()];
        simulation.continuous_states(&mut states).unwrap();
        let mut indicators = vec![0.0; simulation.event_indicator_count()];
        simulation.event_indicators(&mut indicators).unwrap();
        Self { simulation, time: 0.0, states, indicators, events: 0, cells_entered: 0 }
    }

    fn slope(&mut self, states: &[f64]) -> Vec<f64> {
        self.simulation.set_continuous_states(states);
        let mut slope = vec![0.0; states.len()];
        self.simulation.state_derivatives(&mut slope).unwrap();
        slope
    }

    /// Where a step of `h` ends.
    fn tried(&mut self, h: f64) -> Vec<f64> {
        let start = self.states.clone();
        runge_kutta(&start, h, |states| self.slope(states))
    }

    /// Whether an indicator has another sign there.
    fn changes(&mut self, states: &[f64]) -> bool {
        self.simulation.set_continuous_states(states);
        let mut there = vec![0.0; self.indicators.len()];
        self.simulation.event_indicators(&mut there).unwrap();
        there.iter().zip(&self.indicators).any(|(new, old)| (*new > 0.0) != (*old > 0.0))
    }

    fn advance(&mut self, stop: f64, length: f64) {
        while self.time < stop - 1e-15 {
            let mut h = length.min(stop - self.time);
            let mut end = self.tried(h);
            let event = self.changes(&end);
            if event {
                let (mut low, mut high) = (0.0, h);
                while high - low > 1e-16 {
                    h = 0.5 * (low + high);
                    if h == low || h == high {
                        break;
                    }
                    end = self.tried(h);
                    if self.changes(&end) { high = h } else { low = h }
                }
                h = high;
                end = self.tried(h);
            }
            self.time += h;
            self.simulation.set_time(self.time);
            self.simulation.set_continuous_states(&end);
            self.simulation.accept_states().unwrap();
            if event {
                self.events += 1;
                self.cells_entered += usize::from(self.simulation.handle_event().unwrap());
            }
            self.states = end;
            self.simulation.event_indicators(&mut self.indicators).unwrap();
        }
    }
}

fn started(scene: Scene) -> Simulation {
    let mut simulation = Simulation::new(scene, None).unwrap();
    simulation.initialize(0.0).unwrap();
    simulation
}

/// Largest difference of a signal at multiples of the grid, over its range, and the host.
fn compared(scene: &Scene, names: &[&str], stop: f64, h: f64) -> (f64, Host) {
    let (mut by_itself, mut host) = (started(scene.clone()), Host::new(started(scene.clone())));
    let kick = |simulation: &mut Simulation| {
        if let Ok(y) = simulation.get("shaft.load.y") {
            simulation.set("shaft.load.y", 1.2 * y).unwrap();
        }
    };
    kick(&mut by_itself);
    kick(&mut host.simulation);
    let grid = 1e-4;
    let (mut signals, mut apart) = (vec![[f64::MAX, f64::MIN]; names.len()], vec![0.0f64; names.len()]);
    for count in 1..=(stop / grid).round() as usize {
        by_itself.step(grid).unwrap();
        host.advance(count as f64 * grid, h);
        for (i, name) in names.iter().enumerate() {
            let (own, other) = (by_itself.get(name).unwrap(), host.simulation.get(name).unwrap());
            signals[i] = [signals[i][0].min(own), signals[i][1].max(own)];
            apart[i] = apart[i].max((own - other).abs());
        }
    }
    let worst = signals.iter().zip(&apart).map(|([low, high], apart)| apart / (high - low)).fold(0.0, f64::max);
    (worst, host)
}

#[test]
fn integrated_by_somebody_else_a_healthy_bearing_moves_as_by_itself() {
    let scene = Scene { tolerance: 1e-11, ..shipped("6205-healthy") };
    // Fixed steps of 0.1 µs leave 1e-8 of an element's vibration at 50 kHz in each of its periods.
    let (worst, host) = compared(&scene, &["shaft.x", "shaft.y", "housing.y", "sensor.acceleration"], 3e-3, 1e-7);
    assert!(worst < 1e-7, "{worst:e}");
    assert_eq!(host.cells_entered, 0);
}

#[test]
fn twenty_milliseconds_of_a_spalled_bearing_integrated_by_somebody_else_are_the_same_to_1e_8() {
    let scene = Scene { tolerance: 1e-12, ..shipped("er16k-tb1") };
    // What is left is the host's: paths are 5e-8 off with steps of 0.1 µs, 9e-9 with half and 2e-9 with a quarter of
    // them, and what the bearing makes of it at 1e-12 differs from that at 1e-11 by 3e-11.
    let (worst, host) = compared(&scene, &["shaft.x", "shaft.y", "housing.y", "element[1].path"], 20e-3, 5e-8);
    assert!(worst < 1e-8, "{worst:e}");
    assert!(host.cells_entered >= 4, "{} cells entered", host.cells_entered);
    assert!(host.events > host.cells_entered, "no contact began or ended");
}

#[test]
fn integrated_by_somebody_else_balls_in_space_move_as_by_themselves() {
    for (name, seen) in [
        ("7205-preloaded", &["shaft.x", "shaft.y", "shaft.z", "element[1].axial"][..]),
        ("7205-inner", &["shaft.y", "shaft.z", "shaft.tilt.x", "element[1].axial"][..]),
        ("6205-combined", &["shaft.y", "shaft.z", "housing.y", "element[1].path"][..]),
    ] {
        let scene = Scene { tolerance: 1e-11, ..shipped(name) };
        let (worst, _) = compared(&scene, seen, 1e-3, 1e-7);
        // As in the plane: fixed steps of 0.1 µs leave 1e-8 in each period of an element's vibration.
        assert!(worst < 1e-6, "{name}: {worst:e}");
    }
}

#[test]
fn integrated_by_somebody_else_contacts_on_a_grid_are_solved_as_by_themselves() {
    let mut scene = Scene { tolerance: 1e-9, ..shipped("er16k-tb1") };
    (scene.contact.law, scene.contact.cells) = (ContactLaw::Love, Some([8, 8]));
    // An element stands over the spall.
    scene.cage.initial_angle = scene.defects[0].angle;
    let (worst, mut host) = compared(&scene, &["shaft.y", "housing.y", "element[1].path"], 3e-4, 2e-7);
    assert!(worst < 1e-6, "{worst:e}");
    // Deeper than on the smooth raceway.
    assert!(host.simulation.get("element[1].path").unwrap() > 1e-6);
}

#[test]
fn without_inertia_and_with_both_rings_of_the_host_the_cage_angle_is_the_only_state() {
    let mut scene = shipped("6205-hosted");
    scene.bearing.element_inertia = ElementInertia::None;
    let simulation = started(scene);
    assert_eq!(simulation.continuous_state_count(), 1);
    assert_eq!(simulation.exchange_variables()[0].name, "state.cage.angle");
}

/// A column of a Jacobian: its known and the nominal change of it, what is given, and differences.
type Column = (String, f64, Vec<f64>, Vec<f64>);

/// The Jacobian after some time (s) of all but mean forces, with the names of its rows.
fn jacobian(scene: Scene, before: f64) -> (Vec<String>, Vec<Column>) {
    let mut simulation = started(scene);
    simulation.step(before).unwrap();
    let table: Vec<_> = simulation.table().to_vec();
    let exchanged = simulation.exchange_variables();
    let mut states = vec![0.0; simulation.continuous_state_count()];
    simulation.continuous_states(&mut states).unwrap();
    let of_table = |causality| {
        let rows = table.iter().filter(move |row| row.causality == causality);
        rows.filter(|row| matches!(row.kind, brinell::simulation::interface::table::Kind::Real { .. }))
    };
    use brinell::simulation::interface::table::{Causality, Kind};
    let mut unknowns: Vec<(u32, String)> = of_table(Causality::Output)
        .filter(|row| !row.name.contains("mean_force"))
        .map(|row| (row.reference, row.name.clone()))
        .collect();
    let derivatives = exchanged.iter().filter(|row| matches!(row.role, ExchangeRole::Derivative(_)));
    unknowns.extend(derivatives.map(|row| (row.reference, row.name.clone())));
    let references: Vec<u32> = unknowns.iter().map(|unknown| unknown.0).collect();
    let read = |simulation: &mut Simulation| -> Vec<f64> {
        let one = |&reference: &u32, simulation: &mut Simulation| {
            simulation.exchange_value(reference).unwrap().unwrap_or_else(|| reals(simulation, &[reference])[0])
        };
        references.iter().map(|reference| one(reference, simulation)).collect()
    };
    let mut knowns: Vec<(u32, f64)> = of_table(Causality::Input)
        .map(|row| (row.reference, if let Kind::Real { nominal, .. } = row.kind { nominal } else { 1.0 }))
        .collect();
    let of_states = exchanged.iter().filter(|row| matches!(row.role, ExchangeRole::State(_)));
    knowns.extend(of_states.map(|row| (row.reference, row.nominal)));
    let mut columns = Vec::new();
    for &(known, nominal) in &knowns {
        let of_table = table.get(known as usize).map(|row| row.name.clone());
        let name = of_table.or_else(|| simulation.exchange_name(known)).unwrap();
        let mut exact = vec![0.0; references.len()];
        simulation.directional_derivative(&references, &[known], &[1.0], &mut exact).unwrap();
        // A hundredth of the least approach of an element that hangs loose, 10 pm; in space, where approaches are
        // distances of grooves, a hundred times as much for the roundings of these.
        let of_angle = if simulation.reference("shaft.z").is_ok() { 1e-1 } else { 1e-3 };
        let by = 1e-6 * nominal * if nominal >= 1.0 && (known as usize) >= table.len() { of_angle } else { 1.0 };
        let side = |sign: f64| {
            let mut simulation = simulation.clone();
            match simulation.exchange_role(known) {
                Some(ExchangeRole::State(number)) => {
                    let mut moved = states.clone();
                    moved[number] += sign * by;
                    simulation.set_continuous_states(&moved);
                }
                _ => {
                    let value = reals(&mut simulation, &[known])[0];
                    simulation.set_reals(&[known], &[value + sign * by]).unwrap();
                }
            }
            read(&mut simulation)
        };
        let (high, low) = (side(1.0), side(-1.0));
        let differences: Vec<f64> = high.iter().zip(&low).map(|(high, low)| (high - low) / (2.0 * by)).collect();
        columns.push((name, nominal, exact, differences));
    }
    (unknowns.into_iter().map(|unknown| unknown.1).collect(), columns)
}

#[test]
fn the_jacobian_of_outputs_and_state_derivatives_is_that_of_differences() {
    // In the spall, with sensor and both rings free; then with an inner defect, whose frames are states too; hosted;
    // then of three and of five degrees of freedom.
    let scenes = [
        ("er16k-tb1", 7e-3),
        ("er16k-inner", 2e-3),
        ("er16k-tb1-hosted-shaft", 7e-3),
        ("6205-combined", 5e-3),
        ("7205-preloaded", 1e-3),
        ("7205-inner", 2e-3),
    ];
    for (name, before) in scenes {
        let (names, columns) = jacobian(shipped(name), before);
        for (row, of) in names.iter().enumerate() {
            let largest = columns.iter().map(|(_, nominal, exact, _)| (nominal * exact[row]).abs()).fold(0.0, f64::max);
            for (known, nominal, exact, differences) in columns.iter().filter(|_| largest > 0.0) {
                let error = (nominal * (exact[row] - differences[row])).abs() / largest;
                // Central differences over a share of an approach: its square, and rounding of forces over small
                // changes.
                assert!(error < 1e-5, "{name}: {of} by {known}: {:e} and {:e}", exact[row], differences[row]);
            }
        }
    }
}

#[test]
fn a_state_derivative_depends_on_the_states_and_inputs_that_are_declared() {
    for (name, before) in [("er16k-tb1", 7e-3), ("6205-hosted", 1e-3), ("7205-preloaded", 1e-3), ("7205-inner", 2e-3)] {
        let mut simulation = started(shipped(name));
        simulation.step(before).unwrap();
        let declared = simulation.exchange_dependencies();
        let exchanged = simulation.exchange_variables();
        let slopes = exchanged.iter().filter(|row| matches!(row.role, ExchangeRole::Derivative(_)));
        let slopes: Vec<u32> = slopes.map(|row| row.reference).collect();
        let states = exchanged.iter().filter(|row| matches!(row.role, ExchangeRole::State(_)));
        let inputs = simulation.table().iter();
        let inputs = inputs.filter(|row| row.causality == brinell::simulation::interface::table::Causality::Input);
        let knowns: Vec<u32> = inputs.map(|row| row.reference).chain(states.map(|row| row.reference)).collect();
        let mut filled = 0;
        for &known in &knowns {
            let mut column = vec![0.0; slopes.len()];
            simulation.directional_derivative(&slopes, &[known], &[1.0], &mut column).unwrap();
            for (slope, value) in slopes.iter().zip(column) {
                let of = declared.iter().find(|of| of.output == *slope).unwrap();
                let listed = of.direct.contains(&known);
                assert!(listed || value == 0.0, "{name}: {slope} by {known}: {value:e}");
                filled += usize::from(listed);
            }
        }
        // Elements do not feel each other: of the whole matrix most is known to be empty.
        assert!(filled < slopes.len() * knowns.len() / 2, "{name}: {filled} of {}", slopes.len() * knowns.len());
    }
}

#[test]
fn at_the_start_states_and_their_derivatives_follow_inputs_and_parameters_as_differences_say() {
    use brinell::simulation::interface::table::{Causality, Kind};
    for name in ["er16k-tb1", "er16k-inner", "6205-hosted", "6205-combined", "7205-preloaded"] {
        let mut simulation = Simulation::new(shipped(name), None).unwrap();
        if name == "6205-hosted" {
            simulation.set("shaft.y", -20e-6).unwrap();
        }
        let exchanged = simulation.exchange_variables();
        let of_kind = exchanged.iter().filter(|row| !matches!(row.role, ExchangeRole::Indicator(_)));
        let (unknowns, nominals): (Vec<u32>, Vec<f64>) = of_kind.map(|row| (row.reference, row.nominal)).unzip();
        let values = |simulation: &mut Simulation| {
            let mut values = vec![0.0; unknowns.len()];
            simulation.exchange_reals(&unknowns, &mut values).unwrap();
            values
        };
        let table = simulation.table().to_vec();
        for known in ["shaft.speed", "shaft.load.y", "shaft.load.z", "shaft.y", "shaft.vy", "cage.initial_angle"] {
            let Some(row) = table.iter().find(|row| row.name == known && row.causality != Causality::Output) else {
                continue;
            };
            let by = match (known, &row.kind) {
                ("shaft.y", _) => 1e-10,
                ("cage.initial_angle", _) => 1e-6,
                (_, Kind::Real { nominal, .. }) => 1e-4 * nominal,
                _ => panic!("{known}"),
            };
            let mut given = vec![0.0; unknowns.len()];
            simulation.directional_derivative(&unknowns, &[row.reference], &[1.0], &mut given).unwrap();
            let at = reals(&mut simulation, &[row.reference])[0];
            let mut side = |sign: f64| {
                simulation.set_reals(&[row.reference], &[at + sign * by]).unwrap();
                values(&mut simulation)
            };
            let (high, low) = (side(1.0), side(-1.0));
            side(0.0);
            for (i, (high, low)) in high.iter().zip(&low).enumerate() {
                let found = (high - low) / (2.0 * by);
                // Differences go with the square of the step; the equilibrium is known to 1e-10 of what is usual, and
                // forces on elements of some grams to 1e-9 N.
                let share = if exchanged[i].name.contains("velocity)") { 1e-7 } else { 1e-10 };
                let allowed = 1e-4 * given[i].abs() + share * nominals[i].max(high.abs()) / by;
                assert!(
                    (found - given[i]).abs() <= allowed,
                    "{name}: {} by {known}: {:e} given, {found:e} found",
                    exchanged[i].name,
                    given[i]
                );
            }
        }
    }
}

#[test]
fn a_ring_that_the_host_integrates_swings_as_one_inside() {
    // The same mass, once a state of the FMU and once of the host: no coupling error is left.
    let (mass, damping) = (3.0, 1376.8);
    let base = Scene { tolerance: 1e-11, ..shipped("6205-healthy") };
    let (motion, load) = (Motion::Internal, [0.0, -1500.0]);
    let ring = Ring { motion, load, mass, damping, stiffness: 0.0, ..base.shaft };
    let mut inside = started(Scene { shaft: ring, ..base.clone() });
    let start = [inside.get("shaft.x").unwrap(), inside.get("shaft.y").unwrap()];
    inside.set("shaft.load.y", -1800.0).unwrap();
    let (motion, load) = (Motion::Host, [0.0; 2]);
    let hosted = Ring { motion, load, mass: 0.0, damping: 0.0, stiffness: 0.0, ..base.shaft };
    let mut bearing = Simulation::new(Scene { shaft: hosted, ..base }, None).unwrap();
    for (name, value) in [("shaft.x", start[0]), ("shaft.y", start[1])] {
        bearing.set(name, value).unwrap();
    }
    bearing.initialize(0.0).unwrap();
    let mut states = vec![0.0; bearing.continuous_state_count()];
    bearing.continuous_states(&mut states).unwrap();
    let count = states.len();
    states.extend([start[0], start[1], 0.0, 0.0]);
    let slope = |bearing: &mut Simulation, all: &[f64]| {
        let mut slope = vec![0.0; all.len()];
        bearing.set_continuous_states(&all[..count]);
        for (name, value) in ["shaft.x", "shaft.y", "shaft.vx", "shaft.vy"].iter().zip(&all[count..]) {
            bearing.set(name, *value).unwrap();
        }
        bearing.state_derivatives(&mut slope[..count]).unwrap();
        let force = ["shaft.force.x", "shaft.force.y"].map(|name| bearing.get(name).unwrap());
        for axis in 0..2 {
            slope[count + axis] = all[count + 2 + axis];
            let load = [0.0, -1800.0][axis];
            slope[count + 2 + axis] = (force[axis] + load - damping * all[count + 2 + axis]) / mass;
        }
        slope
    };
    let (h, grid, stop) = (1e-7, 1e-4, 3e-3);
    let (mut apart, mut way) = (0.0f64, 0.0f64);
    for _ in 0..(stop / grid) as usize {
        inside.step(grid).unwrap();
        for _ in 0..(grid / h).round() as usize {
            states = runge_kutta(&states, h, |states| slope(&mut bearing, states));
        }
        apart = apart.max((states[count + 1] - inside.get("shaft.y").unwrap()).abs());
        way = way.max((inside.get("shaft.y").unwrap() - start[1]).abs());
    }
    assert!(apart < 1e-7 * way, "{apart:e} of {way:e}");
}
