//! Instances: what makes one, what is refused, and handles.

use crate::two::{Call, FORBIDDEN_CALLS, Host, Line, Resources, bits};
use brinell::scene::model_file;
use brinell_fmi::fmi2::*;
use std::ffi::c_void;
use std::{fs, ptr};

fn good<'a>(guid: &'a str, location: &'a str) -> Call<'a> {
    Call::good("instance 1", guid, location)
}

/// The one line that goes with NULL.
fn refusal(call: &Call<'_>) -> Line {
    let (component, log) = call.make();
    assert!(component.is_null());
    let mut lines = log.take();
    assert_eq!(lines.len(), 1, "{lines:?}");
    let line = lines.remove(0);
    assert_eq!((line.status, line.category.as_str(), line.format.as_str()), (Status::Error, "logStatusError", "%s"));
    line
}

#[test]
fn a_wrong_guid_gives_null_and_a_line_with_both_guids() {
    let resources = Resources::of("er16k-tb1");
    let location = resources.uri();
    let line = refusal(&good("{00000000-0000-0000-0000-000000000000}", &location));
    assert!(line.message.contains("{00000000-") && line.message.contains(&resources.guid), "{}", line.message);
    assert_eq!(line.instance, "instance 1");
}

#[test]
fn a_guid_belongs_to_the_contents_of_the_resources() {
    let resources = Resources::of("er16k-tb1");
    let text = fs::read_to_string(resources.directory.join("scene.toml")).unwrap().replace("500.0", "501.0");
    fs::write(resources.directory.join("scene.toml"), &text).unwrap();
    let location = resources.uri();
    let message = refusal(&good(&resources.guid, &location)).message;
    for part in ["model.bin", "edited", "build the FMU anew"] {
        assert!(message.contains(part), "{part}: {message}");
    }
    let scene = brinell_scene_file::from_toml(&text).unwrap();
    fs::write(resources.directory.join("model.bin"), model_file::encode(&scene, &text).unwrap()).unwrap();
    assert!(refusal(&good(&resources.guid, &location)).message.contains("GUID"));
}

#[test]
fn null_arguments_give_null_and_a_line_that_names_them() {
    let resources = Resources::of("er16k-tb1");
    let (guid, location) = (&resources.guid, resources.uri());
    let call = || good(guid, &location);
    for (call, word) in [
        (Call { name: None, ..call() }, "name"),
        (Call { name: Some(" \t"), ..call() }, "name"),
        (Call { guid: None, ..call() }, "GUID"),
        (Call { location: None, ..call() }, "resource location"),
        (Call { fmu_type: 0, ..call() }, "co-simulation"),
        (Call { fmu_type: -7, ..call() }, "co-simulation"),
    ] {
        assert!(refusal(&call).message.contains(word), "{word}");
    }
}

#[test]
fn missing_callbacks_give_null() {
    let resources = Resources::of("er16k-tb1");
    let location = resources.uri();
    let (component, log) = Call { logger: None, ..good(&resources.guid, &location) }.make();
    assert!(component.is_null() && log.take().is_empty());
    // SAFETY: NULL callbacks are what is tested; the strings end in NUL.
    let component = unsafe {
        fmi2Instantiate(c"a".as_ptr(), CO_SIMULATION, c"b".as_ptr(), c"c".as_ptr(), ptr::null(), FALSE, TRUE)
    };
    assert!(component.is_null());
}

#[test]
fn unreadable_resources_give_null_and_a_line_with_the_path() {
    let resources = Resources::of("er16k-tb1");
    let location = format!("{}/elsewhere", resources.uri());
    assert!(refusal(&good(&resources.guid, &location)).message.contains("elsewhere"));

    let location = resources.uri();
    let path = resources.directory.join("model.bin");
    let sound = fs::read(&path).unwrap();
    let with = |at: usize, byte: u8| [&sound[..at], &[byte], &sound[at + 1..]].concat();
    let middle = sound.len() / 2;
    for (bytes, word) in [
        (sound[..7].to_vec(), "no model file"),
        (with(0, b'b'), "no model file"),
        (with(8, 99), "layout 99"),
        (with(middle, !sound[middle]), "damaged"),
        (sound[..sound.len() - 1].to_vec(), "damaged"),
    ] {
        fs::write(&path, bytes).unwrap();
        let message = refusal(&good(&resources.guid, &location)).message;
        assert!(message.contains("model.bin") && message.contains(word), "{word}: {message}");
    }
    fs::remove_file(&path).unwrap();
    assert!(refusal(&good(&resources.guid, &location)).message.contains("model.bin"));

    fs::write(resources.directory.join("scene.toml"), [0xff, 0xfe]).unwrap();
    assert!(refusal(&good(&resources.guid, &location)).message.contains("scene.toml"));

    assert!(refusal(&good(&resources.guid, "http://example.org/resources")).message.contains("file URI"));
}

#[test]
fn a_missing_profile_gives_null_and_a_line_with_its_name() {
    let resources = Resources::of("6205-epps");
    fs::remove_file(resources.directory.join("6205-epps-trace.csv")).unwrap();
    let location = resources.uri();
    assert!(refusal(&good(&resources.guid, &location)).message.contains("6205-epps-trace.csv"));
}

#[test]
fn resources_are_found_under_every_form_of_file_uri_and_odd_names() {
    for name in ["plain", "a b", "a+b", "über ñ 轴承", "100% [x]", "semi;colon&co"] {
        let resources = Resources::named("6205-epps", name);
        let escaped = resources.uri();
        let path = resources.directory.to_str().unwrap();
        let forms = [
            escaped.clone(),
            escaped.replace("file://", "file:"),
            escaped.replace("file://", "file://localhost"),
            format!("{escaped}/"),
            format!("file://{path}"),
        ];
        for location in &forms {
            let (component, log) = good(&resources.guid, location).make();
            assert!(!component.is_null(), "{location}: {:?}", log.take());
            // SAFETY: any handle may be passed.
            unsafe { fmi2FreeInstance(component) };
        }
    }
}

#[test]
fn null_dead_and_invented_handles_are_errors_not_crashes() {
    let mut host = Host::of("er16k-tb1");
    let dead = host.c;
    // SAFETY: any handle may be passed.
    unsafe { fmi2FreeInstance(dead) };
    let mut invented: Vec<Component> = vec![ptr::null_mut(), dead, ptr::from_mut(&mut host).cast::<c_void>()];
    // Handles are slots and generations; a slot near by may be that of an instance of another thread's test.
    let far_slot = dead.addr() ^ (1 << 19);
    invented.extend([1, 8, 24, usize::MAX, far_slot, dead.addr() | 1, 1 << 40].map(ptr::without_provenance_mut));
    for c in invented {
        host.c = c;
        assert_eq!(host.step(0.0, 1e-3), Status::Error);
        assert_eq!(host.get(&[0]), Err(Status::Error));
        // SAFETY: any handle may be passed.
        unsafe { fmi2FreeInstance(c) };
    }
}

#[test]
fn a_freed_handle_does_not_lead_to_the_next_instance() {
    let first = Host::of("er16k-tb1");
    // SAFETY: any handle may be passed.
    unsafe { fmi2FreeInstance(first.c) };
    let second = Host::of("er16k-tb1");
    assert_ne!(first.c, second.c);
    assert_eq!(first.setup(None, 0.0, None), Status::Error);
    assert_eq!(second.setup(None, 0.0, None), Status::Ok);
}

#[test]
fn a_thousand_instances_of_two_scenes_live_at_once_and_do_not_meet() {
    let scenes = ["er16k-tb1", "6205-hosted"].map(Host::started);
    let mut all = Vec::new();
    for number in 0..1000 {
        let scene = &scenes[number % 2];
        let location = scene.resources.uri();
        let (component, log) = good(&scene.resources.guid, &location).make();
        assert!(!component.is_null(), "{:?}", log.take());
        all.push((component, log));
    }
    let handles: std::collections::BTreeSet<_> = all.iter().map(|(component, _)| component.addr()).collect();
    assert_eq!(handles.len(), 1000);
    let before = scenes[0].get(&scenes[0].reals()).unwrap();
    for (component, _) in &all {
        // SAFETY: any handle may be passed.
        unsafe { fmi2FreeInstance(*component) };
    }
    assert_eq!(scenes[0].get(&scenes[0].reals()).unwrap(), before);
}

#[test]
fn instances_in_eight_threads_give_the_bits_of_one_alone() {
    let run = || {
        let host = Host::started("er16k-tb1");
        for n in 0..40 {
            assert_eq!(host.step(f64::from(n) * 1e-4, 1e-4), Status::Ok);
        }
        bits(&host.all())
    };
    let alone = run();
    let together: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8).map(|_| scope.spawn(run)).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    assert!(together.iter().all(|values| *values == alone));
}

#[test]
fn memory_and_step_callbacks_are_never_called() {
    let host = Host::started("6205-epps");
    assert_eq!(host.step(0.0, 1e-4), Status::Ok);
    let bytes = host.serialize(host.save());
    let state = host.deserialize(&bytes).unwrap();
    assert_eq!((host.restore(state), host.free(state)), (Status::Ok, Status::Ok));
    assert_eq!((host.terminate(), host.reset()), (Status::Ok, Status::Ok));
    drop(host);
    // The other tests of this program pass the same callbacks.
    assert_eq!(FORBIDDEN_CALLS.load(std::sync::atomic::Ordering::Relaxed), 0);
}

#[test]
#[cfg(target_arch = "x86_64")]
fn floating_point_control_state_is_left_alone_and_changes_no_bit() {
    use std::arch::asm;
    let control = || {
        let mut word = 0u32;
        // SAFETY: stores the control word in `word`.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut word) };
        // The six lowest bits are flags that arithmetic leaves.
        word & !0x3f
    };
    let set = |word: u32| {
        // SAFETY: loads a valid control word; all exceptions stay masked.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const word) };
    };
    let usual = control();
    // Denormals to zero, rounding upwards: what some hosts run with.
    let odd = usual | 0x8040 | 0x4000;
    let stepped = || {
        let host = Host::started("er16k-tb1");
        let statuses = [0.0, 1e-4, 2e-4].map(|point| host.step(point, 1e-4));
        (statuses, bits(&host.all()), control())
    };
    set(odd);
    // First, so that what instances share is made now.
    let found = stepped();
    set(usual);
    let (statuses, values, _) = stepped();
    assert_eq!((found.0, found.2), ([Status::Ok; 3], odd));
    assert_eq!((statuses, values), (found.0, found.1));
}

#[test]
fn everything_passed_to_instantiate_is_copied() {
    // `Call::make` drops strings and callbacks before it returns; what follows uses name, logger and resources.
    let host = Host::named("er16k-tb1", "a name that goes away");
    fs::remove_file(host.resources.directory.join("scene.toml")).unwrap();
    host.lines();
    assert_eq!(host.reset(), Status::Ok);
    assert_eq!(host.lines()[0].instance, "a name that goes away");
    host.start();
}
