//! The page: what was measured, in the tables of `assets/error-vs-run-time.md`.

use anyhow::Result;
use fmu_build::package::render;
use minijinja::context;

use super::contact;
use super::integration::{Check, Integration, Row};

/// Errors of the acceleration at which costs are compared.
const LEVELS: [f64; 3] = [1e-2, 1e-3, 1e-5];
const METHODS: [&str; 4] = ["automatic", "phase-fitted only", "DP5 only", "Rodas5P only"];

/// The whole page.
///
/// # Errors
/// Of its template.
pub(super) fn page(machine: &str, contacts: &[contact::Row], integration: &Integration) -> Result<String> {
    let Integration { rows, checks, stop } = integration;
    let columns: Vec<(f64, &str)> = LEVELS.iter().flat_map(|&level| METHODS.map(|method| (level, method))).collect();
    let costs = |check: &Check| {
        let costs = columns.iter().map(|&(level, method)| cheapest(rows, &check.scene, method, level));
        std::iter::once(check.scene.clone()).chain(costs).collect::<Vec<_>>()
    };
    let automatic: Vec<&Row> = rows.iter().filter(|row| row.method == "automatic").collect();
    let mut settings: Vec<f64> = automatic.iter().map(|row| row.setting).collect();
    settings.sort_by(|a, b| b.total_cmp(a));
    settings.dedup();
    let tolerances = |check: &Check| {
        let of_scene = |setting: f64| automatic.iter().find(|row| row.scene == check.scene && row.setting == setting);
        let cell = |&setting: &f64| of_scene(setting).map_or("–".to_owned(), |row| tolerance_cell(row));
        std::iter::once(check.scene.clone()).chain(settings.iter().map(cell)).collect::<Vec<_>>()
    };
    let values = context! {
        machine,
        milliseconds => format!("{:.0}", 1e3 * stop),
        contacts => contacts.iter().map(contact_row).collect::<Vec<_>>(),
        levels => columns.iter().map(|(level, method)| format!("{method}, {level:.0e}")).collect::<Vec<_>>(),
        cheapest => checks.iter().map(costs).collect::<Vec<_>>(),
        settings => settings.iter().map(|setting| format!("{setting:.0e}")).collect::<Vec<_>>(),
        tolerances => checks.iter().map(tolerances).collect::<Vec<_>>(),
        checks => checks.iter().map(check_row).collect::<Vec<_>>(),
    };
    render("error-vs-run-time.md", include_str!("../../assets/error-vs-run-time.md"), values)
}

fn contact_row(row: &contact::Row) -> Vec<String> {
    let seconds = match row.nodes {
        Some(_) => format!("{:.1} ns", 1e9 * row.seconds),
        None => format!("{:.1} µs", 1e6 * row.seconds),
    };
    let nodes = row.nodes.map_or("–".to_owned(), |nodes| nodes.to_string());
    let cells = format!("{} × {}", row.cells.columns, row.cells.rows);
    let mut cells = vec![row.law.to_owned(), cells, nodes];
    cells.extend(row.error.map(short));
    cells.extend([seconds, format!("{} s", cost(row.prepare))]);
    cells
}

fn tolerance_cell(row: &Row) -> String {
    format!("{}, {} s", short(row.deviation.acceleration_rms), cost(row.cost))
}

fn check_row(check: &Check) -> Vec<String> {
    let Check { scene, signal, pair } = check;
    vec![scene.clone(), format!("`{signal}`"), short(pair.acceleration_rms), short(pair.path_max)]
}

fn short(error: f64) -> String {
    format!("{error:.1e}")
}

fn cheapest(rows: &[Row], scene: &str, method: &str, level: f64) -> String {
    let good = rows.iter().filter(|row| row.scene == scene && row.method == method);
    good.filter(|row| row.deviation.acceleration_rms <= level)
        .map(|row| row.cost)
        .min_by(f64::total_cmp)
        .map_or("–".to_owned(), cost)
}

/// Three digits.
fn cost(seconds: f64) -> String {
    let digits = (2 - seconds.log10().floor() as i32).max(0) as usize;
    format!("{seconds:.digits$}")
}
