//! The program `brinell`: see [`fmu_build::cli`].

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    fmu_build::shared::program(|| fmu_build::cli::Arguments::parse().execute())
}
