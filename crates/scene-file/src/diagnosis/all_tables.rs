//! All tables of a scene file.

use super::toml_kinds::TableOf;
use crate::tables::*;

/// All tables and the keys that each takes, as the tables themselves say.
pub(super) fn tables() -> [TableOf; 14] {
    [
        TableOf::of::<SceneFile>(""),
        TableOf::of::<BearingTable>("bearing"),
        TableOf::of::<ContactTable>("contact"),
        TableOf::of::<FilmTable>("film"),
        TableOf::of::<CageTable>("cage"),
        TableOf::of::<DefectTable>("defect"),
        TableOf::of::<ShaftTable>("shaft"),
        TableOf::of::<HousingTable>("housing"),
        TableOf::of::<SensorTable>("sensor"),
        TableOf::of::<SensorModeTable>("sensor.mode"),
        TableOf::of::<ProbeTable>("probe"),
        TableOf::of::<SolverTable>("solver"),
        TableOf::of::<RecorderTable>("recorder"),
        TableOf::of::<ExperimentTable>("experiment"),
    ]
}

/// A key with its table, as it is shown; a table in brackets.
pub(super) fn path(table: &str, key: &str, is_table: bool) -> String {
    let path = if table.is_empty() { key.to_owned() } else { format!("{table}.{key}") };
    if is_table { format!("[{path}]") } else { path }
}
