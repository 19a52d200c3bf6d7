//! Error against CPU time of the contact alone: a ball on the edge of a spall, by grid and by map.
//!
//! ER16K line spall, 100 µm deep, 90° edges, approaches to 10 µm. Grids are compared with one of 128 × 48 cells, maps
//! with their own grid; each grid is two, half a row apart. Errors are relative to the smooth contact's force at 10 µm.

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use anyhow::Result;
use brinell::contact::element_on_raceway::{Across, ElementOnRaceway};
use brinell::contact::error::ContactError;
use brinell::contact::love::{LoveContact, Resolution};
use brinell::contact::map::{MapPlan, MapSpecification, Sequential};
use brinell::contact::rolling::RacewaySide;
use brinell::surface::{Profile, Surface};
use cpu_time::ThreadTime;

use super::Extent;
use super::machine::{fastest, timed};
use fmu_build::shared::whole_file;

/// Largest approach (m).
const LARGEST: f64 = 10e-6;
/// Length of the spall (m): 15.8°.
const LENGTH: f64 = 6.517e-3;
const ELEMENT: ElementOnRaceway = ElementOnRaceway {
    element_radius: 3.97e-3,
    raceway_radius: 23.6325e-3,
    across: Across::Groove(4.095e-3),
    raceway: RacewaySide::Outer,
};
/// Contacts timed together.
const GRID_CONTACTS: usize = 50;
const MAP_CONTACTS: usize = 100_000;

/// Error and cost of one grid or map.
#[derive(Debug, Clone)]
pub(super) struct Row {
    /// "love" or "map".
    pub(super) law: &'static str,
    /// Cells along and across the contact.
    pub(super) cells: Resolution,
    /// Nodes of a map, both flanks.
    pub(super) nodes: Option<usize>,
    /// Largest and root mean square error of the normal force, then of the tangential.
    pub(super) error: [f64; 4],
    /// CPU seconds of one contact.
    pub(super) seconds: f64,
    /// CPU seconds to prepare, on one core.
    pub(super) prepare: f64,
}

/// Measures and writes `contact.csv`.
pub(super) fn measure(extent: Extent, data: &Path) -> Result<Vec<Row>> {
    let surface = Surface::Profile(Profile::spall(LENGTH, 100e-6, FRAC_PI_2));
    let sizes: &[(usize, usize)] = match extent {
        Extent::Full => &[(16, 8), (16, 16), (32, 16), (32, 32), (48, 16), (48, 32), (64, 32)],
        Extent::Short => &[(16, 8), (32, 16)],
    };
    let accuracies: &[f64] = if extent == Extent::Full { &[1e-2, 3e-3, 1e-3] } else { &[1e-2] };
    let (points, exact) = reference(&surface)?;
    let mut rows = Vec::new();
    for &(columns, cells_across) in sizes {
        rows.push(of_grid(&surface, Resolution { columns, rows: cells_across }, &points, &exact)?);
    }
    for &accuracy in accuracies {
        rows.push(of_map(&surface, accuracy)?);
    }
    write(&data.join("contact.csv"), &rows)?;
    Ok(rows)
}

/// Path and position along the raceway of each contact compared.
type Points = Vec<[f64; 2]>;
/// Forces, normal and tangential, over the smooth contact's largest.
type Forces = Vec<[f64; 2]>;

/// From just before the edge to the floor's first touch, 0.5 to 7 µm above the first touch, with the forces there.
fn reference(surface: &Surface) -> Result<(Points, Forces)> {
    let mut finest = LoveContact::new(ELEMENT, surface, 1.6 * LARGEST, Resolution { columns: 128, rows: 48 })?;
    let mut points = Vec::new();
    for k in 0..24 {
        let s = -0.5 * LENGTH - 0.15e-3 + 1.15e-3 * (f64::from(k) + 0.37) / 24.0;
        let touch = finest.first_touch(s);
        points.extend([0.5e-6, 1.5e-6, 3e-6, 5e-6, 7e-6].map(|height| [touch + height, s]));
    }
    let exact = forces(&mut finest, &points)?;
    Ok((points, exact))
}

/// Force of the smooth contact at an approach (m), over Hertz's constant.
fn hertz(approach: f64) -> f64 {
    approach * approach.sqrt()
}

fn forces(contact: &mut LoveContact, points: &Points) -> Result<Forces, ContactError> {
    let scale = hertz(LARGEST);
    points.iter().map(|&[u, s]| Ok(contact.solve(u, s)?.forces(hertz).map(|force| force / scale))).collect()
}

fn of_grid(surface: &Surface, cells: Resolution, points: &Points, exact: &Forces) -> Result<Row> {
    let start = ThreadTime::now();
    let mut contact = LoveContact::new(ELEMENT, surface, 1.6 * LARGEST, cells)?;
    let prepare = start.elapsed().as_secs_f64();
    let mut error = [0.0_f64; 4];
    for (a, b) in forces(&mut contact, points)?.iter().zip(exact) {
        for k in 0..2 {
            error[2 * k] = error[2 * k].max((a[k] - b[k]).abs());
            error[2 * k + 1] += (a[k] - b[k]).powi(2) / points.len() as f64;
        }
    }
    // Warm: an element that passes the edge, 50 nm a step.
    let mut pass =
        || (0..GRID_CONTACTS).try_for_each(|i| contact.solve(5e-6, -0.5 * LENGTH + 50e-9 * i as f64).map(|_| ()));
    let [seconds] = fastest([&mut || timed(&mut pass)])?;
    Ok(Row {
        law: "love",
        cells,
        nodes: None,
        error: [error[0], error[1].sqrt(), error[2], error[3].sqrt()],
        seconds: seconds / GRID_CONTACTS as f64,
        prepare,
    })
}

fn of_map(surface: &Surface, accuracy: f64) -> Result<Row> {
    let specification = MapSpecification { accuracy, ..MapSpecification::new(LARGEST) };
    let start = ThreadTime::now();
    let map = MapPlan::new(surface, ELEMENT, specification)?.build(&mut Sequential(|_, _| ()))?;
    let prepare = start.elapsed().as_secs_f64();
    let mut sum = 0.0;
    let mut pass = || {
        (0..MAP_CONTACTS).try_for_each(|i| {
            let s = -0.5 * LENGTH - 0.1e-3 + 2e-9 * i as f64;
            sum += map.lookup(5e-6, s)?.forces(hertz)[0];
            Ok::<_, ContactError>(())
        })
    };
    let [seconds] = fastest([&mut || timed(&mut pass)])?;
    std::hint::black_box(sum);
    let reached = map.accuracy();
    Ok(Row {
        law: "map",
        cells: specification.resolution,
        nodes: Some(map.nodes()),
        error: [reached.max_normal, reached.rms_normal, reached.max_tangential, reached.rms_tangential],
        seconds: seconds / MAP_CONTACTS as f64,
        prepare,
    })
}

fn write(path: &Path, rows: &[Row]) -> Result<()> {
    whole_file::write_with(path, |out| {
        writeln!(
            out,
            "law,columns,rows,nodes,max_normal,rms_normal,max_tangential,rms_tangential,seconds_per_contact,\
             seconds_to_prepare"
        )?;
        for Row { law, cells, nodes, error: [a, b, c, d], seconds, prepare } in rows {
            let nodes = nodes.map_or(String::new(), |nodes| nodes.to_string());
            let Resolution { columns, rows } = cells;
            writeln!(
                out,
                "{law},{columns},{rows},{nodes},{a:.1e},{b:.1e},{c:.1e},{d:.1e},{seconds:.2e},{prepare:.2e}"
            )?;
        }
        Ok(())
    })
}
