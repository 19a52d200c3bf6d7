//! What happens when a user ends the program by Ctrl-C, or a system by SIGTERM: what is temporary is removed, and the
//! program ends with the status of the signal. A command that can end in order, as a sweep under way, does so itself;
//! a second signal does not wait for it.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// How often the program looks whether a signal has come.
const OFTEN: Duration = Duration::from_millis(20);

/// The signal to which a command is answering; 0 before one has come.
static ANSWERED: AtomicUsize = AtomicUsize::new(0);
/// How many parts of the command end by themselves.
static HELD: AtomicUsize = AtomicUsize::new(0);
/// Files and folders that are removed at the end.
static TEMPORARY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Why a command ended before its time.
#[derive(Debug, thiserror::Error)]
#[error("interrupted")]
pub(crate) struct Interrupted;

/// Looks for signals from now on.
///
/// # Errors
/// What the system says.
pub(crate) fn watch() -> io::Result<()> {
    let came = Arc::new(AtomicUsize::new(0));
    for signal in [SIGINT, SIGTERM] {
        flag::register_usize(signal, Arc::clone(&came), signal as usize)?;
    }
    thread::Builder::new().name("signals".to_owned()).spawn(move || {
        loop {
            thread::sleep(OFTEN);
            let signal = came.swap(0, Ordering::Relaxed);
            if signal != 0 {
                answer(signal);
            }
        }
    })?;
    Ok(())
}

fn answer(signal: usize) {
    // Nobody makes anything temporary while this is held, up to the end of the program.
    let temporary = temporary_ones();
    let first = ANSWERED.swap(signal, Ordering::Relaxed) == 0;
    if first && HELD.load(Ordering::Relaxed) > 0 {
        return;
    }
    for path in temporary.iter() {
        remove(path);
    }
    eprintln!("interrupted: files that were named are whole, others are not there");
    process::exit(status(signal));
}

/// Removes a file or a folder, into which somebody may still be writing.
fn remove(path: &Path) {
    for _ in 0..10 {
        let removed = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
        match removed {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {}
            _ => return,
        }
    }
}

fn temporary_ones() -> MutexGuard<'static, Vec<PathBuf>> {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// As shells count it.
fn status(signal: usize) -> i32 {
    128 + signal as i32
}

/// Whether the command that holds interrupts is to end.
pub(crate) fn came() -> bool {
    ANSWERED.load(Ordering::Relaxed) != 0
}

/// The program's status where a command has ended because of a signal.
pub(crate) fn status_of_interrupted() -> i32 {
    status(ANSWERED.load(Ordering::Relaxed))
}

/// Waits for the end of the program, if a signal is ending it: what fails meanwhile fails for that.
pub(crate) fn wait_if_ending() {
    if came() && HELD.load(Ordering::Relaxed) == 0 {
        loop {
            thread::park();
        }
    }
}

/// While this is there, the command looks by [`came`] whether it is to end, and does so itself.
pub(crate) struct Held;

impl Held {
    pub(crate) fn new() -> Self {
        HELD.fetch_add(1, Ordering::Relaxed);
        Self
    }
}

impl Drop for Held {
    fn drop(&mut self) {
        // Once a signal has come, the command goes on ending by itself.
        if !came() {
            HELD.fetch_sub(1, Ordering::Relaxed);
        }
    }
}

/// Something that is removed where a signal ends the program.
#[derive(Debug)]
pub(crate) struct Temporary(PathBuf);

impl Temporary {
    /// What `make` makes at the path that `path` tells.
    pub(crate) fn made<T>(make: impl FnOnce() -> io::Result<T>, path: impl Fn(&T) -> &Path) -> io::Result<(Self, T)> {
        let mut all = temporary_ones();
        let made = make()?;
        let path = path(&made).to_owned();
        all.push(path.clone());
        Ok((Self(path), made))
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        temporary_ones().retain(|path| *path != self.0);
    }
}
