//! Numbers as people read them.

/// Six significant digits, without the trailing noughts that a change of units leaves.
pub(crate) fn digits(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let shown = format!("{value:.5e}").parse::<f64>().unwrap_or(value);
    shown.to_string()
}
