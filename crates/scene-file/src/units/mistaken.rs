//! Which unit was probably meant by a value that is far off in the unit of its key.

use brinell::scene::Plain;
use brinell::scene::quantity::shown;
use std::fmt;

/// How a key ends, its unit as it is shown, and units for which that one is taken: how many of the key's unit they are.
type Mistaken = (&'static str, &'static str, &'static [(f64, &'static str)]);

/// The first ending that fits counts.
const MISTAKEN: [Mistaken; 22] = [
    ("_m_s2", "m/s2", &[(1e-3, "mm/s2"), (9.806_65, "multiples of g"), (1e3, "km/s2")]),
    ("_kg_m3", "kg/m3", &[(1e3, "g/cm3"), (1e12, "t/mm3")]),
    // 1000^1.5.
    ("_n_m1_5", "N/m^1.5", &[(31_622.776_601_683_792, "N/mm^1.5")]),
    ("_n_s_m", "N s/m", &[(1e3, "N s/mm")]),
    ("_n_m_s", "N m s/rad", &[(1e-3, "N mm s/rad")]),
    ("_n_m_rad", "N m/rad", &[(1e-3, "N mm/rad")]),
    ("_moment_n_m", "N m", &[(1e-3, "N mm")]),
    ("_kg_m2", "kg m2", &[(1e-6, "kg mm2"), (1e-4, "kg cm2")]),
    ("_n_m", "N/m", &[(1e3, "N/mm"), (1e6, "N/um"), (1e-3, "mN/m")]),
    ("_m_n", "m/N", &[(1e-3, "mm/N"), (1e-6, "um/N"), (1e-9, "nm/N")]),
    ("_1_pa", "1/Pa", &[(1e-9, "1/GPa"), (1e-6, "1/MPa")]),
    ("_pa_s", "Pa s", &[(1e-3, "mPa s"), (0.1, "poise")]),
    ("_s_m", "s/m", &[]),
    ("_deg", "degrees", &[(180.0 / std::f64::consts::PI, "radians")]),
    ("_mm", "mm", &[(1e3, "metres"), (1e-3, "micrometres"), (25.4, "inches")]),
    ("_um", "um", &[(1e3, "millimetres"), (1e6, "metres"), (1e-3, "nanometres")]),
    // A pound per square inch is 6894.757 Pa.
    ("_gpa", "GPa", &[(1e-3, "MPa"), (1e-9, "Pa"), (6.894_757e-6, "psi")]),
    ("_hz", "Hz", &[(1.0 / 60.0, "rev/min"), (1e3, "kHz")]),
    ("_kg", "kg", &[(1e-3, "grams"), (1e3, "tonnes")]),
    ("_g", "g", &[(1e3, "kilograms"), (1e-3, "milligrams")]),
    ("_n", "N", &[(1e3, "kN"), (1e-3, "mN")]),
    ("_s", "s", &[(1e-3, "milliseconds"), (1e-6, "microseconds")]),
];
/// Of keys without a unit.
const SHARES: Mistaken = ("_ratio", "", &[(1e-2, "percent")]);

/// A value far from what is usual, and usual if it was given in another unit than its key's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitQuestion {
    /// The key of the scene file with its table.
    pub key: &'static str,
    /// The value as it is written.
    pub value: f64,
    /// What was probably meant, in the key's unit.
    pub meant: f64,
    /// The key's unit.
    pub unit: &'static str,
    /// The unit in which it was probably given.
    pub given: &'static str,
    /// Smallest and largest size that is usual, in the key's unit.
    pub usual: [f64; 2],
    /// Where that is from.
    pub source: &'static str,
}

impl fmt::Display for UnitQuestion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let space = if self.unit.is_empty() { "" } else { " " };
        // Six digits: units are converted by factors that have more.
        let meant = Plain(format!("{:.5e}", self.meant).parse().unwrap_or(self.meant));
        write!(f, "{meant}{space}{} given in {}?", self.unit, self.given)
    }
}

/// What was meant by the `value` of a key if that has a `usual` size in another unit: in the key's unit, that unit, and
/// the one in which it was probably given. `None` for a value that is usual as it stands, that is 0, or that no unit
/// makes usual.
pub(super) fn meant(key: &str, value: f64, usual: [f64; 2]) -> Option<(f64, &'static str, &'static str)> {
    let fits = |value: f64| (usual[0]..=usual[1]).contains(&value.abs());
    let (_, unit, others) = MISTAKEN.iter().chain([&SHARES]).find(|(ending, ..)| key.ends_with(ending))?;
    if value == 0.0 || !value.is_finite() || fits(value) {
        return None;
    }
    let (factor, given) = others.iter().find(|(factor, _)| fits(value * factor))?;
    Some((shown(value * factor), unit, given))
}
