//! Numbers of the command line: what is none is told in plain words. Negative ones are taken for numbers, not for
//! options, so that the command itself says what is wrong with them.

/// Any number.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| "it must be a number".to_owned())
}

/// A whole number of this range.
pub(crate) fn whole<const LEAST: u32, const MOST: u32>(text: &str) -> Result<u32, String> {
    let number = text.trim().parse().ok().filter(|number| (LEAST..=MOST).contains(number));
    number.ok_or_else(|| format!("it must be a whole number from {LEAST} to {MOST}"))
}

/// What says which of all random courses is taken.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    text.trim().parse().map_err(|_| "it must be a whole number, 0 or more".to_owned())
}
