//! The page: what was measured, in tables.

use std::fmt::Write;

use super::contact;
use super::integration::{Check, Integration, Row};

/// Errors of the acceleration at which costs are compared.
const LEVELS: [f64; 3] = [1e-2, 1e-3, 1e-5];
const METHODS: [&str; 4] = ["automatic", "phase-fitted only", "DP5 only", "Rodas5P only"];

/// The whole page.
pub(super) fn page(machine: &str, contacts: &[contact::Row], integration: &Integration) -> String {
    let mut text = format!(
        "# Error against run time\n\n\
         Written by `cargo fmu report`; the numbers behind it are in [`data/`](data). Measured on: {machine}. Times \
         are CPU times of one thread, the fastest of several runs.\n\n\
         What stiff and extreme cases do is in [stability.md](stability.md).\n\n"
    );
    text += &contact_part(contacts);
    text + &integration_part(integration)
}

fn contact_part(rows: &[contact::Row]) -> String {
    let mut text = "## Contact\n\n\
         One ball on the 90° edge of a spall (ER16K, 100 µm deep, approaches to 10 µm). Grids (law `love`) against one \
         of 128 × 48 cells, maps against their own grid; errors over the smooth contact's force at 10 µm. Grids are \
         warm, 50 nm further each time. [contact.md](contact.md) says how grids and maps are made.\n\n\
         ![Error against time of one contact](figures/error-vs-run-time-contact.svg)\n\n\
         | law | cells | nodes, both flanks | normal force: largest | rms | tangential: largest | rms | one contact \
         | to prepare, one core |\n\
         |---|---:|---:|---:|---:|---:|---:|---:|---:|\n"
        .to_owned();
    for row in rows {
        let nodes = row.nodes.map_or("–".to_owned(), |nodes| nodes.to_string());
        let [max_normal, rms_normal, max_tangential, rms_tangential] = row.error;
        let seconds = if row.nodes.is_some() {
            format!("{:.1} ns", 1e9 * row.seconds)
        } else {
            format!("{:.1} µs", 1e6 * row.seconds)
        };
        let _ = writeln!(
            text,
            "| {} | {} × {} | {nodes} | {max_normal:.1e} | {rms_normal:.1e} | {max_tangential:.1e} \
             | {rms_tangential:.1e} | {seconds} | {} s |",
            row.law,
            row.cells.columns,
            row.cells.rows,
            cost(row.prepare)
        );
    }
    text + "\n"
}

fn integration_part(found: &Integration) -> String {
    let mut text = format!(
        "## Time integration\n\n\
         Every shipped scene for {:.0} ms from rest, communication step 0.1 ms, compared every 10 µs. *Acceleration* \
         is the outer ring's along y (`housing.ay`), its error the root mean square over that of the acceleration \
         itself; where the host moves the outer ring it is `shaft.force.y`. *Path* is the largest error of any \
         element's path.\n\n\
         ![Error against CPU time](figures/error-vs-run-time.svg)\n\n\
         CPU seconds per simulated second of the cheapest run whose acceleration error is at most\n\n",
        1e3 * found.stop
    );
    let head: Vec<String> = LEVELS.iter().flat_map(|l| METHODS.map(|m| format!("{m}, {l:.0e}"))).collect();
    let _ = writeln!(text, "| scene | {} |\n|---|{}", head.join(" | "), "---:|".repeat(head.len()));
    for check in &found.checks {
        let cells = LEVELS.iter().flat_map(|&level| METHODS.map(|method| (level, method)));
        let cells: Vec<String> =
            cells.map(|(level, method)| cheapest(&found.rows, &check.scene, method, level)).collect();
        let _ = writeln!(text, "| {} | {} |", check.scene, cells.join(" | "));
    }
    text += "\n– : no run of this method is as exact as that.\n\n\
             ### What a tolerance means\n\n\
             Automatic method: error of the acceleration (rms; largest over largest) and of the paths (rms; largest) \
             by `solver.tolerance`.\n\n\
             | scene | tolerance | CPU s/s | steps/s | implicit | acceleration rms | largest | path rms, m | largest, \
             m |\n\
             |---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
    for row in found.rows.iter().filter(|row| row.method == "automatic") {
        let d = row.deviation;
        let _ = writeln!(
            text,
            "| {} | {:.0e} | {} | {:.0} | {:.0} % | {:.1e} | {:.1e} | {:.1e} | {:.1e} |",
            row.scene,
            row.setting,
            cost(row.cost),
            row.steps,
            100.0 * row.implicit,
            d.acceleration_rms,
            d.acceleration_max,
            d.path_rms,
            d.path_max
        );
    }
    text += "\n### How far the reference can be trusted\n\n\
             The reference is the automatic method at tolerance 1e-12. Beside it: Rodas5P alone at 1e-11, and, over \
             the first 20 ms and with law `hertz`, SciPy's DOP853 at 1e-12 on equations written separately \
             (`tests/oracle`), with both stopping at each contact change.\n\n\
             | scene | compared | Rodas5P: acceleration rms | path, m | DOP853: acceleration rms | path, m |\n\
             |---|---|---:|---:|---:|---:|\n";
    for Check { scene, signal, pair, oracle } in &found.checks {
        let oracle =
            oracle.map_or("– | –".to_owned(), |d| format!("{:.1e} | {:.1e}", d.acceleration_rms, d.path_max));
        let _ = writeln!(
            text,
            "| {scene} | `{signal}` | {:.1e} | {:.1e} | {oracle} |",
            pair.acceleration_rms, pair.path_max
        );
    }
    text
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
