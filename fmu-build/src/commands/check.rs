//! The command `check`: an FMU tried as an importer would, by fmpy: unzip, validate, load, initialize, step, save and
//! restore. Works on any co-simulation FMU of FMI 2.0 or 3.0 that holds a binary for this platform.

use std::ffi::OsStr;
use std::path::Path;

use anyhow::{Context, Result};

use crate::platforms::Platform;
use crate::shared::{Project, Python};

/// The command: one line for each thing that was tried; the first that fails ends it.
pub fn command(project: &Project, path: &Path) -> Result<()> {
    let python = Python::prepare(project).context("an FMU is tried by fmpy, which needs Python")?;
    let host = Platform::host()?;
    let of_fmi3 = host.fmi3_of_this_machine();
    python.show("check.py", [path.as_os_str(), OsStr::new(host.name), OsStr::new(&of_fmi3)])
}
