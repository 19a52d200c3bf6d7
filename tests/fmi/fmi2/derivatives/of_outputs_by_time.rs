//! Derivatives of outputs by time are what a host finds by short steps.

use super::by_inputs::{SCENES, inputs, outputs, references};
use crate::two::Host;
use brinell::simulation::interface::table::{Kind, Unit, Variability};
use brinell_fmi::fmi2::*;
use std::ptr;

#[test]
fn derivatives_of_outputs_by_time_are_what_short_steps_show() {
    for scene in SCENES {
        let host = Host::pressed(scene);
        let table = host.table();
        // What belongs to a communication step has no derivative.
        let outputs: Vec<_> = outputs(table).into_iter().filter(|v| v.variability == Variability::Continuous).collect();
        let unknowns = references(&outputs);
        let mut time = 0.0;
        for point in 0..8 {
            let step = 1.3e-3 + 1e-5 * f64::from(point);
            assert_eq!(host.step(time, step), Status::Ok);
            time += step;
            host.press();
            for input in inputs(table) {
                match input.name.as_str() {
                    "shaft.speed" => assert_eq!(host.rate(input.reference, 1, 40.0), Status::Ok),
                    name if name.contains("load") => assert_eq!(host.rate(input.reference, 1, 1e3), Status::Ok),
                    // In place of 0.3 m/s²: damping makes 10 N/s and more of it.
                    "shaft.vx" => assert_eq!(host.rate(input.reference, 1, 0.8), Status::Ok),
                    _ => {}
                }
            }
            let given = host.by_time(&unknowns, 1).unwrap();
            let before = host.get(&unknowns).unwrap();
            let state = host.save();
            let after = |h: f64| {
                assert_eq!(host.restore(state), Status::Ok);
                assert_eq!(host.step(time, h), Status::Ok);
                host.get(&unknowns).unwrap()
            };
            // Forward differences, extrapolated to no step at all.
            let h = 2e-9;
            let (near, far, farther) = (after(h), after(2.0 * h), after(3.0 * h));
            assert_eq!(host.restore(state), Status::Ok);
            for (i, output) in outputs.iter().enumerate() {
                let found = if output.name == "cage.torque" {
                    // It leaps where a derivative of the speed begins to act, with the step.
                    (8.0 * far[i] - 5.0 * near[i] - 3.0 * farther[i]) / (2.0 * h)
                } else {
                    (4.0 * near[i] - far[i] - 3.0 * before[i]) / (2.0 * h)
                };
                let Kind::Real { nominal, unit, .. } = output.kind else { panic!() };
                // The third derivative of a mode at 50 kHz over these steps; rounding, of which the sensor's spring of
                // 9e9 N/m makes 1e-10 m/s² from positions of 10 µm.
                let rounding = if unit == Unit::MetrePerSecondSquared { 1e-10 } else { 1e-12 };
                let tolerance = 1e-4 * given[i].abs() + rounding * before[i].abs().max(nominal) / h;
                assert!(
                    (given[i] - found).abs() <= tolerance,
                    "{scene} at {time}: {} changes by {} /s, found {found}, allowed {tolerance:e}",
                    output.name,
                    given[i]
                );
            }
        }
    }
}

#[test]
fn derivatives_by_time_of_another_order_or_variable_are_errors() {
    let host = Host::started("er16k-tb1");
    let state = host.save();
    let force = host.reference("shaft.force.y");
    for (reference, order, words) in [
        (force, 0, "order 0"),
        (force, 2, "order 2"),
        (force, -1, "order -1"),
        (host.reference("shaft.speed"), 1, "no real output"),
        (host.reference("solver.steps"), 1, "no real output"),
        (u32::MAX, 1, "unknown"),
    ] {
        host.lines();
        let expected = if words == "no real output" { Status::Discard } else { Status::Error };
        assert_eq!(host.by_time(&[reference], order), Err(expected), "{words}");
        assert!(host.lines()[0].message.contains(words), "{words}");
        assert_eq!(host.restore(state), Status::Ok);
    }
    // SAFETY: NULL goes with no variables.
    let status = unsafe { fmi2GetRealOutputDerivatives(host.c, ptr::null(), 0, ptr::null(), ptr::null_mut()) };
    assert_eq!(status, Status::Ok);
}
