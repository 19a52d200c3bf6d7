//! Numbers of the command line: invalid ones are refused in plain words. Negative ones are taken for numbers, not for
//! options, so that the command itself says what is wrong with them. And numbers as people read them.

use std::path::PathBuf;

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

/// A pressure in gigapascals, from 1 to 20, as `6` or `6GPa`: softer than any raceway to harder than any.
pub(crate) fn gigapascals(text: &str) -> Result<f64, String> {
    let text = text.trim().to_ascii_lowercase();
    let value = text.strip_suffix("gpa").unwrap_or(&text).trim().parse().ok();
    value
        .filter(|limit| (1.0..=20.0).contains(limit))
        .ok_or_else(|| "it must be a number of GPa from 1 to 20".to_owned())
}

/// A rate in hertz: a number of them, or one with its unit, as `51.2kHz`.
pub(crate) fn rate(text: &str) -> Result<f64, String> {
    let text = text.trim().to_ascii_lowercase();
    let units = [("khz", 1e3), ("mhz", 1e6), ("hz", 1.0)];
    let (number, hertz) =
        units.iter().find_map(|(unit, hertz)| Some((text.strip_suffix(unit)?, *hertz))).unwrap_or((&text, 1.0));
    let value: f64 =
        number.trim().parse().map_err(|_| "it must be a number of Hz, or of kHz as in 51.2kHz".to_owned())?;
    Ok(value * hertz)
}

/// A speed in hertz: a number of them, or one with its unit.
pub(crate) fn speed(text: &str) -> Result<f64, String> {
    let text = text.trim().to_ascii_lowercase();
    let units = [("rpm", 1.0 / 60.0), ("rev/min", 1.0 / 60.0), ("1/min", 1.0 / 60.0), ("hz", 1.0)];
    let (number, hertz) =
        units.iter().find_map(|(unit, hertz)| Some((text.strip_suffix(unit)?, *hertz))).unwrap_or((&text, 1.0));
    let value: f64 =
        number.trim().parse().map_err(|_| "it must be a number of Hz, or of rpm as in 1797rpm".to_owned())?;
    Ok(value * hertz)
}

/// A sign between columns, by itself or by its name.
pub(crate) fn delimiter(text: &str) -> Result<char, String> {
    let mut characters = text.chars();
    match (text, characters.next(), characters.next()) {
        ("tab" | "\\t", ..) => Ok('\t'),
        ("blank" | "blanks", ..) => Ok(' '),
        (_, Some(sign), None) => Ok(sign),
        _ => Err("it must be one sign, or tab, or blank".to_owned()),
    }
}

/// The file of a page in HTML.
pub(crate) fn html_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if ending == "html" || ending == "htm" { Ok(path) } else { Err("it is a page in HTML: name it .html".to_owned()) }
}

/// Six significant digits, without the trailing zeros that a change of units leaves.
pub(crate) fn digits(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let shown = format!("{value:.5e}").parse::<f64>().unwrap_or(value);
    shown.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_are_hertz_unless_they_have_another_unit() {
        assert_eq!(
            ["29.95", "29.95 Hz", "1797rpm", "600 rev/min"].map(|text| speed(text).unwrap()),
            [29.95, 29.95, 1797.0 / 60.0, 10.0]
        );
        assert_eq!(
            ["51200", "51.2kHz", "51.2 khz", "51200 Hz", "0.0512MHz"].map(|text| rate(text).unwrap()),
            [51_200.0; 5]
        );
        assert!(rate("kHz").is_err() && rate("51.2k").is_err() && rate("51,2kHz").is_err());
        assert!(speed("fast").is_err() && speed("rpm").is_err() && speed("10 m/s").is_err());
        assert_eq!(["tab", "\\t", "blank", ";"].map(|text| delimiter(text).unwrap()), ['\t', '\t', ' ', ';']);
        assert!(delimiter(";;").is_err() && delimiter("").is_err());
    }
}
