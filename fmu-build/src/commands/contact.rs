//! The command `contact`: pressure of one ball on its raceway as that was measured, and the stresses below, as CSV,
//! figure and a JSON summary on standard output.

use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result};
use brinell::contact::rolling::RacewaySide;
use brinell::scene::{DefectOn, Scene};
use brinell_analysis::pressure::{BallOnRaceway, ContactReport, Pressed, Section, Stress, StressAt};
use clap::ValueEnum;

use super::stiffness::beside;
use crate::package::{SceneFiles, read_all};
use crate::shared::{Project, Python, csv, whole_file};

/// A raceway.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum On {
    /// That of the outer ring.
    Outer,
    /// That of the inner ring.
    Inner,
}

/// What the user says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// The raceway.
    pub on: On,
    /// Angle of the ball from the middle of the raceway's first defect, counter-clockwise (°).
    pub angle_deg: f64,
    /// Force (N).
    pub force: f64,
    /// Cells in each direction.
    pub resolution: usize,
    /// Largest pressure (GPa), at which the surface yields.
    pub pressure_limit: Option<f64>,
    /// Whether to draw.
    pub figure: bool,
}

/// Lines across the raceway on which the depth of a surface that is not the same across is written.
const SURFACE_LINES: usize = 64;

/// The command: prints the summary, and writes `<folder>/<scene>-contact.json`, `-pressure.csv`, `-surface.csv`,
/// with a pressure limit `-dent.csv`, `-depth.csv`, `-plane.csv` and, if wanted, a figure.
pub fn command(project: &Project, scene: &Path, options: &Options, folder: &Path) -> Result<()> {
    let SceneFiles { scene: read, profiles, .. } = read_all(scene)?;
    let about = || scene.display().to_string();
    let side = if options.on == On::Outer { RacewaySide::Outer } else { RacewaySide::Inner };
    let angle = options.angle_deg.to_radians();
    let mut ball = BallOnRaceway::of(&read, profiles.iter().map(|profile| profile.text.as_str()), side, angle)
        .with_context(about)?;
    ball.pressure_limit = options.pressure_limit.map_or(f64::INFINITY, |limit| 1e9 * limit);
    let pressed = ball.pressed(options.force, options.resolution).with_context(about)?;
    let section = Section::of(&ball, &pressed);
    let mut report = ContactReport::new(&read.name, side, options.angle_deg, options.force, &ball, &pressed, &section);
    report.notes.extend(notes_of(&read, side));
    let text = serde_json::to_string_pretty(&report)?;
    println!("{text}");
    std::io::stdout().flush()?;

    let stem = folder.join(format!("{}-contact", read.name));
    whole_file::write(&beside(&stem, ".json"), text + "\n")?;
    whole_file::write_with(&beside(&stem, "-pressure.csv"), |mut out| write_pressure(&mut out, &pressed))?;
    whole_file::write_with(&beside(&stem, "-surface.csv"), |mut out| write_surface(&mut out, &pressed))?;
    if !pressed.dent.is_empty() {
        whole_file::write_with(&beside(&stem, "-dent.csv"), |mut out| write_dent(&mut out, &pressed))?;
    }
    let hertz: Vec<f64> = section.hertz.iter().map(Stress::von_mises).collect();
    let depth = |mut out: &mut (dyn Write + Send)| write_stresses(&mut out, &section.depth, &hertz);
    whole_file::write_with(&beside(&stem, "-depth.csv"), depth)?;
    whole_file::write_with(&beside(&stem, "-plane.csv"), |mut out| write_stresses(&mut out, &section.plane, &[]))?;
    if options.figure {
        Python::draw(project, "contact.py", [stem]);
    }
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

fn write_pressure(out: &mut impl Write, pressed: &Pressed) -> Result<()> {
    csv::header(out, [("x", "m"), ("y", "m"), ("pressure", "Pa")].into_iter())?;
    for cell in pressed.under_pressure() {
        let [x, y] = pressed.centre(cell);
        csv::row(out, [x, y, pressed.pressure[cell]].into_iter())?;
    }
    Ok(())
}

/// Depth of what stays dented, beyond that of the defects.
fn write_dent(out: &mut impl Write, pressed: &Pressed) -> Result<()> {
    csv::header(out, [("x", "m"), ("y", "m"), ("dent", "m")].into_iter())?;
    for cell in (0..pressed.dent.len()).filter(|&cell| pressed.dent[cell] > 0.0) {
        let [x, y] = pressed.centre(cell);
        csv::row(out, [x, y, pressed.dent[cell]].into_iter())?;
    }
    Ok(())
}

/// Depth of the defects over the window, on as many lines across as it differs on: one where it is the same on all.
fn write_surface(out: &mut impl Write, pressed: &Pressed) -> Result<()> {
    csv::header(out, [("x", "m"), ("y", "m"), ("depth", "m")].into_iter())?;
    let columns = pressed.cells[0];
    let first = &pressed.depth[..columns];
    let same = pressed.depth.chunks_exact(columns).all(|line| line == first);
    let step = if same { pressed.cells[1] } else { pressed.cells[1].div_ceil(SURFACE_LINES) };
    for row in (0..pressed.cells[1]).step_by(step) {
        for cell in row * columns..(row + 1) * columns {
            let [x, y] = pressed.centre(cell);
            csv::row(out, [x, y, pressed.depth[cell]].into_iter())?;
        }
    }
    Ok(())
}

/// Stresses at points, and beside them, where there are any, von Mises' of Hertz's contact.
fn write_stresses(out: &mut impl Write, points: &[StressAt], hertz: &[f64]) -> Result<()> {
    let position = [("x", "m"), ("y", "m"), ("depth", "m")];
    let mut stresses: Vec<_> =
        ["xx", "yy", "zz", "xy", "xz", "yz", "von_mises"].map(|name| format!("stress.{name}")).into();
    if !hertz.is_empty() {
        stresses.push("hertz.von_mises".to_owned());
    }
    csv::header(out, position.into_iter().chain(stresses.iter().map(|name| (name.as_str(), "Pa"))))?;
    for (i, StressAt { point, stress }) in points.iter().enumerate() {
        let values = point.iter().chain(&stress.normal).chain(&stress.shear).copied();
        csv::row(out, values.chain([stress.von_mises()]).chain(hertz.get(i).copied()))?;
    }
    Ok(())
}
