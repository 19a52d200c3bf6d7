//! The command `scenes`: which scenes are shipped, and their files as a start for one's own.

use std::path::Path;

use anyhow::{Context, Result, bail};

use super::schema;
use crate::shared::shipped;
use crate::shared::whole_file;

/// The command: one line for each shipped scene; of those named, the files are written into `folder` instead.
pub fn command(names: &[String], folder: &Path) -> Result<()> {
    if names.is_empty() {
        let width = shipped::scenes().map(str::len).max().unwrap_or(0);
        for name in shipped::scenes() {
            let scene = brinell_scene_file::from_toml(&shipped::scene_text(Path::new(name))?)
                .with_context(|| name.to_owned())?;
            println!("{name:width$}  {}", scene.description);
        }
    }
    for name in names {
        let Some(files) = shipped::files_of(name) else {
            bail!("{name}: no such scene; {}", shipped::meant(name));
        };
        for (file, text) in files {
            let path = folder.join(file);
            if path.exists() {
                bail!("{} is there already and stays as it is", path.display());
            }
            whole_file::write(&path, text)?;
            println!("{}", path.display());
        }
    }
    if names.is_empty() { Ok(()) } else { schema::write_beside(folder) }
}
