//! Packs Brinell scenes into FMUs, checks them and runs them.
//!
//! A scene becomes an FMU in three steps: [`model`] reads it and asks the simulation for its variable table,
//! [`model_description`] and [`documentation`] write that table down, [`archive`] zips them together with the
//! one compiled [`library`] that serves every scene. No compiler is needed for a new bearing.

pub mod archive;
mod catalogue;
pub mod check;
pub mod cli;
pub mod compile;
pub mod contact;
pub mod contact_map;
pub mod csv;
pub mod demo;
mod digits;
pub mod documentation;
pub mod ending;
pub mod fmi_version;
pub mod fmu;
pub mod grid;
mod interrupt;
pub mod library;
pub mod model;
pub mod model_description;
pub mod model_description3;
pub mod modes;
mod new_scene;
mod numbers;
pub mod platform;
pub mod project;
pub mod python;
pub mod reference;
pub mod run;
pub mod scenes;
mod schema;
mod sensor_response;
pub mod shipped;
pub mod size;
pub mod slave;
pub mod slave3;
pub mod stiffness;
mod sweep;
pub mod terminals;
pub mod toolchain;
pub mod units;
pub mod universal;
pub mod whole_file;
mod xml;
pub mod zig;
