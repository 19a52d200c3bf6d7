//! What all tests of this package stand on.
// What helpers unwrap is a test's own set-up.
#![allow(clippy::unwrap_used, clippy::expect_used)]

pub mod resources;
pub mod snapshot;

use std::path::Path;

/// Root of the workspace.
pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}
