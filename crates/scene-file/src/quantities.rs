//! The quantities that stand in a scene file, with the limits of what is written there.

use brinell::scene::Bound::{Exclusive, Inclusive};
use brinell::scene::quantity::*;

/// Twice as much as the radial clearance, which is what is checked.
const INTERNAL_CLEARANCE: Quantity =
    quantity("internal clearance", "bearing.internal_clearance_um", 1e6, Inclusive(-2e9), Inclusive(2e9));
/// What conformities leave with elements of any diameter that is possible.
const GROOVE_DIAMETER: Quantity =
    quantity("groove diameter", "bearing.groove_diameter_mm", 1e3, Inclusive(0.01), Inclusive(4e6));
/// As it is written in degrees, of any body.
const SPALL_LENGTH_DEG: Quantity = quantity("spall length", "defect.length_deg", 1.0, Exclusive(0.0), Exclusive(360.0));
const AXIAL_CLEARANCE: Quantity =
    quantity("axial clearance", "bearing.axial_clearance_um", 1e6, Inclusive(0.0), Inclusive(4e9));
const SENSOR_VECTOR: Quantity = quantity("sensor direction", "sensor.direction", 1.0, Inclusive(-1e9), Inclusive(1e9));
const DEFECT_ELEMENT: Quantity =
    quantity("number of the element with the defect", "defect.element", 1.0, Inclusive(1.0), Inclusive(1000.0));

const WAVINESS_ELEMENT: Quantity =
    quantity("number of the wavy element", "waviness.element", 1.0, Inclusive(1.0), Inclusive(1000.0));

/// The quantity of a key of the file, given with its table, with that key as it is known here.
pub(crate) fn of_key(key: &str) -> Option<(&'static str, &'static Quantity)> {
    written().find(|(known, _)| *known == key)
}

/// All numbers that the file says, by their keys.
pub(crate) fn written() -> impl Iterator<Item = (&'static str, &'static Quantity)> {
    let of_two = [
        ("bearing.conformity_inner", &CONFORMITY_INNER),
        ("bearing.conformity_outer", &CONFORMITY_OUTER),
        ("defect.length_mm", &SPALL_LENGTH),
    ];
    WRITTEN.iter().map(|quantity| (quantity.key, *quantity)).chain(of_two)
}

/// Those of one key in one unit.
static WRITTEN: [&Quantity; 85] = [
    &GRAVITY,
    &ELEMENT_COUNT,
    &ELEMENT_DIAMETER,
    &DIAMETER_OFFSET,
    &DIAMETER_RMS,
    &PITCH_DIAMETER,
    &CLEARANCE,
    &INTERNAL_CLEARANCE,
    &AXIAL_CLEARANCE,
    &CONTACT_ANGLE,
    &OPERATING_ANGLE,
    &SHOULDER_INNER,
    &SHOULDER_OUTER,
    &GROOVE_DIAMETER,
    &ROLLER_LENGTH,
    &ROLLER_LAMINAE,
    &YOUNGS_MODULUS,
    &POISSONS_RATIO,
    &DENSITY,
    &ELEMENT_MASS,
    &HERTZ_INNER,
    &HERTZ_OUTER,
    &OUTER_COMPLIANCE,
    &DAMPING_CHI,
    &DAMPING_TAU,
    &ACROSS_DAMPING,
    &LARGEST_FORCE,
    &CONTACT_CELLS,
    &MAP_ACCURACY,
    &VISCOSITY,
    &PRESSURE_VISCOSITY,
    &FILM_LAYER,
    &CAGE_SLIP,
    &CAGE_SPACING,
    &CAGE_SPACING_RMS,
    &CAGE_JITTER,
    &CAGE_WANDER,
    &INITIAL_ANGLE,
    &SHAFT_INITIAL_ANGLE,
    &HOUSING_INITIAL_ANGLE,
    &TILT,
    &DEFECT_ANGLE,
    &SPALL_LENGTH_DEG,
    &DEFECT_ELEMENT,
    &SPALL_DEPTH,
    &EDGE_SLOPE,
    &WAVINESS_ORDER,
    &WAVINESS_AMPLITUDE,
    &WAVINESS_ANGLE,
    &WAVINESS_ELEMENT,
    &HOUSING_SPEED,
    &SPEED,
    &SENSOR_DIRECTION,
    &SENSOR_VECTOR,
    &SENSOR_MASS,
    &SENSOR_STIFFNESS,
    &SENSOR_DAMPING,
    &SENSOR_MODE_FREQUENCY,
    &SENSOR_MODE_DAMPING_RATIO,
    &SENSOR_MODE_GAIN,
    &SENSOR_MODE_QUADRATURE_GAIN,
    &TOLERANCE,
    &MAX_STEPS,
    &RECORDER_RATE,
    &STOP,
    &STEP,
    &SHAFT.load,
    &SHAFT.mass,
    &SHAFT.damping,
    &SHAFT.stiffness,
    &SHAFT.preload,
    &SHAFT.axial_damping,
    &SHAFT.axial_stiffness,
    &LOAD_MOMENT,
    &TRANSVERSE_INERTIA,
    &POLAR_INERTIA,
    &TILT_DAMPING,
    &TILT_STIFFNESS,
    &HOUSING.load,
    &HOUSING.mass,
    &HOUSING.damping,
    &HOUSING.stiffness,
    &HOUSING.preload,
    &HOUSING.axial_damping,
    &HOUSING.axial_stiffness,
];
