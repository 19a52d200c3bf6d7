//! Where a file is not TOML.

use toml::de::{DeTable, Error};

/// The first place at which a text is not TOML, with its line and why; `None` for TOML.
///
/// The parser goes on behind a fault and does not know where the value or table that broke off was to end: most of what
/// it finds then follows from the first fault, which need not come first in its list.
pub fn toml_fault(text: &str) -> Option<Error> {
    let (_, faults) = DeTable::parse_recoverable(text);
    faults.into_iter().min_by_key(|fault| fault.span().map_or(0, |at| at.start))
}
