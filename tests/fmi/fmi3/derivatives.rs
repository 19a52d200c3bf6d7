//! Derivatives and dependencies under FMI 3.0.

use crate::three::{Derivative, Host, product};
use crate::two::any_host::is_real;
use crate::two::{self, bits};
use brinell::simulation::interface::table::{Causality, Kind};
use brinell_fmi::fmi3::*;

const SCENES: [&str; 4] = ["6205-hosted", "er16k-tb1", "er16k-tb1-hosted-shaft", "er16k-turning-outer"];

/// Inputs; outputs with arrays by their first reference, and the number of their values.
fn knowns_and_unknowns(host: &Host) -> (Vec<u32>, Vec<u32>, usize) {
    let table = host.table();
    let knowns = table.iter().filter(|row| row.causality == Causality::Input).map(|row| row.reference).collect();
    let is_output = |reference: &u32| table[*reference as usize].causality == Causality::Output;
    let unknowns = host.reals().0.into_iter().filter(is_output).collect();
    let count = table.iter().filter(|row| row.causality == Causality::Output && is_real(row)).count();
    (knowns, unknowns, count)
}

/// A started instance somewhere in its run, with rings that the host moves pressed in.
fn somewhere(scene: &str) -> (Host, two::Host) {
    let (host, other) = (Host::started(scene), two::Host::started(scene));
    for (name, value) in [("shaft.y", -18e-6), ("shaft.vy", 7e-4), ("housing.vx", 5e-4)] {
        if let Some(row) = host.table().iter().find(|row| row.name == name && row.causality == Causality::Input) {
            assert_eq!(host.set(&[row.reference], &[value]), Status::Ok);
            assert_eq!(other.set(&[row.reference], &[value]), Status::Ok);
        }
    }
    for n in 0..13 {
        host.step(f64::from(n) * 1e-4, 1e-4);
        assert_eq!(other.step(f64::from(n) * 1e-4, 1e-4), Status::Ok);
    }
    (host, other)
}

#[test]
fn adjoint_derivatives_are_the_transposed_product_of_directional_ones() {
    for scene in SCENES {
        let (host, _) = somewhere(scene);
        let (knowns, unknowns, count) = knowns_and_unknowns(&host);
        let seed: Vec<f64> = (0..count).map(|i| (i as f64 * 0.7).sin() + 0.1).collect();
        let adjoint = product(&host, fmi3GetAdjointDerivative, [&unknowns, &knowns], &seed, knowns.len()).unwrap();
        // wᵀ(J v) = (wᵀJ) v for a second seed as well.
        let other: Vec<f64> = (0..knowns.len()).map(|i| (i as f64 * 1.3).cos()).collect();
        let directional = host.directional([&unknowns, &knowns], &other, count).unwrap();
        let [left, right]: [f64; 2] =
            [(&seed, &directional), (&adjoint, &other)].map(|(a, b)| a.iter().zip(b).map(|(a, b)| a * b).sum());
        let size: f64 = seed.iter().zip(&directional).map(|(a, b)| (a * b).abs()).sum();
        // Roundings of a sum of some sixty products, and of changes that were added up in another order.
        assert!((left - right).abs() <= 1e-12 * size, "{scene}: {left} against {right}");
        for (k, &known) in knowns.iter().enumerate() {
            let column = host.directional([&unknowns, &[known]], &[1.0], count).unwrap();
            let sum: f64 = column.iter().zip(&seed).map(|(derivative, weight)| weight * derivative).sum();
            assert_eq!(sum.to_bits(), adjoint[k].to_bits(), "{scene}");
        }
    }
}

#[test]
fn derivatives_by_parameters_in_initialization_mode_have_the_bits_of_fmi_2_either_way() {
    for scene in ["er16k-tb1", "er16k-turning-outer"] {
        let (host, other) = (Host::initializing(scene), two::Host::initializing(scene));
        let (_, unknowns, count) = knowns_and_unknowns(&host);
        let listed: Vec<u32> = dependencies(&host, host.reference("shaft.stiffness.yy")).iter().map(|d| d.1).collect();
        let parameters = host.table().iter().filter(|row| row.causality == Causality::Parameter);
        let mut compared = 0;
        for row in parameters.filter(|row| listed.contains(&row.reference)) {
            let known = [row.reference];
            if !matches!(row.kind, Kind::Real { .. }) {
                let of = [&unknowns[..], &known];
                assert_eq!(host.directional(of, &[1.0], count), Err(Status::Discard));
                continue;
            }
            let column = host.directional([&unknowns, &known], &[1.0], count).unwrap();
            let adjoint = product(&host, fmi3GetAdjointDerivative, [&unknowns, &known], &vec![1.0; count], 1).unwrap();
            assert_eq!(adjoint[0].to_bits(), column.iter().sum::<f64>().to_bits(), "{}", row.name);
            let y = host.reference("shaft.stiffness.yy");
            let one = host.directional([&[y], &known], &[1.0], 1).unwrap();
            let two = other.directional(&[other.reference("shaft.stiffness.yy")], &known, &[1.0]).unwrap();
            assert_eq!(bits(&one), bits(&two), "{}", row.name);
            compared += 1;
        }
        assert!(compared > 3, "{scene}: {compared} compared");
    }
}

#[test]
fn derivatives_have_the_bits_of_fmi_2_and_asking_for_them_changes_nothing() {
    for scene in SCENES {
        let (host, other) = somewhere(scene);
        let (knowns, unknowns, count) = knowns_and_unknowns(&host);
        let seed = vec![0.5; knowns.len()];
        host.directional([&unknowns, &knowns], &seed, count).unwrap();
        product(&host, fmi3GetAdjointDerivative, [&unknowns, &knowns], &vec![1.0; count], knowns.len()).unwrap();
        let rates = host.by_time(&[host.reference("element.path")], 9).unwrap();
        let paths = (1..=9).map(|j| other.reference(&format!("element[{j}].path"))).collect::<Vec<_>>();
        assert_eq!(bits(&rates), bits(&other.by_time(&paths, 1).unwrap()), "{scene}");
        host.step(13.0 * 1e-4, 1e-4);
        assert_eq!(other.step(13.0 * 1e-4, 1e-4), Status::Ok);
        let y = host.reference("shaft.force.y");
        assert_eq!(bits(&host.get(&[y]).unwrap()), bits(&other.get(&[y]).unwrap()));
    }
}

#[test]
fn wrong_unknowns_knowns_orders_and_counts_of_derivatives_are_errors_with_the_reason() {
    let host = Host::started("6205-hosted");
    let state = host.save();
    let [force, speed, path, slip, time] =
        ["shaft.force.y", "shaft.speed", "element.path", "cage.slip", "time"].map(|name| [host.reference(name)]);
    for function in [fmi3GetDirectionalDerivative as Derivative, fmi3GetAdjointDerivative] {
        for (of, seed, count, word) in [
            ([&speed, &speed], &[1.0][..], 1, "it is no real output"),
            ([&force, &slip], &[1.0], 1, "no real input"),
            ([&time, &speed], &[1.0], 1, "time"),
            ([&force, &speed], &[1.0, 1.0], 1, "nSeed = 2"),
            ([&force, &speed], &[1.0], 2, "nSensitivity = 2"),
            ([&path, &speed], &[1.0], 1, "9 values"),
            ([&force, &speed], &[f64::NAN], 1, "NaN"),
        ] {
            host.lines();
            assert!(product(&host, function, of.map(|one| &one[..]), seed, count).is_err(), "{word}");
            let message = host.last_message();
            assert!(message.contains(word), "{word}: {message}");
            assert_eq!(host.restore(state), Status::Ok);
        }
    }
    // SAFETY: one reference, one order, one value.
    assert_eq!(unsafe { fmi3GetOutputDerivatives(host.c, &force[0], 1, &2, &mut 0.0, 1) }, Status::Error);
    assert!(host.last_message().contains("only order 1"));
}

/// Element of the dependent, reference and element of the independent, kind.
fn dependencies(host: &Host, reference: u32) -> Vec<(usize, u32, usize, i32)> {
    let mut count = 0;
    // SAFETY: the arrays are as long as said.
    unsafe {
        assert_eq!(fmi3GetNumberOfVariableDependencies(host.c, reference, &raw mut count), Status::Ok);
        let (mut of, mut on, mut at, mut kind) = (vec![9; count], vec![9; count], vec![9; count], vec![9; count]);
        let arrays = (of.as_mut_ptr(), on.as_mut_ptr(), at.as_mut_ptr(), kind.as_mut_ptr());
        let status = fmi3GetVariableDependencies(host.c, reference, arrays.0, arrays.1, arrays.2, arrays.3, count);
        assert_eq!(status, Status::Ok);
        (0..count).map(|i| (of[i], on[i], at[i], kind[i])).collect()
    }
}

#[test]
fn dependencies_are_those_of_every_element_before_and_after_initialization() {
    let host = Host::of("6205-hosted");
    let (path, force, speed) =
        (host.reference("element.path"), host.reference("element.force.inner"), host.reference("shaft.speed"));
    let initial = dependencies(&host, path);
    assert!(initial.contains(&(9, host.reference("bearing.internal_clearance"), 0, DEPENDENT)));
    assert_eq!(dependencies(&host, speed), []);
    host.start();
    // A state follows no input at once; a force follows the motion that is given.
    assert_eq!(dependencies(&host, path), []);
    let direct = dependencies(&host, force);
    for element in 1..=9 {
        for name in ["shaft.x", "shaft.y", "shaft.vx", "shaft.speed"] {
            assert!(direct.contains(&(element, host.reference(name), 0, DEPENDENT)), "{element} {name}");
        }
    }
    // What is not listed does not move the output.
    let inputs = host.table().iter().filter(|row| row.causality == Causality::Input);
    for input in inputs.filter(|row| direct.iter().all(|found| found.1 != row.reference)) {
        let given = host.directional([&[force], &[input.reference]], &[1.0], 9).unwrap();
        assert_eq!(given, [0.0; 9], "{}", input.name);
    }
    // SAFETY: a wrong count, with no arrays.
    let nothing = std::ptr::null_mut;
    let status = unsafe {
        fmi3GetVariableDependencies(host.c, force, nothing(), std::ptr::null_mut(), nothing(), std::ptr::null_mut(), 3)
    };
    assert_eq!(status, Status::Error);
    assert!(host.last_message().contains("nDependencies = 3"));
}
