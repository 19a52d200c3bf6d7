//! Which sizes of values are usual, by practice or by the bearing's own dimensions: what is far off and would be usual
//! in another unit is asked about. Nothing is refused for it.

use super::mistaken::{UnitQuestion, meant};
use crate::catalogue::catalogued;
use brinell::geometry::load_rating::load_ratings;
use brinell::scene::Bearing;
use std::f64::consts::PI;

/// A smallest and a largest size.
type Range = [f64; 2];

/// What is usual for the values of some keys.
struct Usual {
    keys: &'static [&'static str],
    /// In the unit of the key; `None` where the bearing's dimensions that it follows from are not known.
    range: fn(&Dimensions) -> Option<Range>,
    /// Where it is from.
    source: &'static str,
}

/// Largest n·d_m (mm/min). Catalogues rate a 6205 for 28 000 rev/min on a pitch circle of 39 mm.
const FASTEST: f64 = 1.2e6;
/// What is lifted, m/s².
const GRAVITY: f64 = 9.81;
/// Density from plastics to tungsten alloys (kg/m³).
const DENSITIES: Range = [1e3, 25e3];
const DIAMETERS: Range = [0.3, 300.0];
const PITCHES: Range = [2.0, 5000.0];

const USUAL: [Usual; 33] = [
    Usual {
        keys: &["bearing.element_diameter_mm"],
        range: Dimensions::diameters,
        source: "assumed: of miniature to large bearings, and room for no more than twenty elements between two",
    },
    Usual {
        keys: &["bearing.element_diameter_offsets_um", "bearing.element_diameter_rms_um"],
        range: |_| Some([1e-3, 20.0]),
        source: "assumed: ISO 3290-1 allows 0.5 um in a lot of grade 10 and 1.4 um in one of grade 28",
    },
    Usual {
        keys: &["bearing.pitch_diameter_mm"],
        range: Dimensions::pitches,
        source: "room for each element and for no more than twenty between two",
    },
    Usual {
        keys: &["bearing.roller_length_mm"],
        range: |of| of.diameter.map(|d| [0.3 * d, 3.0 * d]),
        source: "0.3 to 3 times the diameter: discs are shorter, needles longer",
    },
    Usual {
        keys: &["bearing.groove_diameter_mm"],
        range: |of| of.diameter.map(|d| [1.0002 * d, 1.2 * d]),
        source: "conformities of 0.5001 to 0.6",
    },
    Usual {
        keys: &["bearing.contact_angle_deg", "bearing.operating_angle_deg"],
        range: |_| Some([5.0, 60.0]),
        source: "angular contact bearings have 12 to 40 degrees, deep groove bearings under axial load fewer",
    },
    Usual {
        keys: &["bearing.shoulder_inner_mm", "bearing.shoulder_outer_mm"],
        range: |of| of.diameter.map(|d| [0.05 * d, 0.5 * d]),
        source: "assumed: from a twentieth to half of the element's diameter",
    },
    Usual {
        keys: &["bearing.axial_clearance_um"],
        range: |of| of.diameter.map(|d| [1.0, 200.0 * d]),
        source: "assumed: from a micrometre to a fifth of the element's diameter",
    },
    Usual {
        keys: &["bearing.radial_clearance_um", "bearing.internal_clearance_um"],
        range: |of| of.diameter.map(|d| [0.2, 50.0 * d]),
        source: "assumed: from a fifth of a micrometre to a twentieth of the element's diameter; ISO 5753 has whole \
                 micrometres",
    },
    Usual {
        keys: &["bearing.youngs_modulus_gpa"],
        range: |_| Some([50.0, 700.0]),
        source: "from light metals to cemented carbide",
    },
    Usual { keys: &["bearing.density_kg_m3"], range: |_| Some(DENSITIES), source: "from plastics to tungsten alloys" },
    Usual {
        keys: &["bearing.element_mass_g"],
        // 1 kg/m³ is 1e-6 g/mm³.
        range: |of| of.volume().map(|volume| DENSITIES.map(|density| 1e-6 * density * volume)),
        source: "the element's volume of plastics to tungsten alloys",
    },
    Usual {
        keys: &["bearing.hertz_inner_n_m1_5", "bearing.hertz_outer_n_m1_5"],
        range: |_| Some([1e8, 1e13]),
        source: "assumed: steel balls of 1 mm to 100 mm in grooves have 3e9 to 4e10",
    },
    Usual {
        keys: &["bearing.outer_compliance_m_n"],
        range: |_| Some([1e-11, 1e-6]),
        source: "assumed: a contact's own is about 1e-8",
    },
    Usual {
        keys: &["film.viscosity_pa_s"],
        range: |_| Some([1e-3, 3.0]),
        source: "from water to a gear oil in the cold",
    },
    Usual { keys: &["film.pressure_viscosity_1_pa"], range: |_| Some([0.5e-8, 4e-8]), source: "of oils" },
    Usual { keys: &["film.layer_um"], range: |_| Some([0.05, 5e3]), source: "assumed" },
    Usual {
        keys: &["contact.largest_force_n"],
        range: |of| of.rating().map(|rating| [1e-3 * rating, 10.0 * rating]),
        source: "assumed: a thousandth to ten times the static load rating by ISO 76",
    },
    Usual {
        keys: &["gravity_m_s2"],
        range: |_| Some([1.6, 100.0]),
        source: "from the Moon's to ten times the Earth's",
    },
    Usual {
        keys: &["defect.length_mm"],
        range: |of| of.around().map(|around| [0.05, 0.5 * around]),
        source: "assumed: from a scratch to half of the raceway",
    },
    Usual { keys: &["defect.length_deg"], range: |_| Some([0.3, 180.0]), source: "assumed: to half of the raceway" },
    Usual {
        keys: &["defect.depth_um"],
        range: |of| of.diameter.map(|d| [0.5, 100.0 * d]),
        source: "assumed: from roughness to a tenth of the element's diameter",
    },
    Usual {
        keys: &["waviness.amplitude_um"],
        range: |_| Some([1e-3, 100.0]),
        source: "assumed: from ground raceways to rings that their seats press out of round",
    },
    Usual { keys: &["defect.edge_slope_deg"], range: |_| Some([2.0, 90.0]), source: "assumed" },
    Usual {
        keys: &["shaft.speed_hz", "housing.speed_hz"],
        range: |of| of.pitch.map(|pitch| [0.0, FASTEST / 60.0 / pitch]),
        source: "speed times pitch diameter to 1.2e6 mm/min, what catalogues rate ball bearings for",
    },
    Usual {
        keys: &["shaft.load_n", "housing.load_n", "shaft.preload_n", "housing.preload_n"],
        range: |of| of.rating().map(|rating| [5e-4 * rating, 3.0 * rating]),
        source: "assumed: from 0.05 % to three times the static load rating by ISO 76",
    },
    Usual {
        keys: &["shaft.mass_kg", "housing.mass_kg"],
        // Steel, 7.8e-6 kg/mm³.
        range: |of| Some([7.8e-6 * of.count? * of.volume()?, of.rating()? / GRAVITY]),
        source: "assumed: from the rolling elements' own mass to what the static load rating lifts",
    },
    Usual {
        keys: &[
            "shaft.stiffness_n_m",
            "housing.stiffness_n_m",
            "sensor.stiffness_n_m",
            "shaft.axial_stiffness_n_m",
            "housing.axial_stiffness_n_m",
        ],
        range: |_| Some([1e5, 1e12]),
        source: "assumed: from soft mounts to solid steel",
    },
    Usual { keys: &["sensor.mass_kg"], range: |_| Some([1e-4, 10.0]), source: "assumed" },
    Usual {
        keys: &["sensor.mode.frequency_hz"],
        range: |_| Some([20.0, 2e5]),
        source: "assumed: from machines on soft feet to an accelerometer's own",
    },
    Usual { keys: &["sensor.mode.damping_ratio"], range: |_| Some([1e-5, 0.5]), source: "assumed: of structures" },
    Usual { keys: &["recorder.rate_hz"], range: |_| Some([500.0, 5e6]), source: "assumed: of recorders" },
    Usual {
        keys: &["experiment.step_s"],
        range: |_| Some([1e-9, 5e-3]),
        source: "assumed: 200 values a second at least",
    },
];

/// The dimensions of a file's bearing (mm), as far as they are known.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Dimensions {
    count: Option<f64>,
    diameter: Option<f64>,
    pitch: Option<f64>,
    length: Option<f64>,
}

impl Dimensions {
    /// Those that a file gives, by `number` of a key, and the rest from the catalogue, by the name there.
    pub(crate) fn of(name: Option<&str>, number: impl Fn(&str) -> Option<f64>) -> Self {
        let inside = name.and_then(catalogued).map(|bearing| bearing.inside);
        Self {
            count: number("element_count").or(inside.map(|inside| inside.element_count as f64)),
            diameter: number("element_diameter_mm").or(inside.map(|inside| inside.element_diameter)),
            pitch: number("pitch_diameter_mm").or(inside.map(|inside| inside.pitch_diameter)),
            length: number("roller_length_mm").or(inside.and_then(|inside| inside.roller_length)),
        }
    }

    /// Those of a bearing that was read.
    pub(super) fn of_bearing(bearing: &Bearing) -> Self {
        Self {
            count: Some(bearing.element_count as f64),
            diameter: Some(1e3 * bearing.element_diameter),
            pitch: Some(1e3 * bearing.pitch_diameter),
            length: bearing.roller().map(|roller| 1e3 * roller.length),
        }
    }

    /// Pitch diameter on which elements just touch, over their diameter.
    fn crowded(&self) -> Option<f64> {
        self.count.filter(|count| *count >= 2.0).map(|count| 1.0 / libm::sin(PI / count))
    }

    fn diameters(&self) -> Option<Range> {
        let pitch = self.pitch.filter(|pitch| within(*pitch, PITCHES));
        Some(pitch.zip(self.crowded()).map_or(DIAMETERS, |(pitch, crowded)| [0.05, 1.0].map(|x| x * pitch / crowded)))
    }

    fn pitches(&self) -> Option<Range> {
        let diameter = self.diameter.filter(|diameter| within(*diameter, DIAMETERS));
        Some(
            diameter
                .zip(self.crowded())
                .map_or(PITCHES, |(diameter, crowded)| [1.0, 20.0].map(|x| x * diameter * crowded)),
        )
    }

    /// Volume of an element (mm³).
    fn volume(&self) -> Option<f64> {
        let diameter = self.diameter?;
        Some(match self.length {
            None => PI / 6.0 * diameter * diameter * diameter,
            Some(length) => PI / 4.0 * diameter * diameter * length,
        })
    }

    /// Circumference of the outer raceway (mm).
    fn around(&self) -> Option<f64> {
        Some(PI * (self.pitch? + self.diameter?))
    }

    /// Static load rating (N).
    fn rating(&self) -> Option<f64> {
        let (count, diameter, pitch) = (self.count? as usize, 1e-3 * self.diameter?, 1e-3 * self.pitch?);
        let bearing = match self.length {
            None => Bearing::steel_balls(count, diameter, pitch),
            Some(length) => Bearing::steel_rollers(count, diameter, 1e-3 * length, pitch),
        };
        Some(load_ratings(&bearing).fixed).filter(|rating| *rating > 0.0)
    }

    /// The question about a value of a key, given with its table, where there is one.
    pub(crate) fn question(&self, key: &str, value: f64) -> Option<UnitQuestion> {
        let (key, usual, source) = USUAL.iter().find_map(|usual| {
            let key = usual.keys.iter().find(|known| **known == key)?;
            Some((*key, (usual.range)(self)?, usual.source))
        })?;
        let (meant, unit, given) = meant(key, value, usual)?;
        Some(UnitQuestion { key, value, meant, unit, given, usual, source })
    }
}

fn within(value: f64, [low, high]: Range) -> bool {
    (low..=high).contains(&value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::written;

    #[test]
    fn what_is_usual_is_possible_and_each_key_has_a_unit_that_may_be_mistaken() {
        let known = Dimensions { count: Some(9.0), diameter: Some(7.94), pitch: Some(39.04), length: Some(9.0) };
        for Usual { keys, range, source } in &USUAL {
            let [low, high] = range(&known).unwrap();
            assert!(low < high && !source.is_empty(), "{keys:?}: {low} to {high}");
            for key in *keys {
                let (_, quantity) = written().find(|(known, _)| known == key).unwrap();
                let limits = quantity.limits();
                assert!(limits.hold(0.5 * (low + high)), "{key}: {low} to {high} and {limits}");
                let usual = if low > 0.0 { (low * high).sqrt() } else { 0.5 * high };
                let asked = [1e-3, PI / 180.0, 60.0, 1e3, 1e6, 1e9].map(|factor| known.question(key, factor * usual));
                assert!(asked.iter().any(Option::is_some), "{key}: {low} to {high}");
            }
        }
    }
}
