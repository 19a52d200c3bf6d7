//! How an instance comes to be, and what a logger hears of it.

use crate::three::{Call, Host};
use crate::two::Resources;
use brinell_fmi::fmi3::*;
use std::ffi::CStr;
use std::ptr;

/// What the logger hears of an instantiation that fails.
fn refusal(call: Call<'_>) -> String {
    let (instance, environment) = call.make();
    assert!(instance.is_null());
    let mut lines = environment.take();
    assert_eq!(lines.len(), 1, "{lines:?}");
    let line = lines.remove(0);
    assert_eq!((line.status, line.category.as_str()), (Status::Error, "logStatusError"));
    assert!(line.message.starts_with("fmi3InstantiateCoSimulation: "), "{}", line.message);
    line.message
}

#[test]
fn the_version_is_3_0() {
    // SAFETY: a static string.
    assert_eq!(unsafe { CStr::from_ptr(fmi3GetVersion()) }, c"3.0");
}

#[test]
fn whatever_keeps_an_instance_from_being_made_is_told_though_logging_is_off() {
    let resources = Resources::of("6205-healthy");
    let path = resources.directory.to_str().unwrap();
    let refused = |edit: &dyn Fn(&mut Call<'_>), word: &str| {
        let mut call = Call::good(&resources.guid, path);
        edit(&mut call);
        let said = refusal(call);
        assert!(said.contains(word), "{said}");
    };
    refused(&|call| call.name = None, "name is NULL or blank");
    refused(&|call| call.name = Some("  "), "name is NULL or blank");
    refused(&|call| call.token = None, "instantiation token is NULL");
    refused(&|call| call.token = Some("{other}"), "{other}");
    refused(&|call| call.path = None, "resourcePath is NULL");
    refused(&|call| call.path = Some("relative/resources/"), "must be an absolute path");
    refused(&|call| call.path = Some("/no/such/folder/"), "/no/such/folder/scene.toml");
    refused(&|call| call.event_mode = true, "eventModeUsed");
    refused(&|call| call.required = &[0], "without a callback");
    refused(&|call| call.required = &[77_777], "77777");
}

#[test]
fn a_path_is_taken_with_and_without_its_separator_and_with_odd_names() {
    let resources = Resources::named("6205-healthy", "a b+c%20 Wälz");
    for end in ["", "/"] {
        let path = format!("{}{end}", resources.directory.to_str().unwrap());
        let (instance, environment) = Call::good(&resources.guid, &path).make();
        assert!(!instance.is_null(), "{:?}", environment.take());
        // SAFETY: a living instance.
        unsafe { fmi3FreeInstance(instance) };
    }
}

#[test]
fn only_inputs_and_outputs_may_be_asked_for_in_intermediate_updates() {
    let host = Host::of("6205-hosted");
    let resources = &*host.resources;
    let path = resources.directory.to_str().unwrap();
    for (name, possible) in [
        ("shaft.speed", true),
        ("shaft.force.y", true),
        ("element.path", true),
        ("shaft.mean_force.x", true),
        ("solver.steps", false),
        ("cage.slip", false),
        ("time", false),
    ] {
        let required = [host.reference(name)];
        let wanted =
            Call { required: &required, on_update: Some(Box::new(|_| None)), ..Call::good(&resources.guid, path) };
        let (instance, environment) = wanted.make();
        assert_eq!(!instance.is_null(), possible, "{name}: {:?}", environment.take());
        // SAFETY: a living instance, or NULL.
        unsafe { fmi3FreeInstance(instance) };
    }
    // An element that is not the array's first has no reference.
    let hidden = [host.simulation().reference("element[2].path").unwrap()];
    assert!(
        refusal(Call { required: &hidden, on_update: Some(Box::new(|_| None)), ..Call::good(&resources.guid, path) })
            .contains("intermediateUpdate")
    );
}

#[test]
fn the_other_kinds_of_fmu_are_refused_with_a_line() {
    let resources = Resources::of("6205-healthy");
    let (_, environment) = Call::good(&resources.guid, "/").make();
    environment.take();
    unsafe extern "C-unwind" fn hear(environment: InstanceEnvironment, _: Status, _: FmiString, text: FmiString) {
        // SAFETY: the environment is the list below, the text ends in NUL.
        unsafe { (*environment.cast::<Vec<String>>()).push(CStr::from_ptr(text).to_str().unwrap().to_owned()) }
    }
    let mut heard: Vec<String> = Vec::new();
    let (to, name, nothing) = ((&raw mut heard).cast(), c"instance 1".as_ptr(), ptr::null());
    // SAFETY: strings end in NUL or are NULL; the list outlives the calls.
    let made = unsafe {
        [
            fmi3InstantiateModelExchange(name, nothing, nothing, FALSE, FALSE, to, Some(hear)),
            fmi3InstantiateScheduledExecution(name, nothing, nothing, FALSE, FALSE, to, Some(hear), None, None, None),
            // Without a logger there is nobody to tell.
            fmi3InstantiateModelExchange(name, nothing, nothing, FALSE, FALSE, to, None),
        ]
    };
    assert_eq!(made, [ptr::null_mut(); 3]);
    assert_eq!(heard.len(), 2, "{heard:?}");
    assert!(heard.iter().all(|line| line.contains("fmi3InstantiateCoSimulation")), "{heard:?}");
}

#[test]
fn categories_are_turned_on_and_off_one_by_one() {
    let host = Host::of("6205-healthy");
    let turn = |on: Bool, names: &[&CStr]| {
        let pointers: Vec<FmiString> = names.iter().map(|name| name.as_ptr()).collect();
        // SAFETY: as many strings as said, which end in NUL.
        unsafe { fmi3SetDebugLogging(host.c, on, pointers.len(), pointers.as_ptr()) }
    };
    let error_is_heard = || {
        let state = host.save();
        host.lines();
        assert_eq!(host.set(&[99_999], &[1.0]), Status::Error);
        assert_eq!(host.restore(state), Status::Ok);
        !host.lines().is_empty()
    };
    assert!(error_is_heard());
    assert_eq!(turn(FALSE, &[c"logStatusError"]), Status::Ok);
    assert!(!error_is_heard());
    // The others are still on.
    assert_eq!(turn(TRUE, &[c"logNothing"]), Status::Warning);
    assert!(host.last_message().contains("logNothing"));
    // Of a list with one that is unknown the others are turned.
    assert_eq!(turn(TRUE, &[c"logNothing", c"logStatusError", c"logEvents"]), Status::Warning);
    assert!(error_is_heard());
    assert_eq!(turn(FALSE, &[c"logNothing", c"logStatusError"]), Status::Warning);
    assert!(!error_is_heard());
    assert_eq!(turn(TRUE, &[c"logStatusError"]), Status::Ok);
    assert!(error_is_heard());
    assert_eq!(turn(FALSE, &[]), Status::Ok);
    assert!(!error_is_heard());
    assert_eq!(host.begin(None, 0.0, None), Status::Ok);
    assert!(host.lines().is_empty(), "silent when off");
}

#[test]
fn a_number_sign_which_names_variables_in_messages_is_doubled() {
    let resources = Resources::named("6205-healthy", "no #1#");
    let missing = format!("{}/none", resources.directory.to_str().unwrap());
    assert!(refusal(Call::good(&resources.guid, &missing)).contains("no ##1##"));
}
