//! Under every contact law, with an element passing the defect: a step allocates nothing, a state that is put back
//! continues with the same bits, and neither who looks on nor who else uses the model changes any.
//!
//! Bits are also the same whatever the machine's instructions; kernels choose them at run time, so the rest of the
//! program is what compiler flags can change: the golden runs hold under each of them, `for cpu in x86-64 x86-64-v3
//! native; do RUSTFLAGS="-C target-cpu=$cpu" cargo test --workspace --release --test golden; done`.

use crate::counting;
use crate::support::defects::short_spall;
use crate::support::{Named, shipped};
use brinell::dynamics::contacts::Forces;
use brinell::dynamics::parameters::{Excitation, Model};
use brinell::scene::{ContactLaw, Defect, Scene};
use std::f64::consts::FRAC_PI_2;

const LAWS: [ContactLaw; 3] = [ContactLaw::Hertz, ContactLaw::Map, ContactLaw::Love];

/// A bearing with a short shallow spall that element 1 is about to enter.
fn passing(law: ContactLaw) -> Named {
    Named::started(passage(law))
}

fn passage(law: ContactLaw) -> Scene {
    let mut scene: Scene = shipped("er16k-tb1");
    scene.contact.law = law;
    scene.contact.largest_force = Some(1000.0);
    scene.defects = vec![Defect::outer(-FRAC_PI_2, short_spall())];
    // The spall's half length and half a contact's.
    scene.cage.initial_angle = -FRAC_PI_2 - 3e-4 / scene.bearing.outer_raceway_radius();
    scene
}

const OUTPUTS: [&str; 5] = ["shaft.y", "housing.ay", "element[1].path", "element[1].force.outer", "cage.angle"];

fn lookups(bearing: &mut Named) -> i32 {
    ["solver.map_lookups", "solver.contact_solves"].map(|name| bearing.count(name)).iter().sum()
}

#[test]
fn a_step_past_the_defect_allocates_nothing() {
    for law in LAWS {
        let mut bearing = passing(law);
        // Workspaces of the grid grow to their largest at the first contacts.
        bearing.run(2e-5, 10);
        let looked_up = lookups(&mut bearing);
        let (result, allocations) = counting::counted(|| (0..10).try_for_each(|_| bearing.0.step(2e-5)));
        result.unwrap();
        assert_eq!(allocations, 0, "{law:?}");
        assert!(lookups(&mut bearing) > looked_up, "{law:?}: no element was near the defect");
    }
}

#[test]
fn a_state_taken_and_put_back_a_hundred_times_changes_no_bit() {
    for law in LAWS {
        let (mut bearing, mut alone) = (passing(law), passing(law));
        for _ in 0..100 {
            let state = bearing.0.save();
            bearing.run(3.7e-6, 1);
            bearing.0.restore(&state).unwrap();
            bearing.run(3.7e-6, 1);
            alone.run(3.7e-6, 1);
            assert_eq!(bearing.bits(OUTPUTS), alone.bits(OUTPUTS), "{law:?}");
        }
        assert!(lookups(&mut bearing) > 0, "{law:?}: no element was near the defect");
    }
}

#[test]
fn a_run_that_is_read_has_the_bits_and_the_counts_of_one_that_is_not() {
    for law in LAWS {
        let (mut read, mut alone) = (passing(law), passing(law));
        let names = ["shaft.speed", "housing.ay", "shaft.stiffness.yy", "element[1].force.outer"];
        let [speed, outputs @ ..] = names.map(|name| read.0.reference(name).unwrap());
        for n in 0..20 {
            let mut values = [0.0; 3];
            read.0.reals(&outputs, &mut values).unwrap();
            // A step begins with the right-hand side that was evaluated for the outputs, unless inputs go on otherwise.
            if n % 3 == 1 {
                for bearing in [&mut read, &mut alone] {
                    bearing.0.set_input_derivatives(&[speed], &[1], &[1e3]).unwrap();
                }
            }
            if n % 2 == 1 {
                read.0.directional_derivative(&outputs, &[speed], &[1.0], &mut values).unwrap();
                read.0.output_derivatives(&outputs, &[1; 3], &mut values).unwrap();
            }
            if n % 5 == 1 {
                read.0.reals(&outputs, &mut values).unwrap();
            }
            read.run(2e-5, 1);
            alone.run(2e-5, 1);
            assert!(read.0.save() == alone.0.save(), "{law:?} after step {n}");
        }
        assert!(lookups(&mut read) > 0, "{law:?}: no element was near the defect");
    }
}

#[test]
fn at_a_loose_tolerance_steps_pass_contact_changes_and_accelerations_err_by_ten_times_the_tolerance_at_most() {
    let run = |tolerance: f64| {
        let mut bearing = Named::started(Scene { tolerance, ..passage(ContactLaw::Hertz) });
        (bearing.course(["housing.ay"], 2e-5, 200), bearing.count("solver.rejected_steps"))
    };
    let (exact, _) = run(1e-9);
    let [(landing, many), (passing, few)] = [0.999e-3, 1e-3].map(run);
    // Most steps that are rejected end on a change then.
    assert!(2 * few < many, "{few} steps rejected of {many}");
    let rms = |of: &dyn Fn(usize) -> f64| (0..exact.len()).map(|i| of(i) * of(i)).sum::<f64>().sqrt();
    for found in [landing, passing] {
        let error = rms(&|i| found[i][0] - exact[i][0]) / rms(&|i| exact[i][0]);
        assert!(error < 1e-2, "{error:e}");
    }
}

#[test]
fn a_step_that_is_inspected_has_the_bits_of_one_that_is_not() {
    for law in LAWS {
        let (mut watched, mut alone) = (passing(law), passing(law));
        let mut inspections = 0;
        for n in 0..20 {
            let mut under_way = watched.0.begin_step(2e-5).unwrap();
            while !under_way.is_done() {
                watched.0.advance_once(&mut under_way).unwrap();
                let inspection = watched.0.inspect(&under_way);
                watched.bits(OUTPUTS);
                watched.0.resume(&mut under_way, inspection).unwrap();
                inspections += 1;
            }
            watched.0.end_step(under_way);
            alone.run(2e-5, 1);
            assert_eq!(watched.bits(OUTPUTS), alone.bits(OUTPUTS), "{law:?} after step {n}");
        }
        assert!(inspections > 40 && lookups(&mut watched) > 0, "{law:?}: {inspections} inspections");
    }
}

/// Derivatives of one state along the way over the spall, beginning after so many turns of an uneven cage, and how many
/// contacts near it were asked for.
fn derivatives(model: &Model, excitation: &Excitation, turns: i64, state: &[f64]) -> (Vec<u64>, u64) {
    let excitation = Excitation { cage_turns: turns, ..*excitation };
    let (mut forces, mut derivative) = (Forces::of(model), vec![0.0; state.len()]);
    let bits = (0..60).flat_map(|n| {
        let tau = 1e-5 * f64::from(n);
        let cells = model.cells_at(&excitation, tau, state);
        model.derivative(&excitation, tau, &cells, state, &mut derivative, &mut forces);
        derivative.iter().map(|value| value.to_bits()).collect::<Vec<_>>()
    });
    (bits.collect(), forces.defect_lookups)
}

#[test]
fn a_model_that_threads_share_gives_each_the_bits_it_would_have_alone() {
    for law in LAWS {
        let mut scene = passage(law);
        scene.cage.irregularity = shipped("6205-irregular-cage").cage.irregularity;
        let bearing = Named::started(scene);
        let ((model, excitation), state) = (bearing.0.equations(), bearing.0.state_vector());
        let alone = [0, 1000].map(|turns| derivatives(model, &excitation, turns, state));
        assert!(alone[0].1 + alone[1].1 > 20, "{law:?}: no element was near the defect");
        assert_ne!(alone[0].0, alone[1].0, "{law:?}: turns that make no difference");
        let together = std::thread::scope(|threads| {
            let start = |turns| threads.spawn(move || derivatives(model, &excitation, turns, state));
            [0, 1000].map(start).map(|thread| thread.join().unwrap())
        });
        assert!(together == alone, "{law:?}");
    }
}
