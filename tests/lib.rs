//! What all tests of this package stand on.

use std::path::Path;

/// Root of the workspace.
pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}
