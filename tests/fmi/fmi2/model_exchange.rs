//! Model exchange (FMI 2.0, chapter 3): its functions in their order, out of it, and what they give.

use crate::both::{self, probes, refuse};
use crate::two::{Call, Host, Log, Resources, Two};
use brinell_fmi::fmi2::*;
use std::ptr;
use std::sync::Arc;

fn made(resources: &Resources) -> (Component, Box<Log>) {
    let (guid, location) = (&resources.guid, resources.uri());
    Call { fmu_type: MODEL_EXCHANGE, logging: true, ..Call::good("integrated", guid, &location) }.make()
}

/// An instance in event mode.
fn started(scene: &str) -> Host {
    let resources = both::for_both_kinds(scene);
    let host = Host::of_parts(made(&resources), resources);
    host.start();
    host
}

fn list(host: &Host, count: usize, get: unsafe extern "C" fn(Component, *mut Real, usize) -> Status) -> Vec<f64> {
    let mut values = vec![f64::NAN; count];
    // SAFETY: as long as said.
    assert_eq!(unsafe { get(host.c, values.as_mut_ptr(), count) }, Status::Ok, "{:?}", host.lines());
    values
}

/// Six states of one element each, two of both rings and their velocities, the sensor, the cage's angle: of er16k-tb1.
const STATES: usize = 2 * 9 + 2 * 4 + 2 + 1;
/// Onsets of both contacts of nine elements, and nine contacts with the raceway that has the defect.
const INDICATORS: usize = 2 * 9 + 9;

#[test]
fn an_fmu_for_model_exchange_goes_from_event_mode_to_continuous_time_and_back() {
    let host = started("er16k-tb1");
    let info = EventInfo {
        new_discrete_states_needed: TRUE,
        terminate_simulation: TRUE,
        nominals_of_continuous_states_changed: TRUE,
        values_of_continuous_states_changed: TRUE,
        next_event_time_defined: TRUE,
        next_event_time: 1.0,
    };
    let mut found = info;
    // SAFETY of this and what follows: any handle may be passed; pointers are to what they say.
    assert_eq!(unsafe { fmi2NewDiscreteStates(host.c, &raw mut found) }, Status::Ok, "{:?}", host.lines());
    assert_eq!(
        [found.new_discrete_states_needed, found.terminate_simulation, found.next_event_time_defined],
        [FALSE; 3]
    );
    assert_eq!(unsafe { fmi2EnterContinuousTimeMode(host.c) }, Status::Ok);
    let states = list(&host, STATES, fmi2GetContinuousStates);
    assert!(states.iter().any(|state| *state != 0.0));
    assert!(list(&host, STATES, fmi2GetNominalsOfContinuousStates).iter().all(|nominal| *nominal > 0.0));
    let indicators = list(&host, INDICATORS, fmi2GetEventIndicators);
    assert!(indicators[18..].iter().all(|left| *left > 0.0), "{indicators:?}");
    // At rest in equilibrium the rings stay, and the cage turns by 3.8 turns a second.
    let slopes = list(&host, STATES, fmi2GetDerivatives);
    assert!(slopes[STATES - 1] > 20.0 && slopes[18].abs() < 1e-9, "{slopes:?}");
    let moved: Vec<f64> = states.iter().zip(&slopes).map(|(state, slope)| state + 1e-6 * slope).collect();
    assert_eq!(unsafe { fmi2SetTime(host.c, 1e-6) }, Status::Ok);
    assert_eq!(unsafe { fmi2SetContinuousStates(host.c, moved.as_ptr(), STATES) }, Status::Ok);
    assert_eq!(list(&host, STATES, fmi2GetContinuousStates)[..STATES - 1], moved[..STATES - 1]);
    let (mut event, mut end) = (TRUE, TRUE);
    assert_eq!(unsafe { fmi2CompletedIntegratorStep(host.c, TRUE, &raw mut event, &raw mut end) }, Status::Ok);
    assert_eq!([event, end], [FALSE; 2]);
    assert_eq!(unsafe { fmi2EnterEventMode(host.c) }, Status::Ok);
    assert_eq!(host.terminate(), Status::Ok);
}

#[test]
fn functions_of_the_other_kind_and_out_of_their_mode_are_errors() {
    let wrong = probes! {
        fmi2DoStep "" (0.0, 1e-5, TRUE);
        fmi2SetContinuousStates "" ([0.0; STATES].as_ptr(), STATES);
        fmi2CompletedIntegratorStep "" (TRUE, ptr::null_mut(), ptr::null_mut());
        fmi2GetDerivatives "" ([0.0; 3].as_mut_ptr(), 3);
    };
    for probe in wrong {
        refuse(&started("er16k-tb1"), &[probe]);
    }
}

#[test]
fn an_fmu_that_is_not_for_model_exchange_says_how_to_build_one() {
    let (c, log) = made(&Resources::of("er16k-tb1"));
    assert!(c.is_null());
    assert!(log.take().last().unwrap().message.contains("--kind both"));
}

#[test]
fn a_state_no_contact_law_has_an_answer_for_is_discarded_and_the_instance_goes_on() {
    let host = started("er16k-tb1");
    // SAFETY: any handle may be passed; the list is as long as said.
    unsafe {
        assert_eq!(fmi2EnterContinuousTimeMode(host.c), Status::Ok);
        let states = list(&host, STATES, fmi2GetContinuousStates);
        let mut wild = states.clone();
        wild[0] = f64::NAN;
        assert_eq!(fmi2SetContinuousStates(host.c, wild.as_ptr(), STATES), Status::Discard);
        assert_eq!(list(&host, STATES, fmi2GetContinuousStates), states);
    }
}

#[test]
fn a_state_saved_under_one_kind_is_refused_under_the_other() {
    let integrated = started("er16k-tb1");
    let state = integrated.save();
    assert_eq!(integrated.restore(state), Status::Ok);
    // Derivatives are the same after it, to the bit.
    let before = list(&integrated, STATES, fmi2GetDerivatives);
    assert_eq!(integrated.restore(state), Status::Ok);
    assert_eq!(list(&integrated, STATES, fmi2GetDerivatives), before);
    let bytes = integrated.serialize(state);
    let stepped = Host::with(Arc::clone(&integrated.resources), "stepped", true);
    let elsewhere = stepped.deserialize(&bytes).unwrap();
    assert_eq!(stepped.restore(elsewhere), Status::Error);
    assert!(stepped.lines().pop().unwrap().message.contains("other kind"));
}

#[test]
fn an_instance_for_co_simulation_shows_what_an_fmu_for_both_kinds_lists() {
    both::shows_the_variables_of_model_exchange_when_stepped::<Two>(|host, unknown, known| {
        host.directional(&[unknown], &[known], &[1.0]).map(|values| values[0])
    });
}

#[test]
fn nominals_may_be_read_before_initialization_and_states_set_one_by_one() {
    let resources = both::for_both_kinds("er16k-tb1");
    let host = Host::of_parts(made(&resources), resources);
    assert!(list(&host, STATES, fmi2GetNominalsOfContinuousStates).iter().all(|nominal| *nominal > 0.0));
    host.start();
    let first = host.simulation().exchange_variables()[0].reference;
    let state = host.save();
    // Of the modes of a run only that between events lets states be set.
    host.refuses(state, &["fmi2SetReal"], |host| host.set(&[first], &[1e-6]));
    // SAFETY: any handle may be passed.
    assert_eq!(unsafe { fmi2EnterContinuousTimeMode(host.c) }, Status::Ok);
    let before = list(&host, STATES, fmi2GetContinuousStates);
    let speed = host.reference("shaft.speed");
    assert_eq!(host.set(&[first + 1, speed, first], &[3e-6, 100.0, 2e-6]), Status::Ok, "{:?}", host.lines());
    let after = list(&host, STATES, fmi2GetContinuousStates);
    assert_eq!((after[0], after[1], &after[2..]), (2e-6, 3e-6, &before[2..]));
    assert_eq!(host.get(&[speed]), Ok(vec![100.0]));
    // All or none.
    assert_eq!(host.set(&[first, speed], &[4e-6, f64::NAN]), Status::Discard);
    assert_eq!(host.set(&[speed, first], &[90.0, f64::NAN]), Status::Discard);
    assert_eq!(list(&host, STATES, fmi2GetContinuousStates), after);
    assert_eq!(host.get(&[speed]), Ok(vec![100.0]));
}

#[test]
fn an_integrator_may_try_times_past_the_stop_time_and_take_no_step_there() {
    let resources = both::for_both_kinds("er16k-tb1");
    let host = Host::of_parts(made(&resources), resources);
    host.start_at(0.0, Some(0.02));
    // SAFETY: any handle may be passed.
    assert_eq!(unsafe { fmi2EnterContinuousTimeMode(host.c) }, Status::Ok);
    let state = host.save();
    let (mut event, mut end) = (TRUE, TRUE);
    // SAFETY: as above; pointers to one value each.
    let mut take = |host: &Host, time: f64| unsafe {
        assert_eq!(fmi2SetTime(host.c, time), Status::Ok);
        fmi2CompletedIntegratorStep(host.c, TRUE, &raw mut event, &raw mut end)
    };
    // As a host's sum of steps rounds.
    assert_eq!(take(&host, 0.02 * (1.0 + 1e-12)), Status::Ok);
    host.refuses(state, &["past the stop time 0.02"], |host| take(host, 0.0200001));
}

#[test]
fn indicators_are_finite_and_of_order_one_also_of_waves_that_have_no_ends() {
    let waves = "\n[[waviness]]\non = \"element\"\nelement = 1\norder = 5\namplitude_um = 0.2\nangle_deg = 0.0\n";
    let edited = |text: String| text + waves;
    let resources = Resources::edited("6205-healthy", "resources", edited);
    std::fs::write(resources.directory.join("interface"), "model-exchange").unwrap();
    let host = Host::of_parts(made(&resources), resources.into());
    host.start();
    let count = host.simulation().event_indicator_count();
    let indicators = list(&host, count, fmi2GetEventIndicators);
    assert!(count > 2 * host.simulation().scene().bearing.element_count);
    assert!(indicators.iter().all(|value| value.abs() < 1e3), "{indicators:?}");
    assert!(indicators.iter().any(|value| *value > 0.5), "{indicators:?}");
}
