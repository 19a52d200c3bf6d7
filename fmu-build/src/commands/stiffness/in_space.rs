//! The command `stiffness` for rings with three and five degrees of freedom: balance and tangent stiffness over the
//! cage angle. A critical load is worked out in the plane only, and there is no figure.

use std::path::Path;

use anyhow::Result;
use brinell_analysis::modes::loaded;
use brinell_analysis::statics::{BalanceInSpace, BearingInSpace};
use brinell_analysis::statistics;
use serde_json::json;

use super::{OverCageAngle, enough_points};
use crate::package::Model;
use crate::shared::{Project, contact_map, csv, whole_file};

const COORDINATES: [&str; 5] = ["x", "y", "z", "tilt_x", "tilt_y"];

/// The command: `<folder>/<scene>-stiffness.csv` and a summary.
pub(super) fn command(project: &Project, model: &Model, options: &OverCageAngle, folder: &Path) -> Result<()> {
    let scene = options.load.map_or_else(|| model.scene.clone(), |amount| loaded(&model.scene, amount));
    let map = contact_map::of(&scene, model.profile_texts(), project)?;
    let bearing = BearingInSpace::new(&scene, model.profile_texts(), map.as_deref())?;
    let points = options.points(|| enough_points(bearing.period(), None));
    let balances = bearing.sweep(scene.cage.initial_angle, points)?;
    let path = whole_file::beside(&folder.join(&scene.name), "-stiffness.csv");
    let (names, columns) = table(&balances, bearing.order());
    csv::table(&path, &names, &columns)?;
    options.name(&path);
    if options.json {
        println!("{}", serde_json::to_string_pretty(&summary_json(&balances, bearing.order()))?);
    } else {
        print!("{}", summary(&balances, bearing.order()));
    }
    Ok(())
}

fn unit(row: usize, column: usize) -> &'static str {
    match (row < 3, column < 3) {
        (true, true) => "N/m",
        (true, false) => "N/rad",
        (false, true) => "N.m/m",
        (false, false) => "N.m/rad",
    }
}

/// Columns by name and unit: cage angle, position, K row by row.
fn table(balances: &[BalanceInSpace], order: usize) -> (Vec<(String, &'static str)>, Vec<Vec<f64>>) {
    let column = |of: &dyn Fn(&BalanceInSpace) -> f64| balances.iter().map(of).collect::<Vec<f64>>();
    let mut names = vec![("cage_angle".to_owned(), "deg")];
    let mut columns = vec![column(&|at| at.cage_angle.to_degrees())];
    for k in 0..order {
        names.push((COORDINATES[k].to_owned(), if k < 3 { "m" } else { "rad" }));
        columns.push(column(&|at| at.position[k]));
    }
    for row in 0..order {
        for k in 0..order {
            names.push((format!("stiffness_{}_{}", COORDINATES[row], COORDINATES[k]), unit(row, k)));
            columns.push(column(&|at| at.stiffness[row][k]));
        }
    }
    (names, columns)
}

/// Least and greatest of a quantity of all balances.
fn extent(balances: &[BalanceInSpace], of: impl Fn(&BalanceInSpace) -> f64) -> [f64; 2] {
    statistics::extent(balances.iter().map(of))
}

fn largest_force(at: &BalanceInSpace) -> f64 {
    at.balls.iter().map(|ball| ball.forces[0]).fold(0.0, f64::max)
}

/// Least and greatest contact angle (rad) of the loaded balls.
fn contact_angles(balances: &[BalanceInSpace]) -> [f64; 2] {
    let loaded = balances.iter().flat_map(|at| &at.balls).filter(|ball| ball.forces[0] > 0.0);
    statistics::extent(loaded.map(|ball| ball.contact_angles[0]))
}

fn summary(balances: &[BalanceInSpace], order: usize) -> String {
    let mut text = "least and greatest over the cage angle:\n".to_owned();
    for k in 0..order {
        let [least, most] = extent(balances, |at| at.position[k]);
        let (scale, unit) = if k < 3 { (1e6, "um") } else { (1e3, "mrad") };
        text += &format!("    {:<8} {:12.4} to {:12.4} {unit}\n", COORDINATES[k], least * scale, most * scale);
    }
    for row in 0..order {
        for k in row..order {
            let [least, most] = extent(balances, |at| at.stiffness[row][k]);
            let name = format!("K {} {}", COORDINATES[row], COORDINATES[k]);
            text += &format!("    {name:<16} {least:14.6e} to {most:14.6e} {}\n", unit(row, k));
        }
    }
    let ([least, most], [low, high]) = (extent(balances, largest_force), contact_angles(balances).map(f64::to_degrees));
    text += &format!("largest ball force {least:.2} to {most:.2} N, contact angles {low:.2} to {high:.2} degrees\n");
    text + "critical load: worked out for rings in their plane only\n"
}

fn summary_json(balances: &[BalanceInSpace], order: usize) -> serde_json::Value {
    let entries = |row: usize| (0..order).map(|k| extent(balances, |at| at.stiffness[row][k])).collect::<Vec<_>>();
    json!({
        "coordinates": &COORDINATES[..order],
        "position": (0..order).map(|k| extent(balances, |at| at.position[k])).collect::<Vec<_>>(),
        "stiffness": (0..order).map(entries).collect::<Vec<_>>(),
        "largest_ball_force_n": extent(balances, largest_force),
        "contact_angle_deg": contact_angles(balances).map(f64::to_degrees),
    })
}
