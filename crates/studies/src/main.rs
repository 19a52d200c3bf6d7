//! The command `cargo fmu`: see [`brinell_studies::cli`].

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    match brinell_studies::cli::Arguments::parse().execute() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
