//! The rules, in our words, and what shows each.

mod calls;
mod fmi3;
mod host;
mod instance;

/// What shows a rule.
pub(crate) enum Evidence {
    /// A test of the workspace, by its name.
    Test(&'static str),
    /// A command and the figure it gave.
    Measured(&'static str, &'static str),
    /// Not shown here, and why.
    Not(&'static str),
}

/// Section, rule, evidence.
pub(crate) type Rule = (&'static str, &'static str, &'static [Evidence]);

/// What FMI 3.0 asks beside that, section by section.
pub(crate) fn rules_of_fmi3() -> impl Iterator<Item = &'static Rule> {
    fmi3::RULES.iter()
}

/// All rules of FMI 2.0, section by section.
pub(crate) fn rules() -> impl Iterator<Item = &'static Rule> {
    [instance::RULES, calls::RULES, host::RULES].into_iter().flatten()
}
