//! Pressure between one ball and its raceway as that was measured, on a fine grid.
//!
//! The same bodies as in every contact near a defect: true circles, the raceway's depth, elastic half-spaces after
//! Love, no friction (`brinell::contact`). Cells lie on a window that follows the contact: solutions on a coarse grid
//! over all that can touch say where it is, and the last grid covers that and a little more. A cell takes the exact
//! mean of the defect's depth; cells do not end on sharp edges, at which the pressure grows without bound as they are
//! made smaller.
//!
//! Invalid where the contact is not small against the ball, and beyond the elastic limit.

use super::conjugate_gradients::ConjugateGradients;
use super::defect_below::DefectBelow;
use super::grid::{GridContact, GridProblem, at_force};
use brinell::contact::element_on_raceway::{Across, ElementOnRaceway};
use brinell::contact::error::ContactError;
use brinell::contact::rolling::RacewaySide;
use brinell::geometry::hertz_constant::{approach_under, effective_modulus, point_contact};
use brinell::numerics::wrap;
use brinell::scene::{DefectOn, Scene};
use brinell::simulation::SimulationError;
use brinell::simulation::setup::{check_reach, track_across, with_operating_angle};
use brinell::surface::{Surface, SurfaceError};
use std::f64::consts::PI;

/// Fewest and most cells in each direction.
pub(super) const RESOLUTIONS: std::ops::RangeInclusive<usize> = 32..=1024;
/// Part of the radius up to which contact is looked for.
const FARTHEST: f64 = 0.8;
/// Cells in each direction by which the contact is found.
const COARSE: usize = 128;
/// Part of the contact's length by which the window is longer, at either end.
const MARGIN: f64 = 0.08;
/// Residual of the solution, relative to the approach; that of the force, relative to the force.
const RESIDUAL: f64 = 1e-8;
const FORCE_RESIDUAL: f64 = 1e-6;

/// Why there is no pressure.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum PressureError {
    /// Rollers have no point contact.
    #[error("bearing.element is \"cylindrical-roller\": contact pressure is worked out for balls only")]
    Roller,
    /// A number that is out of its range.
    #[error("{quantity} {value} {unit}: it must be {limit}")]
    OutOfRange { quantity: &'static str, value: f64, unit: &'static str, limit: &'static str },
    /// The contact is not small against the ball.
    #[error(
        "contact force {force} N: the contact reaches {percent:.0} % of the radius of ball or groove, beyond which the \
         bodies are no half-spaces; give a smaller force, or a position where the ball lies on the raceway"
    )]
    TooWide { force: f64, percent: f64 },
    /// The defect's profile cannot be used.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// A topography beside which the ball runs.
    #[error(transparent)]
    SetUp(#[from] SimulationError),
    /// The contact cannot be solved.
    #[error(transparent)]
    Contact(#[from] ContactError),
}

/// A ball at one position on a raceway.
#[derive(Debug, Clone)]
pub struct BallOnRaceway {
    /// The two bodies.
    pub bodies: ElementOnRaceway,
    /// E* (Pa).
    pub effective_modulus: f64,
    /// Poisson's ratio of both bodies.
    pub poissons_ratio: f64,
    /// Largest pressure (Pa), at which the surface yields; infinite where it stays elastic.
    pub pressure_limit: f64,
    /// The raceway's defects.
    pub defects: Vec<DefectBelow>,
}

/// Hertz's contact of the same force on the smooth raceway.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hertz {
    /// Approach (m).
    pub approach: f64,
    /// Half-axes along and across the raceway (m).
    pub half_axes: [f64; 2],
    /// Largest pressure (Pa).
    pub max_pressure: f64,
}

/// Pressure on a grid. Coordinates count from the point below the ball's centre, x along the raceway counter-clockwise,
/// y across it.
#[derive(Debug, Clone, PartialEq)]
pub struct Pressed {
    /// Cells along and across.
    pub cells: [usize; 2],
    /// Sides of a cell (m).
    pub cell: [f64; 2],
    /// Middle of the window (m).
    pub middle: [f64; 2],
    /// Approach of the ball to the smooth raceway (m).
    pub approach: f64,
    /// Force (N).
    pub force: f64,
    /// Pressure (Pa), `[row × columns + column]`, rows along x.
    pub pressure: Vec<f64>,
    /// Mean depth of the raceway's defects in each cell (m).
    pub depth: Vec<f64>,
    /// Depth of what stays dented in each cell (m); empty where the surface stays elastic.
    pub dent: Vec<f64>,
    /// Largest gap where pressed, or penetration where not, over the approach since the first touch.
    pub residual: f64,
}

impl BallOnRaceway {
    /// A ball of the scene's bearing on a raceway, `angle` (rad) counter-clockwise in the ring's own sense from the
    /// middle of the first of its defects. In space a topography is met on the track at the operating angle.
    /// `profiles` are as for [`Surface::load_all`].
    /// ```
    /// use brinell::contact::rolling::RacewaySide;
    /// use brinell::scene::{Bearing, Scene};
    /// use brinell_analysis::pressure::BallOnRaceway;
    ///
    /// let scene = Scene::builder(Bearing::steel_balls(9, 7.94e-3, 39.04e-3)).shaft_load([0.0, -1500.0]).build()?;
    /// let ball = BallOnRaceway::of(&scene, None, RacewaySide::Outer, 0.0)?;
    /// // On a smooth raceway the measured surface's pressure is Hertz's.
    /// let pressed = ball.pressed(800.0, 64)?;
    /// assert!((pressed.max_pressure() / ball.hertz(800.0).max_pressure - 1.0).abs() < 0.03);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// For rollers, an angle that is not finite and a profile that cannot be used.
    pub fn of<'p>(
        scene: &Scene,
        profiles: impl IntoIterator<Item = &'p str>,
        side: RacewaySide,
        angle: f64,
    ) -> Result<Self, PressureError> {
        let bearing = &scene.bearing;
        if bearing.roller().is_some() {
            return Err(PressureError::Roller);
        }
        if !(angle.abs() <= PI) {
            let (quantity, limit) = ("angle from the defect's middle", "from -180 to 180");
            return Err(PressureError::OutOfRange { quantity, value: angle.to_degrees(), unit: "degrees", limit });
        }
        let on = if side == RacewaySide::Outer { DefectOn::Outer } else { DefectOn::Inner };
        let scene = &*with_operating_angle(scene);
        let track = track_across(scene, on);
        let surfaces = Surface::load_all(scene, profiles)?;
        let there = scene.defects.iter().zip(surfaces).filter(|(defect, _)| defect.on == on);
        let there: Vec<_> = there
            .map(|(defect, surface)| check_reach(scene, on, &surface).map(|()| (defect, surface.seen_from(track))))
            .collect::<Result<_, _>>()?;
        let first = there.first().map_or(0.0, |(defect, _)| defect.angle);
        let arc = |at: f64| wrap(first + angle - at) * side.radius(bearing);
        Ok(Self {
            bodies: ElementOnRaceway::of(bearing, side).checked()?,
            effective_modulus: effective_modulus(bearing),
            poissons_ratio: bearing.poissons_ratio,
            pressure_limit: f64::INFINITY,
            defects: there.into_iter().map(|(of, surface)| DefectBelow { surface, arc: arc(of.angle) }).collect(),
        })
    }

    /// Hertz's contact on the smooth raceway under a force (N).
    pub fn hertz(&self, force: f64) -> Hertz {
        let [along, across] = self.bodies.curvatures();
        let approach = approach_under(force, point_contact(along, across, self.effective_modulus));
        let half_axes = self.bodies.contact_half_axes(approach);
        Hertz { approach, half_axes, max_pressure: 1.5 * force / (PI * half_axes[0] * half_axes[1]) }
    }

    /// Hertz's pressure of the same force on the smooth raceway, on `resolution` cells in each direction.
    pub fn hertz_pressed(&self, force: f64, resolution: usize) -> Pressed {
        let Hertz { approach, half_axes, max_pressure } = self.hertz(force);
        let cells = [resolution, resolution];
        let cell = half_axes.map(|half| 2.0 * half / resolution as f64);
        let none = vec![0.0; resolution * resolution];
        let (pressure, depth) = (none.clone(), none);
        let (middle, dent, residual) = ([0.0; 2], Vec::new(), 0.0);
        let mut pressed = Pressed { cells, cell, middle, approach, force, pressure, depth, dent, residual };
        for at in 0..pressed.pressure.len() {
            let [x, y] = pressed.centre(at);
            let [x, y] = [x / half_axes[0], y / half_axes[1]];
            pressed.pressure[at] = max_pressure * (1.0 - x * x - y * y).max(0.0).sqrt();
        }
        pressed
    }

    /// Where the depth jumps, along the raceway (m) from the point below the ball's centre.
    pub fn edges(&self) -> impl Iterator<Item = f64> {
        self.defects.iter().flat_map(DefectBelow::edges)
    }

    /// Pressure under a force (N), on `resolution` cells in each direction.
    ///
    /// # Errors
    /// For a force that is not positive, a resolution outside 32 to 1024, and a contact that is too wide.
    pub fn pressed(&self, force: f64, resolution: usize) -> Result<Pressed, PressureError> {
        let refused = |quantity, value, unit, limit| Err(PressureError::OutOfRange { quantity, value, unit, limit });
        if !(force > 0.0 && force.is_finite()) {
            return refused("contact force", force, "N", "finite and above 0");
        }
        if !RESOLUTIONS.contains(&resolution) {
            return refused("resolution", resolution as f64, "cells", "from 32 to 1024");
        }
        let too_wide = || PressureError::TooWide { force, percent: 100.0 * FARTHEST };
        let mut window = self.farthest();
        let mut guess = self.hertz(force).approach;
        // Each round shows the contact closer: of a window's 128 cells some six at least are left.
        for round in 0..8 {
            let found = self.solve(&window, COARSE, force, guess).map_err(|error| match error {
                PressureError::Contact(ContactError::ReachesEdge { .. }) if round == 0 => too_wide(),
                other => other,
            })?;
            guess = found.1;
            let next = found.0.window_around();
            let shrinks = (0..2).any(|k| next[k][1] - next[k][0] < 0.7 * (window[k][1] - window[k][0]));
            window = next;
            if !shrinks {
                break;
            }
        }
        for _ in 0..4 {
            match self.solve(&window, resolution, force, guess) {
                // The coarse grid's border is half a cell uncertain, more where edges are.
                Err(PressureError::Contact(ContactError::ReachesEdge { .. })) => {
                    window = window.map(|[from, to]| [from - 0.1 * (to - from), to + 0.1 * (to - from)]);
                }
                found => return found.map(|(pressed, _)| pressed),
            }
        }
        Err(too_wide())
    }

    /// The largest window.
    fn farthest(&self) -> [[f64; 2]; 2] {
        let radius = self.bodies.element_radius;
        let groove = match self.bodies.across {
            Across::Groove(groove) => groove,
            Across::Roller { length, .. } => length,
        };
        let [x, y] = [self.bodies.raceway_radius, groove].map(|other| FARTHEST * radius.min(other));
        [[-x, x], [-y, y]]
    }

    /// Solution on a window, and the approach since the first touch (m).
    fn solve(
        &self,
        window: &[[f64; 2]; 2],
        resolution: usize,
        force: f64,
        guess: f64,
    ) -> Result<(Pressed, f64), PressureError> {
        let n = resolution;
        let cell = window.map(|[from, to]| (to - from) / n as f64);
        let middle = window.map(|[from, to]| 0.5 * (from + to));
        let smooth = |x: f64, y: f64| self.bodies.gap(middle[0] + x, middle[1] + y);
        let modulus = self.effective_modulus;
        let sampled = GridProblem::sampled(n, n, cell, modulus, smooth)?;
        let mut depth = vec![0.0; n * n];
        self.defects.iter().for_each(|defect| defect.add_depth(*window, cell, &mut depth));
        let mut gap: Vec<f64> = sampled.gap().iter().zip(&depth).map(|(h, d)| h + d).collect();
        // From the first touch on: a deep defect's floor would take digits away.
        let touch = gap.iter().fold(f64::INFINITY, |m, &h| m.min(h));
        gap.iter_mut().for_each(|h| *h -= touch);
        let problem = GridProblem::new(n, n, cell, modulus, gap)?;
        let mut solver = ConjugateGradients::new(&problem, RESIDUAL, self.pressure_limit)?;
        let within = |approach| {
            let contact = solver.at_approach(approach)?;
            problem.check_border(&contact).map(|()| contact)
        };
        let contact = at_force(within, force, guess, FORCE_RESIDUAL)?;
        let (cells, GridContact { approach: since, pressure, force, dent, residual, .. }) = ([n, n], contact);
        let approach = touch + since;
        Ok((Pressed { cells, cell, middle, approach, force, pressure, depth, dent, residual }, since))
    }
}

impl Pressed {
    /// Centre of a cell (m).
    pub fn centre(&self, cell: usize) -> [f64; 2] {
        let at = [cell % self.cells[0], cell / self.cells[0]];
        [0, 1].map(|k| self.middle[k] + (at[k] as f64 + 0.5 - 0.5 * self.cells[k] as f64) * self.cell[k])
    }

    /// Cells under pressure.
    pub fn under_pressure(&self) -> impl Iterator<Item = usize> {
        (0..self.pressure.len()).filter(|&cell| self.pressure[cell] > 0.0)
    }

    /// Largest pressure (Pa).
    pub fn max_pressure(&self) -> f64 {
        self.pressure[self.highest_cell()]
    }

    /// The cell with the largest pressure.
    pub fn highest_cell(&self) -> usize {
        self.under_pressure().max_by(|&a, &b| self.pressure[a].total_cmp(&self.pressure[b])).unwrap_or(0)
    }

    /// Depth of the deepest dent (m), its length along the raceway where it is deepest (m), and its middle along and
    /// across (m); `None` of a surface that keeps its shape.
    pub fn deepest_dent(&self) -> Option<(f64, f64, [f64; 2])> {
        let deepest = (0..self.dent.len()).max_by(|&a, &b| self.dent[a].total_cmp(&self.dent[b]))?;
        let row = deepest / self.cells[0] * self.cells[0];
        let long = self.dent[row..row + self.cells[0]].iter().filter(|&&dent| dent > 0.0).count();
        let depth = self.dent[deepest];
        (depth > 0.0).then(|| (depth, long as f64 * self.cell[0], self.centre(deepest)))
    }

    /// Area under pressure (m²).
    pub fn area(&self) -> f64 {
        self.under_pressure().count() as f64 * self.cell[0] * self.cell[1]
    }

    /// Ends of what is under pressure, along and across (m); borders of cells.
    pub fn extent(&self) -> [[f64; 2]; 2] {
        let mut extent = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        for cell in self.under_pressure() {
            let centre = self.centre(cell);
            for k in 0..2 {
                extent[k][0] = extent[k][0].min(centre[k] - 0.5 * self.cell[k]);
                extent[k][1] = extent[k][1].max(centre[k] + 0.5 * self.cell[k]);
            }
        }
        extent
    }

    /// Half the lengths of that (m): of an ellipse its half-axes.
    pub fn half_axes(&self) -> [f64; 2] {
        self.extent().map(|[from, to]| 0.5 * (to - from))
    }

    /// The cell under pressure that is nearest to the point at which the force acts.
    pub fn middle_cell(&self) -> usize {
        let (mut sum, mut moment) = (0.0, [0.0; 2]);
        for cell in self.under_pressure() {
            let (p, at) = (self.pressure[cell], self.centre(cell));
            sum += p;
            moment = [moment[0] + p * at[0], moment[1] + p * at[1]];
        }
        let acts = moment.map(|m| m / sum);
        let far = |cell: usize| {
            let at = self.centre(cell);
            libm::hypot(at[0] - acts[0], at[1] - acts[1])
        };
        self.under_pressure().min_by(|&a, &b| far(a).total_cmp(&far(b))).unwrap_or(0)
    }

    /// Borders of all cells, along and across (m).
    pub fn window(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|k| {
            let half = 0.5 * self.cells[k] as f64 * self.cell[k];
            [self.middle[k] - half, self.middle[k] + half]
        })
    }

    /// A window for the next grid.
    fn window_around(&self) -> [[f64; 2]; 2] {
        let extent = self.extent();
        [0, 1].map(|k| {
            let [from, to] = extent[k];
            let more = MARGIN * (to - from) + 1.5 * self.cell[k];
            [from - more, to + more]
        })
    }
}
