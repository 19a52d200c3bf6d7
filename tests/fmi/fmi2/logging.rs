//! The host's logger.

use crate::two::{Call, Host, Resources};
use brinell_fmi::fmi2::*;
use std::ffi::CString;
use std::fmt::Write;
use std::ptr;

fn switch(host: &Host, on: bool, categories: &[&str]) -> Status {
    let texts: Vec<_> = categories.iter().map(|text| CString::new(*text).unwrap()).collect();
    let pointers: Vec<_> = texts.iter().map(|text| text.as_ptr()).collect();
    // SAFETY: as many strings as said, each ended by NUL.
    unsafe { fmi2SetDebugLogging(host.c, on.into(), pointers.len(), pointers.as_ptr()) }
}

/// Provokes a line of each category that there is, and gives the categories seen.
fn provoke(host: &Host) -> Vec<String> {
    host.lines();
    host.reset();
    host.set(&[host.reference("shaft.speed")], &[f64::NAN]);
    host.step(0.0, 1.0);
    host.lines().into_iter().map(|line| line.category).collect()
}

#[test]
fn logging_is_silent_when_off_and_complete_when_on() {
    let host = Host::with(Resources::of("er16k-tb1"), "quiet", false);
    assert!(host.lines().is_empty());
    assert!(provoke(&host).is_empty());
    assert_eq!(switch(&host, true, &[]), Status::Ok);
    assert_eq!(provoke(&host), ["logEvents", "logStatusDiscard", "logStatusError"]);
    assert_eq!(switch(&host, false, &[]), Status::Ok);
    assert!(provoke(&host).is_empty());
}

#[test]
fn only_the_categories_asked_for_are_logged() {
    let host = Host::of("er16k-tb1");
    for (categories, seen) in [
        (vec!["logEvents"], vec!["logEvents"]),
        (vec!["logStatusError", "logStatusDiscard"], vec!["logStatusDiscard", "logStatusError"]),
        (vec!["logStatusFatal", "logStatusWarning"], vec![]),
        (vec!["logAll"], vec!["logEvents", "logStatusDiscard", "logStatusError"]),
    ] {
        assert_eq!(switch(&host, true, &categories), Status::Ok);
        assert_eq!(provoke(&host), seen);
    }
    assert_eq!(switch(&host, false, &["logAll"]), Status::Ok);
    assert!(provoke(&host).is_empty());
}

#[test]
fn an_unknown_category_is_a_warning_and_the_known_ones_are_set() {
    let host = Host::of("er16k-tb1");
    assert_eq!(switch(&host, true, &["logStatusWarning", "log%nEverything", "logEvents"]), Status::Warning);
    let line = host.lines().pop().unwrap();
    assert_eq!((line.status, line.category.as_str()), (Status::Warning, "logStatusWarning"));
    assert!(line.message.contains("log%nEverything"));
    assert_eq!(provoke(&host), ["logEvents"]);
    // One that is of another tool and nothing else leaves the choice as it is, in any mode and however it is asked.
    for on in [true, false, true] {
        assert_eq!(switch(&host, on, &["logDynamicStateSelection"]), Status::Warning);
        assert_eq!(provoke(&host), if on { vec!["logEvents"] } else { vec![] });
        assert_eq!(switch(&host, true, &["logEvents"]), Status::Ok);
    }
}

#[test]
fn null_categories_are_errors() {
    let none: FmiString = ptr::null();
    for categories in [ptr::null(), &raw const none] {
        let host = Host::of("er16k-tb1");
        // SAFETY: NULL, or one NULL string, is what is tested.
        assert_eq!(unsafe { fmi2SetDebugLogging(host.c, TRUE, 1, categories) }, Status::Error);
    }
}

#[test]
fn a_message_is_an_argument_of_the_format_and_never_the_format() {
    let host = Host::named("er16k-tb1", "100 %s %n");
    let line = host.lines().remove(0);
    assert_eq!((line.format.as_str(), line.instance.as_str()), ("%s", "100 %s %n"));
}

#[test]
fn every_error_says_what_failed_and_what_to_do() {
    let host = Host::started("er16k-tb1");
    host.lines();
    assert_eq!(host.step(0.0, -1.0), Status::Error);
    let lines = host.lines();
    assert_eq!(lines.len(), 1);
    let message = &lines[0].message;
    for word in ["fmi2DoStep", "-1.0 s", "above 0", "fmi2Reset", "fmi2SetFMUstate", "fmi2FreeInstance"] {
        assert!(message.contains(word), "{word}: {message}");
    }
}

#[test]
fn steps_and_values_in_order_log_nothing() {
    let host = Host::started("er16k-tb1");
    host.lines();
    for n in 0..10 {
        assert_eq!(host.set(&[host.reference("shaft.speed")], &[62.0]), Status::Ok);
        assert_eq!(host.step(f64::from(n) * 1e-4, 1e-4), Status::Ok);
        assert!(host.get(&host.reals()).is_ok());
    }
    assert!(host.lines().is_empty());
}

type Unwinding = unsafe extern "C-unwind" fn(ComponentEnvironment, FmiString, Status, FmiString, FmiString, FmiString);

unsafe extern "C-unwind" fn unwind(
    _: ComponentEnvironment,
    _: FmiString,
    _: Status,
    _: FmiString,
    _: FmiString,
    _: FmiString,
) {
    panic!("a logger that unwinds");
}

#[test]
fn a_logger_that_unwinds_fails_its_instance_and_leaves_the_process_alone() {
    // SAFETY: as in `host`; that a logger may unwind is part of its type.
    let logger = unsafe { std::mem::transmute::<Unwinding, LoggerCallback>(unwind) };
    let resources = Resources::of("6205-healthy");
    let (guid, location) = (resources.guid.clone(), resources.uri());
    let parts = Call { logger: Some(logger), ..Call::good("instance 1", &guid, &location) }.make();
    let host = Host::of_parts(parts, resources.into());
    // SAFETY: a living handle; no categories.
    let switch = |on: Boolean| unsafe { fmi2SetDebugLogging(host.c, on, 0, ptr::null()) };
    assert_eq!((host.setup(None, 0.0, None), switch(TRUE)), (Status::Ok, Status::Ok));
    // It unwinds when it hears of the new mode, and again when it hears of that.
    assert_eq!((host.enter(), host.exit()), (Status::Error, Status::Error));
    assert_eq!((switch(FALSE), host.reset()), (Status::Ok, Status::Ok));
    assert_eq!(host.begin(None, 0.0, None), Status::Ok);
}

/// Warnings with this word since the last look.
fn warnings(host: &Host, word: &str) -> usize {
    host.lines().iter().filter(|line| line.status == Status::Warning && line.message.contains(word)).count()
}

#[test]
fn contacts_that_a_shoulder_cuts_are_warned_of_once() {
    let host = Host::started("7205-preloaded");
    host.step(0.0, 1e-4);
    assert_eq!(warnings(&host, "shoulder"), 0);
    // Two hundred times the preload: the ellipses reach over the edges of their grooves.
    assert_eq!(host.set(&[host.reference("shaft.load.z")], &[60e3]), Status::Ok);
    for step in 1..4 {
        assert_eq!(host.step(f64::from(step) * 1e-3 - 9e-4, 1e-3), Status::Ok);
    }
    let cut = host.get_integers(&[host.reference("solver.truncated_contacts")]).unwrap()[0];
    assert!(cut > 1, "{cut}");
    assert_eq!(warnings(&host, "shoulder"), 1);
}

#[test]
fn contacts_beside_the_slices_of_a_topography_are_warned_of_once() {
    let mut pit = String::from("arc_mm,axial_mm,depth_um\n");
    for (i, j) in (-20..=20).flat_map(|i| (0..=20).map(move |j| (i, j))) {
        let depth = if i32::abs(i) < 20 && (1..20).contains(&j) { 2 } else { 0 };
        writeln!(pit, "{:.3},{:.3},{depth}", 0.01 * f64::from(i), 0.2 + 0.1 * f64::from(j)).unwrap();
    }
    // The track is at 15 degrees; without a push along the axis balls run at the bottom.
    let scene = "name = \"beside\"\n[bearing]\ndegrees_of_freedom = 3\nelement_count = 9\n\
                 element_diameter_mm = 7.94\npitch_diameter_mm = 39.04\nradial_clearance_um = 8.0\n\
                 youngs_modulus_gpa = 207.0\npoissons_ratio = 0.3\n\
                 density_kg_m3 = 7800.0\nconformity_inner = 0.52\nconformity_outer = 0.52\n\
                 operating_angle_deg = 15.0\n[contact]\nlargest_force_n = 300.0\ncells = [12, 8]\n\
                 map_accuracy = 0.1\n[defect]\nangle_deg = -90.0\nprofile = \"pit.csv\"\n\
                 [cage]\ninitial_angle_deg = -90.0\n[shaft]\nmotion = \"host\"\nspeed_hz = 1.0\n\
                 [housing]\nmotion = \"fixed\"\n";
    let host = Host::with(Resources::new(scene, Some(("pit.csv", &pit)), "resources"), "beside", true);
    // On the track: 15 degrees of 0.3176 mm.
    let positions = [host.reference("shaft.y"), host.reference("shaft.z")];
    assert_eq!(host.begin(None, 0.0, None), Status::Ok, "{:?}", host.lines());
    assert_eq!((host.set(&positions, &[-2e-6, 86e-6]), host.exit()), (Status::Ok, Status::Ok), "{:?}", host.lines());
    let warnings = || warnings(&host, "off_track_contacts");
    assert_eq!(host.step(0.0, 1e-5), Status::Ok);
    let counter = [host.reference("solver.off_track_contacts")];
    assert_eq!((warnings(), host.get_integers(&counter).unwrap()), (0, vec![0]));
    for step in 1..4 {
        assert_eq!(host.set(&positions, &[-12e-6, 5e-6]), Status::Ok);
        assert_eq!(host.step(f64::from(step) * 1e-4 - 9e-5, 1e-4), Status::Ok);
    }
    let beside = host.get_integers(&counter).unwrap()[0];
    assert!(warnings() == 1 && beside > 1, "{beside}");
}

/// A ball bearing in a housing that stands, whose shaft the host moves.
const HOSTED: &str = "name = \"hosted\"\n[bearing]\ncatalogue = \"6205\"\n[shaft]\nmotion = \"host\"\nspeed_hz = 25.0\n\
                      [housing]\nmotion = \"fixed\"\n";

/// Warnings of 5 ms in which a mass of 2 kg below 600 N swings on the bearing: it takes this force, read before the
/// bearing's step or after it, and gives its velocity or leaves it out.
fn warnings_of_a_mass(force: &str, sequential: bool, gives_velocity: bool) -> Vec<String> {
    let host = Host::with(Resources::new(HOSTED, None, "resources"), "coupled", true);
    let motion = ["shaft.y", "shaft.vy", "shaft.ay"].map(|name| host.reference(name));
    let force = [host.reference(&format!("shaft.{force}.y"))];
    // The force falls as the mass rises from here, to 600 N some micrometres above.
    let (mut y, mut v, mut a, h) = (-22e-6, 0.0, 0.0, 1e-5);
    assert_eq!(host.begin(None, 0.0, None), Status::Ok, "{:?}", host.lines());
    assert_eq!((host.set(&motion[..1], &[y]), host.exit()), (Status::Ok, Status::Ok), "{:?}", host.lines());
    host.lines();
    for step in 0..500 {
        let before = host.get(&force).unwrap()[0];
        assert_eq!(host.set(&motion, &[y, if gives_velocity { v } else { 0.0 }, a]), Status::Ok);
        assert_eq!(host.step(f64::from(step) * h, h), Status::Ok, "{:?}", host.lines());
        let taken = if sequential { host.get(&force).unwrap()[0] } else { before };
        a = (taken - 600.0) / 2.0;
        (y, v) = (y + h * (v + 0.5 * h * a), v + h * a);
        a = if gives_velocity { a } else { 0.0 };
    }
    host.lines().into_iter().map(|line| line.message).collect()
}

#[test]
fn a_coupling_is_warned_of_by_what_it_loses_and_not_by_its_step() {
    let held = warnings_of_a_mass("force", false, true);
    assert!((1..4).contains(&held.len()), "{held:?}");
    for words in ["host.coupling_error", "2.00 kg of the host on the inner ring", "force of its start"] {
        assert!(held[0].starts_with("communication step of 1e-5 s: ") && held[0].contains(words), "{words}: {held:?}");
    }
    // The same step, and the same gap at the end of each.
    assert_eq!(warnings_of_a_mass("mean_force", true, true), [""; 0]);
    let still = warnings_of_a_mass("mean_force", true, false);
    assert!(still.len() == 1 && still[0].contains("its velocities are 0"), "{still:?}");
}
