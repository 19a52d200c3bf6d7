//! The page of the validation. Its prose stands there alone; its tables are computed, each between `<!-- name -->` and
//! `<!-- end -->`.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result};
use fmu_build::shared::whole_file;

/// Marks the end of a part.
const END: &str = "<!-- end -->";

/// A page that is there.
#[derive(Debug)]
pub struct Page {
    pub(super) path: PathBuf,
}

impl Page {
    /// Puts rows in place of those of the table of a name, whose head stays.
    ///
    /// # Errors
    /// A page that cannot be read or written or has no such table.
    pub fn set_rows(&self, name: &str, rows: &str) -> Result<()> {
        self.change(name, |part| {
            let head: String =
                part.lines().filter(|line| !line.is_empty()).take(2).map(|line| format!("{line}\n")).collect();
            head + rows
        })
    }

    /// Puts a text in place of the part of a name.
    ///
    /// # Errors
    /// As [`Page::set_rows`].
    pub fn set(&self, name: &str, text: &str) -> Result<()> {
        self.change(name, |_| text.to_owned())
    }

    fn change(&self, name: &str, new: impl FnOnce(&str) -> String) -> Result<()> {
        let about = || format!("{}: the part {name} and its end", self.path.display());
        let page = fs::read_to_string(&self.path).with_context(about)?;
        let mark = format!("<!-- {name} -->\n");
        let (before, rest) = page.split_once(&mark).with_context(about)?;
        let (part, after) = rest.split_once(END).with_context(about)?;
        whole_file::write(&self.path, format!("{before}{mark}\n{}\n\n{END}{after}", new(part).trim()))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn rows_and_texts_change_where_they_stand_and_nowhere_else() {
        let folder = tempfile::tempdir().unwrap();
        let page = Page { path: folder.path().join("page.md") };
        let text =
            "a\n\n<!-- one -->\n\n| x |\n|---|\n| 1 |\n\n<!-- end -->\n\nb\n\n<!-- two -->\n\nc\n\n<!-- end -->\n";
        fs::write(&page.path, text).unwrap();
        page.set_rows("one", "| 2 |\n| 3 |\n").unwrap();
        page.set("two", "d\n").unwrap();
        let expected = text.replace("| 1 |", "| 2 |\n| 3 |").replace("\nc\n", "\nd\n");
        assert_eq!(fs::read_to_string(&page.path).unwrap(), expected);
        assert!(page.set("three", "").is_err());
    }
}
