//! Intermediate updates and the early returns that a host asks for in them.

use crate::three::{Call, Host, OnUpdate, Update, get, set};
use crate::two::{Resources, bits};
use brinell::simulation::interface::table::Causality;
use brinell_fmi::fmi3::*;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

const SCENES: [&str; 5] = ["er16k-tb1", "6205-hosted", "6205-epps", "6205-irregular-cage", "er16k-element"];
const STEP: f64 = 1e-3;

/// Time and values seen in updates.
type Seen = Rc<RefCell<Vec<(Update, Vec<u64>)>>>;

/// A host that reads all it may in every update, which are continuous outputs, and asks for what `wants` says.
fn watching(scene: &str, wants: impl Fn(Update) -> Option<f64> + 'static) -> (Host, Seen, Vec<u32>, usize) {
    let plain = Host::of(scene);
    let is_readable = |reference: &u32| {
        let row = &plain.table()[*reference as usize];
        row.changes_within_steps() && row.causality == Causality::Output
    };
    let references: Vec<u32> = plain.reals().0.into_iter().filter(is_readable).collect();
    let arrays = plain.simulation().arrays();
    let width =
        |reference: &u32| arrays.iter().find(|array| array.rows[0] == *reference).map_or(1, |array| array.rows.len());
    let count: usize = references.iter().map(width).sum();
    let seen = Seen::default();
    let (list, wanted) = (Rc::clone(&seen), references.clone());
    let on_update: OnUpdate = Box::new(move |update| {
        let values = get(update.instance, &wanted, count).unwrap();
        list.borrow_mut().push((update, bits(&values)));
        wants(update)
    });
    (Host::updated(scene, &references, on_update), seen, references, count)
}

#[test]
fn a_run_that_is_watched_has_the_bits_of_one_that_is_not() {
    for scene in SCENES {
        let (host, seen, ..) = watching(scene, |_| None);
        let plain = Host::started(scene);
        for n in 0..12 {
            let point = f64::from(n) * STEP;
            host.step(point, STEP);
            plain.step(point, STEP);
            assert_eq!(bits(&host.all()), bits(&plain.all()), "{scene} after step {n}");
            let seen = seen.take();
            assert!(seen.len() > 1, "{scene}: more than one integration step");
            let times: Vec<f64> = seen.iter().map(|(update, _)| update.time).collect();
            assert!(times.is_sorted() && times[0] > point, "{times:?}");
            let (last, earlier) = seen.split_last().unwrap();
            assert_eq!(last.0.time.to_bits(), (point + STEP).to_bits());
            assert!(!last.0.can_return && earlier.iter().all(|(update, _)| update.can_return));
            let all = seen.iter().all(|(update, _)| update.get_allowed && update.finished && !update.set_requested);
            assert!(all, "outputs of accepted steps, and no inputs");
        }
    }
}

#[test]
fn a_run_under_law_love_that_is_watched_has_the_bits_of_one_that_is_not() {
    let love = |text: String| text.replace("law = \"hertz\"", "law = \"love\"");
    let resources = || Resources::edited("er16k-tb1", "resources", love);
    let plain = Host::with(resources(), "instance 1", true);
    let y = [plain.reference("shaft.force.y")];
    let seen = Rc::new(RefCell::new(0));
    let count = Rc::clone(&seen);
    let on_update: OnUpdate = Box::new(move |update| {
        // Reading solves contacts of its own.
        get(update.instance, &y, 1).unwrap();
        *count.borrow_mut() += 1;
        None
    });
    let watched = Host::updated_with(resources(), &y, on_update);
    for host in [&watched, &plain] {
        host.start();
        (0..4).for_each(|n| host.step(f64::from(n) * STEP, STEP));
    }
    assert!(*seen.borrow() > 4, "more than one integration step in each");
    assert_eq!(bits(&watched.all()), bits(&plain.all()));
}

#[test]
fn a_step_returns_early_where_it_is_asked_with_the_outputs_that_were_shown_there() {
    for scene in SCENES {
        // At the third update of each step.
        let (host, seen, references, count) = {
            let number = RefCell::new((f64::NEG_INFINITY, 0));
            watching(scene, move |update| {
                let mut number = number.borrow_mut();
                let since = update.time - number.0;
                *number = (update.time, if since > 0.0 { number.1 + 1 } else { 1 });
                (number.1 % 3 == 0).then_some(update.time)
            })
        };
        let mut point = 0.0;
        let mut returns = 0;
        for _ in 0..30 {
            let (event, end, early, time) = host.do_step(point, STEP).unwrap();
            assert!(!event && !end);
            assert_eq!(early, time < point + STEP);
            let seen = seen.take();
            let (update, values) = seen.last().unwrap();
            assert_eq!(update.time.to_bits(), time.to_bits(), "{scene}");
            assert_eq!(bits(&host.get_values(&references, count).unwrap()), *values, "{scene}");
            assert_eq!(host.get(&[host.reference("time")]).unwrap(), [time]);
            returns += u32::from(early);
            point = time;
        }
        assert!(returns > 5, "{scene}: {returns} early returns");
    }
}

#[test]
fn a_step_returns_exactly_at_a_later_instant_that_the_host_names() {
    for scene in SCENES {
        let at = 0.2345e-3;
        let (host, seen, references, count) = watching(scene, move |update| (update.time < at).then_some(at));
        let stepped = host.do_step(0.0, STEP).unwrap();
        assert_eq!((stepped.2, stepped.3.to_bits()), (true, at.to_bits()), "{scene}");
        let seen = seen.take();
        assert_eq!(seen.last().unwrap().1, bits(&host.get_values(&references, count).unwrap()), "{scene}");
        // A host that had asked for just that step at once is met within the tolerance: 1e-4 of the load, while
        // nothing is struck.
        let plain = Host::started(scene);
        plain.step(0.0, at);
        for name in ["shaft.force.x", "shaft.force.y"] {
            let [a, b] = [&host, &plain].map(|one| one.get(&[one.reference(name)]).unwrap()[0]);
            assert!((a - b).abs() <= 1e-4 * 1500.0, "{scene} {name}: {a} against {b}");
        }
        // And the run goes on from there.
        let rest = host.do_step(at, STEP - at).unwrap();
        assert_eq!(rest.3.to_bits(), (at + (STEP - at)).to_bits());
    }
}

#[test]
fn a_state_saved_after_an_early_return_continues_with_the_same_bits() {
    let (host, ..) = watching("er16k-tb1", |update| (update.time > 0.3e-3).then_some(update.time));
    let (.., early, time) = host.do_step(0.0, STEP).unwrap();
    assert!(early);
    let bytes = host.serialize(host.save());
    let on = |host: &Host| {
        host.do_step(time, 0.1e-3).unwrap();
        bits(&host.all())
    };
    let other = Host::of("er16k-tb1");
    assert_eq!(other.restore(other.deserialize(&bytes).unwrap()), Status::Ok);
    // The watching host asks to return at its first update; the other would not.
    let state = host.save();
    let first = on(&host);
    assert_eq!(host.restore(state), Status::Ok);
    assert_eq!(on(&host), first);
    other.step(time, 0.1e-3);
}

#[test]
fn an_input_set_in_an_update_acts_from_there_on() {
    // A ring that falls back from −10 µm to 0 along a smooth curve; the host knows it at every instant.
    let y = |t: f64| -10e-6 - 4e-6 * (2e3 * t).sin();
    let v = |t: f64| -8e-3 * (2e3 * t).cos();
    let a = |t: f64| 16.0 * (2e3 * t).sin();
    let names = ["shaft.y", "shaft.vy", "shaft.ay"];
    let curve = move |t: f64| [y(t), v(t), a(t)];
    let plain = Host::of("6205-hosted");
    let inputs = names.map(|name| plain.reference(name));
    let force = plain.reference("shaft.force.y");
    let asked = Rc::new(RefCell::new(0));
    let run = |step: f64, count: u32, updated: bool| {
        let asked = Rc::clone(&asked);
        let on_update: OnUpdate = Box::new(move |update| {
            if update.set_requested {
                *asked.borrow_mut() += 1;
                assert_eq!(set(update.instance, &inputs, &curve(update.time)), Status::Ok);
            }
            None
        });
        let host =
            if updated { Host::updated("6205-hosted", &inputs, on_update) } else { Host::started("6205-hosted") };
        for n in 0..count {
            let point = f64::from(n) * step;
            assert_eq!(host.set(&inputs, &curve(point)), Status::Ok);
            host.step(point, step);
        }
        assert_eq!(host.set(&inputs, &curve(f64::from(count) * step)), Status::Ok);
        host.get(&[force]).unwrap()[0]
    };
    let exact = run(1e-6, 1000, false);
    let (held, told) = (run(0.25e-3, 4, false), run(0.25e-3, 4, true));
    assert!(*asked.borrow() > 10, "asked {} times", asked.borrow());
    let error = |value: f64| (value - exact).abs();
    assert!(error(told) < 0.05 * error(held), "{told} told, {held} extrapolated, {exact} in small steps");
}

#[test]
fn inputs_set_to_where_they_are_change_no_bit() {
    let names = ["shaft.load.y", "shaft.speed"];
    let plain = Host::started("er16k-tb1");
    let inputs = names.map(|name| plain.reference(name));
    let asked = Rc::new(Cell::new(0));
    let count = Rc::clone(&asked);
    let on_update: OnUpdate = Box::new(move |update| {
        let present = get(update.instance, &inputs, 2).unwrap();
        if update.set_requested {
            count.set(count.get() + 1);
            assert_eq!(set(update.instance, &inputs, &present), Status::Ok);
        }
        None
    });
    let host = Host::updated("er16k-tb1", &inputs, on_update);
    for n in 0..20 {
        host.step(f64::from(n) * STEP, STEP);
        plain.step(f64::from(n) * STEP, STEP);
        assert_eq!(bits(&host.all()), bits(&plain.all()), "after step {n}");
    }
    assert!(asked.get() > 10, "asked {} times", asked.get());
}

#[test]
fn the_mean_force_belongs_to_the_last_step_while_the_next_is_under_way() {
    let plain = Host::started("6205-hosted");
    let [mean, x] = ["shaft.mean_force.y", "shaft.x"].map(|name| plain.reference(name));
    let seen = Rc::new(RefCell::new(Vec::new()));
    let list = Rc::clone(&seen);
    let on_update: OnUpdate = Box::new(move |update| {
        list.borrow_mut().push(get(update.instance, &[mean], 1).unwrap()[0]);
        if update.set_requested {
            assert_eq!(set(update.instance, &[x], &[1e-9 * (update.time * 1e6).sin()]), Status::Ok);
        }
        None
    });
    let host = Host::updated("6205-hosted", &[mean, x], on_update);
    for n in 0..5 {
        let before = host.get(&[mean]).unwrap();
        assert_eq!(host.set(&[host.reference("shaft.y")], &[-15e-6 - 1e-6 * f64::from(n)]), Status::Ok);
        host.step(f64::from(n) * STEP, STEP);
        let seen = seen.take();
        assert!(!seen.is_empty() && seen.iter().all(|value| value.to_bits() == before[0].to_bits()), "step {n}");
        assert_ne!(host.get(&[mean]).unwrap(), before);
    }
}

#[test]
fn the_mean_force_is_that_of_the_whole_step_though_inputs_are_set_inside() {
    let wiggle = |update: Update| 1e-9 * (update.time * 1e6).sin();
    let plain = Host::started("6205-hosted");
    let x = plain.reference("shaft.x");
    let on_update: OnUpdate = Box::new(move |update| {
        if update.set_requested {
            assert_eq!(set(update.instance, &[x], &[wiggle(update)]), Status::Ok);
        }
        None
    });
    let host = Host::updated("6205-hosted", &[x], on_update);
    for one in [&host, &plain] {
        assert_eq!(one.set(&[one.reference("shaft.y")], &[-15e-6]), Status::Ok);
        one.step(0.0, STEP);
    }
    let mean = |one: &Host| one.get(&[one.reference("shaft.mean_force.y")]).unwrap()[0];
    // A nanometre of 15 µm moves forces by 1e-4.
    assert_ne!(mean(&host).to_bits(), mean(&plain).to_bits());
    assert!((mean(&host) - mean(&plain)).abs() < 1e-3 * mean(&plain).abs(), "{} {}", mean(&host), mean(&plain));
}

/// What an update that does `wrong` makes of its step.
fn failed(required: &[u32], wrong: impl Fn(Update) -> Option<f64> + 'static) -> String {
    let host = Host::updated("6205-hosted", required, Box::new(wrong));
    let state = host.save();
    host.lines();
    assert_eq!(host.do_step(0.0, STEP), Err(Status::Error));
    let messages = host.lines().into_iter().map(|line| line.message).collect::<Vec<_>>().join("\n");
    assert_eq!(host.restore(state), Status::Ok, "nothing is lost");
    messages
}

#[test]
fn what_an_update_may_not_do_fails_the_step_with_the_reason() {
    let plain = Host::of("6205-hosted");
    let [speed, force, path, mean] =
        ["shaft.speed", "shaft.force.y", "element.path", "shaft.mean_force.x"].map(|name| plain.reference(name));
    let said = failed(&[force], move |update| {
        assert!(get(update.instance, &[speed], 1).is_err());
        None
    });
    assert!(said.contains("shaft.speed") && said.contains("requiredIntermediateVariables"), "{said}");
    assert!(said.contains("a call inside the intermediate update"), "{said}");
    let said = failed(&[force], move |update| get(update.instance, &[mean], 1).err().and(None));
    assert!(said.contains("shaft.mean_force.x") && said.contains("cannot be read"), "{said}");
    let said = failed(&[force], move |update| {
        assert_eq!(set(update.instance, &[force], &[1.0]), Status::Error);
        None
    });
    assert!(said.contains("cannot be set in an intermediate update"), "{said}");
    let said = failed(&[path], move |update| get(update.instance, &[path], 3).err().and(None));
    assert!(said.contains("9 values"), "{said}");
    let said = failed(&[], |update| {
        // SAFETY of both: a living handle.
        unsafe {
            assert_eq!(fmi3Reset(update.instance), Status::Error);
            fmi3FreeInstance(update.instance);
        }
        None
    });
    assert!(said.contains("fmi3Reset: not allowed in mode \"intermediate update mode\""), "{said}");
    for wrong in [-1.0, 2.0 * STEP, f64::NAN] {
        let said = failed(&[], move |_| Some(wrong));
        assert!(said.contains("earlyReturnTime") && said.contains("0.001 s"), "{said}");
    }
    let said = failed(&[], |_| panic!("a host that panics"));
    assert!(said.contains("intermediateUpdate did not return: a host that panics"), "{said}");
}

#[test]
fn a_host_that_cannot_handle_an_early_return_gets_none() {
    let resources = Resources::of("6205-healthy");
    let path = resources.directory.to_str().unwrap();
    let on_update: OnUpdate = Box::new(|update| {
        assert!(!update.can_return);
        Some(update.time)
    });
    let parts = Call { on_update: Some(on_update), ..Call::good(&resources.guid, path) }.make();
    let host = Host::of_parts(parts, resources.into());
    host.start();
    host.step(0.0, STEP);
}
