//! Common deep groove and angular contact ball bearings and cylindrical roller bearings by their catalogue's name.
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
//!
//! Angular contact bearings 7202 to 7212 have the boundary of 6202 to 6212 (ISO 15) and by the letter behind the number
//! a contact angle of 15 degrees, C, or 40, B, as NSK, NACHI, SKF and Schaeffler name them. What is inside is
//! estimated: pitch circle and balls as above. One shoulder of a ring is cut away, so that more balls go in than into a
//! deep groove bearing: of those that fill the pitch circle 93 % of B and 87 % of C, whose cages are thicker. Of a
//! 7206-B a static rating of 14.3 kN is published, which by ISO 76 takes 14 balls of 9.525 mm, and shoulders 0.32 and
//! 0.28 of a ball's diameter high; the share of C is assumed. The number may be one off here too.

use crate::spelling::nearest;

/// Millimetres of 1/64 inch, in which balls are made.
const STEP_OF_BALLS: f64 = 25.4 / 64.0;
/// Part of the pitch circle that balls fill (°), from the outermost edge of the first to that of the last but one.
const FILLED: f64 = 195.0;

/// A row for each boundary by ISO 15: the ball bearing and, if there is one, the roller bearing that have it, and what
/// is published of the balls. Sizes 204K to 312K of the source that gives balls in 1/64 inch are 6204 to 6312 here.
const TABLE: &str = include_str!("catalogue.csv");
/// Letters before the number of a roller bearing, which say where its flanges are.
const FLANGES: [&str; 4] = ["NU", "NJ", "NUP", "N"];
/// How what makers put behind a number begins: a sign, or the letters of shields and seals (Z, RS, LL, DD, VV), snap
/// rings and grooves (N), clearance (C), inner design and cages (E, T, M, J), taper bores (K).
const ADDITIONS: [char; 16] = [' ', '-', '/', '.', 'Z', 'R', 'L', 'D', 'V', 'N', 'C', 'E', 'T', 'M', 'J', 'K'];

/// Angular contact bearings, after the ball bearing of the same boundary: with 15 and with 40 degrees.
const ANGULAR: [[&str; 3]; 11] = [
    ["6202", "7202C", "7202B"],
    ["6203", "7203C", "7203B"],
    ["6204", "7204C", "7204B"],
    ["6205", "7205C", "7205B"],
    ["6206", "7206C", "7206B"],
    ["6207", "7207C", "7207B"],
    ["6208", "7208C", "7208B"],
    ["6209", "7209C", "7209B"],
    ["6210", "7210C", "7210B"],
    ["6211", "7211C", "7211B"],
    ["6212", "7212C", "7212B"],
];
/// Contact angle (°) and share of a full circle of balls, of C and of B.
const ANGLES: [(f64, f64); 2] = [(15.0, 0.87), (40.0, 0.93)];

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
    /// Contact angle of an angular contact bearing (°), by its letter.
    pub contact_angle: Option<f64>,
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

/// All bearings of the catalogue: deep groove, angular contact, cylindrical roller bearings.
pub fn catalogue() -> impl Iterator<Item = CatalogueBearing> {
    ball_bearings().chain(angular_contact_bearings()).chain(roller_bearings())
}

fn ball_bearings() -> impl Iterator<Item = CatalogueBearing> {
    TABLE.lines().skip(1).filter_map(|row| {
        let (designation, _, boundary, published) = read(row)?;
        let inside = balls(boundary, &published).unwrap_or_else(|| estimated(boundary));
        Some(CatalogueBearing { designation, boundary, inside })
    })
}

fn angular_contact_bearings() -> impl Iterator<Item = CatalogueBearing> {
    let of = |[_, names @ ..]: [&'static str; 3], boundary| {
        names.into_iter().zip(ANGLES).map(move |(designation, (angle, share))| CatalogueBearing {
            designation,
            boundary,
            inside: estimated_angular(boundary, angle, share),
        })
    };
    let boundaries = ball_bearings().map(|bearing| (bearing.designation, bearing.boundary));
    boundaries.flat_map(move |(name, boundary)| {
        ANGULAR.into_iter().filter(move |names| names[0] == name).flat_map(move |names| of(names, boundary))
    })
}

fn roller_bearings() -> impl Iterator<Item = CatalogueBearing> {
    let rows = TABLE.lines().skip(1).filter_map(read).filter(|(_, name, ..)| !name.is_empty());
    rows.map(|(_, designation, boundary, _)| CatalogueBearing {
        designation,
        boundary,
        inside: estimated_rollers(boundary),
    })
}

/// A row: names of the ball and of the roller bearing, boundary (mm), and the cells of what is published.
fn read(row: &'static str) -> Option<(&'static str, &'static str, [f64; 3], [&'static str; 5])> {
    // The source comes last and may have commas.
    let cells: Vec<&str> = row.splitn(10, ',').collect();
    let &[ball, roller, bore, outside, width, ref published @ ..] = &cells[..] else { return None };
    let boundary = [bore.parse().ok()?, outside.parse().ok()?, width.parse().ok()?];
    Some((ball, roller, boundary, published.try_into().ok()?))
}

/// The balls that are published: their number, their diameter in millimetres or in 1/64 inch, the pitch diameter, which
/// is halfway between bore and outside where it is not given, and who has published that.
fn balls(boundary: [f64; 3], &[count, diameter, steps, pitch, source]: &[&'static str; 5]) -> Option<Inside> {
    let by_steps = || steps.parse().ok().map(|steps: f64| steps * STEP_OF_BALLS);
    Some(Inside {
        element_count: count.parse().ok()?,
        element_diameter: diameter.parse().ok().or_else(by_steps)?,
        pitch_diameter: pitch.parse().unwrap_or(halfway(boundary)),
        roller_length: None,
        contact_angle: None,
        source: Some(source),
    })
}

/// Diameter of the circle halfway between bore and outside.
fn halfway([bore, outside, _]: [f64; 3]) -> f64 {
    0.5 * (bore + outside)
}

/// The bearing of this name, what makers put behind it (`-2RS`, `ZZ`, ` ECP`, ` C3`) left out; `None` if there is none.
/// Of an angular contact bearing the letter of its angle is a part of the name: `7205 BEP` is a 7205B, `7205-C-TVP` a
/// 7205C. Letters right behind a number that no maker's addition begins with (`6205x`) make another name of it.
///
/// ```
/// let bearing = brinell_scene_file::catalogued("6205-2RS").unwrap();
/// assert_eq!((bearing.boundary, bearing.inside.element_count), ([25.0, 52.0, 15.0], 9));
/// ```
pub fn catalogued(designation: &str) -> Option<CatalogueBearing> {
    let name = designation.trim().to_uppercase();
    let letters = name.len() - name.trim_start_matches(|c: char| c.is_ascii_alphabetic()).len();
    let (letters, rest) = name.split_at(letters);
    let number: String = rest.trim_start().chars().take_while(char::is_ascii_digit).collect();
    let behind = rest.trim_start().trim_start_matches(|c: char| c.is_ascii_digit());
    let wanted = match letters {
        "" if number.starts_with("72") => {
            let angle = behind.trim_start_matches([' ', '-']).chars().next().filter(|c| ['B', 'C'].contains(c));
            format!("{number}{}", angle?)
        }
        _ if !behind.is_empty() && !behind.starts_with(ADDITIONS) => return None,
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
    Inside { element_count, element_diameter, pitch_diameter, roller_length, contact_angle: None, source: None }
}

/// With so large a share of the balls that would fill the pitch circle.
fn estimated_angular(boundary: [f64; 3], angle: f64, share: f64) -> Inside {
    let inside = estimated(boundary);
    let full = std::f64::consts::PI / libm::asin(inside.element_diameter / inside.pitch_diameter);
    Inside { element_count: (share * full) as usize, contact_angle: Some(angle), ..inside }
}

fn estimated(boundary @ [bore, outside, _]: [f64; 3]) -> Inside {
    let pitch_diameter = halfway(boundary);
    let element_diameter = (0.3 * (outside - bore) / STEP_OF_BALLS).round() * STEP_OF_BALLS;
    let taken = 2.0 * libm::asin(element_diameter / pitch_diameter).to_degrees();
    let element_count = 1 + (FILLED / taken) as usize;
    let (roller_length, contact_angle) = (None, None);
    Inside { element_count, element_diameter, pitch_diameter, roller_length, contact_angle, source: None }
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
        for (name, printed) in COEFFICIENTS {
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
        assert_eq!(sourced.count(), 2 + COEFFICIENTS.len());
        assert_eq!(catalogue().count(), 37 + 2 * 11 + 21, "a row of the table is not read");
    }

    #[test]
    fn a_7206b_has_the_balls_that_its_published_static_rating_takes() {
        let inside = catalogued("7206B").unwrap().inside;
        // ISO 76: C0 = f0 Z D² cos α, with f0 of 14.9 at D cos α/D_pw = 0.16. The rating is 1.4 % below 14.5 kN, which
        // 14 balls have, and 13 are 5 % above what they have.
        let rating = 14.9 * inside.element_diameter * inside.element_diameter * 40f64.to_radians().cos();
        assert_eq!((inside.element_count, (14.3e3 / rating).round()), (14, 14.0));
    }

    #[test]
    fn elements_have_room_between_the_rings_and_beside_each_other() {
        for bearing in catalogue() {
            let ([bore, outside, _], inside) = (bearing.boundary, bearing.inside);
            let Inside { element_count, element_diameter, pitch_diameter, .. } = inside;
            assert!(pitch_diameter - element_diameter > bore && pitch_diameter + element_diameter < outside);
            let spacing = pitch_diameter * (std::f64::consts::PI / element_count as f64).sin();
            assert!(spacing > 1.05 * element_diameter, "{bearing:?}");
            // Angular contact bearings are filled from the open side.
            let most = match (inside.contact_angle, inside.roller_length) {
                (Some(_), _) => 17,
                (None, Some(_)) => 16,
                (None, None) => 13,
            };
            assert!((6..=most).contains(&element_count), "{bearing:?}");
            let shape = inside.roller_length.map_or(1.0, |length| length / element_diameter);
            assert!((0.6..1.6).contains(&shape), "{bearing:?}");
        }
    }

    #[test]
    fn a_makers_additions_to_a_name_are_left_out() {
        for name in ["6205", "6205-2RS", "6205 ZZ/C3", " 6205", "6205ZZ", "6205llu"] {
            assert_eq!(catalogued(name).map(|bearing| bearing.designation), Some("6205"), "{name}");
        }
        for name in ["NU205", "NU 205 ECP", "NJ205", "N 205", "NUP205/C3"] {
            assert_eq!(catalogued(name).map(|bearing| bearing.designation), Some("NU205"), "{name}");
        }
        for name in ["7205B", "7205 BEP", "7205-B-TVP", "7205BECBP"] {
            assert_eq!(catalogued(name).map(|bearing| bearing.designation), Some("7205B"), "{name}");
        }
        assert_eq!(catalogued("7205 CD/P4A").and_then(|bearing| bearing.inside.contact_angle), Some(15.0));
        for name in ["", "NA205", "NU", "62055", "bearing 6205", "6205x", "NU205Q", "7205", "7205A", "7213B"] {
            assert_eq!(catalogued(name), None, "{name}");
        }
    }
}
