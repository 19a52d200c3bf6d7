//! Columns of the table of a sweep, with what they mean and their units.

use toml::Value;

use super::statistics::HARMONICS;
use super::{Column, Kind};
use crate::sweep::file::{Sweep, number};
use crate::sweep::scenes::LOADS;

/// What a run is a run of, behind its inputs. From `fault_type` to `ftf` by the names and words of the package
/// bearing-datasets, so that its recordings and runs stand in one table.
const LABELS: [(&str, Kind, &str); 17] = [
    ("label_kind", Kind::Text, "healthy, outer, inner, element, or several"),
    ("label_length_mm", Kind::Number, "length of the spall along the raceway"),
    ("label_depth_um", Kind::Number, "depth of the spall's floor"),
    ("label_angle_deg", Kind::Number, "where the middle of the defect is at the start"),
    ("label_load_n", Kind::Number, "force that the bearing carries"),
    ("label_speed_hz", Kind::Number, "turns of the shaft per second, the mean of a speed that changes"),
    ("fault_type", Kind::Text, "normal, outer, inner, rolling_element; several with +"),
    ("fault_location", Kind::Text, "none or test_bearing"),
    ("fault_size_mm", Kind::Number, "length of the longest spall, 0 of a healthy bearing"),
    ("speed_rpm", Kind::Number, "turns of the shaft per minute"),
    ("load", Kind::Number, "force that the bearing carries, in load_unit"),
    ("load_unit", Kind::Text, "unit of load: N"),
    ("fs", Kind::Number, "samples per second"),
    ("bpfo", Kind::Number, "passage frequency of the outer raceway over the shaft's, without slip"),
    ("bpfi", Kind::Number, "passage frequency of the inner raceway over the shaft's, without slip"),
    ("bsf", Kind::Number, "spin frequency of an element over the shaft's, without slip"),
    ("ftf", Kind::Number, "frequency of the cage over the shaft's, without slip"),
];

/// What the first sensor shows.
const STATISTICS: [(&str, &str); 4] = [
    ("bpfo_hz", "passages of elements over a point of the outer raceway per second, the mean over the run"),
    ("rms_m_s2", "root mean square of the first sensor"),
    ("peak_m_s2", "largest absolute value of the first sensor"),
    ("kurtosis", "kurtosis of the first sensor, 3 of normal noise"),
];

/// A passage of the defect, and the cost of a run.
const PASSAGE_AND_STEPS: [(&str, Kind, &str); 6] = [
    ("unloaded_s", Kind::Number, "when an element has lost half its force over the defect"),
    ("loaded_again_s", Kind::Number, "when that element has it again"),
    ("unloaded_deg", Kind::Number, "how far that element turns in between"),
    ("steps", Kind::Whole, "steps of the solver"),
    ("rejected_steps", Kind::Whole, "steps that the solver rejected"),
    ("error", Kind::Text, "why the run failed; null of one that did not"),
];

/// Units of columns whose names do not end in them.
const UNITS: [(&str, &str); 4] =
    [("load", "N"), ("fs", "Hz"), ("speed_rpm", "1/min"), ("shaft.load_moment_n_m", "N.m")];
/// Units that names end in, with the longer ending first where it has another in it.
const ENDINGS: [(&str, &str); 23] = [
    ("_n_m1_5", "N/m1.5"),
    ("_n_m_rad", "N.m/rad"),
    ("_n_m_s", "N.m.s"),
    ("_n_s_m", "N.s/m"),
    ("_kg_m3", "kg/m3"),
    ("_kg_m2", "kg.m2"),
    ("_m_s2", "m/s2"),
    ("_pa_s", "Pa.s"),
    ("_1_pa", "1/Pa"),
    ("_n_m", "N/m"),
    ("_m_n", "m/N"),
    ("_s_m", "s/m"),
    ("_gpa", "GPa"),
    ("_deg", "deg"),
    ("_mm", "mm"),
    ("_um", "um"),
    ("_kg", "kg"),
    ("_hz", "Hz"),
    ("_db", "dB"),
    ("_g", "g"),
    ("_n", "N"),
    ("_s", "s"),
    ("_m", "m"),
];

impl Column {
    /// Unit of its values; "1" of plain numbers, `None` of words.
    pub(in crate::sweep) fn unit(&self) -> Option<&'static str> {
        let named = UNITS.iter().find(|(name, _)| *name == self.name);
        let ending = || ENDINGS.iter().find(|(ending, _)| self.name.ends_with(ending));
        (self.kind != Kind::Text).then(|| named.or_else(ending).map_or("1", |(_, unit)| unit))
    }
}

/// Columns of the table of a sweep; `is_whole` says which keys take whole numbers only.
pub(in crate::sweep) fn columns(sweep: &Sweep, is_whole: &dyn Fn(&str) -> bool) -> Vec<Column> {
    let mut columns = Vec::new();
    let mut add = |name: &str, kind: Kind, meaning: &str| {
        columns.push(Column { name: name.to_owned(), kind, meaning: meaning.to_owned() });
    };
    add("run", Kind::Whole, "number of the run, from 0");
    if sweep.grows {
        add("bearing", Kind::Whole, "number of the bearing whose defect grows, from 0");
    }
    if !sweep.kinds.is_empty() {
        add("kind", Kind::Text, "body that has the defect, or healthy");
    }
    if !sweep.speed_profiles.is_empty() {
        add("speed_profile", Kind::Text, "file of the shaft's speed over time");
    }
    for entry in &sweep.grid {
        let whole = entry.of.iter().all(Value::is_integer) && is_whole(&entry.key);
        let numbers = entry.of.iter().all(|value| number(value).is_some());
        let kind = match (whole, numbers) {
            (true, _) => Kind::Whole,
            (false, true) => Kind::Number,
            (false, false) => Kind::Text,
        };
        add(&entry.key, kind, &meaning(&entry.key));
    }
    for entry in &sweep.random {
        add(&entry.key, if is_whole(&entry.key) { Kind::Whole } else { Kind::Number }, &meaning(&entry.key));
    }
    for (name, limits, meaning) in [
        ("noise_db", sweep.noise.ratio, "ratio of the signal to noise"),
        ("noise_rms_m_s2", sweep.noise.floor, "root mean square of the noise that every sensor has"),
    ] {
        if limits.is_some() {
            add(name, Kind::Number, meaning);
        }
    }
    if sweep.split.is_some() {
        add("split", Kind::Text, "part of the data set: train, validation or test");
    }
    if sweep.grows {
        add("label_growth", Kind::Number, "size that grows, from 0 of its first value to 1 of its last");
    }
    LABELS.iter().for_each(|(name, kind, meaning)| add(name, *kind, meaning));
    STATISTICS.iter().for_each(|(name, meaning)| add(name, Kind::Number, meaning));
    for k in 1..=HARMONICS {
        add(&envelope_name(k), Kind::Number, &format!("line of the first sensor's envelope at {k} bpfo_hz"));
    }
    PASSAGE_AND_STEPS.iter().for_each(|(name, kind, meaning)| add(name, *kind, meaning));
    columns
}

pub(in crate::sweep) fn envelope_name(k: usize) -> String {
    format!("envelope_{k}_bpfo_m_s2")
}

/// What a key of the scene means, without what holds where it is missing.
fn meaning(key: &str) -> String {
    if LOADS.contains(&key) {
        return "input: load along that of the scene".to_owned();
    }
    let all = brinell_scene_file::description(key).unwrap_or_default();
    let first = all.split([';', '\n']).next().unwrap_or_default();
    format!("input: {}", first.trim_end_matches('.'))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn unit(name: &str) -> Option<&'static str> {
        Column { name: name.to_owned(), kind: Kind::Number, meaning: String::new() }.unit()
    }

    #[test]
    fn a_column_has_the_unit_that_its_name_ends_in() {
        for (name, expected) in [
            ("defect.length_mm", "mm"),
            ("label_load_n", "N"),
            ("shaft.stiffness_n_m", "N/m"),
            ("shaft.tilt_damping_n_m_s", "N.m.s"),
            ("housing.damping_n_s_m", "N.s/m"),
            ("contact.damping_tau_s", "s"),
            ("contact.across_damping_s_m", "s/m"),
            ("bearing.outer_compliance_m_n", "m/N"),
            ("envelope_2_bpfo_m_s2", "m/s2"),
            ("film.viscosity_pa_s", "Pa.s"),
            ("speed_rpm", "1/min"),
            ("load", "N"),
            ("kurtosis", "1"),
            ("bearing.element_count", "1"),
            ("cage.slip", "1"),
        ] {
            assert_eq!(unit(name), Some(expected), "{name}");
        }
        assert_eq!(Column { name: "load_unit".to_owned(), kind: Kind::Text, meaning: String::new() }.unit(), None);
    }

    /// Words of units as keys have them.
    const WORDS: [&str; 15] = ["n", "m", "s", "s2", "mm", "um", "g", "kg", "m2", "m3", "deg", "rad", "hz", "pa", "gpa"];

    #[test]
    fn every_key_of_a_scene_that_ends_in_a_unit_has_it_and_every_key_has_a_meaning() {
        let schema: serde_json::Value = brinell_scene_file::schema().into();
        let mut with_units = 0;
        for (table, of) in [
            ("bearing", "BearingTable"),
            ("cage", "CageTable"),
            ("contact", "ContactTable"),
            ("defect", "DefectTable"),
            ("film", "FilmTable"),
            ("housing", "HousingTable"),
            ("shaft", "ShaftTable"),
            ("solver", "SolverTable"),
        ] {
            for key in schema["$defs"][of]["properties"].as_object().unwrap().keys() {
                let name = format!("{table}.{key}");
                let ends = key.rsplit_once('_').is_some_and(|(_, last)| WORDS.contains(&last));
                with_units += usize::from(ends);
                assert!(!ends || unit(&name) != Some("1"), "{name} has no unit");
                assert!(meaning(&name).len() > "input: ".len(), "{name} means nothing");
            }
        }
        assert!(with_units > 30, "{with_units} keys with units");
    }
}
