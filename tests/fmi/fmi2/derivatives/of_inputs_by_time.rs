//! Derivatives of inputs by time: each order is used or refused.

use super::by_inputs::inputs;
use crate::two::{Host, bits};
use brinell::simulation::interface::table::Variable;
use brinell_fmi::fmi2::Status;

const SCENES: [&str; 3] = ["er16k-tb1", "er16k-tb1-hosted-shaft", "6205-hosted"];

/// Highest order that acts.
fn highest(input: &Variable) -> i32 {
    let name = &input.name;
    // A cage whose speed has a second derivative, and a ring whose acceleration has one, are polynomials that no step
    // has.
    if name == "shaft.speed" || name.ends_with(".ax") || name.ends_with(".ay") { 1 } else { 2 }
}

/// A run that has the inner ring pressed into the elements.
fn pressed(scene: &str) -> Host {
    let host = Host::of(scene);
    if inputs(host.table()).iter().any(|input| input.name == "shaft.y") {
        assert_eq!(host.set(&[host.reference("shaft.y")], &[-20e-6]), Status::Ok);
    }
    host.start();
    host
}

#[test]
fn every_input_takes_the_orders_that_its_description_names_and_no_others() {
    for scene in SCENES {
        let host = pressed(scene);
        for input in inputs(host.table()) {
            let highest = highest(input);
            let said = ["derivative of order 1 acts", "derivatives of orders 1 and 2 act"][highest as usize - 1];
            assert!(input.description.contains(said), "{}: {}", input.name, input.description);
            for order in 1..5 {
                host.lines();
                let status = host.rate(input.reference, order, 0.5);
                assert_eq!(
                    status,
                    if order <= highest { Status::Ok } else { Status::Discard },
                    "{} {order}",
                    input.name
                );
                let told = format!("order {order} of {}", input.name);
                let lines = host.lines();
                let is_told = lines.last().is_some_and(|line| line.message.contains(&told));
                assert_eq!(is_told, order > highest, "{told}: {lines:?}");
            }
        }
        // What was refused changed nothing and ended nothing.
        assert_eq!(host.step(0.0, 1e-5), Status::Ok);
    }
}

#[test]
fn orders_that_do_not_exist_and_variables_that_are_no_inputs_are_errors() {
    let host = Host::started("6205-hosted");
    let state = host.save();
    let speed = host.reference("shaft.speed");
    for (reference, order) in [(speed, 0), (speed, -1), (host.reference("shaft.force.y"), 1), (u32::MAX, 1)] {
        assert_eq!(host.rate(reference, order, 1.0), Status::Error);
        assert_eq!(host.restore(state), Status::Ok);
    }
    assert_eq!(host.rate(speed, 1, f64::NAN), Status::Discard);
}

#[test]
fn every_order_that_is_taken_acts() {
    for scene in SCENES {
        let host = pressed(scene);
        let (start, all) = (host.save(), host.reals());
        let after = |derivative: Option<(u32, i32, f64)>| {
            assert_eq!(host.restore(start), Status::Ok);
            if let Some((reference, order, value)) = derivative {
                assert_eq!(host.rate(reference, order, value), Status::Ok);
            }
            assert_eq!(host.step(0.0, 1e-3), Status::Ok, "{:?}", host.lines());
            bits(&host.get(&all).unwrap())
        };
        let without = after(None);
        assert_eq!(after(None), without);
        let forces: Vec<usize> = all.iter().enumerate().filter(|(_, r)| is_force(&host, **r)).map(|(i, _)| i).collect();
        for input in inputs(host.table()) {
            for order in 1..=highest(input) {
                let with = after(Some((input.reference, order, 0.3)));
                // Along x an element above may touch nothing; but something in the bearing has another force.
                let moved = forces.iter().any(|&i| with[i] != without[i]);
                assert!(moved, "{scene}: order {order} of {} has no effect", input.name);
            }
        }
    }
}

fn is_force(host: &Host, reference: u32) -> bool {
    host.table()[reference as usize].name.contains("force")
}

/// Motion of the inner ring along y: its position and the first three derivatives in SI units.
const MOTION: [f64; 4] = [-20e-6, 3e-3, -8.0, 4e4];
const STEP: f64 = 5e-4;

/// The inner ring's position along y and the forces on it, means and now, after one step of [`STEP`] with what `tell`
/// says.
fn told(tell: impl Fn(&Host, &dyn Fn(&str) -> u32)) -> Vec<f64> {
    let host = pressed("er16k-tb1-hosted-shaft");
    tell(&host, &|name| host.reference(name));
    assert_eq!(host.step(0.0, STEP), Status::Ok, "{:?}", host.lines());
    let names = ["shaft.y", "shaft.vy", "shaft.force.x", "shaft.force.y", "shaft.mean_force.y", "housing.y"];
    host.get(&names.map(|name| host.reference(name))).unwrap()
}

#[test]
fn a_motion_is_the_same_in_whichever_variables_it_is_told() {
    let [_, v, a, j] = MOTION;
    let set = |host: &Host, reference: u32, value: f64| assert_eq!(host.set(&[reference], &[value]), Status::Ok);
    let rate = |host: &Host, reference: u32, order: i32, value: f64| {
        assert_eq!(host.rate(reference, order, value), Status::Ok);
    };
    let plainly = told(|host, by| {
        set(host, by("shaft.vy"), v);
        set(host, by("shaft.ay"), a);
        rate(host, by("shaft.ay"), 1, j);
    });
    type Tell<'a> = &'a dyn Fn(&Host, &dyn Fn(&str) -> u32);
    let ways: [(&str, Tell); 5] = [
        ("velocity and its derivatives", &|host, by| {
            set(host, by("shaft.vy"), v);
            rate(host, by("shaft.vy"), 1, a);
            rate(host, by("shaft.vy"), 2, j);
        }),
        ("the position's derivatives, the acceleration's last", &|host, by| {
            rate(host, by("shaft.y"), 1, v);
            rate(host, by("shaft.y"), 2, a);
            rate(host, by("shaft.ay"), 1, j);
        }),
        ("the first derivative of each", &|host, by| {
            set(host, by("shaft.vy"), v);
            set(host, by("shaft.ay"), a);
            rate(host, by("shaft.y"), 1, v);
            rate(host, by("shaft.vy"), 1, a);
            rate(host, by("shaft.ay"), 1, j);
        }),
        ("all of it, all twice", &|host, by| {
            set(host, by("shaft.vy"), v);
            set(host, by("shaft.ay"), a);
            for (name, rates) in [("shaft.y", [v, a]), ("shaft.vy", [a, j])] {
                rate(host, by(name), 1, rates[0]);
                rate(host, by(name), 2, rates[1]);
            }
            rate(host, by("shaft.ay"), 1, j);
        }),
        ("what a derivative takes the place of is of no account", &|host, by| {
            set(host, by("shaft.vy"), -5.0 * v);
            set(host, by("shaft.ay"), 3.0 * a);
            rate(host, by("shaft.y"), 1, v);
            rate(host, by("shaft.vy"), 1, a);
            rate(host, by("shaft.ay"), 1, -j);
            rate(host, by("shaft.vy"), 2, j);
        }),
    ];
    for (what, way) in ways {
        assert_eq!(bits(&told(way)), bits(&plainly), "{what}");
    }
    let [y, v, a, j] = MOTION;
    let position = y + STEP * (v + STEP * (a / 2.0 + STEP * j / 6.0));
    // Rounding of some operations on 20 µm and 5 mm/s.
    assert!((plainly[0] - position).abs() < 1e-19, "{} {position}", plainly[0]);
    assert!((plainly[1] - (v + STEP * (a + STEP * j / 2.0))).abs() < 1e-17);
}

#[test]
fn a_derivative_of_zero_takes_the_place_of_the_input_as_well() {
    let without = told(|_, _| ());
    let with = told(|host, by| {
        assert_eq!(host.set(&[by("shaft.vy"), by("shaft.ay")], &[3e-3, 500.0]), Status::Ok);
        assert_eq!(host.rate(by("shaft.y"), 1, 0.0), Status::Ok);
        assert_eq!(host.rate(by("shaft.vy"), 1, 0.0), Status::Ok);
    });
    assert_eq!(bits(&with), bits(&without));
}

#[test]
fn a_step_of_a_ring_that_jerks_is_a_hundred_small_ones() {
    let run = |count: u32| {
        let host = Host::of("er16k-tb1-hosted-shaft");
        assert_eq!(host.set(&[host.reference("solver.tolerance")], &[1e-9]), Status::Ok);
        assert_eq!(host.set(&[host.reference("shaft.y")], &[MOTION[0]]), Status::Ok);
        host.start();
        let (step, [_, v, a, j]) = (2.0 * STEP / f64::from(count), MOTION);
        let names = ["shaft.y", "shaft.vy", "shaft.ay"].map(|name| host.reference(name));
        for n in 0..count {
            let t = f64::from(n) * step;
            let now = [MOTION[0] + t * (v + t * (a / 2.0 + t * j / 6.0)), v + t * (a + t * j / 2.0), a + t * j];
            assert_eq!(host.set(&names, &now), Status::Ok);
            assert_eq!(host.rate(names[2], 1, j), Status::Ok);
            assert_eq!(host.step(t, step), Status::Ok);
        }
        let seen = ["shaft.force.y", "housing.vy", "element[1].force.outer"];
        host.get(&seen.map(|name| host.reference(name))).unwrap()
    };
    let (one, many) = (run(1), run(100));
    for (one, many) in one.iter().zip(&many) {
        // 1e-7: the tolerance of 1e-9 over some hundred integration steps. Without the third derivative: 0.2 and more.
        assert!((one / many - 1.0).abs() < 1e-7, "{one} {many}");
    }
}

#[test]
fn an_input_follows_its_derivative_inside_the_step() {
    let host = Host::started("6205-hosted");
    let (speed, angle) = (host.reference("shaft.speed"), host.reference("cage.angle"));
    let before = host.get(&[speed, angle, host.reference("cage.speed")]).unwrap();
    let rate = 1000.0;
    assert_eq!(host.rate(speed, 1, rate), Status::Ok);
    assert_eq!(host.step(0.0, 1e-2), Status::Ok);
    let turned = host.get(&[angle]).unwrap()[0] - before[1];
    let cage_ratio = before[2] / before[0];
    let expected = cage_ratio * (before[0] * 1e-2 + 0.5 * rate * 1e-4);
    // 1e-12: rounding of a few operations on numbers of order one.
    assert!((turned - expected).abs() < 1e-12, "{turned} {expected}");
}
