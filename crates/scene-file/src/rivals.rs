//! Keys of a scene file that say one thing in several ways, of which a scene has one.
//!
//! `sensor.response` and its modes are not among them: where `brinell` has read a scene, modes stand there alone.

/// A thing that can be said in several ways.
struct Rivals {
    /// Keys of which each says it: who gives one takes the others away.
    keys: &'static [&'static str],
    /// Keys that say a part of what the first one says: it takes them away, and none of them says enough to take it.
    parts: &'static [&'static str],
}

const RIVALS: [Rivals; 7] = [
    Rivals {
        keys: &[
            "bearing.radial_clearance_um",
            "bearing.internal_clearance_um",
            "bearing.axial_clearance_um",
            "bearing.contact_angle_deg",
        ],
        parts: &[],
    },
    Rivals { keys: &["bearing.groove_diameter_mm", "bearing.conformity_inner"], parts: &["bearing.conformity_outer"] },
    Rivals {
        keys: &["bearing.element_diameter_offsets_um", "bearing.element_diameter_rms_um"],
        parts: &["bearing.element_diameter_seed"],
    },
    Rivals {
        keys: &["cage.irregularity"],
        parts: &["cage.spacing_deg", "cage.spacing_rms_deg", "cage.jitter_rms_deg", "cage.wander"],
    },
    Rivals { keys: &["cage.spacing_deg", "cage.spacing_rms_deg"], parts: &[] },
    Rivals {
        keys: &["defect.profile", "defect.length_deg", "defect.length_mm"],
        parts: &["defect.depth_um", "defect.edge_slope_deg"],
    },
    Rivals { keys: &["sensor.direction_deg", "sensor.direction"], parts: &[] },
];

/// Keys that belong to one bearing: a name of another one takes them away. Material and what a roller's crown is like
/// stay.
const OF_ONE_BEARING: [&str; 22] = [
    "bearing.element",
    "bearing.element_count",
    "bearing.element_diameter_mm",
    "bearing.element_diameter_offsets_um",
    "bearing.pitch_diameter_mm",
    "bearing.roller_length_mm",
    "bearing.groove_diameter_mm",
    "bearing.conformity_inner",
    "bearing.conformity_outer",
    "bearing.radial_clearance_um",
    "bearing.internal_clearance_um",
    "bearing.axial_clearance_um",
    "bearing.contact_angle_deg",
    "bearing.operating_angle_deg",
    "bearing.shoulder_inner_mm",
    "bearing.shoulder_outer_mm",
    "bearing.hertz_inner_n_m1_5",
    "bearing.hertz_outer_n_m1_5",
    "bearing.element_mass_g",
    "bearing.element_youngs_modulus_gpa",
    "bearing.element_poissons_ratio",
    "bearing.element_density_kg_m3",
];

/// Whether who gives a key, with its table (`defect.length_mm`), takes another one away (`defect.length_deg`).
pub fn replaces(key: &str, other: &str) -> bool {
    let takes = |Rivals { keys, parts }: &Rivals| {
        keys.contains(&key) && (keys.contains(&other) || (keys[0] == key && parts.contains(&other)))
    };
    let by_name = key == "bearing.catalogue" && OF_ONE_BEARING.contains(&other);
    by_name || (key != other && RIVALS.iter().any(takes))
}

/// Whether no scene has both of two keys.
pub(crate) fn exclude_each_other(one: &str, other: &str) -> bool {
    let named = [one, other].contains(&"bearing.catalogue");
    !named && (replaces(one, other) || replaces(other, one))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::from_toml;

    /// A key with a value.
    fn line(key: &str) -> String {
        let value = match key {
            "bearing.element_diameter_offsets_um" | "cage.spacing_deg" => "[0, 0, 0, 0, 0, 0, 0, 0, 0]",
            "cage.irregularity" => "\"recorded\"",
            "defect.profile" => "\"pit.csv\"",
            "sensor.direction" => "[0, 1, 0]",
            "cage.wander" => "0.01",
            _ => "1",
        };
        format!("{key} = {value}\n")
    }

    #[test]
    fn a_scene_with_two_keys_that_exclude_each_other_is_refused() {
        let scene = "name = \"a\"\nbearing.catalogue = \"6205\"\nshaft.motion = \"internal\"\nshaft.speed_hz = 10\n\
            housing.motion = \"internal\"\n";
        let mut pairs = 0;
        for Rivals { keys, parts } in &RIVALS {
            let all = [*keys, *parts].concat();
            for (index, first) in all.iter().enumerate() {
                for second in all[index..].iter().filter(|second| exclude_each_other(first, second)) {
                    let said = from_toml(&format!("{scene}{}{}", line(first), line(second))).unwrap_err().to_string();
                    assert!(said.contains(&format!("{first} and {second} exclude each other")), "{said}");
                    pairs += 1;
                }
            }
        }
        // In the order of the table; the two spacings of a cage are met in two of its lines.
        assert_eq!(pairs, 6 + 2 + 2 + (4 + 1) + 1 + (3 + 2) + 1);
    }
}
