//! Derivatives that hosts of FMI 3.0 and 2.0 ask for, against differences: by every known of every unknown that the
//! model description lists, in initialization mode and at a communication point, and by time; of shipped scenes and of
//! random ones.
//!
//! A difference knows its own error by its neighbours' steps. Where an element begins to be pressed within it, which
//! the shorter ones show, it says nothing.

use crate::case::{Case, Motion, Shape};
use crate::draw::{Draw, for_seeds};
use crate::random_case::random;
use crate::three::Host;
use crate::two::{self, Resources};
use crate::units::position_error;
use brinell::simulation::Simulation;
use brinell::simulation::interface::table::{Causality, Dependencies, Kind, Unit};
use brinell_fmi::fmi3::Status;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Steps of differences, as parts of what is changed.
const PARTS: [f64; 9] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11];
/// Part of a derivative that a difference's own error may be, to say anything.
const TELLING: f64 = 1e-2;

/// Share of an output's size to which a start is known: forces are balanced to 1e-12 of a load, and several differences
/// add up.
const ROUNDING: f64 = 1e-11;

/// Part of itself to which a derivative is given. That of a stiffness has the second derivative of a crown's force and
/// the third of a path, which are kept as cubics.
fn share(unknown: &str) -> f64 {
    if unknown.contains("stiffness") { 1e-3 } else { 1e-4 }
}

/// Both versions' instances of the same resources, and what they list.
struct Both {
    three: Host,
    two: two::Host,
    /// Outputs, arrays by their first reference, and the rows of all their values.
    unknowns: Vec<u32>,
    rows: Vec<u32>,
    dependencies: Vec<Dependencies>,
    /// Shortest way (m) by which a difference moves what shapes a bearing: arcs of neighbouring defects are rounded.
    shortest: f64,
    /// Radius at which an angle is a way (m).
    radius: f64,
}

/// The derivative of the unknown `i` that differences over ever shorter steps tell best, and what that may be wrong by.
/// One is wrong by what its two neighbours differ from it, and by the rounding of an output of this `size`: of two that
/// are noise one in a hundred is near the other by chance, of three one in 1e4. It says nothing where neighbours go
/// farther from it than a third of itself, roundings aside; nor if a shorter one differs from it by more than both may
/// be wrong by, as a contact opens or closes on the way.
fn most_told(quotients: &[Vec<f64>], steps: &[f64], i: usize, size: f64, given: f64) -> Option<(f64, f64)> {
    let of = |k: usize| {
        let [longer, it, shorter] = [k - 1, k, k + 1].map(|k| quotients[k][i]);
        let (spread, rounding) = ((longer - it).abs().max((shorter - it).abs()), ROUNDING * size / steps[k + 1]);
        let own = if spread <= (it.abs() / 3.0).max(rounding) { spread + 0.1 * rounding } else { f64::INFINITY };
        (it, own)
    };
    let all: Vec<(f64, f64)> = (1..steps.len().max(2) - 1).map(of).collect();
    let agree = |(a, own_a): (f64, f64), (b, own_b): (f64, f64)| (a - b).abs() <= 3.0 * (own_a + own_b);
    let tells = |&k: &usize| {
        let (value, own) = all[k];
        own <= TELLING * value.abs().max(given.abs()) && all[k..].iter().all(|&shorter| agree(all[k], shorter))
    };
    (0..all.len()).filter(tells).map(|k| all[k]).min_by(|a, b| a.1.total_cmp(&b.1))
}

/// How many derivatives were compared, and how many a difference said nothing about.
#[derive(Default)]
struct Count {
    compared: usize,
    untold: usize,
}

impl Both {
    fn new(resources: Resources) -> Result<Self, String> {
        let resources = Arc::new(resources);
        let two = two::Host::with(Arc::clone(&resources), "instance", false);
        let three = Host::with(resources, "instance 1", true);
        let simulation = three.simulation();
        let is_output = |row: &u32| simulation.table()[*row as usize].causality == Causality::Output;
        let arrays = simulation.arrays();
        let unknowns: Vec<u32> = three.reals().0.into_iter().filter(is_output).collect();
        let all = |first: &u32| match arrays.iter().find(|array| array.rows[0] == *first) {
            Some(array) => array.rows.to_vec(),
            None => vec![*first],
        };
        let rows = unknowns.iter().flat_map(all).collect();
        let dependencies = simulation.dependencies();
        Ok(Self { two, unknowns, rows, dependencies, three, shortest: 0.0, radius: 0.0 })
    }

    fn name(&self, row: u32) -> &str {
        &self.three.table()[row as usize].name
    }

    /// By which a variable's roundings are measured: the largest of those in its unit, a thousandth of what is usual at
    /// least.
    fn size(&self, row: u32, values: &[f64]) -> f64 {
        let unit_of = |row: u32| match self.three.table()[row as usize].kind {
            Kind::Real { unit, nominal, .. } => Some((unit, nominal)),
            _ => None,
        };
        let Some((own, nominal)) = unit_of(row) else { return 0.0 };
        let alike = self.rows.iter().zip(values).filter(|(row, _)| unit_of(**row).is_some_and(|(unit, _)| unit == own));
        alike.fold(1e-3 * nominal, |most, (_, value)| most.max(value.abs()))
    }

    fn outputs(&self) -> Result<Vec<f64>, String> {
        self.three.get_values(&self.unknowns, self.rows.len()).map_err(|_| self.three.last_message())
    }

    /// Derivatives of all outputs by one known, by both versions.
    fn given(&self, known: u32) -> Result<Vec<f64>, String> {
        let (name, known) = (self.name(known), [known]);
        let of_three = self.three.directional([&self.unknowns, &known], &[1.0], self.rows.len());
        let of_three =
            of_three.map_err(|status| format!("by {name}, FMI 3.0: {status:?}: {}", self.three.last_message()))?;
        let of_two = self.two.directional(&self.rows, &known, &[1.0]);
        let of_two = of_two.map_err(|status| format!("by {name}, FMI 2.0: {status:?}"))?;
        if two::bits(&of_three) != two::bits(&of_two) {
            return Err(format!("by {name} FMI 3.0 and 2.0 differ"));
        }
        Ok(of_three)
    }

    fn set(&self, known: u32, value: f64) -> Result<(), String> {
        if self.two.set(&[known], &[value]) == Status::Ok && self.three.set(&[known], &[value]) == Status::Ok {
            return Ok(());
        }
        Err(format!("{} = {value}: {}", self.name(known), self.three.last_message()))
    }

    /// Compares the derivatives by one known with differences of it; those of outputs that do not list it must be 0.
    fn by(&self, known: u32, listed: impl Fn(&Dependencies) -> bool, count: &mut Count) -> Result<(), String> {
        let Kind::Real { nominal, min, max, unit, .. } = self.three.table()[known as usize].kind else { return Ok(()) };
        let is_listed = |row: u32| self.dependencies.iter().any(|of| of.output == row && listed(of));
        let mut at = self.three.get(&[known]).map_err(|_| self.three.last_message())?[0];
        // Differences go both ways from where the known is, or from beside its limit.
        // A defect that turns farther may come upon its neighbour.
        let whole = if self.name(known).starts_with("defect") { 1e-2 } else { 1.0 };
        let mut steps = PARTS.map(|part| whole * part * if at == 0.0 { nominal } else { at.abs() }).to_vec();
        let room = 2.0 * steps[0];
        if let (Some(min), Some(max)) = (min, max)
            && (at - min < room || max - at < room)
        {
            at = at.clamp(min + room, max - room);
            self.set(known, at)?;
        }
        if self.three.table()[known as usize].causality == Causality::Parameter {
            let way = match unit {
                Unit::Metre => 1.0,
                Unit::Radian => self.radius,
                _ => f64::INFINITY,
            };
            steps.retain(|step| step * way >= self.shortest);
        }
        let (middle, given) = (self.outputs()?, self.given(known)?);
        let look = |value: f64| {
            self.set(known, value)?;
            self.outputs()
        };
        let mut quotients = Vec::new();
        for &step in &steps {
            let (below, above) = (look(at - step)?, look(at + step)?);
            quotients.push(below.iter().zip(above).map(|(a, b)| (b - a) / (2.0 * step)).collect::<Vec<f64>>());
        }
        self.set(known, at)?;
        for (i, &row) in self.rows.iter().enumerate() {
            // What is given by a parameter is a difference as well, of a millionth of its usual size or more.
            let size = self.size(row, &middle);
            let rounding = ROUNDING * size / (1e-6 * nominal);
            if !is_listed(row) {
                if given[i].abs() > rounding {
                    return Err(format!(
                        "{} by {}, which it does not list: {}",
                        self.name(row),
                        self.name(known),
                        given[i]
                    ));
                }
                continue;
            }
            let Some((expected, own)) = most_told(&quotients, &steps, i, size, given[i]) else {
                count.untold += 1;
                continue;
            };
            count.compared += 1;
            let limit = share(self.name(row)) * expected.abs() + 3.0 * own + rounding;
            if !((given[i] - expected).abs() <= limit) {
                let (unknown, known) = (self.name(row), self.name(known));
                return Err(format!("{unknown} by {known}: {} given, {expected} found (limit {limit:e})", given[i]));
            }
        }
        Ok(())
    }

    /// Compares the derivatives by time with short steps.
    fn by_time(&self, point: f64, count: &mut Count) -> Result<(), String> {
        let given = self.three.by_time(&self.unknowns, self.rows.len());
        let given = given.map_err(|_| format!("by time: {}", self.three.last_message()))?;
        let state = self.three.save();
        let after = |step: f64| -> Result<Vec<f64>, String> {
            self.three.do_step(point, step).map_err(|_| self.three.last_message())?;
            let found = self.outputs();
            assert_eq!(self.three.restore(state), Status::Ok);
            found
        };
        let now = self.outputs()?;
        // One-sided quotients of second order.
        let mut quotients = Vec::new();
        let steps = [1.6e-7, 4e-8, 1e-8, 2.5e-9, 6.25e-10];
        for step in steps {
            let (one, two) = (after(step)?, after(2.0 * step)?);
            let all = now.iter().zip(one).zip(two);
            quotients.push(all.map(|((f, g), h)| (4.0 * g - 3.0 * f - h) / (2.0 * step)).collect::<Vec<f64>>());
        }
        assert_eq!(self.three.free(state), Status::Ok);
        for (i, &row) in self.rows.iter().enumerate() {
            // What means and counts are of is the step behind.
            if self.name(row).contains("mean_force") || self.name(row).starts_with("solver") {
                continue;
            }
            let Some((expected, own)) = most_told(&quotients, &steps, i, self.size(row, &now), given[i]) else {
                count.untold += 1;
                continue;
            };
            count.compared += 1;
            if !((given[i] - expected).abs() <= share(self.name(row)) * expected.abs() + 3.0 * own) {
                return Err(format!("{} by time: {} given, {expected} found ({own:e})", self.name(row), given[i]));
            }
        }
        Ok(())
    }

    /// All that is listed: knowns of the start, inputs after some steps of this length, and time. Inputs have these
    /// values.
    fn agree(&self, values: &[(&str, f64)], step: f64) -> Result<Count, String> {
        let mut count = Count::default();
        let ok = |both: [Status; 2]| if both == [Status::Ok; 2] { Ok(()) } else { Err(self.three.last_message()) };
        let inputs = self.three.table().iter().filter(|row| row.causality == Causality::Input);
        for row in inputs.clone() {
            if let Some((_, value)) = values.iter().find(|(name, _)| row.name == *name) {
                self.set(row.reference, *value)?;
            }
        }
        let inputs: Vec<u32> = inputs.map(|row| row.reference).collect();
        ok([self.two.begin(None, 0.0, None), self.three.begin(None, 0.0, None)])?;
        let mut knowns: Vec<u32> = self.dependencies.iter().flat_map(|of| of.initial.iter().copied()).collect();
        knowns.sort_unstable();
        knowns.dedup();
        for known in knowns {
            self.by(known, |of| of.initial.contains(&known), &mut count)
                .map_err(|why| format!("in initialization mode, {why}"))?;
        }
        ok([self.two.exit(), self.three.exit()])?;
        for point in [0.0, step, 2.0 * step] {
            ok([self.two.advance(point, step), self.three.advance(point, step)])?;
        }
        for input in inputs {
            self.by(input, |of| of.direct.contains(&input), &mut count)
                .map_err(|why| format!("after {} s, {why}", 3.0 * step))?;
        }
        self.by_time(3.0 * step, &mut count)?;
        Ok(count)
    }
}

/// Every kind of shipped scene; one of each element, defect, law and ring.
const SCENES: [&str; 11] = [
    "6205-healthy",
    "6205-hosted",
    "6205-irregular-cage",
    "6205-two-defects",
    "er16k-element",
    "er16k-tb1",
    "er16k-tb1-oil",
    "er16k-tb1-hosted-shaft",
    "er16k-tb2-compliant",
    "er16k-turning-outer",
    "nu205-inner",
];

/// Presses the inner ring into the elements, moving and sliding a little, where the host moves it.
const PRESSED: [(&str, f64); 4] = [("shaft.x", 3e-6), ("shaft.y", -18e-6), ("shaft.vy", 7e-4), ("housing.vx", 5e-4)];

/// What the host of a case sets before its first step.
fn hosted(case: &Case) -> Vec<(&'static str, f64)> {
    let Some(host) = case.steps[0].host else { return Vec::new() };
    let names = [
        [["shaft.x", "shaft.vx", "shaft.ax"], ["shaft.y", "shaft.vy", "shaft.ay"]],
        [["housing.x", "housing.vx", "housing.ax"], ["housing.y", "housing.vy", "housing.ay"]],
    ];
    let hosted = (0..2).filter(|&which| case.rings[which].motion == Motion::Host);
    let of_rings = hosted
        .flat_map(|which| (0..2).flat_map(move |a| (0..3).map(move |k| (names[which][a][k], host.rings[which][a][k]))));
    of_rings.chain([("shaft.speed", host.speeds[0][0]), ("housing.speed", host.speeds[1][0])]).collect()
}

#[test]
fn derivatives_by_all_that_a_shipped_scene_lists_are_differences() {
    let mut failed = Vec::new();
    for scene in SCENES {
        match Both::new(Resources::of(scene)).and_then(|both| both.agree(&PRESSED, 1e-4)) {
            Ok(Count { compared, untold }) => {
                println!("{scene}: {compared} compared, {untold} untold");
                // Many are 0, and of loose elements differences say nothing.
                assert!(compared > 200, "{scene}: {compared} compared, {untold} untold");
            }
            Err(why) => failed.push(format!("{scene}: {why}")),
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn derivatives_by_all_that_a_random_scene_lists_are_differences() {
    let all = AtomicUsize::new(0);
    for_seeds(4, |_, draw| {
        all.fetch_add(listed_by_a_random_scene(draw)?, Ordering::Relaxed);
        Ok(())
    });
    // Half can be set up and started.
    let all = all.into_inner();
    assert!(all > 50, "{all} compared");
}

/// Balls of which a housing on a spring of 38 N/m is held: the difference of two starts was one of 1000 N/m.
#[test]
fn a_soft_spring_is_moved_by_its_own_share() {
    assert!(listed_by_a_random_scene(&mut Draw::new(136)).unwrap() > 0);
}

/// How many derivatives were compared.
fn listed_by_a_random_scene(draw: &mut Draw) -> Result<usize, String> {
    let (_, case) = random(draw);
    let profiles = case.profiles();
    let topography = case.defects.iter().any(|defect| matches!(defect.shape, Shape::Topography(_)));
    // Resources of tests hold one profile.
    if topography || profiles.len() > 1 {
        return Ok(0);
    }
    let text = case.toml();
    let Ok(scene) = brinell_scene_file::from_toml(&text) else { return Ok(0) };
    // What is refused, at once or at the start, is another test's.
    let started = Simulation::new(scene.clone(), profiles.iter().map(String::as_str))
        .and_then(|mut simulation| simulation.initialize(0.0).map(|()| simulation));
    if started.is_err() {
        return Ok(0);
    }
    let profile = scene.profile_names().into_iter().next().zip(profiles.first());
    let resources = Resources::new(&text, profile.map(|(name, text)| (name, text.as_str())), "resources");
    let radius = 0.5 * scene.bearing.pitch_diameter;
    // Of which one rounding is a thousandth.
    let both = Both { shortest: 1e3 * position_error(&case), radius, ..Both::new(resources)? };
    let Count { compared, untold } = both.agree(&hosted(&case), case.steps[0].length)?;
    println!("{compared} compared, {untold} untold");
    Ok(compared)
}
