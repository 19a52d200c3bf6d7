//! What can be wrong with the keys of a scene file and with the values that stand for themselves.

use std::fmt;

/// One fault in the keys of a scene file.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum KeyFault {
    /// A key or a table that means nothing here.
    Unknown {
        /// Its line in the file, from 1.
        line: usize,
        /// The key with its table, `cage.slipp`; a table in brackets.
        key: String,
        /// What was meant, or what there is.
        hint: Hint,
    },
    /// A key that would say what the model cannot do.
    NotModelled {
        /// Its line in the file, from 1.
        line: usize,
        /// The key with its table; a table in brackets.
        key: String,
        /// What is modelled instead.
        only: &'static str,
    },
    /// A key or a table that is needed.
    Missing {
        /// Line of the table that lacks it, from 1; 0 for the file as a whole.
        line: usize,
        /// The key with its table; a table in brackets.
        key: String,
        /// The keys that a missing table needs.
        with: &'static [&'static str],
    },
    /// Neither of two keys of which one is needed.
    Neither {
        /// Line of the table that lacks them, from 1.
        line: usize,
        /// The two, each with its table.
        keys: [String; 2],
    },
    /// A value that is wrong whatever the rest of the file says, or keys that contradict each other.
    Value {
        /// Its line in the file, from 1; 0 where it is about several.
        line: usize,
        /// What is wrong.
        said: String,
    },
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
            Self::Value { said, .. } => f.write_str(said),
        }
    }
}

impl fmt::Display for Hint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DidYouMean(key) => write!(f, "did you mean {key}?"),
            Self::BelongsTo(table) => write!(f, "it belongs to [{table}]"),
            Self::Takes(keys) => write!(f, "known here are {}", keys.join(", ")),
        }
    }
}

/// All faults, one a line if there are several.
pub(super) fn list(faults: &[KeyFault]) -> String {
    match faults {
        [fault] => fault.to_string(),
        _ => faults.iter().fold(format!("{} faults", faults.len()), |text, fault| format!("{text}\n  {fault}")),
    }
}
