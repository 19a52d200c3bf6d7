//! The quantities of a scene: what each is called, its key in a scene file, its unit there and the limits that depend
//! on nothing else.
#![allow(missing_docs)]

use crate::scene::{Bound, Limits, MOST_SENSOR_MODES, MOST_SENSORS, SceneError};
use Bound::{Exclusive, Inclusive};
use std::f64::consts::{PI, TAU};

/// A quantity with limits that depend on nothing else.
pub struct Quantity {
    quantity: &'static str,
    /// Its key in a scene file, with its table.
    pub key: &'static str,
    /// Key's unit per SI unit.
    per_si: f64,
    /// Limits in the key's unit.
    low: Bound,
    high: Bound,
}

/// Those of a ring.
pub struct RingQuantities {
    pub load: Quantity,
    pub mass: Quantity,
    pub damping: Quantity,
    pub stiffness: Quantity,
    pub preload: Quantity,
    pub axial_damping: Quantity,
    pub axial_stiffness: Quantity,
}

impl RingQuantities {
    /// All of them.
    pub fn all(&self) -> [&Quantity; 7] {
        let Self { load, mass, damping, stiffness, preload, axial_damping, axial_stiffness } = self;
        [load, mass, damping, stiffness, preload, axial_damping, axial_stiffness]
    }
}

impl Quantity {
    /// Checks a value in SI units.
    pub fn check(&self, si: f64) -> Result<(), SceneError> {
        let limits = self.limits();
        let value = si * self.per_si;
        // Rounding to twelve digits matters close to a limit only, and takes its time.
        if limits.hold(value) && limits.hold(value * (1.0 + 1e-11)) && limits.hold(value * (1.0 - 1e-11)) {
            return Ok(());
        }
        let value = shown(value);
        if limits.hold(value) {
            return Ok(());
        }
        Err(SceneError::OutOfRange { quantity: self.quantity, key: self.key, value, limits })
    }

    /// What it may be, in the key's unit.
    pub fn limits(&self) -> Limits {
        Limits { low: self.low, high: self.high }
    }

    /// The ends of what it may be, in SI units.
    pub fn si_limits(&self) -> [f64; 2] {
        [self.low, self.high].map(|bound| match bound {
            Inclusive(limit) | Exclusive(limit) => limit / self.per_si,
        })
    }

    /// Checks a value of a key in the key's unit, as it stands in the file.
    pub fn check_written(&self, key: &'static str, value: f64) -> Result<(), SceneError> {
        let limits = self.limits();
        if limits.hold(value) {
            return Ok(());
        }
        Err(SceneError::OutOfRange { quantity: self.quantity, key, value, limits })
    }

    pub(super) fn check_all(&self, si: &[f64]) -> Result<(), SceneError> {
        si.iter().try_for_each(|&value| self.check(value))
    }
}

/// Twelve digits: takes back the rounding of the conversion, so that 90 degrees are 90 again.
pub fn shown(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

/// Smallest conformity. Below it the contact ellipse is longer than a groove is wide, and at 0.5 it has no end.
pub const SMALLEST_CONFORMITY: f64 = 0.5001;

/// Largest conformity of grooves on which balls run at a contact angle.
pub const LARGEST_CONFORMITY_OF_ANGLES: f64 = 0.6;

/// A quantity by its name, its key, the key's unit per SI unit, and its limits in the key's unit.
pub const fn quantity(quantity: &'static str, key: &'static str, per_si: f64, low: Bound, high: Bound) -> Quantity {
    Quantity { quantity, key, per_si, low, high }
}

const DEG: f64 = 180.0 / PI;
const HZ: f64 = 1.0 / TAU;

/// Constants of quantities that stand in a scene file under one key in one unit, and the list of all of them.
macro_rules! of_keys {
    ($($(#[$doc:meta])* $name:ident: $quantity:expr, $key:expr, $per_si:expr, $low:expr, $high:expr;)*) => {
        $($(#[$doc])* pub const $name: Quantity = quantity($quantity, $key, $per_si, $low, $high);)*
        /// Those of one key in one unit; those of rings are in [`SHAFT`] and [`HOUSING`].
        pub static OF_KEYS: &[&Quantity] = &[$(&$name),*];
    };
}

of_keys! {
    GRAVITY: "gravity", "gravity_m_s2", 1.0, Inclusive(-1e6), Inclusive(1e6);
    ELEMENT_COUNT: "number of elements", "bearing.element_count", 1.0, Inclusive(1.0), Inclusive(1000.0);
    ELEMENT_DIAMETER: "element diameter", "bearing.element_diameter_mm", 1e3, Inclusive(0.01), Inclusive(2e3);
    DIAMETER_OFFSET: "diameter of an element beyond the nominal one",
        "bearing.element_diameter_offsets_um", 1e6, Inclusive(-2e3), Inclusive(2e3);
    DIAMETER_RMS: "root mean square of the diameters about the nominal one",
        "bearing.element_diameter_rms_um", 1e6, Inclusive(0.0), Inclusive(2e3);
    ROLLER_LENGTH: "effective roller length", "bearing.roller_length_mm", 1e3, Inclusive(0.003), Inclusive(6e3);
    ROLLER_LAMINAE: "number of laminae of a roller", "bearing.roller_laminae", 1.0, Inclusive(10.0), Inclusive(1000.0);
    PITCH_DIAMETER: "pitch diameter", "bearing.pitch_diameter_mm", 1e3, Inclusive(0.01), Inclusive(2e4);
    CLEARANCE: "radial clearance", "bearing.radial_clearance_um", 1e6, Inclusive(-1e9), Inclusive(1e9);
    /// Steeper ones are those of thrust bearings.
    CONTACT_ANGLE: "contact angle", "bearing.contact_angle_deg", DEG, Inclusive(-60.0), Inclusive(60.0);
    OPERATING_ANGLE: "operating contact angle", "bearing.operating_angle_deg", DEG, Inclusive(-70.0), Inclusive(70.0);
    SHOULDER_INNER: "height of the inner ring's shoulder",
        "bearing.shoulder_inner_mm", 1e3, Exclusive(0.0), Inclusive(2e3);
    SHOULDER_OUTER: "height of the outer ring's shoulder",
        "bearing.shoulder_outer_mm", 1e3, Exclusive(0.0), Inclusive(2e3);
    YOUNGS_MODULUS: "Young's modulus", "bearing.youngs_modulus_gpa", 1e-9, Inclusive(1e-3), Inclusive(1e4);
    POISSONS_RATIO: "Poisson's ratio", "bearing.poissons_ratio", 1.0, Exclusive(-1.0), Exclusive(0.5);
    ELEMENT_YOUNGS_MODULUS: "Young's modulus of the elements",
        "bearing.element_youngs_modulus_gpa", 1e-9, Inclusive(1e-3), Inclusive(1e4);
    ELEMENT_POISSONS_RATIO: "Poisson's ratio of the elements",
        "bearing.element_poissons_ratio", 1.0, Exclusive(-1.0), Exclusive(0.5);
    DENSITY: "density of the elements", "bearing.density_kg_m3", 1.0, Exclusive(0.0), Inclusive(1e5);
    ELEMENT_MASS: "mass of one element", "bearing.element_mass_g", 1e3, Inclusive(1e-9), Inclusive(1e9);
    HERTZ_INNER: "Hertz constant of the inner contact",
        "bearing.hertz_inner_n_m1_5", 1.0, Inclusive(1.0), Inclusive(1e15);
    HERTZ_OUTER: "Hertz constant of the outer contact",
        "bearing.hertz_outer_n_m1_5", 1.0, Inclusive(1.0), Inclusive(1e15);
    /// 1e-3 m/N are softer than a rubber mount: no ring seat is.
    OUTER_COMPLIANCE: "outer compliance", "bearing.outer_compliance_m_n", 1.0, Inclusive(0.0), Inclusive(1e-3);
    DAMPING_CHI: "contact damping", "contact.damping_chi_s_m", 1.0, Inclusive(0.0), Inclusive(1e3);
    ACROSS_DAMPING: "damping across the groove", "contact.across_damping_s_m", 1.0, Inclusive(0.0), Inclusive(1e3);
    DAMPING_TAU: "contact damping", "contact.damping_tau_s", 1.0, Inclusive(0.0), Inclusive(1.0);
    /// From fuel to grease's base oil in the cold.
    VISCOSITY: "viscosity of the film", "film.viscosity_pa_s", 1.0, Inclusive(1e-4), Inclusive(10.0);
    PRESSURE_VISCOSITY: "pressure coefficient of the film's viscosity",
        "film.pressure_viscosity_1_pa", 1.0, Inclusive(0.5e-8), Inclusive(4e-8);
    FILM_LAYER: "height of the film's oil", "film.layer_um", 1e6, Inclusive(0.01), Inclusive(1e4);
    HOST_MASS: "mass that the host moves", "host.mass_kg", 1.0, Inclusive(1e-6), Inclusive(1e9);
    LARGEST_FORCE: "largest contact force", "contact.largest_force_n", 1.0, Inclusive(1e-3), Inclusive(1e9);
    /// Fewer are no grid, more take minutes.
    CONTACT_CELLS: "number of cells of the contact grid", "contact.cells", 1.0, Inclusive(8.0), Inclusive(256.0);
    /// Finer than the steps of any grid.
    MAP_ACCURACY: "accuracy of the contact map", "contact.map_accuracy", 1.0, Inclusive(1e-5), Inclusive(0.1);
    CAGE_SLIP: "cage slip", "cage.slip", 1.0, Inclusive(0.0), Inclusive(1.0);
    CAGE_SPACING: "offset of an element in the cage", "cage.spacing_deg", DEG, Inclusive(-90.0), Inclusive(90.0);
    CAGE_SPACING_RMS: "offsets of elements in the cage", "cage.spacing_rms_deg", DEG, Inclusive(0.0), Inclusive(90.0);
    CAGE_JITTER: "jitter of the elements in the cage", "cage.jitter_rms_deg", DEG, Inclusive(0.0), Inclusive(90.0);
    CAGE_WANDER: "wander of the cage's speed", "cage.wander", 1.0, Inclusive(0.0), Inclusive(0.1);
    INITIAL_ANGLE: "initial cage angle", "cage.initial_angle_deg", DEG, Inclusive(-36e3), Inclusive(36e3);
    SHAFT_INITIAL_ANGLE: "initial angle of the shaft",
        "shaft.initial_angle_deg", DEG, Inclusive(-36e3), Inclusive(36e3);
    HOUSING_INITIAL_ANGLE: "initial angle of the housing",
        "housing.initial_angle_deg", DEG, Inclusive(-36e3), Inclusive(36e3);
    /// Beyond it the track is nowhere near the pit of any ball.
    TILT: "tilt of the defect off the rolling track", "defect.tilt_deg", DEG, Inclusive(-90.0), Inclusive(90.0);
    DEFECT_ANGLE: "defect angle", "defect.angle_deg", DEG, Inclusive(-36e3), Inclusive(36e3);
    SPALL_DEPTH: "spall depth", "defect.depth_um", 1e6, Exclusive(0.0), Inclusive(1e9);
    EDGE_SLOPE: "edge slope", "defect.edge_slope_deg", DEG, Exclusive(0.0), Inclusive(90.0);
    WAVINESS_ORDER: "number of waves around a body", "waviness.order", 1.0, Inclusive(1.0), Inclusive(1000.0);
    WAVINESS_AMPLITUDE: "amplitude of waviness", "waviness.amplitude_um", 1e6, Inclusive(0.0), Inclusive(1e3);
    WAVINESS_ANGLE: "angle of a crest of waviness", "waviness.angle_deg", DEG, Inclusive(-36e3), Inclusive(36e3);
    LOAD_MOMENT: "moment on the shaft", "shaft.load_moment_n_m", 1.0, Inclusive(-1e9), Inclusive(1e9);
    TRANSVERSE_INERTIA: "transverse inertia of the shaft",
        "shaft.transverse_inertia_kg_m2", 1.0, Inclusive(1e-12), Inclusive(1e9);
    POLAR_INERTIA: "polar inertia of the shaft", "shaft.polar_inertia_kg_m2", 1.0, Inclusive(1e-12), Inclusive(1e9);
    TILT_DAMPING: "tilt damping of the shaft", "shaft.tilt_damping_n_m_s", 1.0, Inclusive(0.0), Inclusive(1e12);
    TILT_STIFFNESS: "tilt stiffness of the shaft", "shaft.tilt_stiffness_n_m_rad", 1.0, Inclusive(0.0), Inclusive(1e15);
    /// 10 kHz are 600 000 rev/min: a steel ring of any size bursts before.
    HOUSING_SPEED: "speed of the housing", "housing.speed_hz", HZ, Inclusive(-1e4), Inclusive(1e4);
    SPEED: "shaft speed", "shaft.speed_hz", HZ, Inclusive(-1e4), Inclusive(1e4);
    SENSOR_DIRECTION: "sensor direction", "sensor.direction_deg", DEG, Inclusive(-1e3), Inclusive(1e3);
    SENSOR_MASS: "sensor mass", "sensor.mass_kg", 1.0, Inclusive(1e-9), Inclusive(1e9);
    SENSOR_STIFFNESS: "sensor stiffness", "sensor.stiffness_n_m", 1.0, Exclusive(0.0), Inclusive(1e15);
    SENSOR_DAMPING: "sensor damping", "sensor.damping_n_s_m", 1.0, Inclusive(0.0), Inclusive(1e12);
    SENSOR_MODE_FREQUENCY: "frequency of a sensor's mode",
        "sensor.mode.frequency_hz", 1.0, Inclusive(1.0), Inclusive(1e6);
    SENSOR_MODE_DAMPING_RATIO: "damping ratio of a sensor's mode",
        "sensor.mode.damping_ratio", 1.0, Exclusive(0.0), Inclusive(1.0);
    SENSOR_MODE_QUADRATURE_GAIN: "quadrature gain of a sensor's mode",
        "sensor.mode.quadrature_gain", 1.0, Inclusive(-1e3), Inclusive(1e3);
    SENSOR_MODE_GAIN: "gain of a sensor's mode", "sensor.mode.gain", 1.0, Inclusive(-1e3), Inclusive(1e3);
    TOLERANCE: "tolerance", "solver.tolerance", 1.0, Inclusive(1e-12), Inclusive(0.1);
    MAX_STEPS: "most integration steps", "solver.max_steps", 1.0, Inclusive(1.0), Inclusive(1e15);
    RECORDER_RATE: "recorder rate", "recorder.rate_hz", 1.0, Exclusive(0.0), Inclusive(1e7);
    STOP: "stop time", "experiment.stop_s", 1.0, Exclusive(0.0), Inclusive(1e9);
    STEP: "communication step", "experiment.step_s", 1.0, Exclusive(0.0), Inclusive(1e9);
}

/// Of rolling bearing steels.
pub const STEELS_MODULUS: Quantity =
    quantity("Young's modulus", "bearing.youngs_modulus_gpa", 1e-9, Inclusive(200.0), Inclusive(212.0));
pub const STEELS_RATIO: Quantity =
    quantity("Poisson's ratio", "bearing.poissons_ratio", 1.0, Inclusive(0.3), Inclusive(0.3));
pub const CONFORMITY_INNER: Quantity = quantity(
    "groove conformity of the inner ring",
    "bearing.groove_diameter_mm or bearing.conformity_inner",
    1.0,
    Inclusive(SMALLEST_CONFORMITY),
    Inclusive(1e3),
);
pub const CONFORMITY_OUTER: Quantity = quantity(
    "groove conformity of the outer ring",
    "bearing.groove_diameter_mm or bearing.conformity_outer",
    1.0,
    Inclusive(SMALLEST_CONFORMITY),
    Inclusive(1e3),
);
pub const DENSITY_BY_MASS: Quantity = quantity(
    "density of the elements in kg/m3, by their mass",
    "bearing.element_mass_g",
    1.0,
    Exclusive(0.0),
    Inclusive(1e5),
);
pub const SPIN_SLIP: Quantity =
    quantity("slip of the elements' spin", "element.spin_slip", 1.0, Inclusive(-1.0), Inclusive(1.0));
pub const SPALL_LENGTH: Quantity =
    quantity("spall length, in mm", "defect.length_deg or defect.length_mm", 1e3, Exclusive(0.0), Inclusive(1e6));
/// Those of the ring of a name.
macro_rules! of_ring {
    ($ring:literal) => {
        RingQuantities {
            load: of_ring!(concat!("load on the ", $ring), $ring, ".load_n", -1e9, 1e9),
            mass: of_ring!(concat!($ring, " mass"), $ring, ".mass_kg", 1e-6, 1e9),
            damping: of_ring!(concat!($ring, " damping"), $ring, ".damping_n_s_m", 0.0, 1e12),
            stiffness: of_ring!(concat!($ring, " stiffness"), $ring, ".stiffness_n_m", 0.0, 1e15),
            preload: of_ring!(concat!("preload of the ", $ring), $ring, ".preload_n", 0.0, 1e9),
            axial_damping: of_ring!(concat!("axial damping of the ", $ring), $ring, ".axial_damping_n_s_m", 0.0, 1e12),
            axial_stiffness: of_ring!(
                concat!("axial stiffness of the ", $ring),
                $ring,
                ".axial_stiffness_n_m",
                0.0,
                1e15
            ),
        }
    };
    ($quantity:expr, $ring:literal, $key:literal, $low:expr, $high:expr) => {
        quantity($quantity, concat!($ring, $key), 1.0, Inclusive($low), Inclusive($high))
    };
}
pub static SHAFT: RingQuantities = of_ring!("shaft");
pub static HOUSING: RingQuantities = of_ring!("housing");
pub const SENSOR_COUNT: Quantity =
    quantity("number of sensors", "[[sensor]]", 1.0, Inclusive(1.0), Inclusive(MOST_SENSORS as f64));
pub const SENSOR_ELEVATION: Quantity =
    quantity("elevation of the sensor direction", "sensor.direction", DEG, Inclusive(-90.0), Inclusive(90.0));
pub const SENSOR_MODE_COUNT: Quantity =
    quantity("number of a sensor's modes", "[[sensor.mode]]", 1.0, Inclusive(0.0), Inclusive(MOST_SENSOR_MODES as f64));
/// Below it the filter would be megabytes long, and what it lets through is no vibration.
pub const FILTERED_RATE: Quantity = quantity(
    "rate of a recorder that filters",
    "recorder.rate_hz with recorder.filter = \"linear-phase\"",
    1.0,
    Inclusive(100.0),
    Inclusive(1e7),
);
