//! Which unit was probably meant by a value that is far off in the unit of its key.

/// Units for which that of a key is taken, by how the key ends, and how many of the key's unit they are.
const MISTAKEN: [(&str, &[(f64, &str)]); 6] = [
    ("_mm", &[(1e3, "metres"), (1e-3, "micrometres"), (25.4, "inches")]),
    ("_um", &[(1e3, "millimetres"), (1e6, "metres")]),
    ("_gpa", &[(1e-3, "MPa"), (1e-9, "Pa")]),
    ("_kg_m3", &[(1e3, "g/cm³"), (1e12, "t/mm³")]),
    ("_hz", &[(1.0 / 60.0, "rev/min")]),
    ("_s", &[(1e-3, "milliseconds"), (1e-6, "microseconds")]),
];

/// The unit in which the value of this key would be `possible`, which it is not as it stands.
pub(super) fn meant(key: &str, value: f64, possible: impl Fn(f64) -> bool) -> Option<&'static str> {
    let (_, units) = MISTAKEN.iter().find(|(unit, _)| key.ends_with(unit))?;
    let meant = units.iter().find(|(factor, _)| possible(value * factor));
    meant.map(|(_, unit)| *unit).filter(|_| !possible(value))
}
