//! What can be wrong with the keys of a scene file and with the values that stand for themselves.

use std::fmt;

/// A scene file that cannot be read, or whose scene cannot exist.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneFileError {
    /// Broken TOML. The message holds the parser's; it is no source that would be shown again.
    #[error("scene file: {0}")]
    Toml(toml::de::Error),
    /// All faults, in the order of their lines.
    #[error("scene file: {}", list(.0))]
    Keys(Vec<KeyFault>),
}

/// One fault in the keys of a scene file.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum KeyFault {
    /// A key or a table that means nothing here.
    Unknown { line: usize, key: String, hint: Hint },
    /// A key that would say what the model cannot do.
    NotModelled { line: usize, key: String, only: &'static str },
    /// A key or a table that is needed.
    Missing { line: usize, key: String, with: &'static [&'static str] },
    /// Neither of two keys of which one is needed.
    Neither { line: usize, keys: [String; 2] },
    /// A value that is wrong whatever the rest of the file says, or keys that contradict each other.
    Value { line: usize, message: String },
}

/// What to do about an unknown key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Hint {
    /// The key of the same table that is spelt most like it.
    DidYouMean(&'static str),
    /// The table that has a key of this name.
    BelongsTo(&'static str),
    /// All keys that the table takes.
    Takes(&'static [&'static str]),
}

impl KeyFault {
    /// Line in the file, from 1; 0 for the file as a whole.
    pub fn line(&self) -> usize {
        match self {
            Self::Unknown { line, .. }
            | Self::NotModelled { line, .. }
            | Self::Missing { line, .. }
            | Self::Neither { line, .. }
            | Self::Value { line, .. } => *line,
        }
    }
}

impl fmt::Display for KeyFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.line() > 0 {
            write!(f, "line {}: ", self.line())?;
        }
        match self {
            Self::Unknown { key, hint, .. } => write!(f, "{key} is unknown: {hint}"),
            Self::NotModelled { key, only, .. } => write!(f, "{key} is not modelled: {only}"),
            Self::Missing { key, with: [], .. } => write!(f, "{key} is missing"),
            Self::Missing { key, with, .. } => write!(f, "{key} is missing, it needs at least {}", with.join(", ")),
            Self::Neither { keys: [first, second], .. } => {
                write!(f, "one of {first} and {second} is needed, neither is given")
            }
            Self::Value { message, .. } => f.write_str(message),
        }
    }
}

impl fmt::Display for Hint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DidYouMean(key) => write!(f, "did you mean {key}?"),
            Self::BelongsTo(table) => write!(f, "it belongs to [{table}]"),
            Self::Takes([]) => f.write_str("its table has no keys"),
            Self::Takes(keys) => write!(f, "known here are {}", keys.join(", ")),
        }
    }
}

/// All faults, one a line if there are several.
fn list(faults: &[KeyFault]) -> String {
    match faults {
        [fault] => fault.to_string(),
        _ => faults.iter().fold(format!("{} faults", faults.len()), |text, fault| format!("{text}\n  {fault}")),
    }
}
