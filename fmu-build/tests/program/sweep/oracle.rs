//! Columns of sweeps over random bearings whose rings both turn, against the oracle's own kinematics.

use super::*;
use brinell_oracle::Bearing;
use brinell_oracle::case::{Case, Grooves, Motion, Ring};
use brinell_oracle::draw::{Draw, for_seeds};
use std::f64::consts::PI;

/// A bearing whose rings both move under loads of their own; how they turn is the sweep's.
fn random(draw: &mut Draw) -> Case {
    let (count, diameter_mm) = (6 + draw.below(10), draw.log(4.0, 20.0));
    let [load, housing_load] = [(); 2].map(|()| {
        let size = draw.log(100.0, 1000.0);
        draw.vector(size)
    });
    let shaft = Ring { motion: Motion::Internal, load, mass: 1.0, damping: 1e3, stiffness: 0.0 };
    let chord = diameter_mm / (PI / count as f64).sin();
    Case {
        count,
        diameter_mm,
        pitch_mm: chord * draw.between(1.1, 1.6),
        grooves: Grooves::Each(0.515, 0.53),
        clearance_um: draw.between(0.0, 30.0),
        rings: [shaft, Ring { load: housing_load, mass: 5.0, stiffness: 1e8, ..shaft }],
        housing_hz: Some(0.0),
        sensor: Some([0.05, 1e8, 50.0]),
        ..Case::at_rest()
    }
}

#[test]
fn random_bearings_with_turning_rings_are_passed_and_loaded_as_the_oracle_says() {
    for_seeds(2, |seed, draw| {
        let case = random(draw);
        let folder = common::folder(&format!("sweep-oracle-{seed}"));
        fs::write(folder.join("case.toml"), case.toml()).unwrap();
        let (runs, out) = (6, folder.join("out"));
        let text = format!(
            "scene = \"case.toml\"\nruns = {runs}\nseed = {seed}\nstop_s = 0.004\nsettle_s = 0.001\nrate_hz = 25600\n\
             [random]\nshaft.speed_hz = [-40, 40]\nhousing.speed_hz = [-40, 40]\ncage.slip = [0, 0.3]\n"
        );
        let told = sweep(&file(&folder, &text), &out, &[]);
        if !told.contains(" 0 failed") {
            return Err(told);
        }
        let names = ["shaft.speed_hz", "housing.speed_hz", "cage.slip", "bpfo_hz", "label_load_n"];
        let [shaft, housing, slip, bpfo, load] = names.map(|name| all(&out, name));
        for i in 0..runs {
            let turning = Case { speed_hz: shaft[i], housing_hz: Some(housing[i]), slip: slip[i], ..case.clone() };
            let [expected, ..] = Bearing::smooth(&turning).frequencies();
            // Roundings of speeds of up to 40 Hz, times the number of elements.
            if !((bpfo[i] - expected).abs() <= 1e-10) {
                return Err(format!("row {i}: BPFO {} Hz, the oracle says {expected} Hz", bpfo[i]));
            }
            // No spring shares the shaft's load with the bearing, and what pulls at the housing goes into its own.
            let expected = case.rings[0].load[0].hypot(case.rings[0].load[1]);
            if !((load[i] / expected - 1.0).abs() <= 1e-11) {
                return Err(format!("row {i}: load {} N, the bearing carries {expected} N", load[i]));
            }
        }
        Ok(())
    });
}
