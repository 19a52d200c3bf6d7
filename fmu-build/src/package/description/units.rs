//! Units as FMI 2.0 wants them: a name and the exponents of the base units (standard, section 2.2.2).
//!
//! Everything is in SI, so no unit needs a factor or an offset of its own. The radian is a base unit of FMI.

use std::f64::consts::PI;

use brinell::simulation::interface::table::Unit;

/// The unit's name, its quantity (the Modelica library's, empty where it has none), and its exponents of kilogram,
/// metre, second and radian.
fn definition(unit: Unit) -> (&'static str, &'static str, [i8; 4]) {
    match unit {
        Unit::One => ("1", "", [0, 0, 0, 0]),
        Unit::Kilogram => ("kg", "Mass", [1, 0, 0, 0]),
        Unit::Metre => ("m", "Length", [0, 1, 0, 0]),
        Unit::Second => ("s", "Time", [0, 0, 1, 0]),
        Unit::Radian => ("rad", "Angle", [0, 0, 0, 1]),
        Unit::MetrePerSecond => ("m/s", "Velocity", [0, 1, -1, 0]),
        Unit::MetrePerSecondSquared => ("m/s2", "Acceleration", [0, 1, -2, 0]),
        Unit::RadianPerSecond => ("rad/s", "AngularVelocity", [0, 0, -1, 1]),
        Unit::Newton => ("N", "Force", [1, 1, -2, 0]),
        Unit::NewtonMetre => ("N.m", "Torque", [1, 2, -2, 0]),
        Unit::NewtonPerMetre => ("N/m", "TranslationalSpringConstant", [1, 0, -2, 0]),
        Unit::NewtonSecondPerMetre => ("N.s/m", "TranslationalDampingConstant", [1, 0, -1, 0]),
        Unit::SecondPerMetre => ("s/m", "", [0, -1, 1, 0]),
        Unit::RadianPerSecondSquared => ("rad/s2", "AngularAcceleration", [0, 0, -2, 1]),
        Unit::KilogramSquareMetre => ("kg.m2", "MomentOfInertia", [1, 2, 0, 0]),
        Unit::NewtonMetreSecondPerRadian => ("N.m.s/rad", "RotationalDampingConstant", [1, 2, -1, -1]),
        Unit::NewtonPerRadian => ("N/rad", "", [1, 1, -2, -1]),
        Unit::NewtonMetrePerRadian => ("N.m/rad", "RotationalSpringConstant", [1, 2, -2, -1]),
        Unit::Hertz => ("Hz", "Frequency", [0, 0, -1, 0]),
        Unit::PascalSecond => ("Pa.s", "DynamicViscosity", [1, -1, -1, 0]),
    }
}

/// The name of the unit in the model description, in CSV headers and in documentation.
pub fn name(unit: Unit) -> &'static str {
    definition(unit).0
}

/// Its quantity as the Modelica library calls it, which is the name of its type as well.
pub fn quantity(unit: Unit) -> Option<&'static str> {
    Some(definition(unit).1).filter(|quantity| !quantity.is_empty())
}

/// What a variable's description says of its unit.
pub(super) fn attributes(unit: Unit, nominal: f64) -> Vec<(&'static str, String)> {
    let mut attributes = vec![("unit", name(unit).to_owned())];
    attributes.extend(quantity(unit).map(|name| ("declaredType", name.to_owned())));
    attributes.extend(display_unit(unit, nominal).map(|(name, _)| ("displayUnit", name.to_owned())));
    attributes
}

/// The base units and their exponents.
pub fn base_units(unit: Unit) -> [(&'static str, i8); 4] {
    let [kg, m, s, rad] = definition(unit).2;
    [("kg", kg), ("m", m), ("s", s), ("rad", rad)]
}

/// The units that a host may show instead: name, and shown value over value; the first is that of the type.
pub fn display_units(unit: Unit) -> &'static [(&'static str, f64)] {
    match unit {
        Unit::RadianPerSecond => &[("rev/min", 30.0 / PI)],
        Unit::Radian => &[("deg", 180.0 / PI)],
        Unit::Metre => &[("mm", 1e3), ("um", 1e6)],
        _ => &[],
    }
}

/// The unit in which a host shows values of this order of magnitude.
pub fn display_unit(unit: Unit, nominal: f64) -> Option<(&'static str, f64)> {
    let shown = display_units(unit);
    // From below a tenth of the larger unit on, the smaller one.
    shown.iter().find(|(_, factor)| factor * nominal >= 0.1).or(shown.last()).copied()
}
