//! The zip file that an FMU is. Equal contents give equal bytes.
//!
//! Entries are sorted, carry the oldest date that zip knows and no extra fields; folders have no entries of
//! their own. Deflate, or store where that is shorter; nothing that needs more than version 2.0 of the format.

use std::collections::BTreeMap;
use std::io::{Cursor, Write};

use zip::{CompressionMethod, DateTime, System, ZipWriter, write::SimpleFileOptions};

/// Why an archive was not written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ArchiveError {
    /// A name that unpacks differently on another system.
    #[error("archive entry {0:?}: names are relative, with forward slashes and without '..'")]
    Name(String),
    /// The zip writer's own error.
    #[error("archive")]
    Zip(#[from] zip::result::ZipError),
    /// Writing failed.
    #[error("archive")]
    Io(#[from] std::io::Error),
}

/// The files of an archive, by their names in it.
#[derive(Debug, Clone, Default)]
pub struct Archive {
    files: BTreeMap<String, Vec<u8>>,
}

impl Archive {
    /// Adds a file, or puts it in place of an earlier one of that name.
    pub fn add(&mut self, name: impl Into<String>, contents: impl Into<Vec<u8>>) -> Result<(), ArchiveError> {
        let name = name.into();
        let plain = |part: &str| !part.is_empty() && part != "." && part != "..";
        if name.contains(['\\', ':']) || !name.split('/').all(plain) {
            return Err(ArchiveError::Name(name));
        }
        self.files.insert(name, contents.into());
        Ok(())
    }

    /// The zip file.
    pub fn to_bytes(&self) -> Result<Vec<u8>, ArchiveError> {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, contents) in &self.files {
            let mode = if name.starts_with("binaries/") { 0o755 } else { 0o644 };
            let options = SimpleFileOptions::default()
                .compression_method(CompressionMethod::Deflated)
                .compression_level(Some(9))
                .last_modified_time(DateTime::default())
                // Wherever it is written: the rights below are Unix's.
                .system(System::Unix)
                .unix_permissions(mode);
            zip.start_file(name.as_str(), options)?;
            zip.write_all(contents)?;
        }
        Ok(zip.finish()?.into_inner())
    }
}
