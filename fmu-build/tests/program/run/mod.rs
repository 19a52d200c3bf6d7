//! The command `run`: its tables and recordings, its figure and its page.
#![allow(clippy::unwrap_used)]

mod figure;
mod many_elements;
mod motion;
mod options;
mod page;
mod player;

use std::ffi::OsStr;
use std::path::Path;

use crate::common::program::{Said, brinell, done};

/// Runs a scene, a file or the name of a shipped one, into a folder.
#[track_caller]
fn run(scene: impl AsRef<OsStr>, out: &Path, more: &[&str]) -> Said {
    done(brinell(&["run", "-o"]).arg(out).arg(scene).args(more))
}
