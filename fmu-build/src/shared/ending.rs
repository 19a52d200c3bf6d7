//! How the programs end: with what was wrong on one line, without a word where nobody reads any more, and in order
//! where a signal ends them.

use std::panic::{self, PanicHookInfo};
use std::process::{self, ExitCode};

use anyhow::Result;

use crate::interrupt::{self, Interrupted};

/// What systems call writing into a pipe that nobody reads: Unix's `EPIPE`; Windows' `ERROR_BROKEN_PIPE` and
/// `ERROR_NO_DATA`.
const NO_READER: &[&str] = if cfg!(windows) { &["(os error 109)", "(os error 232)"] } else { &["(os error 32)"] };

/// Does what a program is for. An error is one line for the user.
pub fn program(work: impl FnOnce() -> Result<()>) -> ExitCode {
    let usual = panic::take_hook();
    panic::set_hook(Box::new(move |panic| {
        // `println!` panics where the reader has gone, as `head` does when it has enough.
        if lacks_reader(panic) {
            process::exit(1);
        }
        usual(panic);
    }));
    if let Err(error) = interrupt::watch() {
        eprintln!("note: Ctrl-C will leave temporary files: {error}");
    }
    match work() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            interrupt::wait_if_ending();
            if error.is::<Interrupted>() {
                process::exit(interrupt::status_of_interrupted());
            }
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn lacks_reader(panic: &PanicHookInfo<'_>) -> bool {
    let text = panic.payload().downcast_ref::<String>();
    text.is_some_and(|text| text.starts_with("failed printing to") && NO_READER.iter().any(|end| text.ends_with(end)))
}
