//! The quantities that stand in a scene file, with the limits of what is written there.

use brinell::scene::Bound::{Exclusive, Inclusive};
use brinell::scene::quantity::*;

/// Those of the file alone.
static OF_FILES: &[&Quantity] = &[
    // Twice as much as the radial clearance, which is what is checked.
    &quantity("internal clearance", "bearing.internal_clearance_um", 1e6, Inclusive(-2e9), Inclusive(2e9)),
    &quantity("density of the elements", "bearing.element_density_kg_m3", 1.0, Exclusive(0.0), Inclusive(1e5)),
    // What conformities leave with elements of any diameter that is possible.
    &quantity("groove diameter", "bearing.groove_diameter_mm", 1e3, Inclusive(0.01), Inclusive(4e6)),
    // As it is written in degrees, of any body.
    &quantity("spall length", "defect.length_deg", 1.0, Exclusive(0.0), Exclusive(360.0)),
    &quantity("axial clearance", "bearing.axial_clearance_um", 1e6, Inclusive(0.0), Inclusive(4e9)),
    &quantity("sensor direction", "sensor.direction", 1.0, Inclusive(-1e9), Inclusive(1e9)),
    &quantity("number of the element with the defect", "defect.element", 1.0, Inclusive(1.0), Inclusive(1000.0)),
    &quantity("number of the wavy element", "waviness.element", 1.0, Inclusive(1.0), Inclusive(1000.0)),
];

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
    let of_one = OF_KEYS.iter().chain(OF_FILES).copied().chain(SHAFT.all()).chain(HOUSING.all());
    of_one.map(|quantity| (quantity.key, quantity)).chain(of_two)
}
