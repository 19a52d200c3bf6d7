//! The page about single steps: which method takes them, and what they cost.

use std::fmt::Write;

use super::choice;
use super::elements::{self, Hosted};
use super::steady;

/// The whole page.
pub(super) fn page(machine: &str, choices: &[choice::Row], elements: &[elements::Row], hosted: &[Hosted]) -> String {
    let mut text = format!(
        "# Cost of steps\n\n\
         Written by `cargo fmu report`, and alone by `cargo fmu report --steps`; the numbers behind it are in \
         [`data/`](data). Measured on: {machine}. Times are CPU times of one thread, the fastest of many runs.\n\n\
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
    text += &SideBySide::new(elements).map_or_else(String::new, |gain| gain.section());
    text += "\n## A communication step of 10 µs\n\n\
         6205-healthy with both rings moved by the host, which sets position and velocity before each step.\n\n\
         | tolerance | a communication step | integration steps in it |\n|---:|---:|---:|\n";
    for Hosted { tolerance, seconds, steps } in hosted {
        let _ = writeln!(text, "| {tolerance:.0e} | {:.3} µs | {steps:.2} |", 1e6 * seconds);
    }
    text
}

/// What bearings side by side in registers would gain.
struct SideBySide<'a> {
    /// Explicit steps of healthy bearings, by rising numbers of elements.
    elements: &'a [elements::Row],
    /// What eight elements more cost of a step [s].
    per_register: f64,
}

impl<'a> SideBySide<'a> {
    /// `None` where all bearings fill one register.
    fn new(elements: &'a [elements::Row]) -> Option<Self> {
        let (few, many) = (elements.first()?, elements.last()?);
        let more = registers(many.count) - registers(few.count);
        (more > 0.0).then(|| Self { elements, per_register: (many.seconds[0] - few.seconds[0]) / more })
    }

    /// Step of a healthy bearing of this many elements, alone and as one of eight, each a lane [s]: a register for each
    /// element of all eight instead of one for each eight elements of one, and an eighth of all else.
    fn step(&self, count: usize) -> Option<[f64; 2]> {
        let alone = self.elements.iter().find(|row| row.count == count)?.seconds[0];
        let rest = (alone - registers(count) * self.per_register).max(0.0);
        Some([alone, (count as f64 * self.per_register + rest) / 8.0])
    }

    /// The section.
    fn section(&self) -> String {
        let mut text = format!(
            "\n### Bearings side by side\n\n\
             Eight bearings could share registers, a lane for each. A register of elements costs {:.3} µs of a step \
             here, whosever elements they are; of all else in a step eight bearings would take an eighth each, if \
             nothing of it had to be done one by one: control of steps, knots, contact changes. So a step would be at \
             best as many times cheaper as the table says. It would take the right-hand side and the stepper a second \
             time, and is left out.\n\n\
             | elements | alone (µs) | one of eight, at best (µs) | times |\n|---:|---:|---:|---:|\n",
            1e6 * self.per_register
        );
        for row in self.elements {
            if let Some([alone, shared]) = self.step(row.count) {
                let (count, times) = (row.count, alone / shared);
                let _ = writeln!(text, "| {count} | {:.3} | {:.3} | {times:.1} |", 1e6 * alone, 1e6 * shared);
            }
        }
        text
    }
}

/// Registers of eight places that so many elements fill.
fn registers(count: usize) -> f64 {
    count.div_ceil(8) as f64
}

/// What whole seconds cost.
pub(super) fn seconds(rows: &[steady::Row], elements: &[elements::Row]) -> String {
    let mut text = "\n## A whole second\n\n\
         Shipped scenes after the first 0.3 s, when what hung in the clearance has begun to bounce. *Start*: the first \
         25 ms from rest. *RMS*: that of `housing.ay`, or `shaft.force.y` where the host has the outer ring, over the \
         second, read every 0.1 ms, against the same run at a tolerance of 1e-7. Runs of elements that bounce are not \
         equal at equal instants, so part of it is chance. *Side by side*: how many times cheaper a step would be at \
         best as one of eight; contacts near a defect are looked up one by one and stay what they are.\n\n\
         | scene | tolerance | start, CPU s/s | the second, CPU s/s | steps/s | rejected/s | RMS | side by side |\n\
         |---|---:|---:|---:|---:|---:|---:|---:|\n"
        .to_owned();
    let gain = SideBySide::new(elements);
    for row in rows {
        let steady::Row { scene, tolerance, cost: [first, cost], steps: [steps, rejected], error, balls } = row;
        let step = cost / steps;
        let balls = balls.and_then(|count| gain.as_ref()?.step(count));
        let times = balls.map_or_else(
            || "–".to_owned(),
            |[alone, shared]| format!("{:.1}", step / (step - alone + shared).max(shared)),
        );
        let _ = writeln!(
            text,
            "| {scene} | {tolerance:.0e} | {first:.3} | {cost:.3} | {steps:.0} | {rejected:.0} | {:+.2} % | {times} |",
            100.0 * error
        );
    }
    text
}
