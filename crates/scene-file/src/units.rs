//! Values that look as if they were in another unit than their key's: far from what is usual, and usual in that other
//! unit. They are asked about, wherever they are given, and nothing is refused for it.

use crate::catalogue::catalogued;
use brinell::geometry::load_rating::load_ratings;
use brinell::scene::quantity::shown;
use brinell::scene::{Bearing, Plain};
use std::f64::consts::PI;
use std::fmt;

/// A smallest and a largest size.
type Range = [f64; 2];
/// Units that are taken for a key's: how many of that each is, and its name.
type Others = &'static [(f64, &'static str)];

/// What is usual for the values of some keys.
struct Usual {
    keys: &'static [&'static str],
    unit: &'static str,
    others: Others,
    /// In the unit of the keys; `None` where the bearing's dimensions that it follows from are not known.
    range: fn(&Dimensions) -> Option<Range>,
    /// Where it is from.
    source: &'static str,
}

const OF_MICROMETRES: Others = &[(1e3, "millimetres"), (1e6, "metres"), (1e-3, "nanometres")];
const OF_DEGREES: Others = &[(180.0 / PI, "radians")];

/// Largest n·d_m (mm/min). Catalogues rate a 6205 for 28 000 rev/min on a pitch circle of 39 mm.
const FASTEST: f64 = 1.2e6;
/// Shortest seeded fault of the recordings of Case Western Reserve University (mm): 0.007 inch.
const SEEDED: f64 = 0.178;

const USUAL: [Usual; 10] = [
    Usual {
        keys: &["shaft.speed_hz", "housing.speed_hz"],
        unit: "Hz",
        others: &[(1.0 / 60.0, "rev/min")],
        range: |of| of.pitch.map(|pitch| [0.0, FASTEST / 60.0 / pitch]),
        source: "speed times pitch diameter to 1.2e6 mm/min, what catalogues rate ball bearings for",
    },
    Usual {
        keys: &["shaft.load_n", "housing.load_n", "shaft.preload_n", "housing.preload_n"],
        unit: "N",
        others: &[(1e3, "kN"), (1e-3, "mN")],
        range: |of| of.rating().map(|rating| [0.01 * rating, 2.0 * rating]),
        source: "from a hundredth of the static load rating, about the minimum load of catalogues, to twice that \
                 rating, a static safety of 0.5 (ISO 76)",
    },
    Usual {
        keys: &["bearing.radial_clearance_um", "bearing.internal_clearance_um", "bearing.axial_clearance_um"],
        unit: "um",
        others: OF_MICROMETRES,
        range: |of| of.diameter.map(|diameter| [0.5, 50.0 * diameter]),
        source: "ISO 5753-1 has whole micrometres, none above a twentieth of the element's diameter",
    },
    Usual {
        keys: &["bearing.contact_angle_deg", "bearing.operating_angle_deg"],
        unit: "degrees",
        others: OF_DEGREES,
        range: |_| Some([5.0, 60.0]),
        source: "ISO 281 has factors for 5 to 45 degrees, thrust bearings have 60",
    },
    Usual {
        keys: &["bearing.density_kg_m3"],
        unit: "kg/m3",
        others: &[(1e3, "g/cm3"), (1e12, "t/mm3")],
        range: |_| Some([1e3, 25e3]),
        source: "from plastics to tungsten alloys",
    },
    Usual {
        keys: &["defect.length_mm"],
        unit: "mm",
        others: &[(1e3, "metres"), (1e-3, "micrometres")],
        range: |of| of.around().map(|around| [0.5 * SEEDED, 0.5 * around]),
        source: "from half of the shortest fault of public recordings, 0.18 mm (CWRU), to half of the raceway",
    },
    Usual {
        keys: &["defect.length_deg"],
        unit: "degrees",
        others: OF_DEGREES,
        range: |of| of.around().map(|around| [360.0 * SEEDED / around, 180.0]),
        source: "from the shortest fault of public recordings, 0.18 mm (CWRU), to half of the raceway",
    },
    Usual {
        keys: &["defect.depth_um"],
        unit: "um",
        others: OF_MICROMETRES,
        range: |of| of.diameter.map(|diameter| [1.0, 100.0 * diameter]),
        source: "from the roughness Rz of raceways, below 1 um, to a tenth of the element's diameter",
    },
    Usual {
        keys: &["defect.edge_slope_deg"],
        unit: "degrees",
        others: OF_DEGREES,
        range: |_| Some([1.6, 90.0]),
        source: "a right angle is 1.571 radians",
    },
    Usual {
        keys: &["waviness.amplitude_um", "bearing.element_diameter_offsets_um", "bearing.element_diameter_rms_um"],
        unit: "um",
        others: OF_MICROMETRES,
        range: |_| Some([1e-3, 100.0]),
        source: "ISO 3290-1 allows 0.08 um to the roundest balls, grade 3",
    },
];

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

impl UnitQuestion {
    /// What there is to ask about a value that belongs to this key of a scene, wherever it is given.
    pub fn of(bearing: &Bearing, key: &str, value: f64) -> Option<Self> {
        Dimensions::of_bearing(bearing).question(key, value)
    }

    /// The question alone, which follows a refusal.
    pub(crate) fn short(&self) -> String {
        // Six digits: units are converted by factors that have more.
        let meant = Plain(format!("{:.5e}", self.meant).parse().unwrap_or(self.meant));
        format!("{meant} {} given in {}?", self.unit, self.given)
    }
}

impl fmt::Display for UnitQuestion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { unit, source, .. } = self;
        let [least, most] = self.usual.map(|value| Plain(format!("{value:.1e}").parse().unwrap_or(value)));
        write!(f, "{} Usual are {least} to {most} {unit} ({source})", self.short())
    }
}

/// The question about a value of a scene file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitRemark {
    /// Its line in the file, from 1.
    pub line: usize,
    /// The question.
    pub question: UnitQuestion,
}

impl fmt::Display for UnitRemark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let UnitQuestion { key, value, .. } = &self.question;
        write!(f, "line {}: {key} = {}: {}", self.line, Plain(*value), self.question)
    }
}

/// The dimensions of a bearing (mm), as far as they are known.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Dimensions {
    count: Option<f64>,
    diameter: Option<f64>,
    pitch: Option<f64>,
    length: Option<f64>,
    /// Contact angle (°) of an angular contact bearing.
    angle: Option<f64>,
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
            angle: number("contact_angle_deg").or(inside.and_then(|inside| inside.contact_angle)),
        }
    }

    fn of_bearing(bearing: &Bearing) -> Self {
        Self {
            count: Some(bearing.element_count as f64),
            diameter: Some(1e3 * bearing.element_diameter),
            pitch: Some(1e3 * bearing.pitch_diameter),
            length: bearing.roller().map(|roller| 1e3 * roller.length),
            angle: bearing.contact_angle.map(f64::to_degrees),
        }
    }

    /// Circumference of the outer raceway (mm).
    fn around(&self) -> Option<f64> {
        Some(PI * (self.pitch? + self.diameter?))
    }

    /// Static load rating (N).
    fn rating(&self) -> Option<f64> {
        let (count, diameter, pitch) = (self.count? as usize, 1e-3 * self.diameter?, 1e-3 * self.pitch?);
        let mut bearing = match self.length {
            None => Bearing::steel_balls(count, diameter, pitch),
            Some(length) => Bearing::steel_rollers(count, diameter, 1e-3 * length, pitch),
        };
        bearing.contact_angle = self.angle.map(f64::to_radians);
        Some(load_ratings(&bearing).fixed).filter(|rating| *rating > 0.0)
    }

    /// The question about a value of a key, given with its table: of one that is neither usual nor 0, where another
    /// unit makes it usual.
    pub(crate) fn question(&self, key: &str, value: f64) -> Option<UnitQuestion> {
        let is_it = |of: &'static Usual| of.keys.iter().find(|known| **known == key).map(|key| (*key, of));
        let (key, Usual { unit, others, range, source, .. }) = USUAL.iter().find_map(is_it)?;
        let usual = range(self)?;
        let fits = |value: f64| (usual[0]..=usual[1]).contains(&value.abs());
        if value == 0.0 || !value.is_finite() || fits(value) {
            return None;
        }
        let (factor, given) = others.iter().find(|(factor, _)| fits(value * factor))?;
        Some(UnitQuestion { key, value, meant: shown(value * factor), unit, given, usual, source })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::written;

    #[test]
    fn the_usual_load_follows_from_a_static_rating_with_the_contact_angle() {
        let rating = |name| Dimensions::of(Some(name), |_| None).rating().unwrap();
        // ISO 76: f0 falls from 15.8 at 0 degrees to 12.4 at 40, times the cosine; 14.5 kN is what `catalogue` prints.
        assert!((rating("7206B") / 14.5e3 - 1.0).abs() < 0.01, "{}", rating("7206B"));
        assert!(rating("7206B") < 0.9 * rating("7206AC"));
    }

    #[test]
    fn what_is_usual_is_possible_and_each_unit_that_may_be_mistaken_is_asked_about() {
        let known =
            Dimensions { count: Some(9.0), diameter: Some(7.94), pitch: Some(39.04), length: None, angle: None };
        for Usual { keys, range, others, source, .. } in &USUAL {
            let [low, high] = range(&known).unwrap();
            assert!(low < high && !source.contains("assumed"), "{keys:?}: {low} to {high}");
            for key in *keys {
                let (_, quantity) = written().find(|(known, _)| known == key).unwrap();
                let limits = quantity.limits();
                assert!(limits.hold(0.5 * (low + high)), "{key}: {low} to {high} and {limits}");
                for (factor, given) in *others {
                    // The largest and the smallest usual value, in the other unit.
                    let asked = [low, high].into_iter().filter_map(|usual| known.question(key, usual / factor));
                    assert!(asked.into_iter().any(|question| question.given == *given), "{key}: {given}");
                }
                assert_eq!([low, high, 0.5 * (low + high), 0.0].map(|usual| known.question(key, usual)), [None; 4]);
            }
        }
    }
}
