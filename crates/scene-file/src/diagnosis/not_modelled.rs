//! Keys that ask for what the model does not have: an answer better than "unknown".

/// Names of keys or tables that ask for one thing.
struct Asked {
    /// Tables in which they are looked for; the empty name is the file itself.
    tables: &'static [&'static str],
    /// Whole names.
    names: &'static [&'static str],
    /// Parts of names.
    parts: &'static [&'static str],
    /// What is modelled instead.
    only: &'static str,
}

/// The message for a defect that is given by another key.
const DEFECTS: &str = "defects are given by a table [defect], or by several [[defect]], whose key `on` \
                       is \"outer\", \"inner\" or \"element\"";
const ELEMENTS: &str = "rolling elements are given by bearing.element, \"ball\" or \"cylindrical-roller\" with \
                        bearing.roller_length_mm; other rollers are not modelled, so far";
const BY_NAME: &str =
    "a bearing is given by its dimensions or by bearing.catalogue, its rolling elements by bearing.element";
const AXIS: &str = "motion along the axis and tilt are given by bearing.degrees_of_freedom = 3 or 5, an axial load by \
                    the third number of load_n, an angle by bearing.contact_angle_deg, moments by \
                    shaft.load_moment_n_m";
const HELD: &str = "the tilt of a housing that moves by itself is held, so far: only the shaft has inertia, moments, \
                    damping and stiffness of tilt";
const DRY: &str = "an oil film is given by a table [film] with viscosity_pa_s and pressure_viscosity_1_pa; friction is \
                   not modelled";

const ASKED: [Asked; 7] = [
    Asked { tables: &[""], names: &["race"], parts: &["defect", "spall", "raceway", "_race"], only: DEFECTS },
    Asked {
        tables: &["defect"],
        names: &["race", "side", "where", "location", "position", "ring", "surface", "part", "ball", "on_ring"],
        parts: &["raceway", "inner", "outer", "defect", "spall"],
        only: DEFECTS,
    },
    Asked {
        tables: &["", "bearing"],
        names: &[
            "element",
            "elements",
            "rolling_element",
            "rolling_elements",
            "element_type",
            "element_kind",
            "type",
            "kind",
        ],
        parts: &["roller", "needle", "element_shape", "element_length"],
        only: ELEMENTS,
    },
    Asked {
        tables: &["", "bearing"],
        names: &["designation", "series", "model"],
        parts: &["bearing_type", "bearing_kind", "bearing_name", "bearing_series", "bearing_model"],
        only: BY_NAME,
    },
    Asked { tables: &["housing"], names: &[], parts: &["tilt", "moment", "inertia", "misalign"], only: HELD },
    Asked {
        tables: &["", "bearing", "shaft", "housing"],
        names: &[],
        parts: &["axial", "thrust", "contact_angle", "tilt", "misalign"],
        only: AXIS,
    },
    Asked {
        tables: &["", "bearing", "contact", "cage"],
        names: &["oil"],
        parts: &["lubric", "viscosity", "film", "grease", "friction"],
        only: DRY,
    },
];

/// What is modelled instead of what this key of this table asks for; `None` if it asks for nothing known.
pub(super) fn instead_of(table: &str, key: &str) -> Option<&'static str> {
    let key = key.to_lowercase().replace('-', "_");
    let asks = |asked: &&Asked| {
        let named = asked.names.contains(&key.as_str()) || asked.parts.iter().any(|part| key.contains(part));
        asked.tables.contains(&table) && named
    };
    ASKED.iter().find(asks).map(|asked| asked.only)
}
