//! The command `check`: an FMU tried as an importer would, by fmpy: unzip, validate, load, initialize, step, save and
//! restore. Works on any co-simulation FMU of FMI 2.0 or 3.0 that holds a binary for this platform.

use std::ffi::OsStr;
use std::path::Path;

use anyhow::{Context, Result};
use serde_json::{Map, Value};

use crate::platforms::Platform;
use crate::shared::{Project, Python};

/// The command: one line for each thing that was tried, or a JSON object of all that passed; the first that fails ends
/// it.
pub fn command(project: &Project, path: &Path, json: bool) -> Result<()> {
    let python = Python::prepare(project).context("an FMU is tried by fmpy, which needs Python")?;
    let host = Platform::host()?;
    let of_fmi3 = host.fmi3_of_this_machine();
    let arguments = [path.as_os_str(), OsStr::new(host.name), OsStr::new(&of_fmi3)];
    if !json {
        return python.show("check.py", arguments);
    }
    let said = python.run("check.py", arguments)?;
    let tried: Map<String, Value> = said
        .lines()
        .filter_map(|line| line.split_once(": "))
        .map(|(what, how)| (what.to_owned(), how.into()))
        .collect();
    println!("{}", serde_json::to_string_pretty(&tried)?);
    Ok(())
}
