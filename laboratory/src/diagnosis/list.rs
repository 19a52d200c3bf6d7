//! The list of recordings: a CSV file with a row for each.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use brinell_analysis::sizing::Fault;

/// A recording and what is known of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Known {
    /// The file.
    pub path: PathBuf,
    /// Name of the machine.
    pub machine: String,
    /// Name of the bearing in the catalogue.
    pub bearing: String,
    /// Sampling rate (Hz), where the file has none.
    pub rate: Option<f64>,
    /// Shaft speed (Hz).
    pub speed: f64,
    /// What is damaged.
    pub fault: Fault,
    /// Length of the spall (degrees), where it is known.
    pub length: Option<f64>,
    /// Load (N), where it is known.
    pub load: Option<f64>,
    /// Channel of the signal, where there are several.
    pub channel: Option<String>,
}

/// Reads a list with the columns `file` (beside the list), `machine`, `bearing`, `speed_hz`, `fault` (`outer`, `inner`,
/// `ball`, `none`), and where they are known `rate_hz`, `length_deg`, `load_n`, `channel`.
///
/// # Errors
/// A list that cannot be read: the row and the column are named.
pub fn read(list: &Path) -> Result<Vec<Known>> {
    let mut rows = csv::Reader::from_path(list).with_context(|| list.display().to_string())?;
    let names = rows.headers()?.clone();
    let folder = list.parent().unwrap_or(Path::new(""));
    let mut all = Vec::new();
    for (k, row) in rows.records().enumerate() {
        let row = row?;
        let place = |column: &str| format!("{}: row {}: column {column}", list.display(), k + 2);
        let optional = |column: &str| {
            let at = names.iter().position(|name| name.trim() == column)?;
            row.get(at).map(str::trim).filter(|text| !text.is_empty())
        };
        let text = |column: &str| optional(column).with_context(|| place(column));
        let number = |column: &str| -> Result<Option<f64>> {
            optional(column).map(|text| text.parse().with_context(|| place(column))).transpose()
        };
        let fault = match text("fault")? {
            "outer" => Fault::Outer,
            "inner" => Fault::Inner,
            "ball" => Fault::Element,
            "none" => Fault::None,
            other => bail!("{}: {other}: outer, inner, ball or none is wanted", place("fault")),
        };
        all.push(Known {
            path: folder.join(text("file")?),
            machine: text("machine")?.to_owned(),
            bearing: text("bearing")?.to_owned(),
            rate: number("rate_hz")?,
            speed: number("speed_hz")?.with_context(|| place("speed_hz"))?,
            fault,
            length: number("length_deg")?,
            load: number("load_n")?,
            channel: optional("channel").map(str::to_owned),
        });
    }
    Ok(all)
}
