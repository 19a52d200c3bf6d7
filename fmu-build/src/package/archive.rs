//! The zip file that an FMU is. Equal contents give equal bytes.
//!
//! Entries are sorted, carry the oldest date that zip knows and no extra fields; folders have no entries of
//! their own. Deflate, or store where that is shorter; nothing that needs more than version 2.0 of the format.

use std::collections::BTreeMap;
use std::io::{Cursor, Write};
use std::sync::Arc;

use zip::{CompressionMethod, DateTime, System, ZipArchive, ZipWriter, write::SimpleFileOptions};

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
    files: BTreeMap<String, Contents>,
}

#[derive(Debug, Clone)]
enum Contents {
    Plain(Vec<u8>),
    Compressed(Compressed),
}

/// A program's file that is compressed once, for any number of archives.
#[derive(Debug, Clone)]
pub struct Compressed(Arc<Vec<u8>>);

impl Compressed {
    /// Compresses a file, as an archive of it alone.
    pub fn executable(contents: &[u8]) -> Result<Self, ArchiveError> {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        zip.start_file("executable", options(0o755))?;
        zip.write_all(contents)?;
        Ok(Self(Arc::new(zip.finish()?.into_inner())))
    }
}

impl Archive {
    /// Adds a file, or puts it in place of an earlier one of that name.
    pub fn add(&mut self, name: impl Into<String>, contents: impl Into<Vec<u8>>) -> Result<(), ArchiveError> {
        self.put(name.into(), Contents::Plain(contents.into()))
    }

    /// The same with a program's file that is compressed; it is executable under any name.
    pub fn add_compressed(&mut self, name: impl Into<String>, file: Compressed) -> Result<(), ArchiveError> {
        self.put(name.into(), Contents::Compressed(file))
    }

    fn put(&mut self, name: String, contents: Contents) -> Result<(), ArchiveError> {
        let plain = |part: &str| !part.is_empty() && part != "." && part != "..";
        if name.contains(['\\', ':']) || !name.split('/').all(plain) {
            return Err(ArchiveError::Name(name));
        }
        self.files.insert(name, contents);
        Ok(())
    }

    /// The zip file.
    pub fn to_zip(&self) -> Result<Vec<u8>, ArchiveError> {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, contents) in &self.files {
            match contents {
                Contents::Plain(bytes) => {
                    let mode = if name.starts_with("binaries/") { 0o755 } else { 0o644 };
                    zip.start_file(name.as_str(), options(mode))?;
                    zip.write_all(bytes)?;
                }
                Contents::Compressed(Compressed(alone)) => {
                    let mut alone = ZipArchive::new(Cursor::new(alone.as_slice()))?;
                    zip.raw_copy_file_rename(alone.by_index_raw(0)?, name)?;
                }
            }
        }
        Ok(zip.finish()?.into_inner())
    }
}

fn options(mode: u32) -> SimpleFileOptions {
    SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .compression_level(Some(9))
        .last_modified_time(DateTime::default())
        // Wherever it is written: the rights are Unix's.
        .system(System::Unix)
        .unix_permissions(mode)
}
