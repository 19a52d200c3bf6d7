//! What is said of a name that is not in the catalogue.

use super::catalogue;
use super::clearance::ClearanceClass;
use crate::spelling::nearest;

/// A name that cannot be read as a bearing of the catalogue.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NotInCatalogue {
    /// A bearing that is not there.
    #[error("bearing.catalogue = {name:?} is not in the catalogue{hint}; `brinell catalogue` lists all, {OWN}")]
    Unknown {
        /// The name.
        name: String,
        /// What is there instead.
        hint: String,
    },
    /// An angular contact bearing without the letter of an angle that is there.
    #[error("bearing.catalogue = {name:?} says no contact angle of the catalogue: it has {known}{other}")]
    NoAngle {
        /// The name.
        name: String,
        /// Those of the same number.
        known: String,
        /// What to do for another angle.
        other: &'static str,
    },
    /// A name with two clearances.
    #[error("bearing.catalogue = {name:?} says two clearance classes, {one} and {other}: leave one out")]
    TwoClasses {
        /// The name.
        name: String,
        /// The first.
        one: ClearanceClass,
        /// The second.
        other: ClearanceClass,
    },
}

/// What a bearing takes that is no bearing of the catalogue.
const OWN: &str = "and one of your own has bearing.element_count, bearing.element_diameter_mm, \
    bearing.pitch_diameter_mm, bearing.groove_diameter_mm, bearing.youngs_modulus_gpa, bearing.poissons_ratio and \
    bearing.density_kg_m3 in place of the name (rollers: bearing.element = \"cylindrical-roller\" and \
    bearing.roller_length_mm for the groove)";
const OTHER_ANGLE: &str = "; bearing.contact_angle_deg beside one of them says another";

impl NotInCatalogue {
    /// A name of no bearing of the catalogue, with what is there of its family.
    pub(super) fn of(name: &str) -> Self {
        let plain = name.to_uppercase();
        let (letters, digits) = series(&plain);
        if letters == Some("") && digits.len() >= 4 {
            let angles: Vec<String> = catalogue()
                .filter_map(|bearing| {
                    let angle = bearing.inside.contact_angle?;
                    let own = bearing.designation.starts_with(&digits[..4]);
                    own.then(|| format!("{} with {angle} degrees", bearing.designation))
                })
                .collect();
            if !angles.is_empty() {
                return Self::NoAngle { name: name.to_owned(), known: angles.join(", "), other: OTHER_ANGLE };
            }
        }
        Self::Unknown { name: name.to_owned(), hint: letters.map_or_else(String::new, |letters| hint(letters, digits)) }
    }
}

/// The digits where a number may be, the first three or more, and NU of a roller bearing's letters in front of them;
/// `None` of another kind's.
fn series(name: &str) -> (Option<&'static str>, &str) {
    let runs = name.split(|c: char| !c.is_ascii_digit()).filter(|run| !run.is_empty());
    let digits = runs.clone().find(|run| run.len() >= 3).or_else(|| runs.clone().next()).unwrap_or_default();
    let front = name.split(digits).next().filter(|_| !digits.is_empty()).unwrap_or_default();
    let letters = front.trim_end_matches(|c: char| !c.is_ascii_alphabetic());
    let word = &letters[letters.rfind(|c: char| !c.is_ascii_alphabetic()).map_or(0, |at| at + 1)..];
    let letters = match word {
        "NUP" | "NU" | "NJ" | "N" => Some("NU"),
        // Makers, whose names are longer.
        _ if word.is_empty() || word.len() > 2 => Some(""),
        _ => None,
    };
    (letters, digits)
}

/// What the catalogue has of a series, or the name that was meant.
fn hint(letters: &str, digits: &str) -> String {
    let of_kind = || {
        let rollers = !letters.is_empty();
        catalogue().filter(move |bearing| bearing.inside.roller_length.is_some() == rollers).map(|b| b.designation)
    };
    // A series and a bore: 63 and 13, NU2 and 13.
    let bores = digits.len().checked_sub(2).filter(|length| *length == if letters.is_empty() { 2 } else { 1 });
    let named = bores.map(|length| format!("{letters}{}", &digits[..length]));
    let of_series: Vec<_> =
        named.iter().flat_map(|series| of_kind().filter(move |name| name.starts_with(series.as_str()))).collect();
    let meant = nearest(of_kind(), &format!("{letters}{digits}")).filter(|near| is_slip(near, digits));
    match (meant, named, &of_series[..]) {
        // Another series, of wider bearings.
        _ if !letters.is_empty() && digits.len() == 4 => {
            ": of cylindrical roller bearings it has NU2.. and NU3..".into()
        }
        (Some(near), ..) => format!(" (did you mean {near}?)"),
        (None, Some(series), [first, .., last]) => format!(": of {series}.. it has {first} to {last}"),
        _ => String::new(),
    }
}

/// Whether one name has the digits of the other in another order, or one more or less.
fn is_slip(name: &str, digits: &str) -> bool {
    let sorted = |text: &str| {
        let mut digits: Vec<char> = text.chars().filter(char::is_ascii_digit).collect();
        digits.sort_unstable();
        digits
    };
    let (known, given) = (sorted(name), sorted(digits));
    known == given || (!given.is_empty() && known.len().abs_diff(given.len()) == 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_is_not_there_is_answered_within_its_family() {
        for (name, expected) in [
            ("6313", ": of 63.. it has 6301 to 6312"),
            ("SKF 6313-2Z", ": of 63.. it has 6301 to 6312"),
            ("NU213", ": of NU2.. it has NU202 to NU212"),
            ("6250", " (did you mean 6205?)"),
            ("NJ 2205", ": of cylindrical roller bearings it has NU2.. and NU3.."),
            ("NU25", " (did you mean NU205?)"),
            ("UC205", ""),
            ("30205", ""),
            ("bearing", ""),
            ("", ""),
        ] {
            let NotInCatalogue::Unknown { hint, .. } = NotInCatalogue::of(name) else { panic!("{name}") };
            assert_eq!(hint, expected, "{name}");
        }
        for name in ["7208", "7208A", "SKF 7208-2RS", "7208 C3"] {
            let said = NotInCatalogue::of(name).to_string();
            assert!(["7208C with 15", "7208AC with 25", "7208B with 40"].iter().all(|known| said.contains(known)));
            assert!(!said.contains("6208"), "{said}");
        }
        let own = NotInCatalogue::of("UC204").to_string();
        let keys = ["element_count", "element_diameter_mm", "pitch_diameter_mm", "youngs_modulus_gpa", "density_kg_m3"];
        assert!(keys.iter().all(|key| own.contains(&format!("bearing.{key}"))), "{own}");
    }
}
