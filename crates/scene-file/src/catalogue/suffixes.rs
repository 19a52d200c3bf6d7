//! What makers put behind the number of a bearing, code by code, as their catalogues explain them (SKF, Rolling
//! bearings, 17000/1 EN, 2018; NTN, Ball and roller bearings, 2203/E; Schaeffler, HR 1; NSK, E1103).
//!
//! Codes of several makers stand side by side: one that is two makers' means nothing else to a model than that it has
//! no effect, or stands among those of one kind of bearing alone. `#` is a digit.

use super::Kind;
use super::clearance::ClearanceClass;

/// What a part of a name says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meaning {
    /// Nothing that the model knows; what it is.
    WithoutEffect(&'static str),
    /// A clearance class, after what else is in the word.
    Clearance(ClearanceClass),
    /// A clearance class, where the name says no other.
    ImpliedClearance(ClearanceClass),
    /// Elements of silicon nitride.
    Hybrid,
    /// Something that would change the bearing, and what to do.
    Asked(&'static str),
}

const SEALS: &str = "seals or shields";
const CAGE: &str = "cage";
const TOLERANCE: &str = "tolerance class";
const GREASE: &str = "grease";
const SNAP_RING: &str = "snap ring or its groove";
const HEAT: &str = "heat treatment";
const SET: &str = "set, its preload or play";
const INSULATION: &str = "electrical insulation";
const DESIGN: &str = "the maker's design";
const MARK: &str = "the maker's mark";

/// Codes of all kinds of bearings.
const ALL: [(&str, &[&str]); 10] = [
    (
        SEALS,
        &[
            "Z", "ZZ", "2Z", "ZR", "2ZR", "ZA", "ZZA", "ZE", "ZZE", "ZS", "ZZS", "ZZ1", "2ZS", "RS", "2RS", "RS#",
            "2RS#", "RSH", "2RSH", "RSH2", "2RSH2", "RSL", "2RSL", "RSR", "2RSR", "RSD", "2RSD", "BRS", "2BRS", "HRS",
            "2HRS", "RSC", "2RSC", "RST", "2RST", "RSS", "2RSS", "RSN", "2RSN", "RZ", "2RZ", "2ELS", "LS", "2LS", "RD",
            "2RD", "RK", "2RK", "RU", "2RU", "2RDT", "DU", "DDU", "DD", "DDW", "DW", "VV", "LB", "LLB", "LU", "LLU",
            "LH", "LLH", "LLUA", "LUA", "NSE", "2NSE", "NSE#", "2NSE#", "NSL", "2NSL", "NK", "2NK", "NKE", "2NKE",
            "EE", "FT", "PP", "RR", "FF", "2RF", "2F", "TT", "UU",
        ],
    ),
    (
        CAGE,
        &[
            "M", "M#", "M#A", "M#B", "MA", "MB", "MAS", "MBS", "MAR", "J", "J#", "JA", "JB", "JR", "JN", "JW", "JP#",
            "TN", "TN#", "TNH", "TNG", "TNGH", "TV", "TVP", "TVP#", "TVPB", "TVH", "TVHB", "TVM", "TPA", "TPB", "TP",
            "TPX", "T", "T#", "T#X", "T##", "T#G", "TA", "TB", "TH", "TY", "TYN", "TR", "W", "Y", "YA", "YN", "L",
            "L1", "L1B", "LA", "ML", "MP", "MR", "MPA", "MPB", "MPBX", "MPY", "MPAX", "F", "F#", "FA", "FB", "FP",
            "FPA", "FPB", "FY", "P", "PH", "PHA", "PHAS", "PA", "PB", "G1", "G2", "G15", "A2S", "AT",
        ],
    ),
    (
        TOLERANCE,
        &[
            "P0", "P2", "P4", "P4A", "P4S", "P5", "P5A", "P6", "P6E", "P6X", "PA9A", "PA9B", "PN", "SP", "UP", "ABEC#",
            "CLN",
        ],
    ),
    (
        GREASE,
        &[
            "GJN", "GJ", "GE", "GEM", "GEM9", "GWB", "GWP", "GWF", "GHU", "GLE", "HT", "HT##", "LT", "LT##", "LHT",
            "LHT##", "MT", "MT##", "WT", "WTF#", "WT##", "WTF", "VT###", "VP###", "L0##", "L1##", "L2##", "L###", "5K",
            "2AS", "AS2S", "AV2S", "NS7S", "NS7", "NS", "PS2", "SRL", "EA2", "EP2", "LX##", "M17", "D##", "W64", "AG",
            "MAS6",
        ],
    ),
    (SNAP_RING, &["N", "NR", "N1", "N2", "NB", "NBR", "NX", "R"]),
    (HEAT, &["S0", "S1", "S2", "S3", "S4", "SN", "TS2", "TS3", "TS4", "HA#", "HB#", "HN#", "L4B", "L5B", "L7B", "J30"]),
    (
        SET,
        &[
            "DB", "DF", "DT", "DG", "DBL", "DFL", "DBM", "DFM", "DUL", "DUM", "DUH", "DBA", "DBB", "DBC", "DR", "QR",
            "SU", "SUL", "SUM", "SUH", "UA", "UB", "UO", "UL", "UM", "UH", "U", "GA", "GB", "GC", "GN", "GM", "GL",
            "GH", "DGA", "DGB", "TBT", "QBC", "TFT",
        ],
    ),
    (INSULATION, &["VL0###", "VL####", "J20A", "J20AA", "J20AB", "J20AC", "J20B", "J20C", "J20GA", "J20GI"]),
    (DESIGN, &["XL", "A", "B", "D", "G", "EXPLORER", "OPEN", "HS"]),
    (MARK, &["QE#", "Q##", "VQ###", "VE###", "VC###", "VA3##", "W20", "W26", "W33", "W33X", "AH", "LP##", "ENP", "NA"]),
];
/// Codes of deep groove ball bearings alone.
const BALLS: [(&str, &[&str]); 3] = [(SEALS, &["V", "D", "S"]), (DESIGN, &["C"]), (MARK, &["K"])];
/// Codes of angular contact ball bearings alone, behind that of the angle.
const ANGULAR: [(&str, &[&str]); 2] =
    [(SET, &["CA", "CB", "CC", "CG", "CGA", "CGB", "C7", "C8", "C9"]), (DESIGN, &["E", "EA", "EP"])];
/// Codes of cylindrical roller bearings alone.
const ROLLERS: [(&str, &[&str]); 1] = [(DESIGN, &["E", "EC", "ECA", "EM", "ET", "EW", "EG", "E1"])];

const CLEARANCE: &str = "a clearance that ISO 5753-1 does not have: bearing.internal_clearance_um says it, without it \
    that of CN is taken";
const HOT: &str = "more clearance than C5: bearing.internal_clearance_um says it";
const MORE_BALLS: &str = "more balls, or larger ones: bearing.element_count and bearing.element_diameter_mm say them";
const FULL: &str = "as many rollers as go in: bearing.element_count says how many";
const TAPER: &str = "a tapered bore, of other clearance: bearing.internal_clearance_um says it";

/// Codes that would change the bearing.
const ASKED: [(&str, &[&str]); 2] = [(CLEARANCE, &["C1", "CM", "CT", "CS", "CC#", "CG##"]), (HOT, &["VA2##"])];
const ASKED_OF_BALLS: [(&str, &[&str]); 1] = [(MORE_BALLS, &["E"])];
const ASKED_OF_MINIATURES: [(&str, &[&str]); 2] = [(CLEARANCE, &["MC#"]), (MORE_BALLS, &["E"])];
const ASKED_OF_ROLLERS: [(&str, &[&str]); 2] = [(FULL, &["V", "VH", "CV"]), (TAPER, &["K", "K30"])];

/// Words for elements of silicon nitride.
const HYBRID: [&str; 6] = ["HC", "HC#", "HYBRID", "HYB", "SI3N4", "SN24"];

/// Longest word that is taken apart.
const LONGEST: usize = 24;

/// Single letters in a word, at most: more are no codes but a word that is not known.
const MOST_LETTERS: usize = 2;

/// A word of a name in its codes, the longest that there are; `None` if it has others in it.
pub(super) fn codes(word: &str, kind: Kind) -> Option<Vec<(String, Meaning)>> {
    if !word.is_ascii() || word.len() > LONGEST {
        return None;
    }
    // 2RSHYB is no 2RSH: a word for ceramic elements stands at the end.
    let hybrid = HYBRID.iter().find(|code| code.len() > 2 && word.len() > code.len() && word.ends_with(**code));
    let mut all = split(&word[..word.len() - hybrid.map_or(0, |code| code.len())], kind)?;
    all.extend(hybrid.map(|code| ((*code).to_owned(), Meaning::Hybrid)));
    // NSK's E behind a class is that of noise.
    if let [.., (_, Meaning::Clearance(_)), (code, meaning)] = &mut all[..]
        && code == "E"
    {
        *meaning = Meaning::WithoutEffect("noise class");
    }
    (all.iter().filter(|(code, _)| code.len() == 1).count() <= MOST_LETTERS).then_some(all)
}

/// The clearance class with which an unknown word begins or ends, and the rest of it.
pub(super) fn class_within(word: &str) -> (Option<ClearanceClass>, &str) {
    let class =
        |part: Option<&str>| part.filter(|part| part.starts_with('C') && part != &"CN").and_then(ClearanceClass::of);
    let (front, back) = (word.get(..2), word.len().checked_sub(2).and_then(|at| word.get(at..)));
    let goes_on = word.chars().nth(2).is_some_and(|c| c.is_ascii_alphabetic());
    match (class(front).filter(|_| goes_on), class(back)) {
        (Some(class), _) => (Some(class), &word[2..]),
        (None, Some(class)) => (Some(class), &word[..word.len() - 2]),
        (None, None) => (None, word),
    }
}

fn split(word: &str, kind: Kind) -> Option<Vec<(String, Meaning)>> {
    if word.is_empty() {
        return Some(Vec::new());
    }
    (1..=word.len()).rev().find_map(|length| {
        let (code, rest) = word.split_at(length);
        // C3HT is C3 and HT: a part of a class ends its word.
        let meaning = meaning(code, kind).filter(|of| {
            !(matches!(of, Meaning::Clearance(_)) && length == 3 && code.starts_with('C') && !rest.is_empty())
        })?;
        let mut all = split(rest, kind)?;
        all.insert(0, (code.to_owned(), meaning));
        Some(all)
    })
}

fn meaning(code: &str, kind: Kind) -> Option<Meaning> {
    if HYBRID.iter().any(|pattern| fits(code, pattern)) {
        return Some(Meaning::Hybrid);
    }
    // SKF's mark of bearings for electric motors: C3, and a grease.
    if code == "JEM" {
        return ClearanceClass::of("C3").map(Meaning::ImpliedClearance);
    }
    // C2 to C9 of a single angular contact bearing are those of sets.
    if let Some(class) = ClearanceClass::of(code) {
        return Some(Meaning::Clearance(class));
    }
    // P63 is P6 and C3.
    if let Some(class) = code.strip_prefix('P').filter(|digits| digits.len() == 2 && "2456".contains(&digits[..1]))
        && let Some(class) = ClearanceClass::of(&format!("C{}", &class[1..]))
    {
        return Some(Meaning::Clearance(class));
    }
    let [own, asked]: [&[(&'static str, &[&str])]; 2] = match kind {
        Kind::DeepGroove => [&BALLS, &ASKED_OF_BALLS],
        Kind::Miniature => [&BALLS, &ASKED_OF_MINIATURES],
        Kind::Angular => [&ANGULAR, &[]],
        Kind::Roller => [&ROLLERS, &ASKED_OF_ROLLERS],
    };
    let of = |lists: &[(&'static str, &[&str])]| {
        lists.iter().find(|(_, codes)| codes.iter().any(|pattern| fits(code, pattern))).map(|(what, _)| *what)
    };
    let asked = of(asked).or_else(|| of(&ASKED)).map(Meaning::Asked);
    asked.or_else(|| of(own).or_else(|| of(&ALL)).map(Meaning::WithoutEffect))
}

fn fits(code: &str, pattern: &str) -> bool {
    let alike = |(c, p): (char, char)| c == p || (p == '#' && c.is_ascii_digit());
    code.len() == pattern.len() && code.chars().zip(pattern.chars()).all(alike)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_taken_apart_into_the_longest_codes() {
        let of = |word, kind| codes(word, kind).map(|all| all.into_iter().map(|(code, _)| code).collect::<Vec<_>>());
        let words = |list: &[&str]| Some(list.iter().map(|&word| word.to_owned()).collect::<Vec<_>>());
        assert_eq!(of("2RSLTN9", Kind::DeepGroove), words(&["2RSL", "TN9"]));
        assert_eq!(of("HC5C3WT", Kind::DeepGroove), words(&["HC5", "C3", "WT"]));
        assert_eq!(of("C3VL0241", Kind::Roller), words(&["C3", "VL0241"]));
        assert_eq!(of("ECBPH", Kind::Angular), words(&["E", "CB", "PH"]));
        assert_eq!(of("DDUCM", Kind::DeepGroove), words(&["DDU", "CM"]));
        assert_eq!(of("2ZNR", Kind::DeepGroove), words(&["2Z", "NR"]));
        assert_eq!(of("ECML", Kind::Roller), words(&["EC", "ML"]));
        assert_eq!(of("C3HT", Kind::DeepGroove), words(&["C3", "HT"]));
        assert_eq!(of("C3L", Kind::DeepGroove), words(&["C3L"]));
        assert_eq!(of("2RSHYB", Kind::DeepGroove), words(&["2RS", "HYB"]));
        assert_eq!(of("2RSJEM", Kind::DeepGroove), words(&["2RS", "JEM"]));
        for word in ["QXYZ", "C6C7", "2RS?", "Ü", "ABCDEF"] {
            assert_eq!(of(word, Kind::DeepGroove), None, "{word}");
        }
    }

    #[test]
    fn no_code_stands_for_two_things_of_one_kind_of_bearing() {
        for own in [&BALLS[..], &ANGULAR[..], &ROLLERS[..]] {
            let mut all: Vec<&str> = own.iter().flat_map(|(_, codes)| codes.iter().copied()).collect();
            let count = all.len();
            all.sort_unstable();
            all.dedup();
            assert_eq!(all.len(), count);
        }
        let mut all: Vec<&str> = ALL.iter().flat_map(|(_, codes)| codes.iter().copied()).collect();
        let count = all.len();
        all.sort_unstable();
        let twice: Vec<_> = all.windows(2).filter(|two| two[0] == two[1]).collect();
        assert!(twice.is_empty(), "{twice:?} of {count}");
    }
}
