//! Communication steps of every length, and a long run.

use crate::row::Row;
use crate::scenes::Kind;
use crate::support::Named;
use brinell::geometry::kinematics::Ratios;
use std::f64::consts::TAU;

pub fn communication_steps(kind: Kind) -> Row {
    let end = |steps: &[f64], stop: f64, load_factor: f64| {
        let mut scene = kind.spalled();
        scene.tolerance = 1e-10;
        scene.shaft.load[1] *= load_factor;
        let mut bearing = Named::started(scene);
        let mut time = 0.0;
        for &step in steps.iter().cycle() {
            let step = f64::min(step, stop - time);
            if step < 1e-13 {
                break;
            }
            bearing.run(step, 1);
            time += step;
        }
        // Over the load of 500 N, and what it does to the housing's spring.
        let found = [
            bearing.get("shaft.force.y") / 500.0,
            bearing.get("element[9].force.outer") / 500.0,
            bearing.get("housing.y") / (500.0 / 1.5e7),
        ];
        (found, bearing)
    };
    let differ = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).fold(0.0f64, |worst, (a, b)| worst.max((a - b).abs()));
    const SPLITS: [&[f64]; 2] = [&[1e-3], &[3.3e-5, 1.7e-3, 2e-6, 1.1e-2]];
    let short = differ(end(&[3e-4], 3e-4, 1.0).0, end(&[1e-7], 3e-4, 1.0).0);
    let (entry, _) = end(&[9e-3], 9e-3, 1.0);
    let entry = SPLITS.iter().fold(0.0f64, |worst, steps| worst.max(differ(entry, end(steps, 9e-3, 1.0).0)));
    // Errors of a thousand steps at 1e-10 add up, through the entry of one element into the spall.
    assert!(short < 1e-10 && entry < 1e-7, "{short} {entry}");
    // Elements that hang loose between the rings bounce, and small differences grow with every bounce: after four
    // passages the bearing answers to a change of the load in its twelfth digit as it does to another splitting of
    // time.
    let (whole, bearing) = end(&[0.1], 0.1, 1.0);
    // One change of the load may by chance grow little; of several the largest counts.
    let changes = [1e-12, -1e-12, 2e-12, -2e-12, 3e-12];
    let sensitivity = changes.iter().fold(0.0f64, |worst, by| worst.max(differ(whole, end(&[0.1], 0.1, 1.0 + by).0)));
    let long = SPLITS.iter().fold(0.0f64, |worst, steps| worst.max(differ(whole, end(steps, 0.1, 1.0).0)));
    assert!(long < 10.0 * sensitivity && long < 2e-2, "{long} {sensitivity}");
    Row::new(
        "communication steps 1e-7, 1e-3, 0.1 s and irregular, tolerance 1e-10",
        format!("equal forces; after 0.1 s as equal as with a load changed by 1e-12, which is {sensitivity:.0e} of it"),
        format!("differ by {short:.0e} of the load after 0.3 ms, {entry:.0e} after 9 ms, {long:.0e} after 0.1 s"),
        &bearing,
    )
}

pub fn one_minute(kind: Kind) -> Row {
    let mut scene = kind.hosted();
    scene.bearing.element_count = 3;
    scene.shaft_speed = 25.0 * TAU;
    let omega = scene.shaft_speed * Ratios::new(&scene.bearing, 0.0, 0.0).cage[0];
    let mut bearing = Named::started_with(scene, &[("shaft.y", -2e-5)]);
    let start = bearing.get("cage.angle");
    let force = |b: &mut Named| (1..=3).map(|j| b.get(&format!("element[{j}].force.outer"))).fold(0.0, f64::max);
    // The cage turns by one spacing in this time, after which all repeats.
    let period = TAU / 3.0 / omega;
    bearing.run(period, 1);
    let first = force(&mut bearing);
    let count = (60.0 / period) as usize;
    bearing.run(period, count - 1);
    let (angle, last) = (bearing.get("cage.angle") - start, force(&mut bearing));
    let turned = count as f64 * TAU / 3.0;
    // Rounding of each advance, 2e-16 of half a turn, adds up over 1800.
    assert!((angle - turned).abs() < 1e-11, "{angle} {turned}");
    assert!((last - first).abs() < 1e-4 * first, "{last} {first}");
    Row::new(
        "a minute of simulated time at 25 Hz, 3 elements",
        format!("cage {turned:.6} rad; largest element force {first:.4} N as in the first period"),
        format!("{angle:.6} rad; {last:.4} N"),
        &bearing,
    )
    .within((last - first).abs() / first, 1e-4)
}
