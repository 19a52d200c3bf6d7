//! A bug inside Brinell must not take the host down. Tests are built with the feature `panic-on-demand`.

use crate::host::Host;
use brinell_fmi::fmi2::*;

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
