//! The host's logger and the categories of messages.
//!
//! To FMI 2.0 a message is passed as the argument of the format `"%s"`, so a per cent sign in it is harmless; to FMI
//! 3.0 as it is, with `#`, which names variables there, doubled. Nothing is formatted while logging is off.

use std::ffi::CString;

use brinell::simulation::interface::Category;

use super::c_types::{CallbackFunctions, ComponentEnvironment, LogMessageCallback, LoggerCallback, Status};

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

/// The host's function.
#[derive(Debug, Clone, Copy)]
enum Sink {
    /// FMI 2.0's.
    Formatted(LoggerCallback),
    /// FMI 3.0's.
    Plain(LogMessageCallback),
    /// FMI 3.0's hosts may have none.
    Nothing,
}

/// An instance's way to the host's logger. Copies what it needs of the callbacks and of the instance's name.
#[derive(Debug)]
pub(crate) struct Logger {
    sink: Sink,
    environment: ComponentEnvironment,
    instance_name: CString,
    /// Categories that are switched on, as a sum of [`Category`] values.
    switched_on: u8,
}

// SAFETY: the environment is the host's. It is handed back to the host's own logger, in calls on this instance only,
// and a host that makes those from one thread after another (the standard allows it) expects its logger there.
unsafe impl Send for Logger {}

impl Logger {
    /// The instance's name.
    pub(crate) fn instance_name(&self) -> &str {
        // Hosts must pass UTF-8; what is not is only replaced in the name of a file.
        self.instance_name.to_str().unwrap_or("instance")
    }

    /// FMI 2.0's logger with all categories on or off; `None` when the host gave no callback.
    pub(crate) fn formatted(callbacks: &CallbackFunctions, instance_name: CString, on: bool) -> Option<Self> {
        Some(Self::new(Sink::Formatted(callbacks.logger?), callbacks.component_environment, instance_name, on))
    }

    /// FMI 3.0's logger with all categories on or off.
    pub(crate) fn plain(
        callback: Option<LogMessageCallback>,
        environment: ComponentEnvironment,
        instance_name: CString,
        on: bool,
    ) -> Self {
        Self::new(callback.map_or(Sink::Nothing, Sink::Plain), environment, instance_name, on)
    }

    fn new(sink: Sink, environment: ComponentEnvironment, instance_name: CString, on: bool) -> Self {
        Self { sink, environment, instance_name, switched_on: if on { Category::All as u8 } else { 0 } }
    }

    /// Switches the listed categories on or off, all of them if none is listed, and leaves the others. Gives the first
    /// unknown name.
    pub(crate) fn turn<'a>(&mut self, on: bool, names: &[&'a str]) -> Result<(), &'a str> {
        let named = |name: &str| Category::LIST.into_iter().find(|category| category.name() == name);
        let wanted = if names.is_empty() {
            Category::All as u8
        } else {
            names.iter().filter_map(|name| named(name)).fold(0, |sum, category| sum | category as u8)
        };
        self.switched_on = if on { self.switched_on | wanted } else { self.switched_on & !wanted };
        names.iter().find(|name| named(name).is_none()).map_or(Ok(()), |name| Err(*name))
    }

    /// Switches all categories off, or on as listed; an empty list means all. Gives the first unknown name; where all
    /// are unknown, what is on stays on.
    pub(crate) fn switch<'a>(&mut self, on: bool, names: &[&'a str]) -> Result<(), &'a str> {
        let known = |name: &&str| Category::LIST.into_iter().any(|category| category.name() == *name);
        if !on || names.is_empty() || names.iter().any(known) {
            self.switched_on = 0;
        }
        self.turn(on, names)
    }

    /// Sends a line if its category is on. `text` is called only then.
    pub(crate) fn line(&self, status: Status, text: impl FnOnce() -> String) {
        let category = category_of(status);
        if self.switched_on & category as u8 != 0 {
            self.send(status, category, text());
        }
    }

    /// Sends a line that a host must not miss: whatever is switched on, unless the standard forbids that, as 3.0 does.
    pub(crate) fn tell(&self, status: Status, text: String) {
        match self.sink {
            Sink::Formatted(_) => self.insist(status, text),
            Sink::Plain(_) | Sink::Nothing => self.line(status, || text),
        }
    }

    /// Sends a line whatever is switched on: for an instantiation that fails, which leaves no instance to switch
    /// logging on for.
    pub(crate) fn insist(&self, status: Status, text: String) {
        self.send(status, category_of(status), text);
    }

    /// Panics if the instance's name asks for it: lets a test see what a bug would do to its host.
    #[cfg(feature = "panic-on-demand")]
    pub(crate) fn panic_on_demand(&self) {
        assert!(self.instance_name.as_c_str() != c"panic on demand", "panic on demand");
    }

    fn send(&self, status: Status, category: Category, text: String) {
        let Self { sink, environment, ref instance_name, .. } = *self;
        let category = category.c_name().as_ptr();
        match sink {
            Sink::Formatted(callback) => {
                let (name, text) = (instance_name.as_ptr(), c_string(text));
                // SAFETY: the host promises a callable logger for as long as the instance lives (FMI 2.0,
                // fmi2Instantiate). All strings end in NUL and outlive the call; the format takes exactly one string.
                unsafe { callback(environment, name, status, category, c"%s".as_ptr(), text.as_ptr()) }
            }
            Sink::Plain(callback) => {
                let text = c_string(text.replace('#', "##"));
                // SAFETY: as above (FMI 3.0, logMessage).
                unsafe { callback(environment, status, category, text.as_ptr()) }
            }
            Sink::Nothing => {}
        }
    }
}

/// Text as a C string. A NUL inside, which C could not show, becomes the replacement character.
pub(crate) fn c_string(text: String) -> CString {
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
