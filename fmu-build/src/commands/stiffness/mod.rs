//! The command `stiffness`: static stiffness, load distribution and critical load of a scene, as CSV, figure and
//! summary.

mod in_space;

use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use brinell::scene::{Bearing, ContactLaw, DefectOn, DegreesOfFreedom, Scene};
use brinell_analysis::statics::{
    Balance, Bottom, CriticalLoad, NoCriticalLoad, StaticBearing, StaticError, min_mean_max, sweep,
};
use clap::Args;
use serde_json::{Value, json};

use crate::package::Model;
use crate::package::model::ask_unit;
use crate::shared::{Drawn, Project, contact_map, csv, number, whole, whole_file};

/// Options of `stiffness` and `modes`, which sweep the cage angle.
#[derive(Debug, Args)]
pub struct OverCageAngle {
    /// Scene file (TOML), or the name of a shipped scene; its cage stands still
    pub(super) scene: PathBuf,
    /// Load in newtons along the scene's load; `modes` takes a scene without load as well, and puts it on the shaft
    /// and downwards, wherever that is held [default: the scene's]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number)]
    pub(super) load: Option<f64>,
    /// Cage angles within one element spacing [default: 200, more for a short defect]; those at which elements begin to
    /// carry are added, by `modes` also those at an edge of a defect and where modes change much
    #[arg(long, value_name = "COUNT", allow_negative_numbers = true, value_parser = whole::<1, 100_000>)]
    points: Option<u32>,
    /// Print the summary as JSON; files are named on standard error
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) drawn: Drawn,
}

impl OverCageAngle {
    /// Evenly spaced cage angles within one element spacing, `otherwise` where the user does not say.
    pub(super) fn points(&self, otherwise: impl FnOnce() -> usize) -> usize {
        self.points.map_or_else(otherwise, |n| n as usize)
    }

    /// Says what was written, unless standard output is for JSON.
    pub(super) fn tell(&self, what: impl std::fmt::Display) {
        if self.json { eprint!("{what}") } else { print!("{what}") }
    }

    /// Names a file that was written.
    pub(super) fn name(&self, path: &Path) {
        self.tell(format_args!("{}\n", path.display()));
    }

    /// Refuses a load that is none, and asks about one in another unit.
    pub(super) fn check(&self, scene: &Scene) -> Result<()> {
        let Some(amount) = self.load else { return Ok(()) };
        if !(amount.is_finite() && amount > 0.0) {
            bail!("load {amount} N: it must be finite and above 0");
        }
        ask_unit(&scene.bearing, "shaft.load_n", amount, "--load");
        Ok(())
    }
}

/// Depths, as factors of the scene's, at which the critical load is computed.
const DEPTHS: [f64; 9] = [0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0];
/// Number of angles of the inner ring, and of the cage at each of them, at which stiffness is computed.
const SHAFT_ANGLES: usize = 180;
const CAGE_ANGLES: usize = 24;
/// Number of clearances and compliances at which it is computed.
const VARIATIONS: usize = 21;

/// The command: `<folder>/<scene>-stiffness.csv`, with a defect `<scene>-critical-load.csv`, and, if wanted, a figure.
pub fn command(project: &Project, options: &OverCageAngle) -> Result<()> {
    let model = Model::read(&options.scene)?;
    options.check(&model.scene)?;
    let folder = options.drawn.folder(project, "stiffness");
    if model.scene.bearing.degrees_of_freedom != DegreesOfFreedom::Two {
        return in_space::command(project, &model, options, &folder);
    }
    let map = contact_map::of(&model.scene, model.profile_texts(), project)?;
    let bearing = loaded(StaticBearing::with_map(&model.scene, model.profile_texts(), map.as_deref())?, options.load)?;
    let healthy =
        loaded(StaticBearing::new(&Scene { defects: Vec::new(), ..model.scene.clone() }, None)?, options.load)?;
    let [x, y] = bearing.load();
    // Stiffness with a spall inside is least while that is under the load.
    let inside = model.scene.defects.iter().find(|defect| defect.on == DefectOn::Inner).map(|defect| defect.angle);
    let under_load = inside.map(|angle| libm::atan2(y, x) - angle);
    let bearing = under_load.map_or_else(|| bearing.clone(), |angle| bearing.with_shaft_angle(angle));
    let plain = plain(&bearing, &model, options.load)?;
    let plain = under_load.map_or_else(|| plain.clone(), |angle| plain.with_shaft_angle(angle));
    let bottom = bottom_of(&bearing)?;
    // In the middle of the sweep element 1 is in the middle of the defect, at its ends two elements are about it.
    let middle = bottom.map_or(libm::atan2(y, x), |bottom| bottom.middle);
    let first = middle - 0.5 * bearing.period();
    let points = options.points(|| enough_points(bearing.period(), bearing.defect_length()));
    let balances = sweep(&bearing, first, points)?;

    let stem = folder.join(&model.scene.name);
    let path = whole_file::beside(&stem, "-stiffness.csv");
    write_sweep(&path, &plain, &healthy, &balances)?;
    options.name(&path);

    if let Some(angle) = under_load {
        let path = whole_file::beside(&stem, "-shaft-stiffness.csv");
        write_over_shaft(&path, &bearing, angle)?;
        options.name(&path);
    }

    let critical = bottom.as_ref().map(|bottom| anyhow::Ok((bottom, plain.critical_load()?))).transpose()?;
    if let Some((bottom, Ok(critical))) = &critical {
        let path = whole_file::beside(&stem, "-critical-load.csv");
        let Bearing { radial_clearance, outer_compliance, .. } = model.scene.bearing;
        write_variations(&path, &plain, bottom, critical, radial_clearance, outer_compliance)?;
        options.name(&path);
    }
    let critical = critical.as_ref().map(|(bottom, critical)| (*bottom, critical.as_ref()));
    if options.json {
        println!("{}", serde_json::to_string_pretty(&summary_json(&plain, &balances, critical))?);
    } else {
        print!("{}", summary(&plain, &balances, critical)?);
    }
    options.tell(options.drawn.figure(project, "stiffness.py", [&stem], &[whole_file::beside(&stem, "-stiffness")])?);
    Ok(())
}

/// The bearing that is asked for critical loads. The bottom of a spall is flat: every law is Hertz's there. With
/// `hertz` a variation needs no new map, and no map ends below the load.
fn plain(bearing: &StaticBearing, model: &Model, load: Option<f64>) -> Result<StaticBearing> {
    let mut scene = model.scene.clone();
    scene.contact.law = ContactLaw::Hertz;
    match StaticBearing::new(&scene, model.profile_texts()) {
        Ok(plain) => loaded(plain, load),
        // Law `hertz` knows no topography.
        Err(_) => Ok(bearing.clone()),
    }
}

/// The bearing under an amount of load along its own.
fn loaded(bearing: StaticBearing, amount: Option<f64>) -> Result<StaticBearing> {
    let Some(amount) = amount else { return Ok(bearing) };
    let [x, y] = bearing.load();
    let length = libm::hypot(x, y);
    // A scene whose rings the host moves has no load: downwards then.
    let [x, y] = if length > 0.0 { [x / length, y / length] } else { [0.0, -1.0] };
    Ok(bearing.with_load([amount * x, amount * y]))
}

/// An even number, so that the middle is one of them: 0.2 degrees for nine elements, or a fortieth of a short defect.
pub(crate) fn enough_points(spacing: f64, defect_length: Option<f64>) -> usize {
    let of_defect = defect_length.map_or(0.0, |length| 20.0 * spacing / length);
    2 * (of_defect.ceil() as usize).clamp(100, 2000)
}

/// The bottom of the defect; `None` for a healthy bearing or a defect that only rises.
fn bottom_of(bearing: &StaticBearing) -> Result<Option<Bottom>> {
    match bearing.bottom() {
        Ok(bottom) => Ok(Some(bottom)),
        Err(StaticError::NoDefect | StaticError::NoDepth { .. }) => Ok(None),
        Err(error) => Err(error.into()),
    }
}

fn write_sweep(path: &Path, plain: &StaticBearing, healthy: &StaticBearing, balances: &[Balance]) -> Result<()> {
    let names = [
        ("cage.angle", "rad"),
        ("stiffness.free", "N/m"),
        ("stiffness.held", "N/m"),
        ("stiffness.healthy", "N/m"),
        ("stiffness.xx", "N/m"),
        ("stiffness.xy", "N/m"),
        ("stiffness.yx", "N/m"),
        ("stiffness.yy", "N/m"),
        ("shaft.x", "m"),
        ("shaft.y", "m"),
        ("load.x", "N"),
        ("load.y", "N"),
        ("load_zone", "rad"),
        ("critical_load", "N"),
    ]
    .map(|(name, unit)| (name.to_owned(), unit));
    let of_element = [("angle", "rad"), ("force.inner", "N"), ("force.outer", "N"), ("in_defect", "1")];
    let of_elements =
        (1..=plain.element_count()).flat_map(|j| of_element.map(|(name, unit)| (format!("element[{j}].{name}"), unit)));
    let rows = balances.iter().map(|balance| {
        let without = healthy.balance(balance.cage_angle, balance.load)?;
        let critical = plain.critical_load_at(balance.cage_angle)?.map_or(f64::NAN, |critical| critical.load);
        let [[xx, xy], [yx, yy]] = balance.stiffness;
        let ([x, y], [load_x, load_y]) = (balance.displacement, balance.load);
        let mut row =
            vec![balance.cage_angle, balance.free_stiffness(), balance.held_stiffness(), without.free_stiffness()];
        row.extend([xx, xy, yx, yy, x, y, load_x, load_y, balance.load_zone, critical]);
        for element in &balance.elements {
            let in_defect = f64::from(u8::from(element.in_defect));
            row.extend([element.angle, element.inner_force, element.outer_force, in_defect]);
        }
        Ok(row)
    });
    csv::write(path, names.into_iter().chain(of_elements), rows)
}

/// Stiffness along the load over the inner ring's angle, counted from that at which its defect is under the load:
/// least, mean and greatest over the cage angle.
fn write_over_shaft(path: &Path, bearing: &StaticBearing, under_load: f64) -> Result<()> {
    let names = ["shaft.angle", "stiffness.free.least", "stiffness.free.mean", "stiffness.free.greatest"];
    let rows = (0..=SHAFT_ANGLES).map(|i| {
        let angle = PI * (2.0 * i as f64 / SHAFT_ANGLES as f64 - 1.0);
        let balances = sweep(&bearing.with_shaft_angle(under_load + angle), 0.0, CAGE_ANGLES)?;
        Ok([angle].into_iter().chain(min_mean_max(&balances, Balance::free_stiffness)))
    });
    csv::write(path, names.into_iter().zip(["rad", "N/m", "N/m", "N/m"]), rows)
}

/// Three blocks, in each of which one of path, clearance and compliance varies and the others are the scene's.
fn write_variations(
    path: &Path,
    bearing: &StaticBearing,
    bottom: &Bottom,
    critical: &CriticalLoad,
    clearance: f64,
    compliance: f64,
) -> Result<()> {
    let mut rows = Vec::new();
    let mut row = |varied: f64, path: f64, clearance: f64, compliance: f64, bearing: &StaticBearing| -> Result<()> {
        let critical = bearing.critical_load()?.map_or(f64::NAN, |critical| critical.load);
        rows.push(Ok([varied, path, clearance, compliance, critical]));
        Ok(())
    };
    for factor in DEPTHS {
        match bearing.with_depth_times(factor) {
            Ok(other) => row(0.0, other.bottom()?.path, clearance, compliance, &other)?,
            // Deeper than an element's radius: the curve ends.
            Err(StaticError::Surface(_)) => {}
            Err(error) => return Err(error.into()),
        }
    }
    let part = |i: usize| i as f64 / (VARIATIONS - 1) as f64;
    let widest = (4.0 * clearance).max(0.5 * bottom.path);
    for i in 0..VARIATIONS {
        let clearance = widest * part(i);
        row(1.0, bottom.path, clearance, compliance, &bearing.with_clearance(clearance))?;
    }
    let rigid = bearing.with_outer_compliance(0.0).critical_load()?.map_or(critical.load, |critical| critical.load);
    // Where an element is at the bottom without any load, no compliance has a say.
    if rigid != 0.0 {
        let softest = (4.0 * bottom.path / rigid).max(2.0 * compliance);
        for i in 0..VARIATIONS {
            let compliance = softest * part(i);
            row(2.0, bottom.path, clearance, compliance, &bearing.with_outer_compliance(compliance))?;
        }
    }
    let names = [("varied", "1"), ("path", "m"), ("clearance", "m"), ("compliance", "m/N"), ("critical_load", "N")];
    csv::write(path, names, rows)
}

/// What [`summary`] says, in SI units except for degrees.
fn summary_json(
    bearing: &StaticBearing,
    balances: &[Balance],
    critical: Option<(&Bottom, Result<&CriticalLoad, &NoCriticalLoad>)>,
) -> Value {
    let extent = |quantity: fn(&Balance) -> f64| {
        let [least, mean, greatest] = min_mean_max(balances, quantity);
        json!({ "least": least, "mean": mean, "greatest": greatest })
    };
    let [x, y] = bearing.load();
    let found = critical.as_ref().and_then(|(_, critical)| critical.as_ref().ok());
    json!({
        "load_n": [x, y],
        "stiffness_n_m": extent(Balance::free_stiffness),
        "held_stiffness_n_m": extent(Balance::held_stiffness),
        "load_zone_deg": extent(|balance| balance.load_zone.to_degrees()),
        "critical_load_n": found.map(|critical| critical.load),
        "critical_load_reason": critical.and_then(|(_, critical)| critical.err().map(ToString::to_string)),
    })
}

fn summary(
    bearing: &StaticBearing,
    balances: &[Balance],
    critical: Option<(&Bottom, Result<&CriticalLoad, &NoCriticalLoad>)>,
) -> Result<String> {
    let [x, y] = bearing.load();
    let per_um = |quantity: fn(&Balance) -> f64| min_mean_max(balances, quantity).map(|k| k * 1e-6);
    let (free, held) = (per_um(Balance::free_stiffness), per_um(Balance::held_stiffness));
    let zone = min_mean_max(balances, |balance| balance.load_zone.to_degrees());
    let line = |name: &str, [least, mean, greatest]: [f64; 3], unit: &str| {
        format!("{name}: least {least:.2}, mean {mean:.2}, greatest {greatest:.2} {unit}\n")
    };
    let mut text = format!("load {:.1} N\n", libm::hypot(x, y));
    text += &line("stiffness along the load", free, "N/µm");
    text += &line("  transverse position held", held, "N/µm");
    text += &line("load zone, half-angle", zone, "degrees");
    let Some((bottom, critical)) = critical else { return Ok(text) };
    let critical = match critical {
        Ok(critical) => critical,
        Err(why) => return Ok(text + &format!("critical load: none; {why}\n")),
    };
    let angles = [critical.cage_angle.to_degrees(), bottom.path * 1e6];
    text += &format!(
        "critical load: {:.1} N ({} at the bottom, path {:.1} µm, cage angle {:.1} degrees)\n",
        critical.load,
        if critical.elements == 1 { "1 element".to_owned() } else { format!("{} elements", critical.elements) },
        angles[1],
        angles[0]
    );
    if let Some(by) = bearing.sensitivity(critical)? {
        text += &format!(
            "  per µm of depth {:+.1} N, per µm of clearance {:+.1} N, per nm/N of compliance {:+.1} N\n",
            by.by_depth * 1e-6,
            by.by_clearance * 1e-6,
            by.by_compliance * 1e-9
        );
    }
    let [direction, about] = [libm::atan2(y, x), bottom.middle];
    let aside = libm::remainder(direction - about, 2.0 * PI).to_degrees();
    if aside.abs() > 1.0 {
        text += &format!("  the middle of the defect is {:.1} degrees from the direction of the load\n", aside.abs());
    }
    Ok(text)
}
