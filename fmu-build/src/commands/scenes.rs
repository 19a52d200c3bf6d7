//! The command `scenes`: which scenes are shipped, and their files as a start for one's own.

use std::path::Path;

use anyhow::{Context, Result, bail};
use serde_json::json;

use super::schema;
use crate::shared::{shipped, whole_file};

/// The command: one line for each shipped scene; of those named, the files are written into `folder` instead.
pub fn command(names: &[String], json: bool, folder: &Path) -> Result<()> {
    if json {
        let rows: Result<Vec<_>> =
            shipped::scenes().map(|name| Ok(json!({ "name": name, "description": description(name)? }))).collect();
        println!("{}", serde_json::to_string_pretty(&rows?)?);
        return Ok(());
    }
    if names.is_empty() {
        let width = shipped::scenes().map(str::len).max().unwrap_or(0);
        for name in shipped::scenes() {
            println!("{name:width$}  {}", description(name)?);
        }
    }
    for name in names {
        let Some(files) = shipped::files_of(name) else {
            bail!("{name}: no such scene; {}", shipped::meant(name));
        };
        for (file, text) in files {
            whole_file::write_own(&folder.join(file), text)?;
        }
    }
    if names.is_empty() { Ok(()) } else { schema::write_beside(folder) }
}

fn description(name: &str) -> Result<String> {
    let text = shipped::scene_text(Path::new(name))?;
    Ok(brinell_scene_file::from_toml(&text).with_context(|| name.to_owned())?.description)
}
