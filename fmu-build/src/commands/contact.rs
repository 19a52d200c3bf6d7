//! The command `contact`: pressure of one ball on its raceway as that was measured, and the stresses below, as CSV,
//! figure and a JSON summary on standard output.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use brinell::contact::rolling::RacewaySide;
use brinell::scene::{DefectOn, Scene};
use brinell_analysis::pressure::{BallOnRaceway, ContactReport, Pressed, Section, Stress, StressAt};
use clap::{Args, ValueEnum};

use crate::package::model::ask_unit;
use crate::package::{SceneFiles, read_all};
use crate::shared::{Drawn, Project, csv, gigapascals, number, whole_file};

/// A raceway.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum On {
    /// That of the outer ring.
    Outer,
    /// That of the inner ring.
    Inner,
}

/// Options of `contact`.
#[derive(Debug, Args)]
pub struct Contact {
    /// Scene file (TOML) of a ball bearing, or the name of a shipped scene; nothing moves
    scene: PathBuf,
    /// The raceway
    #[arg(long, value_enum)]
    on: On,
    /// Angle of the ball in degrees from the middle of the raceway's first defect, counter-clockwise about the
    /// bearing's axis in the ring's own frame: 0 is over the middle, half the defect's length over its end
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = number)]
    angle: f64,
    /// Contact force in newtons
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number)]
    force: f64,
    /// Cells along and across the raceway, over the contact and a little more
    #[arg(long, value_name = "CELLS", default_value_t = 512)]
    resolution: usize,
    /// Largest pressure in GPa, from 1 to 20, at which the surface yields and stays dented: the indentation hardness, 6
    /// to 7.5 of hardened bearing steel [default: none, the surface stays elastic]
    #[arg(long = "yield", value_name = "GPA", allow_negative_numbers = true, value_parser = gigapascals)]
    pressure_limit: Option<f64>,
    #[command(flatten)]
    drawn: Drawn,
}

/// Lines across the raceway on which the depth of a surface that is not the same across is written.
const SURFACE_LINES: usize = 64;

/// The command: prints the summary, and writes `<folder>/<scene>-contact.json`, `-pressure.csv`, `-surface.csv`,
/// with a pressure limit `-dent.csv`, `-depth.csv`, `-plane.csv` and, if wanted, a figure.
pub fn command(project: &Project, options: &Contact) -> Result<()> {
    let SceneFiles { scene, profiles, .. } = read_all(&options.scene)?;
    let about = || options.scene.display().to_string();
    ask_unit(&scene.bearing, "shaft.load_n", options.force, "--force");
    let side = if options.on == On::Outer { RacewaySide::Outer } else { RacewaySide::Inner };
    let angle = options.angle.to_radians();
    let mut ball = BallOnRaceway::of(&scene, profiles.iter().map(|profile| profile.text.as_str()), side, angle)
        .with_context(about)?;
    ball.pressure_limit = options.pressure_limit.map_or(f64::INFINITY, |limit| 1e9 * limit);
    let pressed = ball.pressed(options.force, options.resolution).with_context(about)?;
    let section = Section::of(&ball, &pressed);
    let mut report = ContactReport::new(&scene.name, side, options.angle, options.force, &ball, &pressed, &section);
    report.notes.extend(notes_of(&scene, side));
    let text = serde_json::to_string_pretty(&report)?;
    println!("{text}");
    std::io::stdout().flush()?;
    let stem = options.drawn.folder(project, "contact").join(format!("{}-contact", scene.name));
    let beside = |end: &str| whole_file::beside(&stem, end);
    whole_file::write(&beside(".json"), text + "\n")?;
    let at = |cell: usize, value: f64| {
        let [x, y] = pressed.centre(cell);
        Ok([x, y, value])
    };
    let names = |quantity: &'static str, unit: &'static str| [("x", "m"), ("y", "m"), (quantity, unit)];
    let under_pressure = pressed.under_pressure().map(|cell| at(cell, pressed.pressure[cell]));
    csv::write(&beside("-pressure.csv"), names("pressure", "Pa"), under_pressure)?;
    let surface = surface_cells(&pressed).map(|cell| at(cell, pressed.depth[cell]));
    csv::write(&beside("-surface.csv"), names("depth", "m"), surface)?;
    if !pressed.dent.is_empty() {
        // What stays dented, beyond the depth of the defects.
        let dented = (0..pressed.dent.len()).filter(|&cell| pressed.dent[cell] > 0.0);
        csv::write(&beside("-dent.csv"), names("dent", "m"), dented.map(|cell| at(cell, pressed.dent[cell])))?;
    }
    let hertz: Vec<f64> = section.hertz.iter().map(Stress::von_mises).collect();
    write_stresses(&beside("-depth.csv"), &section.depth, &hertz)?;
    write_stresses(&beside("-plane.csv"), &section.plane, &[])?;
    eprint!("{}", options.drawn.figure(project, "contact.py", [&stem], std::slice::from_ref(&stem))?);
    Ok(())
}

/// What of the scene is not in the answer.
fn notes_of(scene: &Scene, side: RacewaySide) -> Vec<String> {
    let mut notes = Vec::new();
    let own = if side == RacewaySide::Outer { DefectOn::Outer } else { DefectOn::Inner };
    if !scene.defects.iter().any(|defect| defect.on == own) {
        notes.push("this raceway has no defect: it is smooth everywhere".to_owned());
    }
    if scene.defects.iter().any(|defect| matches!(defect.on, DefectOn::Element { .. })) {
        notes.push("defects of elements are left out: the ball is one without".to_owned());
    }
    if scene.bearing.hertz_inner.is_some() || scene.bearing.hertz_outer.is_some() {
        notes.push("the scene's own Hertz constants are left out: radii and moduli decide here".to_owned());
    }
    notes
}

/// Cells of the window on as many lines across as the depth of the defects differs on: one where it is the same on all.
fn surface_cells(pressed: &Pressed) -> impl Iterator<Item = usize> {
    let [columns, rows] = pressed.cells;
    let first = &pressed.depth[..columns];
    let same = pressed.depth.chunks_exact(columns).all(|line| line == first);
    let step = if same { rows } else { rows.div_ceil(SURFACE_LINES) };
    (0..rows).step_by(step).flat_map(move |row| row * columns..(row + 1) * columns)
}

/// Stresses at points, and beside them, where there are any, von Mises' of Hertz's contact.
fn write_stresses(path: &Path, points: &[StressAt], hertz: &[f64]) -> Result<()> {
    let position = [("x", "m"), ("y", "m"), ("depth", "m")].map(|(name, unit)| (name.to_owned(), unit));
    let stresses = ["xx", "yy", "zz", "xy", "xz", "yz", "von_mises"].map(|name| (format!("stress.{name}"), "Pa"));
    let of_hertz = (!hertz.is_empty()).then(|| ("hertz.von_mises".to_owned(), "Pa"));
    let rows = points.iter().enumerate().map(|(i, StressAt { point, stress })| {
        let values = point.iter().chain(&stress.normal).chain(&stress.shear).copied();
        Ok(values.chain([stress.von_mises()]).chain(hertz.get(i).copied()))
    });
    csv::write(path, position.into_iter().chain(stresses).chain(of_hertz), rows)
}
