//! Answers counted by machine.

use std::fmt::Write;

use super::{Answer, Extent};
use brinell_analysis::sizing::{Fault, Grade};
use brinell_analysis::statistics::{median, quantile};

/// All tables, as Markdown.
pub(super) fn tables(all: &[Answer]) -> String {
    let mut machines: Vec<&str> = all.iter().map(|a| a.known.machine.as_str()).collect();
    machines.sort_unstable();
    machines.dedup();
    let mut text = String::from(
        "| machine | | kind right / wrong / not named | script | `clear` right / wrong | `likely` | healthy: none / \
         undecided / named | script: alarms | CPU (s) median, most |\n|---|---|---:|---:|---:|---:|---:|---:|---:|\n",
    );
    for machine in &machines {
        for extent in [Extent::Whole, Extent::Half, Extent::Second, Extent::WrongSpeed] {
            let of: Vec<&Answer> = all.iter().filter(|a| a.known.machine == *machine && a.extent == extent).collect();
            text += &kinds(machine, extent, &of);
        }
    }
    text += "\n| machine | | lengths | hold | ± (median) | mean error | at least: hold |\n";
    text += "|---|---|---:|---:|---:|---:|---:|\n";
    for machine in &machines {
        for fault in [Fault::Outer, Fault::Inner] {
            for extent in [Extent::Whole, Extent::Half, Extent::Second] {
                let is_of = |a: &&Answer| a.known.machine == *machine && a.extent == extent && a.known.fault == fault;
                let of: Vec<&Answer> = all.iter().filter(is_of).collect();
                text += &lengths(machine, extent, fault, &of);
            }
        }
    }
    text
}

fn is_kind(fault: Fault) -> bool {
    matches!(fault, Fault::Outer | Fault::Inner | Fault::Element)
}

fn name(extent: Extent) -> &'static str {
    match extent {
        Extent::Whole => "whole",
        Extent::Half => "halves",
        Extent::Second => "1 s",
        Extent::WrongSpeed => "whole, at half to twice the speed",
    }
}

fn kinds(machine: &str, extent: Extent, of: &[&Answer]) -> String {
    let count = |wanted: &dyn Fn(&Answer) -> bool| of.iter().filter(|a| wanted(a)).count();
    let three = |answer: &dyn Fn(&Answer) -> Fault| {
        let faulty = |a: &Answer| a.known.fault != Fault::None;
        let right = count(&|a| faulty(a) && answer(a) == a.known.fault);
        let named = count(&|a| faulty(a) && is_kind(answer(a)));
        format!("{right} / {} / {}", named - right, count(&faulty) - named)
    };
    let graded = |grade: Grade| {
        let named = |a: &Answer| a.grade == grade && is_kind(a.fault);
        let right = count(&|a| named(a) && a.fault == a.known.fault);
        format!("{right} / {}", count(&named) - right)
    };
    let healthy = |answer: &dyn Fn(Fault) -> bool| count(&|a| a.known.fault == Fault::None && answer(a.fault));
    let cpu: Vec<f64> = of.iter().map(|a| a.cpu).collect();
    format!(
        "| {machine} | {} | {} | {} | {} | {} | {} / {} / {} | {} of {} | {:.2}, {:.2} |\n",
        name(extent),
        three(&|a| a.fault),
        three(&|a| a.script),
        graded(Grade::Clear),
        graded(Grade::Likely),
        healthy(&|f| f == Fault::None),
        healthy(&|f| f == Fault::Undecided),
        healthy(&is_kind),
        count(&|a| a.known.fault == Fault::None && is_kind(a.script)),
        healthy(&|_| true),
        median(&cpu),
        quantile(&cpu, 1.0).unwrap_or(0.0)
    )
}

fn lengths(machine: &str, extent: Extent, fault: Fault, of: &[&Answer]) -> String {
    let known: Vec<(f64, &&Answer)> = of.iter().filter_map(|a| Some((a.known.length?, a))).collect();
    if known.is_empty() {
        return String::new();
    }
    let given: Vec<(f64, [f64; 2])> = known.iter().filter_map(|(truth, a)| Some((*truth, a.length?))).collect();
    let hold = given.iter().filter(|(truth, [length, half])| (length - truth).abs() <= *half).count();
    let widths: Vec<f64> = given.iter().map(|(_, [length, half])| 100.0 * half / length).collect();
    let error = given.iter().map(|(truth, [length, _])| 100.0 * (length / truth - 1.0)).sum::<f64>();
    let least: Vec<bool> = known.iter().filter_map(|(truth, a)| Some(a.at_least? <= *truth)).collect();
    let mut text = format!("| {machine} | {fault:?}, {} | {} of {} | {hold} |", name(extent), given.len(), known.len());
    let (error, count) = (error / given.len().max(1) as f64, least.iter().filter(|holds| **holds).count());
    let _ = writeln!(text, " {:.1} % | {error:+.1} % | {count} of {} |", median(&widths), least.len());
    text
}
