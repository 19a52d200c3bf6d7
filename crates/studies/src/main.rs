//! The command `cargo fmu`: see [`brinell_studies::cli`].

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    fmu_build::shared::program(|| brinell_studies::cli::Arguments::parse().execute())
}
