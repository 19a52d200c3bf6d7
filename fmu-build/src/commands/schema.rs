//! The JSON schema of scene files, by which editors complete and explain their keys: scenes name it in their first
//! line, so that it stands beside each that is written here.

use std::path::Path;

use anyhow::Result;

use crate::shared::whole_file;

/// The file that scenes name.
const NAME: &str = "scene.schema.json";

/// The schema as a text.
pub(crate) fn text() -> Result<String> {
    Ok(serde_json::to_string_pretty(&brinell_scene_file::schema())? + "\n")
}

/// Writes the schema into a folder, unless a file of its name is there: it may be somebody's.
pub(crate) fn write_beside(folder: &Path) -> Result<()> {
    let path = folder.join(NAME);
    if path.exists() { Ok(()) } else { whole_file::write_own(&path, &text()?) }
}
