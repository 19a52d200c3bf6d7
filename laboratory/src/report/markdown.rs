//! The page: what was measured, in the tables of `assets/error-vs-run-time.md`.

use anyhow::Result;
use fmu_build::package::render;
use minijinja::context;

use super::contact;
use super::integration::{Check, Integration, Row};

/// The whole page.
///
/// # Errors
/// Of its template.
pub(super) fn page(machine: &str, contacts: &[contact::Row], integration: &Integration) -> Result<String> {
    let Integration { rows, checks, stop } = integration;
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

/// Three digits.
fn cost(seconds: f64) -> String {
    let digits = (2 - seconds.log10().floor() as i32).max(0) as usize;
    format!("{seconds:.digits$}")
}
