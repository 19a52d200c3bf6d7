//! Units as FMI 2.0 wants them: a name and the exponents of the base units (standard, section 2.2.2).
//!
//! Everything is in SI, so no unit needs a factor or an offset of its own. The radian is a base unit of FMI.

use std::f64::consts::PI;

use brinell::simulation::interface::table::Unit;

/// A unit that a host shows instead.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DisplayUnit {
    /// Name.
    pub name: &'static str,
    /// Shown value = factor · value.
    pub factor: f64,
}

/// The unit's name, and its exponents of kilogram, metre, second and radian.
fn definition(unit: Unit) -> (&'static str, [i8; 4]) {
    match unit {
        Unit::One => ("1", [0, 0, 0, 0]),
        Unit::Kilogram => ("kg", [1, 0, 0, 0]),
        Unit::Metre => ("m", [0, 1, 0, 0]),
        Unit::Second => ("s", [0, 0, 1, 0]),
        Unit::Radian => ("rad", [0, 0, 0, 1]),
        Unit::MetrePerSecond => ("m/s", [0, 1, -1, 0]),
        Unit::MetrePerSecondSquared => ("m/s2", [0, 1, -2, 0]),
        Unit::RadianPerSecond => ("rad/s", [0, 0, -1, 1]),
        Unit::Newton => ("N", [1, 1, -2, 0]),
        Unit::NewtonMetre => ("N.m", [1, 2, -2, 0]),
        Unit::NewtonPerMetre => ("N/m", [1, 0, -2, 0]),
        Unit::NewtonSecondPerMetre => ("N.s/m", [1, 0, -1, 0]),
        Unit::SecondPerMetre => ("s/m", [0, -1, 1, 0]),
        Unit::RadianPerSecondSquared => ("rad/s2", [0, 0, -2, 1]),
        Unit::KilogramSquareMetre => ("kg.m2", [1, 2, 0, 0]),
        Unit::NewtonMetreSecondPerRadian => ("N.m.s/rad", [1, 2, -1, -1]),
        Unit::NewtonPerRadian => ("N/rad", [1, 1, -2, -1]),
        Unit::NewtonMetrePerRadian => ("N.m/rad", [1, 2, -2, -1]),
    }
}

/// The name of the unit in the model description, in CSV headers and in documentation.
pub fn name(unit: Unit) -> &'static str {
    definition(unit).0
}

/// The base units and their exponents.
pub fn base_units(unit: Unit) -> [(&'static str, i8); 4] {
    let [kg, m, s, rad] = definition(unit).1;
    [("kg", kg), ("m", m), ("s", s), ("rad", rad)]
}

/// The unit that a host shows instead, if there is one.
pub fn display_unit(unit: Unit) -> Option<DisplayUnit> {
    match unit {
        Unit::RadianPerSecond => Some(DisplayUnit { name: "rev/min", factor: 30.0 / PI }),
        _ => None,
    }
}
