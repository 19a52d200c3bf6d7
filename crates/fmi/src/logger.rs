//! The host's logger and the categories of messages.
//!
//! A message is passed as the argument of the format `"%s"`, so a per cent sign in it is harmless. Nothing is formatted
//! while logging is off.

use std::ffi::CString;

use brinell::simulation::log_category::Category;

use super::c_types::{CallbackFunctions, ComponentEnvironment, LoggerCallback, Status};

/// The category of lines that go with a status.
fn category_of(status: Status) -> Category {
    match status {
        Status::Ok | Status::Pending => Category::Events,
        Status::Warning => Category::StatusWarning,
        Status::Discard => Category::StatusDiscard,
        Status::Error => Category::StatusError,
        Status::Fatal => Category::StatusFatal,
    }
}

/// An instance's way to the host's logger. Copies what it needs of the callbacks and of the instance's name.
#[derive(Debug)]
pub(super) struct Logger {
    callback: LoggerCallback,
    environment: ComponentEnvironment,
    instance_name: CString,
    /// Categories that are switched on, as a sum of [`Category`] values.
    switched_on: u8,
}

// SAFETY: the environment is the host's. It is handed back to the host's own logger, in calls on this instance only,
// and a host that makes those from one thread after another (FMI 2.0 allows it) expects its logger there.
unsafe impl Send for Logger {}

impl Logger {
    /// The instance's name.
    pub(super) fn instance_name(&self) -> &str {
        // Hosts must pass UTF-8; what is not is only replaced in the name of a file.
        self.instance_name.to_str().unwrap_or("instance")
    }

    /// A logger with all categories on or off; `None` when the host gave no callback.
    pub(super) fn new(callbacks: &CallbackFunctions, instance_name: CString, on: bool) -> Option<Self> {
        Some(Self {
            callback: callbacks.logger?,
            environment: callbacks.component_environment,
            instance_name,
            switched_on: if on { Category::All as u8 } else { 0 },
        })
    }

    /// Switches all categories off, or on as listed; an empty list means all. Gives the first unknown name.
    pub(super) fn switch<'a>(&mut self, on: bool, names: &[&'a str]) -> Result<(), &'a str> {
        self.switched_on = if on && names.is_empty() { Category::All as u8 } else { 0 };
        let mut result = Ok(());
        for name in names {
            match Category::LIST.into_iter().find(|category| category.name() == *name) {
                Some(category) if on => self.switched_on |= category as u8,
                Some(_) => {}
                None => result = result.and(Err(*name)),
            }
        }
        result
    }

    /// Sends a line if its category is on. `text` is called only then.
    pub(super) fn line(&self, status: Status, text: impl FnOnce() -> String) {
        let category = category_of(status);
        if self.switched_on & category as u8 != 0 {
            self.send(status, category, text());
        }
    }

    /// Sends a line whatever is switched on: for `fmi2Instantiate`, which leaves no instance to switch logging on for,
    /// and for what a host must not miss.
    pub(super) fn insist(&self, status: Status, text: String) {
        self.send(status, category_of(status), text);
    }

    /// Panics if the instance's name asks for it: lets a test see what a bug would do to its host.
    #[cfg(feature = "panic-on-demand")]
    pub(super) fn panic_on_demand(&self) {
        assert!(self.instance_name.as_c_str() != c"panic on demand", "panic on demand");
    }

    fn send(&self, status: Status, category: Category, text: String) {
        let text = c_string(text);
        // SAFETY: the host promises a callable logger for as long as the instance lives (FMI 2.0, fmi2Instantiate).
        // All strings end in NUL and outlive the call; the format takes exactly one string.
        unsafe {
            (self.callback)(
                self.environment,
                self.instance_name.as_ptr(),
                status,
                category.c_name().as_ptr(),
                c"%s".as_ptr(),
                text.as_ptr(),
            );
        }
    }
}

/// Text as a C string. A NUL inside, which C could not show, becomes the replacement character.
pub(super) fn c_string(text: String) -> CString {
    CString::new(text).unwrap_or_else(|error| {
        let text = String::from_utf8_lossy(&error.into_vec()).replace('\0', "\u{fffd}");
        CString::new(text).unwrap_or_default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_nul_inside_a_message_is_shown_not_cut_off() {
        assert_eq!(c_string("a\0b".to_owned()).to_str(), Ok("a\u{fffd}b"));
    }

    #[test]
    fn every_category_has_its_own_name_and_all_covers_them() {
        let names: std::collections::BTreeSet<_> = Category::LIST.iter().map(|category| category.name()).collect();
        assert_eq!(names.len(), Category::LIST.len());
        for category in Category::LIST {
            assert_eq!(category as u8 & Category::All as u8, category as u8);
        }
    }
}
