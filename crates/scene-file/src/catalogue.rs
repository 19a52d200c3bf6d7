//! Common deep groove ball bearings and cylindrical roller bearings by their catalogue's name.
//!
//! Catalogues give the boundary dimensions of ISO 15 and keep what is inside to themselves. Where the number of balls,
//! their diameter and the pitch diameter are published, they stand here with their source. Of Timken's bearings the
//! frequencies of faults are published, in turns of the shaft: BPFO + BPFI is the number of balls, and γ = √(BSF² + 1)
//! − BSF their diameter over the pitch diameter. With the pitch circle halfway between bore and outside, that is a
//! whole number of 1/64 inch to 0.02, in which balls are made: so both are known. Two sizes of the table are left out,
//! 202K and 305K: their balls come out between two sizes.
//!
//! For all others they are estimated from the boundary: pitch diameter (d + D)/2, balls of 0.3 (D − d) to the nearest
//! 1/64 inch, as many as fill 195° of the pitch circle, about what can be put in between two rings that are moved to
//! one side. Of the bearings that are published that is the number of balls of all but two, where it is one off, and
//! their diameter to 7 %. Makers differ as well: in a bearing on a shelf there may be one more or less, and every
//! frequency changes with it.
//!
//! Of roller bearings all that is inside is estimated: rollers of 0.28 (D − d) to the nearest half millimetre, an
//! effective length of 0.6 B, as many as take four fifths of the pitch circle (d + D)/2. Makers crown their rollers
//! each in their own way. NU, NJ, NUP and N differ in their flanges alone.

use brinell::scene::nearest;

/// Millimetres of 1/64 inch, in which balls are made.
const STEP_OF_BALLS: f64 = 25.4 / 64.0;
/// Part of the pitch circle that balls fill (°), from the outermost edge of the first to that of the last but one.
const FILLED: f64 = 195.0;

/// Cylindrical roller bearings, and the ball bearing that has the same boundary by ISO 15.
const ROLLER_BEARINGS: [(&str, &str); 21] = [
    ("NU202", "6202"),
    ("NU203", "6203"),
    ("NU204", "6204"),
    ("NU205", "6205"),
    ("NU206", "6206"),
    ("NU207", "6207"),
    ("NU208", "6208"),
    ("NU209", "6209"),
    ("NU210", "6210"),
    ("NU211", "6211"),
    ("NU212", "6212"),
    ("NU303", "6303"),
    ("NU304", "6304"),
    ("NU305", "6305"),
    ("NU306", "6306"),
    ("NU307", "6307"),
    ("NU308", "6308"),
    ("NU309", "6309"),
    ("NU310", "6310"),
    ("NU311", "6311"),
    ("NU312", "6312"),
];
/// Letters before the number of a roller bearing, which say where its flanges are.
const FLANGES: [&str; 4] = ["NU", "NJ", "NUP", "N"];

/// A bearing of the catalogue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CatalogueBearing {
    /// Its name.
    pub designation: &'static str,
    /// Bore, outside diameter and width (mm).
    pub boundary: [f64; 3],
    /// What is inside.
    pub inside: Inside,
}

/// The rolling elements of a bearing of the catalogue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inside {
    /// Number of balls or rollers.
    pub element_count: usize,
    /// Their diameter (mm).
    pub element_diameter: f64,
    /// Pitch diameter (mm).
    pub pitch_diameter: f64,
    /// Effective length of a roller (mm); `None` of balls.
    pub roller_length: Option<f64>,
    /// Who has published that; `None` where it is estimated.
    pub source: Option<&'static str>,
}

/// Static load rating of deep groove ball bearings over Z·D² (N/mm²), about ISO 76's f₀ for them.
const RATING_OF_BALLS: f64 = 12.3;
/// The same of cylindrical roller bearings over (1 − D/D_pw) Z L D (N/mm²), ISO 76.
const RATING_OF_ROLLERS: f64 = 44.0;

impl Inside {
    /// Static load rating by ISO 76, roughly (N).
    pub fn static_rating(&self) -> f64 {
        let (count, diameter) = (self.element_count as f64, self.element_diameter);
        match self.roller_length {
            None => RATING_OF_BALLS * count * diameter * diameter,
            Some(length) => RATING_OF_ROLLERS * (1.0 - diameter / self.pitch_diameter) * count * length * diameter,
        }
    }
}

/// Name, bore, outside diameter and width (mm) by ISO 15.
const BOUNDARIES: [(&str, [f64; 3]); 37] = [
    ("608", [8.0, 22.0, 7.0]),
    ("6000", [10.0, 26.0, 8.0]),
    ("6001", [12.0, 28.0, 8.0]),
    ("6002", [15.0, 32.0, 9.0]),
    ("6003", [17.0, 35.0, 10.0]),
    ("6004", [20.0, 42.0, 12.0]),
    ("6005", [25.0, 47.0, 12.0]),
    ("6006", [30.0, 55.0, 13.0]),
    ("6007", [35.0, 62.0, 14.0]),
    ("6008", [40.0, 68.0, 15.0]),
    ("6009", [45.0, 75.0, 16.0]),
    ("6010", [50.0, 80.0, 16.0]),
    ("6200", [10.0, 30.0, 9.0]),
    ("6201", [12.0, 32.0, 10.0]),
    ("6202", [15.0, 35.0, 11.0]),
    ("6203", [17.0, 40.0, 12.0]),
    ("6204", [20.0, 47.0, 14.0]),
    ("6205", [25.0, 52.0, 15.0]),
    ("6206", [30.0, 62.0, 16.0]),
    ("6207", [35.0, 72.0, 17.0]),
    ("6208", [40.0, 80.0, 18.0]),
    ("6209", [45.0, 85.0, 19.0]),
    ("6210", [50.0, 90.0, 20.0]),
    ("6211", [55.0, 100.0, 21.0]),
    ("6212", [60.0, 110.0, 22.0]),
    ("6301", [12.0, 37.0, 12.0]),
    ("6302", [15.0, 42.0, 13.0]),
    ("6303", [17.0, 47.0, 14.0]),
    ("6304", [20.0, 52.0, 15.0]),
    ("6305", [25.0, 62.0, 17.0]),
    ("6306", [30.0, 72.0, 19.0]),
    ("6307", [35.0, 80.0, 21.0]),
    ("6308", [40.0, 90.0, 23.0]),
    ("6309", [45.0, 100.0, 25.0]),
    ("6310", [50.0, 110.0, 27.0]),
    ("6311", [55.0, 120.0, 29.0]),
    ("6312", [60.0, 130.0, 31.0]),
];

/// Name, number of balls, their diameter and the pitch diameter (mm), and who has published that.
const PUBLISHED: [(&str, usize, [f64; 2], &str); 2] = [
    ("6203", 8, [6.7462, 28.4988], "Case Western Reserve University's bearing data, fan end"),
    ("6205", 9, [7.94, 39.04], "Case Western Reserve University's bearing data, drive end"),
];

/// Who has published the frequencies of those below, as sizes 204K to 312K.
const BY_FREQUENCIES: &str = "Timken's ball bearing housed unit catalogue, table A-9, by its frequency coefficients";
/// Name, number of balls and their diameter [1/64 inch] by their frequencies; the pitch diameter is (d + D)/2.
const TIMKEN: [(&str, usize, f64); 17] = [
    ("6204", 8, 20.0),
    ("6206", 9, 24.0),
    ("6207", 9, 28.0),
    ("6208", 9, 32.0),
    ("6209", 9, 32.0),
    ("6210", 10, 32.0),
    ("6211", 10, 36.0),
    ("6212", 10, 40.0),
    ("6303", 7, 22.0),
    ("6304", 7, 24.0),
    ("6306", 7, 34.0),
    ("6307", 8, 36.0),
    ("6308", 8, 40.0),
    ("6309", 8, 44.0),
    ("6310", 8, 48.0),
    ("6311", 8, 52.0),
    ("6312", 8, 56.0),
];

/// A name that is not in the catalogue.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("bearing.catalogue = {name:?} is not in the catalogue{}, which has {}", meant(name), designations().join(", "))]
pub struct NotInCatalogue {
    /// The name.
    pub name: String,
}

fn designations() -> Vec<&'static str> {
    catalogue().map(|bearing| bearing.designation).collect()
}

fn meant(name: &str) -> String {
    nearest(designations(), name).map_or_else(String::new, |near| format!(" (did you mean {near}?)"))
}

/// All bearings of the catalogue, those with balls first.
pub fn catalogue() -> impl Iterator<Item = CatalogueBearing> {
    ball_bearings().chain(roller_bearings())
}

fn roller_bearings() -> impl Iterator<Item = CatalogueBearing> {
    ROLLER_BEARINGS.iter().filter_map(|&(designation, same_boundary)| {
        let (_, boundary) = *BOUNDARIES.iter().find(|(name, _)| *name == same_boundary)?;
        Some(CatalogueBearing { designation, boundary, inside: estimated_rollers(boundary) })
    })
}

fn ball_bearings() -> impl Iterator<Item = CatalogueBearing> {
    BOUNDARIES.iter().map(|&(designation, boundary)| {
        let inside = published(designation, boundary).unwrap_or_else(|| estimated(boundary));
        CatalogueBearing { designation, boundary, inside }
    })
}

fn published(designation: &str, boundary: [f64; 3]) -> Option<Inside> {
    let balls = |element_count, element_diameter, pitch_diameter, source| Inside {
        element_count,
        element_diameter,
        pitch_diameter,
        roller_length: None,
        source: Some(source),
    };
    let by_dimensions = PUBLISHED.iter().find(|(name, ..)| *name == designation);
    let by_frequencies = TIMKEN.iter().find(|(name, ..)| *name == designation);
    match (by_dimensions, by_frequencies) {
        (Some(&(_, count, [diameter, pitch], source)), _) => Some(balls(count, diameter, pitch, source)),
        (None, Some(&(_, count, steps))) => {
            Some(balls(count, steps * STEP_OF_BALLS, halfway(boundary), BY_FREQUENCIES))
        }
        (None, None) => None,
    }
}

/// Diameter of the circle halfway between bore and outside.
fn halfway([bore, outside, _]: [f64; 3]) -> f64 {
    0.5 * (bore + outside)
}

/// The bearing of this name, what makers put behind it (`-2RS`, `ZZ`, ` ECP`, ` C3`) left out; `None` if there is none.
/// ```
/// let bearing = brinell_scene_file::catalogued("6205-2RS").unwrap();
/// assert_eq!((bearing.boundary, bearing.inside.element_count), ([25.0, 52.0, 15.0], 9));
/// ```
pub fn catalogued(designation: &str) -> Option<CatalogueBearing> {
    let name = designation.trim().to_uppercase();
    let letters = name.len() - name.trim_start_matches(|c: char| c.is_ascii_alphabetic()).len();
    let (letters, rest) = name.split_at(letters);
    let number: String = rest.trim_start().chars().take_while(char::is_ascii_digit).collect();
    let wanted = match letters {
        "" => number,
        letters if FLANGES.contains(&letters) => format!("NU{number}"),
        _ => return None,
    };
    catalogue().find(|bearing| bearing.designation == wanted)
}

fn estimated_rollers(boundary @ [bore, outside, width]: [f64; 3]) -> Inside {
    let pitch_diameter = halfway(boundary);
    let element_diameter = (0.28 * (outside - bore) * 2.0).round() / 2.0;
    let element_count = (0.8 * std::f64::consts::PI * pitch_diameter / element_diameter).round() as usize;
    let roller_length = Some((0.6 * width * 10.0).round() / 10.0);
    Inside { element_count, element_diameter, pitch_diameter, roller_length, source: None }
}

fn estimated(boundary @ [bore, outside, _]: [f64; 3]) -> Inside {
    let pitch_diameter = halfway(boundary);
    let element_diameter = (0.3 * (outside - bore) / STEP_OF_BALLS).round() * STEP_OF_BALLS;
    let taken = 2.0 * libm::asin(element_diameter / pitch_diameter).to_degrees();
    let element_count = 1 + (FILLED / taken) as usize;
    Inside { element_count, element_diameter, pitch_diameter, roller_length: None, source: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cage, ball, outer and inner raceway in turns of the shaft, as printed.
    const COEFFICIENTS: [(&str, [f64; 4]); 17] = [
        ("6204", [0.382, 1.992, 3.052, 4.948]),
        ("6206", [0.396, 2.311, 3.568, 5.432]),
        ("6207", [0.396, 2.303, 3.565, 5.435]),
        ("6208", [0.394, 2.256, 3.547, 5.453]),
        ("6209", [0.402, 2.461, 3.621, 5.379]),
        ("6210", [0.409, 2.665, 4.093, 5.907]),
        ("6211", [0.408, 2.620, 4.078, 5.922]),
        ("6212", [0.407, 2.584, 4.066, 5.934]),
        ("6303", [0.364, 1.696, 2.545, 4.455]),
        ("6304", [0.368, 1.757, 2.574, 4.426]),
        ("6306", [0.368, 1.757, 2.574, 4.426]),
        ("6307", [0.376, 1.888, 3.006, 4.994]),
        ("6308", [0.378, 1.925, 3.023, 4.977]),
        ("6309", [0.380, 1.955, 3.037, 4.963]),
        ("6310", [0.381, 1.981, 3.047, 4.953]),
        ("6311", [0.382, 2.002, 3.057, 4.943]),
        ("6312", [0.383, 2.020, 3.064, 4.936]),
    ];

    #[test]
    fn bearings_known_by_their_frequencies_have_those_that_are_printed() {
        for ((name, printed), (known, ..)) in COEFFICIENTS.into_iter().zip(TIMKEN) {
            assert_eq!(name, known);
            let inside = catalogued(name).unwrap().inside;
            let (count, share) = (inside.element_count as f64, inside.element_diameter / inside.pitch_diameter);
            let cage = 0.5 * (1.0 - share);
            let found = [cage, 0.5 * (1.0 / share - share), count * cage, count * (1.0 - cage)];
            for (found, printed) in found.into_iter().zip(printed) {
                // One unit of the last digit: the table cuts some off and rounds others.
                assert!((found - printed).abs() < 1e-3, "{name}: {found}, printed {printed}");
            }
            assert!(inside.source.is_some_and(|source| source.contains("table A-9")));
        }
    }

    #[test]
    fn what_is_estimated_is_near_what_is_published_where_both_are_known() {
        let mut off = Vec::new();
        for bearing in ball_bearings().filter(|bearing| bearing.inside.source.is_some()) {
            let (name, known, guess) = (bearing.designation, bearing.inside, estimated(bearing.boundary));
            if guess.element_count != known.element_count {
                assert_eq!(guess.element_count.abs_diff(known.element_count), 1, "{name}");
                off.push(name);
            }
            // What the page of this file says.
            assert!((guess.element_diameter / known.element_diameter - 1.0).abs() < 0.07, "{name}: {guess:?}");
            // A pitch circle need not be halfway between bore and outside.
            assert!((guess.pitch_diameter / known.pitch_diameter - 1.0).abs() < 0.015, "{name}: {guess:?}");
        }
        assert_eq!(off, ["6209", "6303"]);
        let sourced = ball_bearings().filter(|bearing| bearing.inside.source.is_some());
        assert_eq!(sourced.count(), PUBLISHED.len() + TIMKEN.len());
    }

    #[test]
    fn elements_have_room_between_the_rings_and_beside_each_other() {
        for bearing in catalogue() {
            let ([bore, outside, _], inside) = (bearing.boundary, bearing.inside);
            let Inside { element_count, element_diameter, pitch_diameter, .. } = inside;
            assert!(pitch_diameter - element_diameter > bore && pitch_diameter + element_diameter < outside);
            let spacing = pitch_diameter * (std::f64::consts::PI / element_count as f64).sin();
            assert!(spacing > 1.05 * element_diameter, "{bearing:?}");
            let most = if inside.roller_length.is_some() { 16 } else { 13 };
            assert!((6..=most).contains(&element_count), "{bearing:?}");
            let shape = inside.roller_length.map_or(1.0, |length| length / element_diameter);
            assert!((0.6..1.6).contains(&shape), "{bearing:?}");
        }
    }

    #[test]
    fn a_makers_additions_to_a_name_are_left_out() {
        for name in ["6205", "6205-2RS", "6205 ZZ/C3", " 6205"] {
            assert_eq!(catalogued(name).map(|bearing| bearing.designation), Some("6205"), "{name}");
        }
        for name in ["NU205", "NU 205 ECP", "NJ205", "N 205", "NUP205/C3"] {
            assert_eq!(catalogued(name).map(|bearing| bearing.designation), Some("NU205"), "{name}");
        }
        for name in ["", "NA205", "NU", "62055", "bearing 6205"] {
            assert_eq!(catalogued(name), None, "{name}");
        }
    }
}
