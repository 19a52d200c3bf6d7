//! A bug inside Brinell must not take the host down. Tests are built with the feature `panic-on-demand`.

use crate::two::{Host, Resources};
use brinell_fmi::fmi2::*;
use host::Instance;

#[test]
fn a_panic_fails_its_own_instance_and_no_other() {
    let (bad, good) = (Host::named("er16k-tb1", "panic on demand"), Host::started("er16k-tb1"));
    bad.start();
    let state = bad.save();
    bad.lines();
    assert_eq!(bad.step(0.0, 1e-4), Status::Error);
    let line = bad.lines().remove(0);
    assert!(line.message.contains("internal error: panic on demand"), "{line:?}");

    assert_eq!(good.step(0.0, 1e-4), Status::Ok);
    assert_eq!(bad.step(0.0, 1e-4), Status::Error);
    assert!(bad.lines().remove(0).message.contains("not allowed in mode"));
    // A saved state or a reset brings it back.
    assert_eq!(bad.restore(state), Status::Ok);
    assert!(bad.get(&bad.reals()).is_ok());
    assert_eq!(bad.reset(), Status::Ok);
    bad.start();
}

#[test]
fn a_panic_in_the_library_reaches_the_host_as_a_status() {
    let resources = Resources::of("er16k-tb1");
    let library = host::library_beside().unwrap();
    let started = |name: &str| {
        let mut instance = Instance::new(&library, name, &resources.guid, &resources.directory).unwrap();
        instance.initialize(None).unwrap();
        instance
    };
    let (mut bad, mut good) = (started("panic on demand"), started("good"));
    let error = bad.step(0.0, 1e-5).unwrap_err().to_string();
    assert!(error.contains("Error") && error.contains("panic on demand"), "{error}");
    good.step(0.0, 1e-5).unwrap();
    drop(bad);
    good.step(1e-5, 1e-5).unwrap();
}
