//! The report on a contact: its pressure against Hertz's, and the stresses below it along depth and in two planes.

use super::contact_pressure::{BallOnRaceway, Pressed};
use super::subsurface::{Corners, Stress, maximum};
use brinell::contact::rolling::RacewaySide;
use brinell::surface::Interval;
use serde::Serialize;
use std::f64::consts::PI;

/// Depths of the line, over three times the patch's shorter half-axis or 1.2 times Hertz's.
const DEPTHS: usize = 120;
/// Columns and depths of a plane.
const ACROSS: usize = 80;
const DOWN: usize = 40;
/// Blocks of cells across the window for planes.
const BLOCKS: usize = 64;
/// Cells each way of Hertz's own pressure.
const HERTZ_CELLS: usize = 128;
/// Cells along a patch below which it is said to be coarse: cells at its border, which are half under pressure, are
/// then a quarter of all.
const FEW: f64 = 16.0;
/// Largest pressure (Pa) between balls and raceways up to which ISO 76 takes rolling bearings to keep their shape: it
/// leaves a dent of a ten-thousandth of the ball's diameter.
const STATIC_LIMIT: f64 = 4.2e9;

/// What a pressure limit is not.
const LIMITED: &str = "the pressure is limited as an indentation's: perfect plasticity of the surface, which knows no \
                       hardening, no residual stress and no material that piles up; stresses are those of the limited \
                       pressure on an elastic body";

/// A stress and where it is.
#[derive(Debug, Clone, Copy)]
pub struct StressAt {
    /// Its point (m): x, y and depth.
    pub point: [f64; 3],
    /// The stress.
    pub stress: Stress,
}

/// Stresses below the patch's middle.
#[derive(Debug, Clone)]
pub struct Section {
    /// Along depth, from the surface on.
    pub depth: Vec<StressAt>,
    /// At the same depths below the middle of Hertz's contact on the smooth raceway.
    pub hertz: Vec<Stress>,
    /// In the plane along the raceway, depth by depth, then in that across it.
    pub plane: Vec<StressAt>,
}

impl Section {
    /// The stresses of a pressure. On the line below the middle every cell counts, in planes blocks of them.
    pub fn of(ball: &BallOnRaceway, pressed: &Pressed) -> Self {
        let [x0, y0] = pressed.centre(pressed.middle_cell());
        let shorter = |[a, b]: [f64; 2]| a.min(b);
        // Hertz's largest stress is within 0.8 of his shorter half-axis.
        let deepest = (3.0 * shorter(pressed.half_axes())).max(1.2 * shorter(ball.hertz(pressed.force).half_axes));
        let fine = Corners::new(pressed, ball.poissons_ratio, 1);
        let at = |corners: &Corners, point: [f64; 3]| StressAt { point, stress: corners.stress(point) };
        let depths = || (0..=DEPTHS).map(|i| deepest * i as f64 / DEPTHS as f64);
        let line = depths().map(|z| at(&fine, [x0, y0, z])).collect();
        let smooth = ball.hertz_pressed(pressed.force, HERTZ_CELLS);
        // At z = 0 a point must lie within a cell, not on its border.
        let [hertz_x, hertz_y] = smooth.centre(smooth.middle_cell());
        let smooth = Corners::new(&smooth, ball.poissons_ratio, 1);
        let hertz = depths().map(|z| smooth.stress([hertz_x, hertz_y, z])).collect();
        let coarse = Corners::new(pressed, ball.poissons_ratio, pressed.cells[0].div_ceil(BLOCKS));
        let mut plane = Vec::new();
        for k in 0..2 {
            let [from, to] = pressed.extent()[k];
            let more = 0.3 * (to - from);
            for j in 1..=DOWN {
                let z = deepest * j as f64 / DOWN as f64;
                for i in 0..=ACROSS {
                    let along = (from - more) + (to - from + 2.0 * more) * i as f64 / ACROSS as f64;
                    plane.push(at(&coarse, if k == 0 { [along, y0, z] } else { [x0, along, z] }));
                }
            }
        }
        Self { depth: line, hertz, plane }
    }
}

/// A contact's figures, in the units of a drawing.
#[derive(Debug, Clone, Serialize)]
pub struct ContactReport {
    /// Name of the scene.
    pub scene: String,
    /// "outer" or "inner".
    pub on: &'static str,
    /// Angle of the ball from the middle of the raceway's first defect, counter-clockwise in the ring's sense (°).
    pub angle_deg: f64,
    /// Force that was asked for (N).
    pub force_n: f64,
    /// Cells along and across.
    pub cells: [usize; 2],
    /// Sides of a cell (µm).
    pub cell_um: [f64; 2],
    /// First and last border of the cells, along and across, from the point below the ball's centre (mm).
    pub window_mm: [[f64; 2]; 2],
    /// Where the raceway's depth jumps, along it (mm).
    pub edges_mm: Vec<f64>,
    /// Residual of the solution, relative to the approach since the first touch.
    pub residual: f64,
    /// The contact.
    pub found: PatchReport,
    /// What stays dented; left out of a surface that keeps its shape.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dent: Option<DentReport>,
    /// Hertz's on the smooth raceway.
    pub hertz: PatchReport,
    /// Below the patch.
    pub stress: StressReport,
    /// What to know before relying on it.
    pub notes: Vec<String>,
}

/// A patch under pressure.
#[derive(Debug, Clone, Serialize)]
pub struct PatchReport {
    /// Approach of the ball to the smooth raceway (µm).
    pub approach_um: f64,
    /// Largest pressure (MPa).
    pub max_pressure_mpa: f64,
    /// Where that is, along and across from the point below the ball's centre (mm).
    pub max_pressure_at_mm: [f64; 2],
    /// Half its length along and half its width across the raceway (mm); of several patches that around all.
    pub half_axes_mm: [f64; 2],
    /// Area under pressure (mm²).
    pub area_mm2: f64,
}

/// What a pressure at its limit leaves.
#[derive(Debug, Clone, Serialize)]
pub struct DentReport {
    /// Largest pressure that was allowed (MPa).
    pub pressure_limit_mpa: f64,
    /// Depth where it is deepest (µm).
    pub depth_um: f64,
    /// Its length along the raceway there (mm).
    pub length_mm: f64,
    /// Where that is, along and across from the point below the ball's centre (mm).
    pub at_mm: [f64; 2],
}

/// Von Mises stresses.
#[derive(Debug, Clone, Serialize)]
pub struct StressReport {
    /// The largest on the line below the point at which the force acts.
    pub below_middle: Highest,
    /// The largest in the planes along and across the raceway through that line.
    pub in_planes: Highest,
    /// The largest below the middle of Hertz's contact.
    pub hertz: Highest,
}

/// A von Mises stress and where it is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Highest {
    /// The stress (MPa).
    pub von_mises_mpa: f64,
    /// Along and across the raceway from the point below the ball's centre, and depth (mm).
    pub at_mm: [f64; 3],
}

impl ContactReport {
    /// What is reported of this contact under the force (N) that was asked for.
    pub fn new(
        scene: &str,
        side: RacewaySide,
        angle_deg: f64,
        force: f64,
        ball: &BallOnRaceway,
        pressed: &Pressed,
        section: &Section,
    ) -> Self {
        let hertz = ball.hertz(force);
        let highest = pressed.centre(pressed.highest_cell());
        Self {
            scene: scene.to_owned(),
            on: if side == RacewaySide::Outer { "outer" } else { "inner" },
            angle_deg,
            force_n: force,
            cells: pressed.cells,
            cell_um: pressed.cell.map(|side| 1e6 * side),
            window_mm: pressed.window().map(|ends| ends.map(|end| 1e3 * end)),
            edges_mm: ball.edges().map(|edge| 1e3 * edge).collect(),
            residual: pressed.residual,
            found: PatchReport {
                approach_um: 1e6 * pressed.approach,
                max_pressure_mpa: 1e-6 * pressed.max_pressure(),
                max_pressure_at_mm: highest.map(|at| 1e3 * at),
                half_axes_mm: pressed.half_axes().map(|half| 1e3 * half),
                area_mm2: 1e6 * pressed.area(),
            },
            dent: pressed.deepest_dent().map(|(depth, length, at)| DentReport {
                pressure_limit_mpa: 1e-6 * ball.pressure_limit,
                depth_um: 1e6 * depth,
                length_mm: 1e3 * length,
                at_mm: at.map(|at| 1e3 * at),
            }),
            hertz: PatchReport {
                approach_um: 1e6 * hertz.approach,
                max_pressure_mpa: 1e-6 * hertz.max_pressure,
                max_pressure_at_mm: [0.0; 2],
                half_axes_mm: hertz.half_axes.map(|half| 1e3 * half),
                area_mm2: 1e6 * PI * hertz.half_axes[0] * hertz.half_axes[1],
            },
            stress: StressReport::of(section),
            notes: notes(ball, pressed),
        }
    }
}

impl StressReport {
    fn of(section: &Section) -> Self {
        let stresses: Vec<Stress> = section.depth.iter().map(|at| at.stress).collect();
        let depths: Vec<f64> = section.depth.iter().map(|at| at.point[2]).collect();
        let [x, y, _] = section.depth[0].point;
        let below = |stresses: &[Stress], [x, y]: [f64; 2]| {
            let [most, depth] = maximum(&depths, stresses);
            Highest::at(most, [x, y, depth])
        };
        let values = section.plane.iter().map(|at| (at.stress.von_mises(), at.point));
        let (most, at) = values.fold((0.0, [0.0; 3]), |most, here| if here.0 > most.0 { here } else { most });
        Self {
            below_middle: below(&stresses, [x, y]),
            in_planes: Highest::at(most, at),
            hertz: below(&section.hertz, [0.0; 2]),
        }
    }
}

impl Highest {
    fn at(stress: f64, at: [f64; 3]) -> Self {
        Self { von_mises_mpa: 1e-6 * stress, at_mm: at.map(|at| 1e3 * at) }
    }
}

fn notes(ball: &BallOnRaceway, pressed: &Pressed) -> Vec<String> {
    let mut notes = Vec::new();
    let most = pressed.max_pressure();
    if ball.pressure_limit.is_finite() {
        notes.push(LIMITED.to_owned());
    } else if most > STATIC_LIMIT {
        notes.push(format!(
            "the largest pressure, {:.0} MPa, is above {:.0} MPa, up to which ISO 76 takes balls and raceways to keep \
             their shape: all stresses are elastic ones, real steel yields",
            1e-6 * most,
            1e-6 * STATIC_LIMIT
        ));
    }
    let extent = pressed.extent();
    for ([from, to], (cell, direction)) in extent.into_iter().zip(pressed.cell.into_iter().zip(["along", "across"])) {
        if to - from < FEW * cell {
            notes.push(format!(
                "the patch has {:.0} cells {direction} the raceway, too few to read pressures: more with --resolution",
                (to - from) / cell
            ));
        }
    }
    let [from, to] = extent[0];
    let sharp = ball.pressure_limit.is_infinite();
    if sharp && ball.edges().any(|edge| edge > from - (to - from) && edge < to + (to - from)) {
        notes.push(
            "an edge is at the contact: the pressure there, and the stress just below, grow without bound as cells are \
             made smaller, the force and the approach do not"
                .to_owned(),
        );
    }
    for defect in &ball.defects {
        for (interval, cell) in defect.surface.coarsest_intervals().into_iter().zip(pressed.cell) {
            if let Some(Interval { length, .. }) = interval.filter(|of| of.length > cell) {
                notes.push(format!(
                    "measured points are up to {:.2} um apart, cells {:.2} um: the surface is straight between points",
                    1e6 * length,
                    1e6 * cell
                ));
            }
        }
    }
    notes
}
