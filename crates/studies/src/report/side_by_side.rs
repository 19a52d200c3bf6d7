//! What bearings side by side in registers would gain: the best case, from what elements and all else of a step cost.
//!
//! Alone a bearing of Z elements fills ⌈Z/8⌉ registers of eight. B bearings fill ⌈BZ/8⌉ together, and of all else in a
//! step each has 1/B. With eight that is a lane for each.

use std::fmt::Write;
use std::path::Path;

use anyhow::Result;
use fmu_build::shared::whole_file;

use super::elements;

/// Bearings that share registers.
const BESIDE: [usize; 4] = [1, 2, 4, 8];

/// What bearings side by side in registers would gain.
pub(super) struct SideBySide<'a> {
    /// Explicit steps of healthy bearings, by rising numbers of elements.
    elements: &'a [elements::Row],
    /// What a register of elements costs of a step (s).
    per_register: f64,
    /// What all else costs of a step (s).
    rest: f64,
}

impl<'a> SideBySide<'a> {
    /// By least squares over all numbers of elements; `None` where all bearings fill one register.
    pub(super) fn new(elements: &'a [elements::Row]) -> Option<Self> {
        let points: Vec<[f64; 2]> = elements.iter().map(|row| [registers(row.count), row.seconds[0]]).collect();
        let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / points.len() as f64;
        let [x, y] = [mean(0), mean(1)];
        let spread: f64 = points.iter().map(|point| (point[0] - x).powi(2)).sum();
        let product: f64 = points.iter().map(|point| (point[0] - x) * (point[1] - y)).sum();
        let per_register = product / spread;
        (spread > 0.0).then_some(Self { elements, per_register, rest: y - per_register * x })
    }

    /// CPU time of a healthy bearing's step (s), one of `beside` bearings at best.
    pub(super) fn step(&self, count: usize, beside: usize) -> f64 {
        (registers(count * beside) * self.per_register + self.rest) / beside as f64
    }

    /// Writes `side-by-side.csv`.
    pub(super) fn write(&self, data: &Path) -> Result<()> {
        whole_file::write_with(&data.join("side-by-side.csv"), |out| {
            writeln!(out, "elements,alone_measured_s,{}", BESIDE.map(|beside| format!("of_{beside}_s")).join(","))?;
            for row in self.elements {
                let steps = BESIDE.map(|beside| format!("{:.4e}", self.step(row.count, beside)));
                writeln!(out, "{},{:.4e},{}", row.count, row.seconds[0], steps.join(","))?;
            }
            Ok(())
        })
    }

    /// The section of the page.
    pub(super) fn section(&self) -> String {
        let mut text = format!(
            "\n### Bearings side by side\n\n\
             Two, four or eight bearings could share registers of eight lanes. A register of elements costs {:.3} µs \
             of a step, whosever elements they are, and all else {:.3} µs: both fitted to the table above. If nothing \
             of all else had to be done one by one (control of steps, knots, contact changes), a step would cost at \
             best what this table says, and the last column how many times less that is with eight. With more elements \
             the gain is lost: alone a bearing fills the registers itself. It would take the right-hand side and the \
             stepper a second time, and is left out.\n\n\
             ![Steps a second over the number of elements, alone and side by side](figures/side-by-side.svg)\n\n\
             | elements | alone, measured (µs) | alone | one of 2, at best | one of 4 | one of 8 | times |\n\
             |---:|---:|---:|---:|---:|---:|---:|\n",
            1e6 * self.per_register,
            1e6 * self.rest,
        );
        for row in self.elements {
            let steps = BESIDE.map(|beside| self.step(row.count, beside));
            let cells = steps.map(|step| format!("{:.3}", 1e6 * step)).join(" | ");
            let (measured, times) = (1e6 * row.seconds[0], steps[0] / steps[3]);
            let _ = writeln!(text, "| {} | {measured:.3} | {cells} | {times:.1} |", row.count);
        }
        text
    }
}

/// Registers of eight lanes that so many elements fill.
fn registers(count: usize) -> f64 {
    count.div_ceil(8) as f64
}
