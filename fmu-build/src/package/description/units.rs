//! Units as FMI 2.0 wants them: a name and the exponents of the base units (standard, section 2.2.2).
//!
//! Everything is in SI, so no unit needs a factor or an offset of its own. The radian is a base unit of FMI.

use std::f64::consts::PI;

use brinell::simulation::interface::table::Unit;

/// Exponents of the base units.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct BaseUnit {
    /// Kilogram.
    pub kg: i8,
    /// Metre.
    pub m: i8,
    /// Second.
    pub s: i8,
    /// Radian.
    pub rad: i8,
}

/// A unit that a host shows instead.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DisplayUnit {
    /// Name.
    pub name: &'static str,
    /// Shown value = factor · value.
    pub factor: f64,
}

/// The name of the unit in the model description, in CSV headers and in documentation.
pub fn name(unit: Unit) -> &'static str {
    match unit {
        Unit::One => "1",
        Unit::Kilogram => "kg",
        Unit::Metre => "m",
        Unit::Second => "s",
        Unit::Radian => "rad",
        Unit::MetrePerSecond => "m/s",
        Unit::MetrePerSecondSquared => "m/s2",
        Unit::RadianPerSecond => "rad/s",
        Unit::Newton => "N",
        Unit::NewtonMetre => "N.m",
        Unit::NewtonPerMetre => "N/m",
        Unit::NewtonSecondPerMetre => "N.s/m",
        Unit::SecondPerMetre => "s/m",
    }
}

/// The unit in base units.
pub fn base_unit(unit: Unit) -> BaseUnit {
    let none = BaseUnit::default();
    match unit {
        Unit::One => none,
        Unit::Kilogram => BaseUnit { kg: 1, ..none },
        Unit::Metre => BaseUnit { m: 1, ..none },
        Unit::Second => BaseUnit { s: 1, ..none },
        Unit::Radian => BaseUnit { rad: 1, ..none },
        Unit::MetrePerSecond => BaseUnit { m: 1, s: -1, ..none },
        Unit::MetrePerSecondSquared => BaseUnit { m: 1, s: -2, ..none },
        Unit::RadianPerSecond => BaseUnit { rad: 1, s: -1, ..none },
        Unit::Newton => BaseUnit { kg: 1, m: 1, s: -2, ..none },
        Unit::NewtonMetre => BaseUnit { kg: 1, m: 2, s: -2, ..none },
        Unit::NewtonPerMetre => BaseUnit { kg: 1, s: -2, ..none },
        Unit::NewtonSecondPerMetre => BaseUnit { kg: 1, s: -1, ..none },
        Unit::SecondPerMetre => BaseUnit { m: -1, s: 1, ..none },
    }
}

/// The unit that a host shows instead, if there is one.
pub fn display_unit(unit: Unit) -> Option<DisplayUnit> {
    match unit {
        Unit::RadianPerSecond => Some(DisplayUnit { name: "rev/min", factor: 30.0 / PI }),
        _ => None,
    }
}
