//! Under every contact law, with an element passing the defect: a step allocates nothing, and a state that is put back
//! continues with the same bits.
//!
//! Bits are also the same whatever the machine's instructions; kernels choose them at run time, so the rest of the
//! program is what compiler flags can change: the golden runs hold under each of them, `for cpu in x86-64 x86-64-v3
//! native; do RUSTFLAGS="-C target-cpu=$cpu" cargo test --workspace --release --test golden; done`.

#![allow(clippy::unwrap_used)]

use crate::counting;
use crate::support::{Named, shipped};
use brinell::scene::{ContactLaw, Defect, DefectShape, Scene};
use std::f64::consts::FRAC_PI_2;

const LAWS: [ContactLaw; 3] = [ContactLaw::Hertz, ContactLaw::Map, ContactLaw::Love];

/// A bearing with a short shallow spall that element 1 is about to enter.
fn passing(law: ContactLaw) -> Named {
    let mut scene: Scene = shipped("er16k-tb1");
    scene.contact.law = law;
    scene.contact.largest_force = Some(1000.0);
    let shape = DefectShape::Spall { length: 2e-4, depth: 2e-6, edge_slope: FRAC_PI_2 };
    scene.defects = vec![Defect::outer(-FRAC_PI_2, shape)];
    // The spall's half length and half a contact's.
    scene.cage.initial_angle = -FRAC_PI_2 - 3e-4 / scene.bearing.outer_raceway_radius();
    Named::started(scene)
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
            let bits = |bearing: &mut Named| OUTPUTS.map(|name| bearing.get(name).to_bits());
            assert_eq!(bits(&mut bearing), bits(&mut alone), "{law:?}");
        }
        assert!(lookups(&mut bearing) > 0, "{law:?}: no element was near the defect");
    }
}
