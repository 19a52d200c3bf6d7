//! A public importer drives the FMUs: fmpy, through the C interface. The scripts in `tests/python` say what they
//! check.

#[path = "../common/mod.rs"]
mod common;
mod fmi2;
mod fmi3;
mod fmi_kinds;
