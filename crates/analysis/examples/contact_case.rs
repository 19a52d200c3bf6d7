//! Solves one stored contact problem and prints one line of JSON.
//!
//! `cargo run --release -p brinell-analysis --example contact_case -- CASE.json [--solver active-set|cg] [--repeat N]
//! [--force N] [--residual R]`
//!
//! CASE.json, SI units: `nx, ny, cell_x, cell_y` (full sides), `x_first_centre, y_first_centre, delta, Estar, hx[nx],
//! hy[ny]`: undeformed gap h(i,j) = hx[i] + hy[j]. `seconds` is the best of N cold solutions; kernel and transforms are
//! prepared before (`setup_seconds`).

use std::error::Error;
use std::time::Instant;

use brinell_analysis::pressure::{Border, ConjugateGradients, GridActiveSet, GridProblem, GridSolver};
use serde_json::{Value, json};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (mut path, mut solver, mut repeat, mut force, mut residual) = (None, None, 1_usize, None, 1e-8);
    while let Some(argument) = arguments.next() {
        let mut value = |name: &str| arguments.next().ok_or(format!("{name} needs a value"));
        match argument.as_str() {
            "--solver" => solver = Some(value("--solver")?),
            "--repeat" => repeat = value("--repeat")?.parse()?,
            "--force" => force = Some(value("--force")?.parse::<f64>()?),
            "--residual" => residual = value("--residual")?.parse()?,
            _ if path.is_none() && !argument.starts_with("--") => path = Some(argument),
            _ => return Err(format!("unknown argument {argument}").into()),
        }
    }
    let path =
        path.ok_or("usage: contact_case CASE.json [--solver active-set|cg] [--repeat N] [--force N] [--residual R]")?;
    let case: Value = serde_json::from_str(&std::fs::read_to_string(&path).map_err(|e| format!("{path}: {e}"))?)?;
    let (problem, delta) = read(&case)?;
    let direct = problem.expected_unknowns(delta) < 200.0;
    let name = solver.unwrap_or_else(|| if direct { "active-set" } else { "cg" }.to_owned());
    let start = Instant::now();
    let mut solver: Box<dyn GridSolver + '_> = match name.as_str() {
        "active-set" => Box::new(GridActiveSet::new(&problem, false)?),
        "cg" => Box::new(ConjugateGradients::new(&problem, residual)?),
        other => return Err(format!("unknown solver {other}, there are active-set and cg").into()),
    };
    let setup = start.elapsed().as_secs_f64();
    let mut seconds = f64::INFINITY;
    let mut contact = None;
    for _ in 0..repeat.max(1) {
        let start = Instant::now();
        let solved = match force {
            Some(force) => solver.at_force(force, delta)?,
            None => solver.at_approach(delta)?,
        };
        seconds = seconds.min(start.elapsed().as_secs_f64());
        contact = Some(solved);
    }
    let contact = contact.ok_or("nothing solved")?;
    if contact.reaches_border(problem.columns()) {
        eprintln!("warning: the contact reaches the border of the grid; it is right only if the body ends there");
    }
    println!(
        "{}",
        json!({
            "solver": name,
            "force_n": contact.force,
            "max_pressure_pa": contact.max_pressure(),
            "contact_cells": contact.contact_cells(),
            "residual": contact.residual,
            "iterations": contact.iterations,
            "seconds": seconds,
            "setup_seconds": setup,
            "delta": contact.approach,
        })
    );
    Ok(())
}

/// The problem and its approach.
fn read(case: &Value) -> Result<(GridProblem, f64), Box<dyn Error>> {
    let number = |key: &str| case[key].as_f64().ok_or(format!("{key}: a number is needed"));
    let array = |key: &str| -> Result<Vec<f64>, String> {
        let values = case[key].as_array().ok_or(format!("{key}: an array is needed"))?;
        values.iter().map(|v| v.as_f64().ok_or(format!("{key}: only numbers are allowed"))).collect()
    };
    let (nx, ny) = (number("nx")? as usize, number("ny")? as usize);
    let (hx, hy) = (array("hx")?, array("hy")?);
    if hx.len() != nx || hy.len() != ny {
        return Err(format!("hx has {} and hy {} values, nx is {nx} and ny {ny}", hx.len(), hy.len()).into());
    }
    let gap = hy.iter().flat_map(|y| hx.iter().map(move |x| x + y)).collect();
    let cell = [number("cell_x")?, number("cell_y")?];
    let problem = GridProblem::new(nx, ny, cell, number("Estar")?, gap, Border::Body)?;
    Ok((problem, number("delta")?))
}
