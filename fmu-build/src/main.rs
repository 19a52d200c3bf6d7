//! The program `brinell`: see [`fmu_build::cli`].

use std::process::ExitCode;

use fmu_build::cli::Arguments;
use fmu_build::shared::{Project, program};

fn main() -> ExitCode {
    program(|| Arguments::parse_as("brinell").execute(&Project::of_user()))
}
