//! The program `brinell`: see [`fmu_build::cli`].

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    match fmu_build::cli::Arguments::parse().execute() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
