//! What the modes over the cage angle say, for people and for figures: each line in a few numbers, and all modes at
//! each angle.

use super::assembly::{Assembly, Body, Hold};
use super::eigenmodes::{Kind, Mode, Modes};
use super::lines::spans;
use crate::statistics;
use serde::Serialize;

/// Modes over one element spacing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModesReport {
    /// Name of the scene.
    pub scene: String,
    /// Load on the inner ring (N).
    pub shaft_load_n: [f64; 2],
    /// Load on the outer ring (N).
    pub housing_load_n: [f64; 2],
    /// Centre of the defect, or else direction of the load (degrees), counter-clockwise from +x: the middle of the
    /// angles.
    pub middle_deg: f64,
    /// Length of the defect (degrees); `None` without one.
    pub defect_length_deg: Option<f64>,
    /// Names of the degrees of freedom, in the order of shapes and energies.
    pub freedoms: Vec<String>,
    /// Modes followed over the angles, by ascending mean frequency over the angle.
    pub lines: Vec<LineReport>,
    /// All modes at each angle.
    pub angles: Vec<AngleReport>,
}

/// One mode over all angles at which it is there. Pairs are least and greatest.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LineReport {
    /// Its number, from 1.
    pub line: usize,
    /// Undamped natural frequency (Hz).
    pub undamped_frequency_hz: [f64; 2],
    /// Damping ratio ζ.
    pub damping_ratio: [f64; 2],
    /// Mean share of each degree of freedom in the kinetic energy, over the angle.
    pub energy: Vec<f64>,
    /// Mean share of all elements.
    pub elements: f64,
}

/// All modes at one cage angle.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AngleReport {
    /// Angle of element 1 (degrees), counter-clockwise from +x.
    pub cage_angle_deg: f64,
    /// Angle of each element (degrees).
    pub element_angles_deg: Vec<f64>,
    /// What holds each element.
    pub elements: Vec<Hold>,
    /// Its modes, the slowest first.
    pub modes: Vec<ModeReport>,
}

/// One mode at one cage angle.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModeReport {
    /// Number of its line, from 1; `None` without natural frequency.
    pub line: Option<usize>,
    /// How it moves by itself.
    pub kind: Kind,
    /// Undamped natural frequency (Hz).
    pub undamped_frequency_hz: Option<f64>,
    /// Frequency with damping (Hz).
    pub damped_frequency_hz: Option<f64>,
    /// Damping ratio ζ.
    pub damping_ratio: Option<f64>,
    /// Eigenvalues (1/s), real and imaginary part.
    pub eigenvalues_1_s: Vec<[f64; 2]>,
    /// Amplitude of each degree of freedom, the largest being 1.
    pub amplitude: Vec<f64>,
    /// Phase of each degree of freedom ahead of the largest (degrees).
    pub phase_deg: Vec<f64>,
    /// Share of each degree of freedom in the kinetic energy.
    pub energy: Vec<f64>,
}

impl ModesReport {
    /// The report of a [`sweep`](super::lines::sweep) about the angle `middle` (rad).
    pub fn new(scene: String, assembly: &Assembly, middle: f64, sweep: &[Modes]) -> Self {
        let bodies: Vec<Body> = assembly.freedoms().iter().map(|freedom| freedom.body).collect();
        let spans = spans(sweep);
        let followed = |line: usize| -> Vec<(&Mode, f64)> {
            let all = sweep.iter().zip(&spans).flat_map(|(at, &span)| at.modes.iter().map(move |mode| (mode, span)));
            all.filter(|(mode, _)| mode.line == Some(line)).collect()
        };
        let lines = (0..).map(followed).take_while(|line| !line.is_empty());
        let [shaft_load_n, housing_load_n] = assembly.loads();
        Self {
            scene,
            shaft_load_n,
            housing_load_n,
            middle_deg: middle.to_degrees(),
            defect_length_deg: assembly.defect().map(|defect| defect.length.to_degrees()),
            freedoms: assembly.freedom_names(),
            lines: lines.enumerate().map(|(line, modes)| line_report(line, &modes, &bodies)).collect(),
            angles: sweep.iter().map(angle_report).collect(),
        }
    }

    /// Number of elements that are held so, least and greatest over the angles.
    pub fn held(&self, hold: Hold) -> [usize; 2] {
        let counts = self.angles.iter().map(|angle| angle.elements.iter().filter(|&&element| element == hold).count());
        counts.fold([usize::MAX, 0], |[least, greatest], count| [least.min(count), greatest.max(count)])
    }

    /// Least and greatest undamped natural frequency (Hz) and damping ratio of the modes in which most of the motion is
    /// that of elements held so; `None` without such a mode.
    pub fn of_elements(&self, hold: Hold) -> Option<[[f64; 2]; 2]> {
        let mut extents = None;
        for angle in &self.angles {
            for mode in &angle.modes {
                let parts = angle.elements.iter().zip(&mode.energy).filter(|(held, _)| **held == hold);
                let most = parts.map(|(_, part)| part).sum::<f64>() > 0.5;
                let (Some(frequency), Some(ratio), true) = (mode.undamped_frequency_hz, mode.damping_ratio, most)
                else {
                    continue;
                };
                let values = [frequency, ratio];
                let [f, zeta] = extents.unwrap_or(values.map(|value| [value; 2]));
                let wider = |[least, most]: [f64; 2], value: f64| [least.min(value), most.max(value)];
                extents = Some([wider(f, frequency), wider(zeta, ratio)]);
            }
        }
        extents
    }

    /// Largest number of modes of a kind at any angle.
    pub fn most(&self, kind: Kind) -> usize {
        let counts = self.angles.iter().map(|angle| angle.modes.iter().filter(|mode| mode.kind == kind).count());
        counts.max().unwrap_or(0)
    }
}

/// The report of a line from its modes, each with the part of the angles that it stands for (rad).
fn line_report(line: usize, modes: &[(&Mode, f64)], bodies: &[Body]) -> LineReport {
    let extent = |of: fn(&Mode) -> Option<f64>| statistics::extent(modes.iter().filter_map(|(mode, _)| of(mode)));
    let whole: f64 = modes.iter().map(|(_, span)| span).sum();
    let mean =
        |of: &dyn Fn(&Mode) -> f64| rounded(modes.iter().map(|(mode, span)| span * of(mode)).sum::<f64>() / whole);
    let of_elements = |mode: &Mode| -> f64 {
        let parts = bodies.iter().zip(&mode.energy);
        parts.filter(|(body, _)| matches!(body, Body::Element(_))).map(|(_, energy)| energy).sum()
    };
    LineReport {
        line: line + 1,
        undamped_frequency_hz: extent(Mode::undamped_frequency),
        damping_ratio: extent(Mode::damping_ratio),
        energy: (0..bodies.len()).map(|i| mean(&|mode| mode.energy[i])).collect(),
        elements: mean(&of_elements),
    }
}

fn angle_report(modes: &Modes) -> AngleReport {
    AngleReport {
        cage_angle_deg: modes.cage_angle.to_degrees(),
        element_angles_deg: modes.angles.iter().map(|angle| angle.to_degrees()).collect(),
        elements: modes.holds.clone(),
        modes: modes.modes.iter().map(mode_report).collect(),
    }
}

fn mode_report(mode: &Mode) -> ModeReport {
    ModeReport {
        line: mode.line.map(|line| line + 1),
        kind: mode.kind,
        undamped_frequency_hz: mode.undamped_frequency(),
        damped_frequency_hz: mode.damped_frequency(),
        damping_ratio: mode.damping_ratio(),
        eigenvalues_1_s: mode.eigenvalues.clone(),
        amplitude: mode.shape.iter().map(|[amplitude, _]| rounded(*amplitude)).collect(),
        phase_deg: mode.shape.iter().map(|[_, phase]| rounded(phase.to_degrees())).collect(),
        energy: mode.energy.iter().copied().map(rounded).collect(),
    }
}

/// To a millionth: parts of 1 that nobody reads more closely.
fn rounded(part: f64) -> f64 {
    (part * 1e6).round() * 1e-6
}
