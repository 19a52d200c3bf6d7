//! Model exchange (FMI 3.0, section 3): counts, lists and variables say the same, and its Jacobian is of differences.

use crate::both;
use crate::three::{Call, Environment, Host, Three};
use crate::two::Resources;
use brinell_fmi::fmi3::*;

/// An instance for model exchange.
fn made(resources: &Resources) -> (Instance, Box<Environment>) {
    let path = resources.directory.to_str().unwrap();
    Call { name: Some("integrated"), model_exchange: true, ..Call::good(&resources.guid, path) }.make()
}

fn list(host: &Host, count: usize, get: unsafe extern "C" fn(Instance, *mut f64, usize) -> Status) -> Vec<f64> {
    let mut values = vec![f64::NAN; count];
    // SAFETY: as long as said.
    assert_eq!(unsafe { get(host.c, values.as_mut_ptr(), count) }, Status::Ok);
    values
}

#[test]
fn states_derivatives_and_indicators_are_variables_and_the_jacobian_is_theirs() {
    let resources = both::for_both_kinds("er16k-tb1");
    let host = Host::of_parts(made(&resources), resources);
    host.start();
    let (mut flags, mut time) = ([TRUE; 5], 1.0);
    let [a, b, c, d, e] = &mut flags;
    // SAFETY: a living handle; pointers to one value each.
    unsafe {
        assert_eq!(fmi3UpdateDiscreteStates(host.c, a, b, c, d, e, &raw mut time), Status::Ok);
        assert_eq!(fmi3EnterContinuousTimeMode(host.c), Status::Ok);
    }
    assert_eq!(flags, [FALSE; 5]);
    let (mut states, mut indicators) = (0, 0);
    // SAFETY: the numbers may be written.
    unsafe {
        assert_eq!(fmi3GetNumberOfContinuousStates(host.c, &raw mut states), Status::Ok);
        assert_eq!(fmi3GetNumberOfEventIndicators(host.c, &raw mut indicators), Status::Ok);
    }
    let first = host.simulation().exchange_variables()[0].reference;
    let references = |from: usize, count: usize| (0..count).map(|i| first + (from + i) as u32).collect::<Vec<_>>();
    assert_eq!(host.get(&references(0, states)).unwrap(), list(&host, states, fmi3GetContinuousStates));
    assert_eq!(host.get(&references(states, states)).unwrap(), list(&host, states, fmi3GetContinuousStateDerivatives));
    assert_eq!(host.get(&references(2 * states, indicators)).unwrap(), list(&host, indicators, fmi3GetEventIndicators));
    // The acceleration of the shaft by its own velocity: its support's damper, and what the contacts' hand on.
    let column = host.directional([&[first + (states + 21) as u32], &[first + 21]], &[1.0], 1).unwrap();
    let here = list(&host, states, fmi3GetContinuousStates);
    let slope = |by: f64| {
        let mut moved = here.clone();
        moved[21] += by;
        // SAFETY: as long as said.
        assert_eq!(unsafe { fmi3SetContinuousStates(host.c, moved.as_ptr(), states) }, Status::Ok);
        list(&host, states, fmi3GetContinuousStateDerivatives)[21]
    };
    let difference = (slope(1e-6) - slope(-1e-6)) / 2e-6;
    // Contacts damp in proportion to their rate of approach, so that the difference has no error but rounding.
    assert!((column[0] / difference - 1.0).abs() < 1e-6, "{} and {difference}", column[0]);
}

#[test]
fn without_the_mark_of_its_kind_there_is_no_instance_for_model_exchange() {
    assert!(made(&Resources::of("er16k-tb1")).0.is_null());
}

#[test]
fn an_instance_for_co_simulation_shows_what_an_fmu_for_both_kinds_lists_under_fmi_3() {
    both::shows_the_variables_of_model_exchange_when_stepped::<Three>(|host, unknown, known| {
        host.directional([&[unknown], &[known]], &[1.0], 1).map(|values| values[0])
    });
}
