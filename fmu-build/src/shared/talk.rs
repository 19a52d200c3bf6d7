//! How much the program says on standard error: what it remarks, how far it is, and with `-v` what it does.

use std::sync::atomic::{AtomicI8, Ordering};

use indicatif::{ProgressBar, ProgressStyle};

/// −1 errors alone, 0 as usual, 1 more.
static LEVEL: AtomicI8 = AtomicI8::new(0);

/// Sets how much is said from now on.
pub(crate) fn set(quiet: bool, verbose: bool) {
    LEVEL.store(i8::from(verbose) - i8::from(quiet), Ordering::Relaxed);
}

/// Whether remarks and bars are shown.
pub(crate) fn is_shown() -> bool {
    LEVEL.load(Ordering::Relaxed) >= 0
}

/// Whether every step of the work is reported.
pub(crate) fn is_detailed() -> bool {
    LEVEL.load(Ordering::Relaxed) > 0
}

/// A bar of so many steps, hidden where nobody looks or nothing is to be said.
pub fn bar(steps: u64, template: &str) -> ProgressBar {
    if !is_shown() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(steps);
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// A remark on standard error, unless `--quiet` is given.
macro_rules! note {
    ($($text:tt)*) => {
        if $crate::shared::talk::is_shown() {
            eprintln!($($text)*);
        }
    };
}

/// What is done, on standard error with `-v`.
macro_rules! detail {
    ($($text:tt)*) => {
        if $crate::shared::talk::is_detailed() {
            eprintln!($($text)*);
        }
    };
}

pub(crate) use {detail, note};
