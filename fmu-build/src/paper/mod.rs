//! The paper behind the model, figure by figure and table by table: Larizza, Howard, Grainger and Wang (2018).
//!
//! Each part is computed anew, and each claim is printed beside what comes out. What the paper does not say is assumed
//! as in the shipped scenes; `docs/evidence/validation.md` has all of it.

pub mod averages;
mod case;
mod claims;
pub mod passage;
pub mod statics;

pub use case::Case;
pub use claims::{Beside, Claim, Outcome};
pub use passage::{Epps, FourEvents, Passage};

use std::path::Path;

use anyhow::Result;
use brinell::scene::ContactLaw;
use clap::ValueEnum;
use serde_json::json;

use crate::shared::{Drawn, Project, csv, whole_file};
use averages::PANELS;

/// The laws that are laid beside each other.
pub const LAWS: [ContactLaw; 2] = [ContactLaw::Map, ContactLaw::Hertz];

/// A part of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Part {
    /// The four events of one passage over the line spall
    Fig1,
    /// The profile of Epps' spall and the path of a rigid element
    Fig4,
    /// Acceleration, path and force over Epps' spall
    Fig5,
    /// Entry and exit of line and extended spall, averaged, and their frequencies
    Fig6,
    /// The two test bearings' spalls, with stiffness and critical load
    Table1,
    /// The bearing's dimensions, and what follows from them
    Table2,
}

impl Part {
    /// As the user names it.
    fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }

    /// The figure of its data, by its name in `paper.py`.
    fn figure(self) -> Option<&'static str> {
        match self {
            Self::Fig1 => Some("four-events"),
            Self::Fig4 => Some("profile"),
            Self::Fig5 => Some("epps"),
            Self::Fig6 => Some("spectrograms"),
            Self::Table1 | Self::Table2 => None,
        }
    }
}

/// The command: claims on standard output, the data of a figure and the figure into a folder.
///
/// # Errors
/// Of simulation, files and Python.
pub(crate) fn command(project: &Project, part: Part, json: bool, drawn: &Drawn) -> Result<()> {
    let data = tempfile::tempdir()?;
    let claims = match part {
        Part::Fig1 => claims::four_events(four_events(project, data.path())?, project)?,
        Part::Fig4 => claims::profile(&epps_profile(data.path())?)?,
        Part::Fig5 => {
            let case = Case::shipped("6205-epps")?;
            claims::epps(&case, &epps(project, &[("trace", &case)], data.path())?)?
        }
        Part::Fig6 => claims::averages(&averaged(project, data.path())?),
        Part::Table1 => claims::test_bearings()?,
        Part::Table2 => claims::dimensions()?,
    };
    if json {
        println!("{}", serde_json::to_string_pretty(&json!({ "part": part.name(), "claims": claims }))?);
    } else {
        print!("{}", claims::table(&claims));
    }
    let Some(name) = part.figure() else { return Ok(()) };
    let stem = drawn.folder(project, "paper").join(format!("paper-{}", part.name()));
    for entry in std::fs::read_dir(data.path())? {
        // Where a figure has one table, that is named after the figure.
        let path = stem.with_extension("csv");
        whole_file::write(&path, std::fs::read(entry?.path())?)?;
        println!("{}", path.display());
    }
    let what = [name.as_ref(), data.path().as_os_str(), stem.as_os_str()];
    print!("{}", drawn.figure(project, "paper.py", what, std::slice::from_ref(&stem))?);
    Ok(())
}

/// The line spall's passage under both laws, and its signals in the folder's `four-events.csv`.
///
/// # Errors
/// Of the simulation; of writing.
pub fn four_events(project: &Project, data: &Path) -> Result<Vec<(FourEvents, Passage)>> {
    let of_law = |law| {
        let case = Case::shipped("er16k-tb1")?.with_law(law);
        let passage = Passage::of(project, &case, case.length(), [2e-3, 22e-3])?;
        Ok((FourEvents::of(&passage, case.length() / case.travel()), passage))
    };
    let found = LAWS.into_iter().map(of_law).collect::<Result<Vec<_>>>()?;
    let (names, columns) = passage::table(["map", "hertz"].into_iter().zip(found.iter().map(|(_, passage)| passage)));
    csv::table(&data.join("four-events.csv"), &names, &columns)?;
    Ok(found)
}

/// Epps' spall, its profile in the folder's `profile.csv`.
///
/// # Errors
/// Of writing.
pub fn epps_profile(data: &Path) -> Result<Case> {
    let case = Case::shipped("6205-epps")?;
    let (names, columns) = passage::profile(&case, passage::AROUND)?;
    csv::table(&data.join("profile.csv"), &names, &columns)?;
    Ok(case)
}

/// Passages over Epps' spall in shapes with their names, each under both laws, and their signals in the folder's
/// `epps.csv`.
///
/// # Errors
/// Of the simulation; of writing.
pub fn epps(project: &Project, shapes: &[(&str, &Case)], data: &Path) -> Result<Vec<Epps>> {
    let (mut names, mut found) = (Vec::new(), Vec::new());
    for &(shape, case) in shapes {
        for (law, word) in LAWS.into_iter().zip(["map", "hertz"]) {
            names.push(format!("{shape} {word}"));
            found.push(Epps::of(project, &case.clone().with_law(law))?);
        }
    }
    let passages = names.iter().map(String::as_str).zip(found.iter().map(|epps| &epps.passage));
    let (names, columns) = passage::table(passages);
    csv::table(&data.join("epps.csv"), &names, &columns)?;
    Ok(found)
}

/// Frequencies of the figure's panels, and with the shallow floor (Hz, after entry and after exit).
fn averaged(project: &Project, data: &Path) -> Result<Vec<[f64; 2]>> {
    let (mut names, mut columns) = (vec![("time".to_owned(), "s")], Vec::new());
    let mut found = Vec::new();
    for panel in &PANELS[..5] {
        let case = panel.case()?;
        let passage = averages::averaged(project, &case)?;
        if columns.is_empty() {
            columns.push(averages::times(&case, passage.len()));
        }
        let rings = averages::rings(&case, &passage);
        found.push(rings.map_or([f64::NAN; 2], |rings| [rings.after_entry, rings.after_exit]));
        names.push((format!("{} sensor.acceleration", panel.key), "m/s2"));
        columns.push(passage);
    }
    csv::table(&data.join("averages.csv"), &names, &columns)?;
    Ok(found)
}
