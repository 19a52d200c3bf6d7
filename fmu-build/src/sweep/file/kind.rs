//! What kinds of fault a sweep can have.

use brinell::scene::DefectOn;

/// A kind of fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::sweep) enum Kind {
    Healthy,
    Outer,
    Inner,
    Element,
}

impl Kind {
    /// As a file says it.
    pub(super) const ALL: [(&'static str, Self); 4] =
        [("healthy", Self::Healthy), ("outer", Self::Outer), ("inner", Self::Inner), ("element", Self::Element)];

    /// That of a defect.
    pub(in crate::sweep) fn of(on: DefectOn) -> Self {
        match on {
            DefectOn::Outer => Self::Outer,
            DefectOn::Inner => Self::Inner,
            DefectOn::Element { .. } => Self::Element,
        }
    }

    /// As a file says it.
    pub(in crate::sweep) fn word(self) -> &'static str {
        Self::ALL.iter().find(|(_, kind)| *kind == self).map_or("", |(word, _)| word)
    }

    /// As public collections of recordings say it.
    pub(in crate::sweep) fn field_word(self) -> &'static str {
        match self {
            Self::Healthy => "normal",
            Self::Element => "rolling_element",
            raceway => raceway.word(),
        }
    }
}
