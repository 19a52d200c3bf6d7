//! The command `modes`: natural frequencies, damping ratios and mode shapes of a scene over the cage angle, as JSON,
//! figure and summary.

use anyhow::{Result, bail};
use brinell_analysis::modes::{Assembly, Hold, Kind, LineReport, ModesReport, loaded, sweep};

use super::stiffness::{OverCageAngle, enough_points};
use crate::package::Model;
use crate::shared::{Project, contact_map, whole_file};

/// The command: `<folder>/<scene>-modes.json` and, if wanted, a figure.
pub fn command(project: &Project, options: &OverCageAngle) -> Result<()> {
    let model = Model::read(&options.scene)?;
    options.check(&model.scene)?;
    let folder = options.drawn.folder(project, "modes");
    let scene = options.load.map_or_else(|| model.scene.clone(), |amount| loaded(&model.scene, amount));
    let map = contact_map::of(&scene, model.profile_texts(), project)?;
    let assembly = Assembly::new(&scene, model.profile_texts(), map.as_deref())?;
    let [[x, y], [x_o, y_o]] = assembly.loads();
    let direction = if [x, y] == [0.0; 2] { libm::atan2(0.0 - y_o, 0.0 - x_o) } else { libm::atan2(y, x) };
    // In the middle of the sweep element 1 is in the middle of the defect, at its ends two elements are about it.
    let middle = assembly.defect().map_or(direction, |defect| defect.centre);
    let length = assembly.defect().map(|defect| defect.length);
    let points = options.points(|| enough_points(assembly.period(), length));
    let modes = sweep(&assembly, middle - 0.5 * assembly.period(), points)?;
    let report = ModesReport::new(scene.name.clone(), &assembly, middle, &modes);
    if report.held(Hold::Pressed)[1] == 0 {
        bail!(
            "no element is pressed between the raceways at any cage angle, so nothing couples the rings: \
             give a load, or a larger one, with --load"
        );
    }

    let stem = folder.join(&scene.name);
    let path = whole_file::beside(&stem, "-modes.json");
    whole_file::write(&path, serde_json::to_string(&report)? + "\n")?;
    options.name(&path);
    if options.json {
        println!("{}", serde_json::to_string_pretty(&report)?);
    } else {
        print!("{}", summary(&report));
    }
    options.tell(options.drawn.figure(project, "modes.py", [&stem], &[whole_file::beside(&stem, "-modes")])?);
    Ok(())
}

fn summary(report: &ModesReport) -> String {
    let loads = [("shaft", report.shaft_load_n), ("housing", report.housing_load_n)];
    let mut text = String::new();
    for (ring, [x, y]) in loads.into_iter().filter(|(_, load)| *load != [0.0; 2]) {
        text += &format!("load on the {ring}: {x:.1}, {y:.1} N\n");
    }
    text += "least and greatest over the cage angle:\n";
    text += "    undamped (Hz)         damping (%)       what moves, by share of the kinetic energy\n";
    for line in report.lines.iter().filter(|line| line.elements <= 0.5) {
        text += &row([line.undamped_frequency_hz, line.damping_ratio], &what_moves(report, line));
    }
    for (hold, what) in [
        (Hold::Pressed, "elements pressed between the raceways"),
        (Hold::Resting, "elements resting under their weight"),
    ] {
        if let Some(extents) = report.of_elements(hold) {
            text += &row(extents, what);
        }
    }
    for (hold, what) in [(Hold::Pressed, "pressed"), (Hold::Resting, "resting on one raceway"), (Hold::Loose, "loose")]
    {
        let [least, greatest] = report.held(hold);
        if greatest > 0 {
            text += &format!("elements {what}: {least} to {greatest}\n");
        }
    }
    for (kind, what) in [
        (Kind::Overdamped, "overdamped: no oscillation"),
        (Kind::Decaying, "held by dampers alone"),
        (Kind::Free, "held by nothing: frequency 0"),
        (Kind::Unstable, "unstable: the equilibrium does not hold by itself"),
    ] {
        let most = report.most(kind);
        if most > 0 {
            text += &format!("modes {what}: up to {most} at a time\n");
        }
    }
    text
}

fn row([[low, high], damping]: [[f64; 2]; 2], what: &str) -> String {
    let [least, greatest] = damping.map(|ratio| 100.0 * ratio);
    format!("    {low:8.1} to {high:8.1}  {least:7.2} to {greatest:6.2}  {what}\n")
}

/// Freedoms with at least a twentieth of the energy, the largest first.
fn what_moves(report: &ModesReport, line: &LineReport) -> String {
    let mut parts: Vec<(f64, &str)> =
        report.freedoms.iter().zip(&line.energy).map(|(name, &part)| (part, name.as_str())).collect();
    parts.retain(|(part, name)| *part >= 0.05 && !name.starts_with("element"));
    if line.elements >= 0.05 {
        parts.push((line.elements, "elements"));
    }
    parts.sort_by(|a, b| b.0.total_cmp(&a.0));
    parts.iter().map(|(part, name)| format!("{name} {:.0} %", 100.0 * part)).collect::<Vec<_>>().join(", ")
}
