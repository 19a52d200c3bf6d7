//! The categories of messages that an FMU gives its host: the logger tags lines with them, the model description lists
//! them.

use std::ffi::CStr;

/// Category of a message, as named in the model description.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Category {
    /// Changes of mode.
    Events = 1,
    /// Lines that go with the status warning.
    StatusWarning = 2,
    /// Lines that go with the status discard.
    StatusDiscard = 4,
    /// Lines that go with the status error.
    StatusError = 8,
    /// Lines that go with the status fatal; there are none.
    StatusFatal = 16,
    /// Everything.
    All = 31,
}

impl Category {
    /// All categories, in the order of the model description.
    pub const LIST: [Category; 6] = [
        Category::Events,
        Category::StatusWarning,
        Category::StatusDiscard,
        Category::StatusError,
        Category::StatusFatal,
        Category::All,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        // None of the names holds a byte that is not ASCII.
        self.c_name().to_str().unwrap_or_default()
    }

    /// Its name as C wants it.
    pub fn c_name(self) -> &'static CStr {
        match self {
            Category::Events => c"logEvents",
            Category::StatusWarning => c"logStatusWarning",
            Category::StatusDiscard => c"logStatusDiscard",
            Category::StatusError => c"logStatusError",
            Category::StatusFatal => c"logStatusFatal",
            Category::All => c"logAll",
        }
    }

    /// One line for the reader, with the prefix that the standard's version gives to names: `fmi2` or `fmi3`.
    pub fn description(self, prefix: &str) -> String {
        match self {
            Category::Events => "Changes of mode".to_owned(),
            Category::StatusWarning => format!("Reasons for {prefix}Warning"),
            Category::StatusDiscard => format!("Reasons for {prefix}Discard"),
            Category::StatusError => format!("Reasons for {prefix}Error"),
            Category::StatusFatal => format!("Reasons for {prefix}Fatal (none is ever returned)"),
            Category::All => "All messages".to_owned(),
        }
    }
}
