//! Extremes of rings that move in space, against the oracle in space, which shares no code with the library.

use crate::refused::refused;
use crate::row::Row;
use crate::support::energy::energy;
use crate::support::{Named, shipped};
use brinell::scene::{Damping, DegreesOfFreedom, Motion, Ring, Scene};
use brinell::simulation::{Simulation, SimulationError};
use brinell_oracle::case;
use brinell_oracle::spatial::{AxialSetting, Gyroscopic, Host, SpatialBearing, SpatialCase, SpatialRing, SpatialRun};
use std::f64::consts::TAU;

/// Error (m) of a position in a step of the oracle, and most of its steps.
const EXACT: f64 = 1e-15;
const BUDGET: usize = 1_000_000;

/// Names of the forces (N) that are compared.
const FORCES: [&str; 6] = [
    "shaft.force.x",
    "shaft.force.y",
    "shaft.force.z",
    "housing.force.z",
    "element[1].force.outer",
    "element[2].force.inner",
];

macro_rules! cases {
    ($($name:ident = $case:expr;)*) => {
        /// Every case, in order.
        pub fn rows() -> Vec<Row> {
            vec![$($case),*]
        }

        $(#[test]
        fn $name() {
            print!("{}", $case);
        })*
    };
}

cases! {
    twenty_thousand_turns_a_minute_agree = fast("shaft at 20 000 rev/min", 20_000.0);
    sixty_thousand_turns_a_minute_agree = fast("shaft at 60 000 rev/min", 60_000.0);
    a_preload_that_is_lifted_agrees = preload_lifted();
    a_soft_spring_instead_of_a_preload_agrees = without_preload();
    nothing_along_the_axis_is_refused = nothing_along_the_axis();
    a_thrust_that_turns_round_agrees = thrust_turns();
    a_thrust_that_turned_round_settles_on_the_other_side = settles_on_the_other_side();
    a_jump_of_a_micrometre_along_the_axis_agrees = jumps("host jumps by 1 µm along the axis", 1e-6);
    a_jump_of_a_hundred_micrometres_along_the_axis_agrees = jumps("host jumps by 100 µm along the axis", 1e-4);
    without_damping_the_energy_stays = energy_stays();
    a_moment_that_jumps_agrees = moment_jumps();
    a_tilt_of_five_milliradians_agrees = tilted("host tilts by 5 mrad at once", 5e-3);
    a_tilt_of_fifty_milliradians_that_is_held_agrees = held_tilted();
    a_tilt_of_fifty_milliradians_at_once_is_an_error = tilted_too_far();
}

/// The bearing of a spindle, without the accelerometer that the oracle lacks.
fn preloaded() -> Scene {
    Scene { sensors: Vec::new(), ..shipped("7205-preloaded") }
}

/// The same for the oracle.
fn as_case(scene: &Scene) -> SpatialCase {
    let (b, degrees) = (&scene.bearing, f64::to_degrees);
    let Damping::HuntCrossley(chi) = scene.contact.damping else { panic!("another damping") };
    let ring = |ring: &Ring| {
        let ([x, y], [about_x, about_y]) = (ring.load, ring.tilt.load_moment);
        SpatialRing {
            motion: match ring.motion {
                Motion::Host => case::Motion::Host,
                Motion::Internal => case::Motion::Internal,
                Motion::Fixed => case::Motion::Fixed,
            },
            load: [x, y, ring.axial.load, about_x, about_y],
            preload: ring.axial.preload,
            mass: ring.mass,
            damping: [ring.damping, ring.axial.damping, ring.tilt.damping],
            stiffness: [ring.stiffness, ring.axial.stiffness, ring.tilt.stiffness],
            inertia: [ring.tilt.transverse_inertia, ring.tilt.polar_inertia],
        }
    };
    SpatialCase {
        freedom: b.degrees_of_freedom.count(),
        gravity: [scene.gravity[0], scene.gravity[1], scene.axial_gravity],
        count: b.element_count,
        diameter_mm: b.element_diameter * 1e3,
        pitch_mm: b.pitch_diameter * 1e3,
        conformities: [b.conformity_inner, b.conformity_outer],
        setting: AxialSetting::Angle(degrees(b.contact_angle.unwrap())),
        operating_deg: b.contact_angle.map(degrees),
        shoulders_mm: [None; 2],
        modulus_gpa: b.youngs_modulus * 1e-9,
        poisson: b.poissons_ratio,
        element: b.element_youngs_modulus.zip(b.element_poissons_ratio).map(|(modulus, ratio)| [modulus * 1e-9, ratio]),
        density: b.density,
        mass_g: None,
        hertz: [None; 2],
        damping: case::Damping::HuntCrossley(chi),
        across: scene.contact.damping_across(),
        slip: scene.cage.slip,
        cage_deg: degrees(scene.cage.initial_angle),
        inertia: true,
        gyroscopic: Gyroscopic::Nobody,
        defects: Vec::new(),
        rings: [ring(&scene.shaft), ring(&scene.housing)],
        speed_hz: scene.shaft_speed / TAU,
        housing_hz: None,
        tolerance: scene.tolerance,
        steps: Vec::new(),
    }
}

/// A place of the shaft on its axis (m).
fn along(z: f64) -> [f64; 5] {
    [0.0, 0.0, z, 0.0, 0.0]
}

/// An extreme: a scene, and what its host sets after the start.
struct Extreme {
    what: &'static str,
    scene: Scene,
    /// Where the shaft's balance is looked for, or the host has it (m, rad).
    near: [f64; 5],
    /// Inputs of the shaft and their values from the start on: x, y, z and about x, y of loads, or of positions.
    later: Vec<(usize, f64)>,
    /// Length of a communication step (s), ten of which are compared.
    step: f64,
    limit: f64,
}

impl Extreme {
    fn inputs(&self) -> [&'static str; 5] {
        match self.scene.shaft.motion {
            Motion::Host => ["shaft.x", "shaft.y", "shaft.z", "shaft.tilt.x", "shaft.tilt.y"],
            _ => ["shaft.load.x", "shaft.load.y", "shaft.load.z", "shaft.load_moment.x", "shaft.load_moment.y"],
        }
    }

    /// The oracle's forces at the ends of the steps, by its tolerance (m).
    fn expected(&self, tolerance: f64) -> Vec<[f64; 6]> {
        let case = as_case(&self.scene);
        let bearing = SpatialBearing::new(&case);
        let speeds = [[self.scene.shaft_speed, 0.0], [0.0; 2]];
        let mut host = Host { speeds, rings: case.rings.map(|ring| ring.load.map(|load| [load, 0.0, 0.0])) };
        if self.scene.shaft.motion == Motion::Host {
            (0..5).for_each(|k| host.rings[0][k][0] = self.near[k]);
        }
        let balance = bearing.balance(Some(&host), self.near).unwrap();
        let largest = balance.held.balls.iter().flat_map(|ball| ball.contacts).fold(0.0f64, |m, t| m.max(t.force));
        assert!(balance.left.max(balance.held.left) < 1e-8 * largest, "{}: the oracle finds no balance", self.what);
        let mut run = SpatialRun::new(&bearing, balance.state, Some(&host), [0.0; 2], tolerance, BUDGET);
        for &(input, value) in &self.later {
            host.rings[0][input][0] = value;
        }
        let mut found = Vec::new();
        for _ in 0..10 {
            run.step(self.step, Some(&host)).unwrap();
            let ([shaft, housing], balls) = (run.acting.rings, &run.acting.balls);
            let elements = [balls[0].contacts[1].force, balls[1].contacts[0].force];
            found.push([shaft[0], shaft[1], shaft[2], housing[2], elements[0], elements[1]]);
        }
        found
    }

    /// The library's, at the scene's tolerance.
    fn found(&self) -> Result<(Named, Vec<[f64; 6]>), SimulationError> {
        let mut bearing = Named::new(self.scene.clone());
        if self.scene.shaft.motion == Motion::Host {
            for (name, value) in
                self.inputs().into_iter().zip(self.near).take(self.scene.bearing.degrees_of_freedom.count())
            {
                bearing.set(name, value);
            }
        }
        bearing.0.initialize(0.0)?;
        for &(input, value) in &self.later {
            bearing.set(self.inputs()[input], value);
        }
        let mut found = Vec::new();
        for _ in 0..10 {
            bearing.0.step(self.step)?;
            found.push(FORCES.map(|name| bearing.get(name)));
        }
        Ok((bearing, found))
    }

    fn row(&self) -> Row {
        let what = self.what;
        let (expected, coarse) = (self.expected(EXACT), self.expected(100.0 * EXACT));
        let (bearing, found) = self.found().unwrap();
        let all = |rows: &[[f64; 6]]| rows.iter().flatten().copied().collect::<Vec<f64>>();
        let [expected, coarse, found] = [all(&expected), all(&coarse), all(&found)];
        let at = (0..expected.len()).max_by(|&a, &b| expected[a].abs().total_cmp(&expected[b].abs())).unwrap();
        let largest = expected[at].abs();
        let off = |a: &[f64]| a.iter().zip(&expected).fold(0.0f64, |worst, (a, b)| worst.max((a - b).abs())) / largest;
        let (own, error) = (off(&coarse), off(&found));
        // The oracle must know better than what it judges.
        assert!(own < 0.1 * self.limit, "{what}: the oracle's own error is {own:e}");
        assert!(error <= self.limit, "{what}: forces differ by {error:e} of {largest:e} N");
        let by = format!("oracle: `{}` {:.6e} N", FORCES[at % FORCES.len()], expected[at]);
        Row::new(what, by, format!("{:.6e} N", found[at]), &bearing).within(error, self.limit)
    }
}

fn fast(what: &'static str, turns_a_minute: f64) -> Row {
    let scene = Scene { shaft_speed: turns_a_minute / 60.0 * TAU, ..preloaded() };
    Extreme { what, scene, near: along(1e-5), later: vec![(0, 100.0)], step: 3e-4, limit: 1e-4 }.row()
}

fn nothing_along_the_axis() -> Row {
    let mut scene = preloaded();
    scene.shaft.axial.preload = 0.0;
    let error = Simulation::new(scene, None).map(|_| ());
    refused("no preload, nor anything else along the axis", "preload", error, &Named::new(preloaded()))
}

/// The spring is so soft that the load across pushes the shaft to where the grooves face each other.
fn without_preload() -> Row {
    let mut scene = preloaded();
    (scene.shaft.axial.preload, scene.shaft.axial.stiffness) = (0.0, 1e3);
    let near = [0.0, -3.1e-5, -1.342e-4, 0.0, 0.0];
    let what = "no preload, a spring of 1 N/mm along the axis";
    Extreme { what, scene, near, later: Vec::new(), step: 3e-4, limit: 1e-3 }.row()
}

fn preload_lifted() -> Row {
    let what = "preload of 300 N lifted at once, 150 N across";
    Extreme { what, scene: preloaded(), near: along(1e-5), later: vec![(2, -300.0)], step: 3e-4, limit: 1e-3 }.row()
}

/// From 300 N of preload to 700 N the other way: the balls come loose and go over, 0.27 mm.
const TURNED: f64 = -1000.0;

fn thrust_turns() -> Row {
    let what = "thrust turns from 300 to −700 N, the balls going over";
    Extreme { what, scene: preloaded(), near: along(1e-5), later: vec![(2, TURNED)], step: 2e-4, limit: 1e-2 }.row()
}

fn settles_on_the_other_side() -> Row {
    let what = "the same with the shaft standing, 0.2 s later";
    let mut scene = preloaded();
    scene.shaft_speed = 0.0;
    let mut bearing = Named::started(scene.clone());
    bearing.set("shaft.load.z", TURNED);
    bearing.run(1e-3, 200);
    scene.shaft.axial.load = TURNED;
    let case = as_case(&scene);
    let balance = SpatialBearing::new(&case).balance(None, [0.0, 0.0, -3e-4, 0.0, 0.0]).unwrap();
    let forces: Vec<f64> = balance.held.balls.iter().map(|ball| ball.contacts[1].force).collect();
    let largest = forces.iter().fold(0.0f64, |m, f| m.max(*f));
    assert!(balance.left.max(balance.held.left) < 1e-8 * largest);
    let found: Vec<f64> = (1..=12).map(|j| bearing.get(&format!("element[{j}].force.outer"))).collect();
    let error = forces.iter().zip(&found).fold(0.0f64, |worst, (a, b)| worst.max((a - b).abs())) / largest;
    assert!(bearing.get("element[1].contact_angle.outer") < 0.0 && error < 1e-3, "{error}: {found:?} {forces:?}");
    let got = found.iter().fold(0.0f64, |m, f| m.max(*f));
    Row::new(what, format!("oracle's balance: largest element force {largest:.4e} N"), format!("{got:.4e} N"), &bearing)
        .within(error, 1e-3)
}

fn jumps(what: &'static str, by: f64) -> Row {
    let mut scene = preloaded();
    scene.shaft = Ring::hosted();
    Extreme { what, scene, near: along(1e-5), later: vec![(2, 1e-5 + by)], step: 1e-4, limit: 1e-4 }.row()
}

fn moment_jumps() -> Row {
    let what = "tilting (`7205-inner` without its spall), moment jumps from 0.5 to −5 N m";
    let scene = Scene { sensors: Vec::new(), defects: Vec::new(), ..shipped("7205-inner") };
    Extreme { what, scene, near: along(1e-5), later: vec![(3, -5.0)], step: 3e-4, limit: 1e-3 }.row()
}

fn tilted(what: &'static str, tilt: f64) -> Row {
    let scene = shipped("7205-pair");
    Extreme { what, scene, near: along(1e-5), later: vec![(3, tilt)], step: 1e-5, limit: 1e-3 }.row()
}

fn held_tilted() -> Row {
    let (what, scene) = ("host holds a tilt of 50 mrad", shipped("7205-pair"));
    Extreme { what, scene, near: [0.0, 0.0, 1e-5, 0.05, 0.0], later: Vec::new(), step: 1e-5, limit: 1e-3 }.row()
}

/// At once, the balls still where they were.
fn tilted_too_far() -> Row {
    let mut bearing = Named::started(shipped("7205-pair"));
    bearing.set("shaft.tilt.x", 0.05);
    let found = bearing.0.step(1e-5);
    refused("host tilts by 50 mrad at once", "contact angle", found, &bearing)
}

/// The shaft in space on a bearing that stands, without any damping.
fn energy_stays() -> Row {
    let mut scene = preloaded();
    (scene.housing, scene.shaft_speed, scene.contact.damping) = (Ring::fixed(), 0.0, Damping::HuntCrossley(0.0));
    (scene.shaft.damping, scene.shaft.axial.damping) = (0.0, 0.0);
    assert_eq!((scene.contact.damping_across(), scene.bearing.degrees_of_freedom), (0.0, DegreesOfFreedom::Three));
    let mut bearing = Named::started(scene.clone());
    bearing.set("shaft.load.z", 300.0);
    scene.shaft.axial.load = 300.0;
    let [start, _] = energy(&mut bearing.0, &scene);
    let (mut drift, mut motion): (f64, f64) = (0.0, 0.0);
    for _ in 0..500 {
        bearing.run(1e-4, 1);
        let [now, of_shaft] = energy(&mut bearing.0, &scene);
        (drift, motion) = (drift.max((now - start).abs()), motion.max(of_shaft));
    }
    let (share, limit) = (drift / motion, 1e-6);
    // Some ten thousand steps at 1e-6 of the approach each, of which errors of one sign might add up.
    assert!(share < limit, "{share}");
    let expected = format!("energy constant; the shaft's own goes up to {motion:.4e} J");
    let what = "no damping anywhere, thrust jumps from 300 to 600 N, 50 ms";
    Row::new(what, expected, format!("changes by {drift:.1e} J"), &bearing).within(share, limit)
}
