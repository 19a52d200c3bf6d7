//! How much of its thread's stack each call takes, in all shipped scenes: a host's threads may have little to spare.

use crate::three::{self, product};
use crate::two;
use crate::two::any_host::{Host, Version};
use brinell::simulation::interface::table::{Causality, Kind};
use brinell_fmi::fmi3::{Status, fmi3GetDirectionalDerivative};
use brinell_tests::resources::Resources;
use std::sync::Arc;
use std::thread;

/// The most that a call may take (bytes) as tests are compiled: a step of a hosted ring with five degrees of freedom
/// takes 101 kB, what makes an instance 58 kB.
const LIMIT: usize = 104_000;
/// How far down is looked (bytes), and what is left out at the top, where the helpers themselves are.
const DEPTH: usize = 160 << 10;
const OWN: usize = 512;
const PAINT: u64 = 0xa5a5_a5a5_a5a5_a5a5;

/// Paints the stack below, and gives where that ends.
#[inline(never)]
fn paint() -> usize {
    let here = 0u64;
    let top = (&raw const here).addr() - OWN;
    // SAFETY: below what is used of this thread's own stack, of which there is more than that.
    unsafe { std::ptr::with_exposed_provenance_mut::<u8>(top - DEPTH).write_bytes(PAINT as u8, DEPTH) };
    top
}

/// How much of the paint is gone (bytes).
#[inline(never)]
fn gone(top: usize) -> usize {
    let words = (top - DEPTH..top).step_by(size_of::<u64>());
    // SAFETY: as above; aligned, as the top is.
    let is_painted =
        |address: usize| unsafe { std::ptr::with_exposed_provenance::<u64>(address).read_volatile() } == PAINT;
    let first = words.into_iter().find(|&address| !is_painted(address));
    first.map_or(0, |address| top - address)
}

/// What a call gives, and how much stack it takes (bytes).
fn taken<R>(call: impl FnOnce() -> R) -> (R, usize) {
    let top = paint();
    let result = call();
    (result, gone(top))
}

/// A name of each call, and what it takes.
type Takes = Vec<(&'static str, usize)>;

fn life<V: Version>(resources: &Arc<Resources>, derive: impl Fn(&Host<V>, &[u32], u32)) -> Takes {
    let mut all = Takes::new();
    let mut note = |what: &'static str, (status, taken): (Status, usize)| {
        assert_eq!(status, Status::Ok, "{what}");
        all.push((what, taken));
    };
    let (host, by) = taken(|| Host::<V>::with(Arc::clone(resources), "stack", false));
    note("Instantiate", (Status::Ok, by));
    // Set up here, for the names.
    let simulation = host.simulation();
    let (references, count) = V::reals(simulation);
    let mut values = vec![0.0; count];
    let rows = simulation.table().iter().filter(|row| matches!(row.kind, Kind::Real { .. }));
    let rows: Vec<_> = rows.collect();
    let of = |causality| rows.iter().filter(move |row| row.causality == causality).map(|row| row.reference);
    let outputs: Vec<u32> = of(Causality::Output).filter(|row| references.contains(row)).collect();
    note("EnterInitializationMode", taken(|| host.begin(None, 0.0, None)));
    note("Get", taken(|| V::get(host.c, &references, &mut values)));
    note("ExitInitializationMode", taken(|| host.exit()));
    for n in 0..4 {
        note("DoStep", taken(|| host.advance(f64::from(n) * 2e-3, 2e-3)));
        note("Get", taken(|| V::get(host.c, &references, &mut values)));
        for input in of(Causality::Input).take(3) {
            note("GetDirectionalDerivative", taken(|| (derive(&host, &outputs, input), Status::Ok).1));
        }
    }
    let mut state = std::ptr::null_mut();
    // SAFETY: a living handle, a pointer to one value.
    note("GetFMUstate", taken(|| unsafe { (V::FUNCTIONS.get_state)(host.c, &raw mut state) }));
    let mut size = 0;
    // SAFETY of these: a living handle; pointers to as much as is said.
    note("SerializedFMUstateSize", taken(|| unsafe { (V::FUNCTIONS.state_size)(host.c, state, &raw mut size) }));
    let mut bytes = vec![0u8; size];
    let to = bytes.as_mut_ptr();
    note("SerializeFMUstate", taken(|| unsafe { (V::FUNCTIONS.serialize)(host.c, state, to.cast(), size) }));
    let (mut copy, from) = (std::ptr::null_mut(), bytes.as_ptr());
    let deserialize = V::FUNCTIONS.deserialize;
    note("DeserializeFMUstate", taken(|| unsafe { deserialize(host.c, from.cast(), size, &raw mut copy) }));
    note("SetFMUstate", taken(|| host.restore(state)));
    note("Terminate", taken(|| host.terminate()));
    note("Reset", taken(|| host.reset()));
    note("FreeInstance", (Status::Ok, taken(|| drop(host)).1));
    all
}

#[test]
fn no_call_of_any_scene_takes_more_than_104_kilobytes_of_stack() {
    let mut worst: Vec<(usize, String)> = Vec::new();
    let files = brinell_tests::files_below(&brinell_tests::root().join("scenes"), "toml");
    for file in files {
        let name = file.file_stem().unwrap().to_str().unwrap().to_owned();
        // Resources here have one profile at most.
        if std::fs::read_to_string(&file).unwrap().matches("\nprofile = ").count() > 1 {
            continue;
        }
        let measure = move || {
            let resources = Arc::new(Resources::of(&name));
            let of_two = life::<two::Two>(&resources, |host, outputs, input| {
                host.directional(outputs, &[input], &[1.0]).unwrap();
            });
            let of_three = life::<three::Three>(&resources, |host, outputs, input| {
                let count = host.simulation().table().len();
                let _ = product(host, fmi3GetDirectionalDerivative, [&outputs[..1], &[input]], &[1.0], count.min(1));
            });
            let all = of_two.into_iter().chain(of_three);
            all.map(|(what, taken)| (taken, format!("{name}: {what}"))).collect::<Vec<_>>()
        };
        let thread = thread::Builder::new().stack_size(2 * DEPTH + (1 << 20));
        worst.extend(thread.spawn(measure).unwrap().join().unwrap());
    }
    worst.sort_by(|a, b| b.cmp(a));
    worst.dedup_by(|a, b| a.1 == b.1);
    let report: Vec<String> = worst.iter().take(60).map(|(taken, what)| format!("{taken} {what}")).collect();
    println!("{}", report.join("\n"));
    assert!(worst[0].0 <= LIMIT, "{}", report[0]);
}
