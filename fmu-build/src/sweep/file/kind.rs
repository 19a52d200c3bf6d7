//! What kinds of fault a sweep can have.

/// A kind of fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::sweep) enum Kind {
    Healthy,
    Outer,
    Inner,
    Element,
}

impl Kind {
    pub(super) const ALL: [(&'static str, Self); 4] =
        [("healthy", Self::Healthy), ("outer", Self::Outer), ("inner", Self::Inner), ("element", Self::Element)];

    /// As a file says it.
    pub(in crate::sweep) fn word(self) -> &'static str {
        Self::ALL.iter().find(|(_, kind)| *kind == self).map_or("", |(word, _)| word)
    }
}
