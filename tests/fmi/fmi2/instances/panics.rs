//! A bug inside Brinell must not take the host down. Tests are built with the feature `panic-on-demand`.

use crate::both;
use crate::two::{Resources, Two};
use host::Instance;

#[test]
fn a_panic_fails_its_own_instance_and_no_other() {
    both::a_panic_fails_its_instance_alone::<Two>();
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
