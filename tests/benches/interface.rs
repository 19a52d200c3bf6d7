//! What the FMI interface costs: nanoseconds per call, through the compiled library as a host loads it, FMI 2.0 and 3.0
//! in turn, so that both meet the same machine.
//!
//! `cargo bench --bench interface`, with the path of another library if wanted. Each figure is the fastest of many
//! batches: what disturbs a measurement only adds. The overhead of `fmi2DoStep` is what a refused step costs (null
//! handle), and the difference between a step through the interface and the same step of `Simulation`.

// A benchmark stops at the first surprise.
#![allow(clippy::unwrap_used, missing_docs)]

use brinell::simulation::Simulation;
use brinell::simulation::interface::table::{Causality, Kind, Variable};
use brinell_tests::resources::Resources;
use host::{Instance, library_beside, three};
use std::env;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

/// Nanoseconds per call of each: the fastest of 200 batches, in turn.
fn beside<const N: usize>(count: u32, mut calls: [&mut dyn FnMut(); N]) -> [f64; N] {
    let mut fastest = [f64::INFINITY; N];
    for _ in 0..200 {
        for (best, call) in fastest.iter_mut().zip(&mut calls) {
            let start = Instant::now();
            (0..count).for_each(|_| call());
            *best = best.min(start.elapsed().as_secs_f64() * 1e9 / f64::from(count));
        }
    }
    fastest
}

fn show(what: &str, [two, three]: [f64; 2]) {
    println!("{what:44} {two:10.1} {three:10.1} ns   ratio {:.3}", three / two);
}

/// A scene for both versions.
struct Both<'a> {
    library: &'a Path,
    resources: Resources,
    simulation: Simulation,
    two: Instance,
    three: three::Instance,
}

fn started(library: &Path, resources: &Resources) -> Instance {
    let mut instance = Instance::new(library, "bench", &resources.guid, &resources.directory).unwrap();
    instance.initialize(None).unwrap();
    instance
}

impl<'a> Both<'a> {
    fn new(library: &'a Path, scene: &str) -> Self {
        println!("{scene}, law hertz");
        let resources = Resources::of(scene);
        let text = std::fs::read_to_string(resources.directory.join("scene.toml")).unwrap();
        let mut simulation = Simulation::new(brinell_scene_file::from_toml(&text).unwrap(), None).unwrap();
        simulation.initialize(0.0).unwrap();
        let two = started(library, &resources);
        let three = three::Instance::start(library, &resources.guid, &resources.directory, false).unwrap();
        Self { library, resources, simulation, two, three }
    }

    /// References of 20 variables, some of them several times.
    fn twenty(&self, wanted: impl Fn(&Variable) -> bool) -> Vec<u32> {
        let table = self.simulation.table();
        table.iter().filter(|row| wanted(row)).map(|row| row.reference).cycle().take(20).collect()
    }

    fn reading_and_setting(&mut self) {
        let arrays: Vec<Vec<u32>> = self.simulation.arrays().iter().map(|array| array.rows.clone()).collect();
        let is_scalar = |row: &Variable| arrays.iter().all(|rows| !rows.contains(&row.reference));
        let outputs = self.twenty(|row| {
            let real = row.causality == Causality::Output && matches!(row.kind, Kind::Real { .. });
            real && is_scalar(row) && !row.name.contains("stiffness")
        });
        let inputs = self.twenty(|row| row.causality == Causality::Input);
        let rows: Vec<u32> = arrays.concat();
        let firsts: Vec<u32> = arrays.iter().map(|rows| rows[0]).collect();
        let (two, three) = (&mut self.two, &mut self.three);
        let (mut values, mut others) = (vec![0.0; rows.len().max(20)], vec![0.0; rows.len().max(20)]);
        for (what, by_row, by_array, count) in [
            ("get, no variable", &outputs[..0], &outputs[..0], 0),
            ("get, 1 scalar", &outputs[..1], &outputs[..1], 1),
            ("get, 20 scalars", &outputs[..], &outputs[..], 20),
            ("get, all values of elements", &rows[..], &firsts[..], rows.len()),
        ] {
            let mut of_two = || two.reals_into(by_row, &mut values[..count]).unwrap();
            let mut of_three = || three.floats_into(by_array, &mut others[..count]).unwrap();
            show(what, beside(20_000, [&mut of_two, &mut of_three]));
        }
        let given = two.reals(&inputs).unwrap();
        for count in [1, 20] {
            let (of, given) = (&inputs[..count], &given[..count]);
            let mut of_two = || two.set_reals(of, given).unwrap();
            let mut of_three = || three.set_floats(of, given).unwrap();
            show(&format!("set, {count} inputs"), beside(20_000, [&mut of_two, &mut of_three]));
        }
    }

    /// Batches of the same steps, from a state put back.
    fn stepping(&mut self, step: f64, watched: bool) {
        let folder = &self.resources.directory;
        self.three = three::Instance::start(self.library, &self.resources.guid, folder, watched).unwrap();
        self.two = started(self.library, &self.resources);
        let (two, three) = (&mut self.two, &mut self.three);
        let (saved_two, saved_three) = (two.save(None).unwrap(), three.save().unwrap());
        let count = if step < 1e-6 { 500 } else { 20 };
        let at = |taken: &mut u32| {
            *taken += 1;
            f64::from((*taken - 1) % count) * step
        };
        let (mut of_two, mut of_three) = (0, 0);
        let mut by_two = || {
            if of_two % count == 0 {
                two.restore(saved_two).unwrap();
            }
            two.step(at(&mut of_two), step).unwrap();
        };
        let mut by_three = || {
            if of_three % count == 0 {
                three.restore(saved_three).unwrap();
            }
            three.step(at(&mut of_three), step).unwrap();
        };
        let what = if watched { "doStep with updates, of" } else { "doStep of" };
        show(&format!("{what} {step:e} s"), beside(count, [&mut by_two, &mut by_three]));
    }

    fn beyond_the_solver(&mut self) {
        let (two, simulation) = (&mut self.two, &mut self.simulation);
        let [refused] = beside(20_000, [&mut || _ = black_box(two.step_of_none())]);
        println!("doStep on a null handle     {refused:8.1} ns");
        let mut two = started(self.library, &self.resources);
        let (h, mut point) = (1e-12, 0.0);
        let mut through = || {
            two.step(point, h).unwrap();
            point += h;
        };
        let [through, direct] = beside(500, [&mut through, &mut || simulation.step(black_box(h)).unwrap()]);
        println!("doStep, Simulation::step    {through:8.1} {direct:8.1} ns, overhead {:.1} ns", through - direct);
    }

    fn saving(&mut self) {
        let two = &mut self.two;
        let state = two.save(None).unwrap();
        let [saving] = beside(20_000, [&mut || _ = black_box(two.save(Some(state)).unwrap())]);
        let [restoring] = beside(20_000, [&mut || two.restore(state).unwrap()]);
        println!("GetFMUstate, SetFMUstate    {saving:8.1} {restoring:8.1} ns");
    }

    fn living(&self) {
        let new = || Instance::new(self.library, "bench", &self.resources.guid, &self.resources.directory).unwrap();
        let mut start = || drop(black_box(started(self.library, &self.resources)));
        let [created, started] = beside(5, [&mut || drop(black_box(new())), &mut start]);
        println!("create–free, create–init–free {:8.1} {:8.1} µs", created / 1e3, started / 1e3);
    }
}

fn main() {
    let given = env::args().skip(1).find(|argument| !argument.starts_with("--"));
    let library = given.map_or_else(|| library_beside().unwrap(), |given| brinell_tests::root().join(given));
    println!("{}\n{:44} {:>10} {:>10}", library.display(), "", "FMI 2.0", "FMI 3.0");
    for scene in ["6205-healthy", "er16k-tb1"] {
        let mut both = Both::new(&library, scene);
        both.reading_and_setting();
        both.saving();
        both.living();
        both.beyond_the_solver();
        for step in [1e-12, 1e-5, 1e-3] {
            both.stepping(step, false);
        }
        both.stepping(1e-3, true);
    }
}
