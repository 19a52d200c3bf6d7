//! Options of commands about what the program brings along: the paper's parts, scenes, bearings.

use std::path::PathBuf;

use clap::Args;

use crate::commands::{Asked, Spall};
use crate::paper;
use crate::shared::Drawn;

/// Options of `paper`.
#[derive(Debug, Args)]
pub struct Paper {
    /// Which of its parts
    #[arg(value_enum)]
    pub(super) part: paper::Part,
    /// Print the claims as JSON
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) drawn: Drawn,
}

/// Options of `scenes`.
#[derive(Debug, Args)]
pub struct Scenes {
    /// Names of shipped scenes whose files are written
    #[arg(value_name = "NAME")]
    pub(super) names: Vec<String>,
    /// Print the list as JSON
    #[arg(long, conflicts_with = "names")]
    pub(super) json: bool,
    /// Folder for the files [default: the current one]
    #[arg(short, long, value_name = "DIR", requires = "names")]
    pub(super) output: Option<PathBuf>,
}

/// Options of `new`.
#[derive(Debug, Args)]
pub struct New {
    /// Name of the scene or sweep: letters, digits, - and _ [default: bearing and defect, as in 6205-healthy]
    #[arg(value_name = "NAME", required_if_eq("sweep", "true"))]
    pub(super) name: Option<String>,
    /// The bearing as its maker writes it: 6205, "SKF 6205-2Z/C3", "NU 205 ECP"; `brinell catalogue` lists all
    #[arg(long, value_name = "NAME", default_value = "6205")]
    pub(super) bearing: String,
    /// A spall: outer, inner or element, a colon and its length in mm or deg [default: none]
    #[arg(long, value_name = "inner:1.2mm")]
    pub(super) defect: Option<Spall>,
    /// Load, N, downwards; with --hosted what the host is expected to bring, for which contacts are prepared [default:
    /// 5 % of the static rating]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(super) load: Option<f64>,
    /// Axial load, N, along z: the scene gets three degrees of freedom [default: none; of an angular contact bearing as
    /// much as the radial one]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(super) axial: Option<f64>,
    /// In how many directions the rings move: 2, 3 with the axis, 5 with tilt [default: 2, with an axial load 3]
    #[arg(long, value_name = "2|3|5", value_parser = ["2", "3", "5"])]
    pub(super) degrees_of_freedom: Option<String>,
    /// The shaft is moved by an FMU's host, as a rotor's simulation
    #[arg(long)]
    pub(super) hosted: bool,
    /// Instead of a scene a file for `brinell sweep`, a short one that has every key
    #[arg(long, conflicts_with_all = ["bearing", "defect", "load", "axial", "degrees_of_freedom", "hosted"])]
    pub(super) sweep: bool,
    /// Folder for the file [default: the current one]
    #[arg(short, long, value_name = "DIR")]
    pub(super) output: Option<PathBuf>,
}

impl New {
    /// What the scene is to be; `None` where a sweep is wanted.
    pub(super) fn asked(&self) -> Option<Asked<'_>> {
        let scene = Asked {
            spall: self.defect.as_ref(),
            load: self.load,
            axial: self.axial,
            freedom: self.degrees_of_freedom.as_ref().and_then(|count| count.parse().ok()),
            hosted: self.hosted,
        };
        (!self.sweep).then_some(scene)
    }
}

/// Options of `catalogue`.
#[derive(Debug, Args)]
pub struct Catalogue {
    /// How the names begin, as 62
    #[arg(value_name = "FILTER", default_value = "", hide_default_value = true)]
    pub(super) filter: String,
    /// Print them as JSON
    #[arg(long)]
    pub(super) json: bool,
}
