//! The command `cargo fmu`: see [`fmu_build::cli`]. Results go into the workspace's `target`.

use std::process::ExitCode;

use fmu_build::cli::Arguments;
use fmu_build::shared::{Project, program};

fn main() -> ExitCode {
    program(|| Arguments::parse_as("cargo fmu").execute(&Project::find().with_library_beside()))
}
