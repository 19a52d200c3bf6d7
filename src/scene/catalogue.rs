//! Common deep groove ball bearings by their catalogue's name.
//!
//! Catalogues give the boundary dimensions of ISO 15 and keep what is inside to themselves. Where the number of balls,
//! their diameter and the pitch diameter are published, they stand here with their source. For all others they are
//! estimated from the boundary: pitch diameter (d + D)/2, balls of 0.3 (D − d) to the nearest 1/64 inch, as many as fill
//! 195° of the pitch circle, about what can be put in between two rings that are moved to one side. That gives 6203 and
//! 6205 the number and size of balls that are published of them; in a bearing on a shelf there may be one more or less,
//! and every frequency changes with it.

/// Millimetres of 1/64 inch, in which balls are made.
const STEP_OF_BALLS: f64 = 25.4 / 64.0;
/// Part of the pitch circle that balls fill [°], from the outermost edge of the first to that of the last but one.
const FILLED: f64 = 195.0;

/// A bearing of the catalogue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CatalogueBearing {
    /// Its name.
    pub designation: &'static str,
    /// Bore, outside diameter and width [mm].
    pub boundary: [f64; 3],
    /// What is inside.
    pub inside: Inside,
}

/// The rolling elements of a bearing of the catalogue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inside {
    /// Number of balls.
    pub element_count: usize,
    /// Their diameter [mm].
    pub element_diameter: f64,
    /// Pitch diameter [mm].
    pub pitch_diameter: f64,
    /// Who has published that; `None` where it is estimated.
    pub source: Option<&'static str>,
}

/// Name, bore, outside diameter and width [mm] by ISO 15.
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

/// Name, number of balls, their diameter and the pitch diameter [mm], and who has published that.
const PUBLISHED: [(&str, usize, [f64; 2], &str); 2] = [
    ("6203", 8, [6.7462, 28.4988], "Case Western Reserve University's bearing data, fan end"),
    ("6205", 9, [7.94, 39.04], "Case Western Reserve University's bearing data, drive end"),
];

/// All bearings of the catalogue.
pub fn catalogue() -> impl Iterator<Item = CatalogueBearing> {
    BOUNDARIES.iter().map(|&(designation, boundary)| {
        let published = PUBLISHED.iter().find(|(name, ..)| *name == designation);
        let inside = published.map_or_else(
            || estimated(boundary),
            |&(_, element_count, [element_diameter, pitch_diameter], source)| Inside {
                element_count,
                element_diameter,
                pitch_diameter,
                source: Some(source),
            },
        );
        CatalogueBearing { designation, boundary, inside }
    })
}

/// The bearing of this name, what makers put behind it (`-2RS`, `ZZ`, ` C3`) left out; `None` if there is none.
pub fn catalogued(designation: &str) -> Option<CatalogueBearing> {
    let number: String = designation.trim().chars().take_while(char::is_ascii_digit).collect();
    catalogue().find(|bearing| bearing.designation == number)
}

fn estimated([bore, outside, _]: [f64; 3]) -> Inside {
    let pitch_diameter = 0.5 * (bore + outside);
    let element_diameter = (0.3 * (outside - bore) / STEP_OF_BALLS).round() * STEP_OF_BALLS;
    let taken = 2.0 * libm::asin(element_diameter / pitch_diameter).to_degrees();
    Inside { element_count: 1 + (FILLED / taken) as usize, element_diameter, pitch_diameter, source: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_estimated_is_what_is_published_where_both_are_known() {
        for (name, count, [diameter, pitch], _) in PUBLISHED {
            let bearing = catalogued(name).unwrap();
            let guess = estimated(bearing.boundary);
            assert_eq!(guess.element_count, count, "{name}");
            // Balls to 0.01 mm; a pitch circle need not be halfway between bore and outside.
            assert!((guess.element_diameter - diameter).abs() < 0.01, "{name}: {guess:?}");
            assert!((guess.pitch_diameter / pitch - 1.0).abs() < 0.015, "{name}: {guess:?}");
            assert_eq!((bearing.inside.element_count, bearing.inside.element_diameter), (count, diameter));
        }
    }

    #[test]
    fn balls_have_room_between_the_rings_and_beside_each_other() {
        for bearing in catalogue() {
            let ([bore, outside, _], inside) = (bearing.boundary, bearing.inside);
            let Inside { element_count, element_diameter, pitch_diameter, .. } = inside;
            assert!(pitch_diameter - element_diameter > bore && pitch_diameter + element_diameter < outside);
            let spacing = pitch_diameter * (std::f64::consts::PI / element_count as f64).sin();
            assert!(spacing > 1.05 * element_diameter, "{bearing:?}");
            assert!((6..=13).contains(&element_count), "{bearing:?}");
        }
    }

    #[test]
    fn a_makers_additions_to_a_name_are_left_out() {
        for name in ["6205", "6205-2RS", "6205 ZZ/C3", " 6205"] {
            assert_eq!(catalogued(name).map(|bearing| bearing.designation), Some("6205"), "{name}");
        }
        for name in ["", "NU205", "62055", "bearing 6205"] {
            assert_eq!(catalogued(name), None, "{name}");
        }
    }
}
