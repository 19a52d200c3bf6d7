//! The categories of messages that an FMU gives its host: the logger tags lines with them, the model description lists
//! them.

use std::ffi::CStr;

/// Category of a message, as named in the model description.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Category {
    /// Changes of mode.
    Events = 1,
    /// Lines that go with `fmi2Warning`.
    StatusWarning = 2,
    /// Lines that go with `fmi2Discard`.
    StatusDiscard = 4,
    /// Lines that go with `fmi2Error`.
    StatusError = 8,
    /// Lines that go with `fmi2Fatal`; there are none.
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

    /// One line for the reader.
    pub fn description(self) -> &'static str {
        match self {
            Category::Events => "Changes of mode",
            Category::StatusWarning => "Reasons for fmi2Warning",
            Category::StatusDiscard => "Reasons for fmi2Discard",
            Category::StatusError => "Reasons for fmi2Error",
            Category::StatusFatal => "Reasons for fmi2Fatal (none is ever returned)",
            Category::All => "All messages",
        }
    }
}
