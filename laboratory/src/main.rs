//! The command `cargo lab`: see [`brinell_laboratory::cli`].

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    fmu_build::shared::program(|| brinell_laboratory::cli::Arguments::parse().execute())
}
