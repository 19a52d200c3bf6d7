//! The page about single steps: which method takes them, and what they cost.

use std::fmt::Write;

use super::choice;
use super::elements::{self, Hosted};
use super::side_by_side::SideBySide;
use super::steady;

/// The whole page.
pub(super) fn page(
    machine: &str,
    choices: &[choice::Row],
    elements: &[elements::Row],
    gain: Option<&SideBySide<'_>>,
    hosted: &[Hosted],
) -> String {
    let mut text = format!(
        "# Cost of steps\n\n\
         Written by `cargo fmu report`, and alone by `cargo fmu report --steps`; the numbers behind it are in \
         [`data/`](data). Measured on: {machine}. Times are CPU times of one thread, the fastest of many runs; whole \
         seconds were run once each, at the end.\n\n\
         ## Choice of the method\n\n\
         Tolerance 1e-5, communication step 0.1 ms. The methods take turns: the phase-fitted pair \
         alone, Dormand–Prince alone, Rodas5P alone, and the automatic choice. *Steps* are those tried per simulated \
         second, an implicit one counted as the five explicit ones that it costs about: a count without noise. \
         *Ratio*: automatic over the best of the others. At equal tolerance the phase-fitted pair is the more exact \
         one.\n\n\
         | case | phase-fitted, CPU s/s | DP5 | Rodas5P | automatic | **ratio** | phase-fitted, steps/s | DP5 \
         | Rodas5P | automatic | ratio | implicit steps \
         |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n"
    );
    for row in choices {
        let cost = row.cost.map(|cost| format!("{cost:.4}")).join(" | ");
        let steps = row.steps.map(|steps| format!("{steps:.0}")).join(" | ");
        let _ = writeln!(
            text,
            "| {} | {cost} | **{:.2}** | {steps} | {:.2} | {:.0} % |",
            row.what,
            choice::Row::ratio(row.cost),
            choice::Row::ratio(row.steps),
            100.0 * row.implicit
        );
    }
    let worst = choices.iter().map(|row| choice::Row::ratio(row.cost)).fold(0.0, f64::max);
    let within = choices.iter().filter(|row| choice::Row::ratio(row.cost) <= 1.3).count();
    let _ = writeln!(text, "\nWithin 1.3: {within} of {}; the largest ratio is {worst:.2}.", choices.len());
    text += "\n## Number of elements\n\n\
         Microseconds of one accepted step, rejected ones and landings included; 6205 at the same load for each \
         element, and the ER16K with its spall, law `hertz`. Elements are computed eight at a time.\n\n\
         ![Cost of a step over the number of elements](figures/elements.svg)\n\n\
         | elements | explicit | each element | implicit | each element | explicit, spall | each element |\n\
         |---:|---:|---:|---:|---:|---:|---:|\n";
    for row in elements {
        let cells = row.seconds.map(|s| format!("{:.3} | {:.4}", 1e6 * s, 1e6 * s / row.count as f64));
        let _ = writeln!(text, "| {} | {} |", row.count, cells.join(" | "));
    }
    if let Some(gain) = gain {
        text += &gain.section();
    }
    text += "\n## A communication step of 10 µs\n\n\
         6205-healthy with both rings moved by the host, which sets position and velocity before each step.\n\n\
         | tolerance | a communication step | integration steps in it |\n|---:|---:|---:|\n";
    for Hosted { tolerance, seconds, steps } in hosted {
        let _ = writeln!(text, "| {tolerance:.0e} | {:.3} µs | {steps:.2} |", 1e6 * seconds);
    }
    text += "\nIt costs what its integration steps cost. 0.3 µs would be less than the two registers of its nine \
             elements take in one step.\n";
    text
}

/// What whole seconds cost; elements of `6205-healthy` vibrate at up to `fastest` (Hz).
pub(super) fn seconds(rows: &[steady::Row], gain: Option<&SideBySide<'_>>, fastest: f64) -> String {
    let mut text = "\n## A whole second\n\n\
         Shipped scenes after the first 0.3 s, when what hung in the clearance has begun to bounce. *Start*: the first \
         25 ms from rest. *RMS*: that of `housing.ay`, or `shaft.force.y` where the host has the outer ring, over the \
         second, read every 0.1 ms, against the same run at a tolerance of 1e-7. Runs of elements that bounce are not \
         equal at equal instants, so part of it is chance. *Side by side*: how many times cheaper a step would be at \
         best as one of eight; contacts near a defect are looked up one by one and stay what they are.\n\n\
         | scene | tolerance | start, CPU s/s | the second, CPU s/s | steps/s | rejected/s | RMS | side by side |\n\
         |---|---:|---:|---:|---:|---:|---:|---:|\n"
        .to_owned();
    for row in rows {
        let steady::Row { scene, tolerance, cost: [first, cost], steps: [steps, rejected], error, balls } = row;
        let step = cost / steps;
        let times = gain.zip(*balls).map_or_else(
            || "–".to_owned(),
            |(gain, count)| {
                let [alone, shared] = [1, 8].map(|beside| gain.step(count, beside));
                format!("{:.1}", step / (step - alone + shared).max(shared))
            },
        );
        let _ = writeln!(
            text,
            "| {scene} | {tolerance:.0e} | {first:.3} | {cost:.3} | {steps:.0} | {rejected:.0} | {:+.2} % | {times} |",
            100.0 * error
        );
    }
    text += &bounds(rows, fastest);
    text
}

/// Reach ωh of the phase-fitted pair's stability.
const REACH: f64 = 4.0;

/// Why a second does not cost less; elements of `6205-healthy` vibrate at up to `fastest` (Hz).
fn bounds(rows: &[steady::Row], fastest: f64) -> String {
    let of = |scene: &str| rows.iter().find(|row| row.scene == scene && row.tolerance == 1e-3);
    let (Some(healthy), Some(spalled)) = (of("6205-healthy"), of("er16k-tb1")) else { return String::new() };
    let cost_of_a_step = healthy.cost[1] / healthy.steps[0];
    let [accepted, rejected] = spalled.steps;
    format!(
        "\n### What bounds it\n\n\
         *Healthy*, tolerance 1e-3. The elements of `6205-healthy` vibrate at up to {:.0} kHz under its load \
         (`brinell modes 6205-healthy`), and an explicit step is stable up to ωh = {REACH}: {:.0} steps a second. The \
         run takes {:.0}, at any tolerance above 1e-4: it is stability that limits its steps, and a step of five \
         evaluations costs {:.2} µs. Half the time would need half as many evaluations: a method of longer reach, or \
         `bearing.element_inertia = \"none\"`, which leaves the element vibrations out.\n\n\
         *Spalled*, tolerance 1e-3. `er16k-tb1` tries {:.0} steps a second, {:.0} of which end at a contact change or \
         are too long, and one costs {:.2} µs: elements near the spall are looked up in the contact map one by one, \
         and contact changes are searched for. If its accepted steps cost what a healthy bearing's do, and none were \
         rejected, the second would cost {:.2} s: with such steps nothing can go below that.\n",
        1e-3 * fastest,
        std::f64::consts::TAU * fastest / REACH,
        healthy.steps[0],
        1e6 * cost_of_a_step,
        accepted + rejected,
        rejected,
        1e6 * spalled.cost[1] / (accepted + rejected),
        accepted * cost_of_a_step,
    )
}
