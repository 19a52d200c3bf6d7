//! What is inside the bearings of the catalogue.
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
//! Of roller bearings the diameters of the raceways are published, where one ring comes off: inside those of NU,
//! outside those of N, F and E of SKF's catalogue (Rolling bearings, 17000/1 EN, 2018), so that rollers have (E − F)/2
//! and the pitch circle (E + F)/2; of NU202 the outer one is assumed. As many rollers are taken as fill four fifths of
//! the pitch circle. Their effective length is what the published static rating leaves of 44 (1 − D/D_pw) Z L D (ISO
//! 76): 0.45 of the width of an NU202 and 0.5 to 0.65 of all others, as chamfers take as much of short rollers as of
//! long ones. Makers crown their rollers each in their own way. NU, NJ, NUP and N differ in their flanges alone.
//!
//! Angular contact bearings 7202 to 7212 have the boundary of 6202 to 6212 (ISO 15) and by the letters behind the
//! number a contact angle of 15 degrees, C, of 25, AC (E of Schaeffler, A5 of NSK), or of 40, B. What is inside is
//! estimated: pitch circle and balls as above. One shoulder of a ring is cut away, so that more balls go in than into a
//! deep groove bearing: of those that fill the pitch circle 93 % of B and AC and 87 % of C, whose cages are thicker.
//! SKF's static ratings of BEP and ACCBM are 9 % below to 14 % above those of as many balls; the share of C is assumed.
//! The number may be one off here too.

use super::{CatalogueBearing, Inside};

/// Millimetres of 1/64 inch, in which balls are made.
const STEP_OF_BALLS: f64 = 25.4 / 64.0;
/// Part of the pitch circle that balls fill (°), from the outermost edge of the first to that of the last but one.
const FILLED: f64 = 195.0;

/// A row for each boundary by ISO 15: the ball bearing and, if there is one, the roller bearing that have it, and what
/// is published of the balls. Sizes 204K to 312K of the source that gives balls in 1/64 inch are 6204 to 6312 here.
const TABLE: &str = include_str!("table.csv");
/// Angular contact bearings, after the ball bearing of the same boundary: with 15, 25 and 40 degrees.
const ANGULAR: [[&str; 4]; 11] = [
    ["6202", "7202C", "7202AC", "7202B"],
    ["6203", "7203C", "7203AC", "7203B"],
    ["6204", "7204C", "7204AC", "7204B"],
    ["6205", "7205C", "7205AC", "7205B"],
    ["6206", "7206C", "7206AC", "7206B"],
    ["6207", "7207C", "7207AC", "7207B"],
    ["6208", "7208C", "7208AC", "7208B"],
    ["6209", "7209C", "7209AC", "7209B"],
    ["6210", "7210C", "7210AC", "7210B"],
    ["6211", "7211C", "7211AC", "7211B"],
    ["6212", "7212C", "7212AC", "7212B"],
];
/// Contact angle (°) and share of a full circle of balls, of C, AC and B.
const ANGLES: [(f64, f64); 3] = [(15.0, 0.87), (25.0, 0.93), (40.0, 0.93)];

/// Who publishes what of roller bearings is published.
const ROLLERS_BY: &str = "SKF's catalogue 17000/1 EN, by raceways and static rating; the number assumed";

/// Deep groove ball bearings.
pub(super) fn ball_bearings() -> impl Iterator<Item = CatalogueBearing> {
    TABLE.lines().skip(1).filter_map(|row| {
        let Row { ball: designation, boundary, balls: published, .. } = read(row)?;
        let inside = balls(boundary, &published).unwrap_or_else(|| estimated(boundary));
        Some(CatalogueBearing { designation, boundary, inside })
    })
}

/// Rexnord's ER16K, an insert bearing of one inch; its width is that of the outer ring, assumed.
pub(super) fn inserted() -> impl Iterator<Item = CatalogueBearing> {
    let inside = Inside {
        element_count: 9,
        element_diameter: 7.94,
        pitch_diameter: 39.32,
        roller_length: None,
        contact_angle: None,
        source: Some("Larizza, Howard, Grainger and Wang 2018, table 2"),
    };
    std::iter::once(CatalogueBearing { designation: "ER16K", boundary: [25.4, 52.0, 15.0], inside })
}

/// Angular contact ball bearings.
pub(super) fn angular_contact_bearings() -> impl Iterator<Item = CatalogueBearing> {
    let of = |[_, names @ ..]: [&'static str; 4], boundary| {
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

/// Cylindrical roller bearings.
pub(super) fn roller_bearings() -> impl Iterator<Item = CatalogueBearing> {
    TABLE.lines().skip(1).filter_map(read).filter_map(|Row { roller: designation, boundary, rollers, .. }| {
        Some(CatalogueBearing { designation, boundary, inside: rollers_of(rollers)? })
    })
}

/// A row of the table.
struct Row {
    /// Names of the ball and of the roller bearing.
    ball: &'static str,
    roller: &'static str,
    /// In millimetres.
    boundary: [f64; 3],
    /// Cells of what is published of each.
    rollers: [&'static str; 3],
    balls: [&'static str; 5],
}

fn read(row: &'static str) -> Option<Row> {
    // The source comes last and may have commas.
    let cells: Vec<&str> = row.splitn(13, ',').collect();
    let &[ball, roller, bore, outside, width, ref published @ ..] = &cells[..] else { return None };
    let boundary = [bore.parse().ok()?, outside.parse().ok()?, width.parse().ok()?];
    let (rollers, balls) = published.split_at_checked(3)?;
    Some(Row { ball, roller, boundary, rollers: rollers.try_into().ok()?, balls: balls.try_into().ok()? })
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

/// The rollers between two raceways (mm) of a bearing of this static rating (kN).
fn rollers_of(published: [&str; 3]) -> Option<Inside> {
    let [inner, outer, rating]: [f64; 3] =
        [published[0].parse().ok()?, published[1].parse().ok()?, published[2].parse().ok()?];
    // Diameters are published to a tenth of a millimetre, and rollers are made in halves.
    let (element_diameter, pitch_diameter) = ((outer - inner).round() / 2.0, 0.5 * (outer + inner));
    let element_count = (0.8 * std::f64::consts::PI * pitch_diameter / element_diameter).round() as usize;
    let of_length = 44.0 * (1.0 - element_diameter / pitch_diameter) * element_count as f64 * element_diameter;
    let roller_length = Some((1e3 * rating / of_length * 10.0).round() / 10.0);
    let (contact_angle, source) = (None, Some(ROLLERS_BY));
    Some(Inside { element_count, element_diameter, pitch_diameter, roller_length, contact_angle, source })
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
    use crate::catalogue::{catalogue, catalogued};

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
        assert_eq!(catalogue().count(), 37 + 1 + 3 * 11 + 21, "a row of the table is not read");
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
            assert!((0.8..1.2).contains(&shape), "{bearing:?}");
        }
    }
}
