//! Where things are: the workspace's source, if it is there, and the folder for everything that is made.

use std::env;
use std::path::{Path, PathBuf};

/// The workspace's source and the folder for what is made.
#[derive(Debug, Clone)]
pub struct Project {
    source: Option<PathBuf>,
    target: PathBuf,
}

impl Project {
    /// Looks for the workspace that this program was built from; without it, `target` is made in the current folder.
    pub fn find() -> Self {
        let built_from = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
        let source = built_from.filter(|root| root.join("src/lib.rs").is_file()).map(Path::to_path_buf);
        let target = match env::var_os("CARGO_TARGET_DIR") {
            Some(folder) => PathBuf::from(folder),
            None => source.as_deref().unwrap_or(Path::new(".")).join("target"),
        };
        Self { source, target: std::path::absolute(&target).unwrap_or(target) }
    }

    /// The workspace with its source in this folder; what is made goes into its own `target`.
    pub fn at(source: &Path) -> Self {
        Self { source: Some(source.to_path_buf()), target: source.join("target") }
    }

    /// Root of the workspace's source, if it is there.
    pub fn source(&self) -> Option<&Path> {
        self.source.as_deref()
    }

    /// Folder for everything that is made.
    pub fn target(&self) -> &Path {
        &self.target
    }
}
