//! Names as makers write them: `SKF 6205-2Z/C3`, `NU 205 ECP`, `7205 BEP/HC5C3`, `HCB7205-C-T-P4S`.
//!
//! A name is a maker, letters in front, a number and what stands behind it, with blanks, dashes, dots and strokes
//! between them where a maker likes them. Behind the number come codes one after another, several in a word. A
//! clearance class, ceramic elements and the contact angle say what the model needs; seals, cages, greases and
//! tolerances are without effect and named as such; what is not known, or would change the bearing, is asked about.

use super::clearance::ClearanceClass;
use super::suffixes::{Meaning, class_within, codes};
use super::{CatalogueBearing, Designation, Kind, NotInCatalogue, catalogue};

/// Makers of bearings, who stand in front of a name or behind it.
const MAKERS: &str = "NTN-SNR NSK-RHP SKF FAG INA SCHAEFFLER NSK NTN SNR KOYO JTEKT NACHI TIMKEN FAFNIR MRC RHP \
    ZKL ZVL KINEX URB KYK NKE ORS GMN IBC SLF FBJ NMB EZO BARDEN GRW KBC LYC HRB ZWZ C&U TPI NBC \
    STEYR DKF SNFA REXNORD LINK-BELT CRAFT NIS ISB CX VXB BECO PFI FERSA PEER HOFFMANN EBC HCH \
    CYSD DYZV AST STIEBER NORMA RIV ASAHI FYH DODGE MCGILL RBC IKO KML NRB NSB SEALMASTER \
    AMERICAN THK ROLLWAY CMB";
/// What may stand in front of a number, and what it is.
const PREFIXES: [(&str, Front); 19] = [
    ("D/W", Front::WithoutEffect("stainless steel, taken for bearing steel")),
    ("ICOS", Front::WithoutEffect("an oil seal")),
    ("5S", Front::Hybrid),
    ("XCB", Front::Hybrid),
    ("HCB", Front::Hybrid),
    ("HCS", Front::Hybrid),
    ("XCS", Front::Hybrid),
    ("HC", Front::Hybrid),
    ("XC", Front::Hybrid),
    ("E2", Front::Asked("fewer balls for less friction: bearing.element_count says how many")),
    ("TS2", Front::WithoutEffect("heat treatment")),
    ("TS3", Front::WithoutEffect("heat treatment")),
    ("TM", Front::WithoutEffect("the maker's design")),
    ("SS", Front::WithoutEffect("stainless steel, taken for bearing steel")),
    ("S", Front::WithoutEffect("stainless steel, taken for bearing steel")),
    ("W", Front::WithoutEffect("stainless steel, taken for bearing steel")),
    ("B", Front::WithoutEffect("a spindle bearing")),
    // Of NTN.
    ("EC-", Front::WithoutEffect("against creep of the outer ring")),
    ("AC-", Front::WithoutEffect("against creep of the outer ring")),
];
/// Letters before the number of a roller bearing, which say where its flanges are.
const FLANGES: [&str; 4] = ["NUP", "NU", "NJ", "N"];
/// Codes of contact angles behind the number of an angular contact bearing, and the catalogue's letter for each.
/// NTN has a U in front, which is the design.
const ANGLES: [(&str, &str); 8] =
    [("UAD", "AC"), ("UC", "C"), ("AD", "AC"), ("AC", "AC"), ("A5", "AC"), ("B", "B"), ("C", "C"), ("E", "AC")];

/// What stands in front of a number.
#[derive(Clone, Copy)]
enum Front {
    WithoutEffect(&'static str),
    Hybrid,
    Asked(&'static str),
}

/// Reads a name.
///
/// ```
/// let read = brinell_scene_file::designation("SKF 6205-2Z/C3").unwrap();
/// assert_eq!((read.bearing.designation, read.bearing.inside.element_count), ("6205", 9));
/// assert_eq!(read.clearance.unwrap().range_um, [13.0, 28.0]);
/// ```
///
/// # Errors
/// A name of no bearing of the catalogue, and one that says two clearance classes.
pub fn designation(name: &str) -> Result<Designation, NotInCatalogue> {
    let none = || NotInCatalogue::of(name);
    let text = plain(name);
    let (maker, text) = without_maker(&text);
    let mut parts = Parts::default();
    let text = parts.take_front(&text);
    let Number { digits, kind, letter, rest, attached } = number(&text).ok_or_else(none)?;
    let wanted = match (kind, letter) {
        (Kind::Roller, _) => format!("NU{digits}"),
        (Kind::Angular, Some(letter)) => format!("{digits}{letter}"),
        (Kind::Angular, None) => return Err(none()),
        (Kind::DeepGroove | Kind::Miniature, _) => digits.to_owned(),
    };
    let bearing = catalogue().find(|bearing| bearing.designation == wanted).ok_or_else(none)?;
    parts.take_rest(rest, kind, attached).ok_or_else(none)?;
    parts.into_designation(name, bearing, maker)
}

/// Capitals, with one kind of dash and of blank.
fn plain(name: &str) -> String {
    let same = |c: char| match c {
        '–' | '—' | '‐' | '‑' | '−' | '_' => '-',
        c if c.is_whitespace() => ' ',
        c => c,
    };
    name.trim().to_uppercase().chars().map(same).collect()
}

/// The maker at either end of a name, and the rest.
fn without_maker(text: &str) -> (Option<&'static str>, String) {
    let is_end = |c: Option<char>| c.is_none_or(|c| !c.is_ascii_alphabetic());
    for maker in MAKERS.split(' ') {
        if let Some(rest) = text.strip_prefix(maker).filter(|rest| is_end(rest.chars().next())) {
            return (Some(maker), rest.trim_start_matches(SEPARATORS).to_owned());
        }
        let behind = text.trim_end_matches(SEPARATORS).strip_suffix(maker);
        if let Some(rest) = behind.filter(|rest| rest.ends_with(SEPARATORS)) {
            return (Some(maker), rest.trim_end_matches(SEPARATORS).to_owned());
        }
    }
    (None, text.to_owned())
}

/// Letters of a word in front of a name, at least: fewer are a kind of bearing, if not a whole number follows.
const LEAST_OF_WORD: usize = 4;
/// Digits of a ball bearing's number that no kind of bearing stands in front of: UC 205 is an insert bearing.
const WHOLE: usize = 4;

const SEPARATORS: [char; 11] = [' ', '-', '/', '.', ',', '(', ')', '+', ':', ';', '*'];

/// The number of a name.
struct Number<'t> {
    digits: &'t str,
    kind: Kind,
    /// The catalogue's letter for the contact angle.
    letter: Option<&'static str>,
    rest: &'t str,
    /// Whether the rest begins right behind the number.
    attached: bool,
}

/// The number of a bearing of the catalogue's kinds, with its contact angle.
fn number(text: &str) -> Option<Number<'_>> {
    let front = text.len() - text.trim_start_matches(|c: char| c.is_ascii_alphabetic()).len();
    let (letters, rest) = text.split_at(front);
    let rest = if letters.is_empty() { rest } else { rest.trim_start_matches([' ', '-']) };
    let count = match letters {
        "ER" => return inserted(rest),
        "" if !rest.starts_with("608") => 4,
        _ if letters.is_empty() || FLANGES.contains(&letters) => 3,
        _ => return None,
    };
    let (digits, rest) =
        rest.split_at_checked(count).filter(|(digits, _)| digits.bytes().all(|c| c.is_ascii_digit()))?;
    // `62052RS` is a 6205 2RS, and 62055 another number.
    let more = rest.bytes().take_while(u8::is_ascii_digit).count();
    if more > 1 || (more == 1 && (!rest.starts_with('2') || rest.len() == 1)) {
        return None;
    }
    let kind = match letters {
        "" if digits.starts_with("72") => Kind::Angular,
        "" if digits == "608" => Kind::Miniature,
        "" => Kind::DeepGroove,
        _ => Kind::Roller,
    };
    let attached = !rest.starts_with(SEPARATORS);
    let angle = if kind == Kind::Angular { angle(rest) } else { None };
    let (letter, rest) = angle.map_or((None, rest), |(letter, rest)| (Some(letter), rest));
    Some(Number { digits, kind, letter, rest, attached })
}

/// The catalogue's letter of a contact angle, and what stands behind its code.
fn angle(rest: &str) -> Option<(&'static str, &str)> {
    let behind = rest.trim_start_matches(SEPARATORS);
    ANGLES.iter().find_map(|(code, letter)| {
        let rest = behind.strip_prefix(code)?;
        // C3 is a clearance.
        let is_class = *code == "C" && rest.starts_with(|c: char| c.is_ascii_digit());
        (!is_class).then_some((*letter, rest))
    })
}

/// ER16K, an insert bearing: `ER-16K`, `ER 16 K`.
fn inserted(rest: &str) -> Option<Number<'_>> {
    let behind = rest.strip_prefix("16")?.trim_start_matches([' ', '-']).strip_prefix('K')?;
    let attached = !behind.starts_with(SEPARATORS);
    Some(Number { digits: "ER16K", kind: Kind::DeepGroove, letter: None, rest: behind, attached })
}

/// What was found beside the number.
#[derive(Default)]
struct Parts {
    classes: Vec<ClearanceClass>,
    /// The class of a mark that stands for several things, where no other is said.
    implied: Option<ClearanceClass>,
    hybrid: bool,
    without_effect: Vec<(String, &'static str)>,
    asked: Vec<(String, Option<&'static str>)>,
}

impl Parts {
    /// What stands in front of the number; gives the rest. A word that is not known may be a maker.
    fn take_front(&mut self, text: &str) -> String {
        for (code, what) in PREFIXES {
            let Some(rest) = text.strip_prefix(code) else { continue };
            let rest = rest.trim_start_matches(SEPARATORS);
            // Of a number there is a first digit or the letters of a roller bearing.
            let goes_on = rest.starts_with(|c: char| c.is_ascii_digit()) || FLANGES.iter().any(|f| rest.starts_with(f));
            if goes_on && !(code.len() == 1 && FLANGES.iter().any(|f| rest.starts_with(f))) {
                match what {
                    Front::WithoutEffect(what) => self.without_effect.push((code.to_owned(), what)),
                    Front::Hybrid => self.hybrid = true,
                    Front::Asked(what) => self.asked.push((code.to_owned(), Some(what))),
                }
                return rest.to_owned();
            }
        }
        let Some((word, rest)) = text.split_once(SEPARATORS) else { return text.to_owned() };
        let rest = rest.trim_start_matches(SEPARATORS);
        let is_long = word.chars().count() >= LEAST_OF_WORD && word.chars().all(char::is_alphabetic);
        let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
        let of_roller = FLANGES.iter().filter_map(|letters| rest.strip_prefix(letters)).map(digits).max();
        let is_whole = digits(rest) >= WHOLE || of_roller.is_some_and(|count| count >= WHOLE - 1);
        let is_number = FLANGES.contains(&word) || word == "ER" || digits(word) >= WHOLE - 1;
        if is_long || (is_whole && !is_number && word.bytes().any(|c| c.is_ascii_alphabetic())) {
            self.asked.push((word.to_owned(), None));
            return self.take_front(rest);
        }
        text.to_owned()
    }

    /// What stands behind the number. One unknown letter right behind it makes another name of it.
    fn take_rest(&mut self, rest: &str, kind: Kind, attached: bool) -> Option<()> {
        let mut words: Vec<String> = Vec::new();
        for word in rest.split(SEPARATORS).filter(|word| !word.is_empty()) {
            let is_digit = word.len() == 1 && word.bytes().all(|c| c.is_ascii_digit());
            match words.last_mut() {
                // `C 3` and `ABEC-7`.
                Some(last) if is_digit && (last == "C" || last == "ABEC") => last.push_str(word),
                _ => words.push(word.to_owned()),
            }
        }
        for (index, word) in words.into_iter().enumerate() {
            match codes(&word, kind) {
                Some(all) => all.into_iter().for_each(|(code, meaning)| self.take(code, meaning)),
                None if index == 0 && attached && word.chars().count() == 1 => return None,
                None => {
                    let (class, unknown) = class_within(&word);
                    class.into_iter().for_each(|class| self.take(word.clone(), Meaning::Clearance(class)));
                    self.asked.push((unknown.to_owned(), None));
                }
            }
        }
        Some(())
    }

    fn take(&mut self, code: String, meaning: Meaning) {
        match meaning {
            Meaning::WithoutEffect(what) => self.without_effect.push((code, what)),
            Meaning::Asked(what) => self.asked.push((code, Some(what))),
            Meaning::Hybrid => self.hybrid = true,
            Meaning::ImpliedClearance(class) => self.implied = Some(class),
            Meaning::Clearance(class) => {
                if !self.classes.contains(&class) {
                    self.classes.push(class);
                }
            }
        }
    }

    fn into_designation(
        mut self,
        name: &str,
        bearing: CatalogueBearing,
        maker: Option<&'static str>,
    ) -> Result<Designation, NotInCatalogue> {
        if let [one, other, ..] = self.classes[..] {
            return Err(NotInCatalogue::TwoClasses { name: name.to_owned(), one, other });
        }
        let class = self.classes.first().copied().or(self.implied);
        let rollers = bearing.inside.roller_length.is_some();
        let clearance = match bearing.inside.contact_angle {
            None => class.unwrap_or(ClearanceClass::NORMAL).range(bearing.boundary[0], rollers),
            Some(_) => {
                let what = "of bearings without a contact angle, which gives the clearance";
                self.without_effect.extend(class.map(|class| (class.to_string(), what)));
                None
            }
        };
        let says_class = class.is_some() && clearance.is_some();
        let Self { hybrid, without_effect, asked, .. } = self;
        Ok(Designation { bearing, clearance, says_class, hybrid, maker, without_effect, asked })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Names of catalogues and shops: the bearing, the clearance class that is said, whether elements are ceramic, and
    /// whether something is asked about.
    const NAMES: &str = include_str!("names.csv");

    #[test]
    fn names_are_read_as_makers_write_them() {
        let (mut count, mut wrong) = (0, Vec::new());
        for row in NAMES.lines().skip(1) {
            let [name, bearing, class, hybrid, asked] = row.split(';').collect::<Vec<_>>().try_into().unwrap();
            let read = designation(name).unwrap_or_else(|why| panic!("{name}: {why}"));
            let said = read.clearance.filter(|_| read.says_class).map_or(String::new(), |c| c.class.to_string());
            let found = (read.bearing.designation, &*said, read.hybrid, !read.asked.is_empty());
            if found != (bearing, class, hybrid == "HC", asked == "asked") {
                wrong.push(format!("{row}: {found:?}, {:?}, {:?}", read.without_effect, read.asked));
            }
            count += 1;
        }
        assert!(count >= 200 && wrong.is_empty(), "{count}: {wrong:#?}");
    }

    #[test]
    fn what_stands_around_a_number_changes_nothing_but_what_it_says() {
        let numbers = [("6205", "6205"), ("NU 205", "NU205"), ("7205 B", "7205B"), ("608", "608"), ("NJ-310", "NU310")];
        let makers = ["", "SKF ", "fag-", "NTN ", " koyo "];
        let seals = ["", "-2Z", " 2RS1", "/P6", ".TVP", " M", "-2RSR"];
        let classes =
            [("", "CN"), ("/C3", "C3"), (" C4", "C4"), ("-C2", "C2"), (".C5", "C5"), (" C 3", "C3"), ("-C-4", "C4")];
        for (number, expected) in numbers {
            for maker in makers {
                for seal in seals {
                    for (class, of) in classes {
                        for name in [format!("{maker}{number}{seal}{class}"), format!("{maker}{number}{class}{seal}")] {
                            let read = designation(&name).unwrap_or_else(|why| panic!("{name}: {why}"));
                            assert_eq!(read.bearing.designation, expected, "{name}");
                            let angular = read.bearing.inside.contact_angle.is_some();
                            let found = read.clearance.map(|clearance| clearance.class.to_string());
                            assert_eq!(found.as_deref(), (!angular).then_some(of), "{name}");
                            assert!(!read.hybrid && read.asked.is_empty(), "{name}: {read:?}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn what_is_no_name_of_the_catalogue_is_refused() {
        for name in
            ["", "NA205", "NU", "62055", "QJ 205", "UC 205", "6205x", "NU205Q", "7205", "7205A", "7213B", "6205é", "2"]
        {
            assert!(designation(name).is_err(), "{name}");
        }
        let both = designation("6205 C3/C4").unwrap_err().to_string();
        assert!(both.contains("two clearance classes, C3 and C4"), "{both}");
    }

    #[test]
    fn a_name_says_what_it_says() {
        let said = |name: &str| designation(name).unwrap().remark().unwrap_or_default();
        assert_eq!(said("6205"), "");
        let full = said("SKF 6205-2Z/C3");
        let parts = ["a 6205 of SKF: ", "C3, 13 to 28 um (ISO 5753-1)", "20.5 um", "without effect here: 2Z (seals"];
        assert!(parts.iter().all(|part| full.contains(part)), "{full}");
        for (name, word) in [("6205-ABCDEF", "ABCDEF"), ("bearing 6205", "BEARING"), ("Nobody 6205", "NOBODY")] {
            assert!(said(name).contains(&format!("what does {word} say?")), "{}", said(name));
        }
        assert!(said("NU 210 ECM/HC5C3").contains("silicon nitride"));
        assert!(said("7205 BEP/C3").contains("C3 (of bearings without a contact angle"));
    }
}
