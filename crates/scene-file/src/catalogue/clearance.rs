//! Radial internal clearance of new bearings with a cylindrical bore by ISO 5753-1:2009, which makers' catalogues print
//! (SKF, Rolling bearings, 17000/1 EN, 2018: table 6 of deep groove ball bearings, table 3 of cylindrical roller
//! bearings).
//!
//! It is what one ring can be moved against the other, from stop to stop. A class has a smallest and a largest value
//! for each range of bores; its middle is what is taken where nothing more is known. A letter behind the class takes a
//! part of it: H its upper half, L its lower half, M its middle half, P its upper half and the lower half of the next
//! class. Fits and warmth of a mounted bearing take some of it away.
//!
//! Angular contact ball bearings of one row have no radial clearance of their own: their contact angle gives it.

use std::fmt;

/// Classes of ISO 5753-1, from the tightest on.
const CLASSES: [&str; 5] = ["C2", "CN", "C3", "C4", "C5"];

/// Smallest and largest clearance (µm) of each class up to a bore (mm).
type Row = (f64, [[f64; 2]; 5]);

/// Deep groove ball bearings.
const BALLS: [Row; 10] = [
    (10.0, [[0.0, 7.0], [2.0, 13.0], [8.0, 23.0], [14.0, 29.0], [20.0, 37.0]]),
    (18.0, [[0.0, 9.0], [3.0, 18.0], [11.0, 25.0], [18.0, 33.0], [25.0, 45.0]]),
    (24.0, [[0.0, 10.0], [5.0, 20.0], [13.0, 28.0], [20.0, 36.0], [28.0, 48.0]]),
    (30.0, [[1.0, 11.0], [5.0, 20.0], [13.0, 28.0], [23.0, 41.0], [30.0, 53.0]]),
    (40.0, [[1.0, 11.0], [6.0, 20.0], [15.0, 33.0], [28.0, 46.0], [40.0, 64.0]]),
    (50.0, [[1.0, 11.0], [6.0, 23.0], [18.0, 36.0], [30.0, 51.0], [45.0, 73.0]]),
    (65.0, [[1.0, 15.0], [8.0, 28.0], [23.0, 43.0], [38.0, 61.0], [55.0, 90.0]]),
    (80.0, [[1.0, 15.0], [10.0, 30.0], [25.0, 51.0], [46.0, 71.0], [65.0, 105.0]]),
    (100.0, [[1.0, 18.0], [12.0, 36.0], [30.0, 58.0], [53.0, 84.0], [75.0, 120.0]]),
    (120.0, [[2.0, 20.0], [15.0, 41.0], [36.0, 66.0], [61.0, 97.0], [90.0, 140.0]]),
];
/// Cylindrical roller bearings.
const ROLLERS: [Row; 8] = [
    (24.0, [[0.0, 25.0], [20.0, 45.0], [35.0, 60.0], [50.0, 75.0], [65.0, 90.0]]),
    (30.0, [[0.0, 25.0], [20.0, 45.0], [35.0, 60.0], [50.0, 75.0], [70.0, 95.0]]),
    (40.0, [[5.0, 30.0], [25.0, 50.0], [45.0, 70.0], [60.0, 85.0], [80.0, 105.0]]),
    (50.0, [[5.0, 35.0], [30.0, 60.0], [50.0, 80.0], [70.0, 100.0], [95.0, 125.0]]),
    (65.0, [[10.0, 40.0], [40.0, 70.0], [60.0, 90.0], [80.0, 110.0], [110.0, 140.0]]),
    (80.0, [[10.0, 45.0], [40.0, 75.0], [65.0, 100.0], [90.0, 125.0], [130.0, 165.0]]),
    (100.0, [[15.0, 50.0], [50.0, 85.0], [75.0, 110.0], [105.0, 140.0], [155.0, 190.0]]),
    (120.0, [[15.0, 55.0], [50.0, 90.0], [85.0, 125.0], [125.0, 165.0], [180.0, 220.0]]),
];

/// A clearance class, or a part of one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ClearanceClass {
    /// Its place in [`CLASSES`].
    index: usize,
    /// H, L, M or P.
    part: Option<char>,
}

/// Clearance of a class for one bearing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClearanceRange {
    /// The class.
    pub class: ClearanceClass,
    /// Smallest and largest value (µm), as catalogues count.
    pub range_um: [f64; 2],
}

impl ClearanceClass {
    /// What bearings have whose name says nothing.
    pub const NORMAL: Self = Self { index: 1, part: None };

    /// The class of a word, as `C3`, `CN` (or `C0`), `C2H`.
    pub(super) fn of(word: &str) -> Option<Self> {
        let (class, part) = match word.len() {
            2 => (word, None),
            3 if word.is_ascii() => (&word[..2], word.chars().last().filter(|part| "HLMP".contains(*part)).map(Some)?),
            _ => return None,
        };
        let class = if class == "C0" { "CN" } else { class };
        Some(Self { index: CLASSES.iter().position(|known| *known == class)?, part })
    }

    /// Its clearance in a bearing of this bore (mm), with rollers or with balls; `None` beyond the table.
    pub(super) fn range(self, bore: f64, rollers: bool) -> Option<ClearanceRange> {
        let rows: &[Row] = if rollers { &ROLLERS } else { &BALLS };
        let (_, classes) = rows.iter().find(|(up_to, _)| bore <= *up_to)?;
        let [low, high] = classes[self.index];
        let middle = 0.5 * (low + high);
        let range_um = match self.part {
            None => [low, high],
            Some('H') => [middle, high],
            Some('L') => [low, middle],
            Some('M') => [0.5 * (low + middle), 0.5 * (middle + high)],
            Some(_) => {
                let [next_low, next_high] = classes.get(self.index + 1).copied().unwrap_or([low, high]);
                [middle, 0.5 * (next_low + next_high)]
            }
        };
        Some(ClearanceRange { class: self, range_um })
    }
}

impl ClearanceRange {
    /// The middle (µm), which is taken.
    pub fn middle_um(&self) -> f64 {
        0.5 * (self.range_um[0] + self.range_um[1])
    }
}

impl fmt::Display for ClearanceClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(CLASSES[self.index])?;
        self.part.map_or(Ok(()), |part| write!(f, "{part}"))
    }
}

impl fmt::Display for ClearanceRange {
    /// `C3, 13 to 28 um`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [low, high] = self.range_um;
        write!(f, "{}, {low} to {high} um", self.class)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(class: &str, bore: f64, rollers: bool) -> [f64; 2] {
        ClearanceClass::of(class).unwrap().range(bore, rollers).unwrap().range_um
    }

    #[test]
    fn a_class_has_the_standards_range_for_its_bore_and_kind() {
        // SKF's tables, at the ends of a range and beyond them.
        for (class, bore, balls, rollers) in [
            ("CN", 8.0, [2.0, 13.0], [20.0, 45.0]),
            ("C5", 10.0, [20.0, 37.0], [65.0, 90.0]),
            ("C3", 10.5, [11.0, 25.0], [35.0, 60.0]),
            ("C4", 25.0, [23.0, 41.0], [50.0, 75.0]),
            ("C3", 25.0, [13.0, 28.0], [35.0, 60.0]),
            ("C2", 40.0, [1.0, 11.0], [5.0, 30.0]),
            ("CN", 60.0, [8.0, 28.0], [40.0, 70.0]),
        ] {
            assert_eq!((range(class, bore, false), range(class, bore, true)), (balls, rollers), "{class} {bore}");
        }
        assert_eq!(ClearanceClass::NORMAL.range(500.0, false), None);
    }

    #[test]
    fn parts_of_a_class_are_halves_of_it_and_of_the_next() {
        let c3 = [13.0, 28.0];
        assert_eq!(range("C3", 25.0, false), c3);
        for (class, expected) in
            [("C3H", [20.5, 28.0]), ("C3L", [13.0, 20.5]), ("C3M", [16.75, 24.25]), ("C3P", [20.5, 32.0])]
        {
            assert_eq!(range(class, 25.0, false), expected, "{class}");
        }
        for word in ["C1", "C6", "C3X", "3", "C", "CM", "C3HH"] {
            assert_eq!(ClearanceClass::of(word), None, "{word}");
        }
    }

    #[test]
    fn classes_follow_each_other_and_wider_bores_have_no_smaller_middle() {
        for rows in [&BALLS[..], &ROLLERS[..]] {
            for (_, classes) in rows {
                assert!(classes.windows(2).all(|two| two[0][0] <= two[1][0] && two[0][1] < two[1][1]));
                assert!(classes.iter().all(|[low, high]| low < high));
            }
            assert!(rows.windows(2).all(|two| two[0].0 < two[1].0));
            let middle = |row: &Row, k: usize| row.1[k][0] + row.1[k][1];
            assert!((0..5).all(|k| rows.windows(2).all(|two| middle(&two[0], k) <= middle(&two[1], k))));
        }
    }
}
