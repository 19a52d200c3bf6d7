//! Runs of the paper's scenes: variants of a shipped one, sampled at an even rate, averaged over passages.

use anyhow::{Context, Result};
use brinell::geometry::kinematics;
use brinell::scene::{ContactLaw, DefectShape, Scene};
use brinell::simulation::Simulation;
use brinell_analysis::sizing::Raceway;
use brinell_analysis::sizing::passages::fold;

use crate::shared::{Project, contact_map, shipped};

/// A scene with the text of its profile.
#[derive(Debug, Clone)]
pub struct Case {
    /// The scene.
    pub scene: Scene,
    profile: Option<String>,
}

impl Case {
    /// A shipped scene.
    ///
    /// # Errors
    /// Of a name that is none.
    pub fn shipped(name: &str) -> Result<Self> {
        let files = shipped::files_of(name).with_context(|| shipped::meant(name))?;
        let scene = brinell_scene_file::from_toml(files[0].1).with_context(|| name.to_owned())?;
        Ok(Self { scene, profile: files.get(1).map(|(_, text)| (*text).to_owned()) })
    }

    /// The same under another contact law.
    pub fn with_law(mut self, law: ContactLaw) -> Self {
        self.scene.contact.law = law;
        self
    }

    /// The same under another load downwards (N).
    pub fn with_load(mut self, load: f64) -> Self {
        self.scene.shaft.load = [0.0, -load];
        self
    }

    /// The same at another shaft speed (Hz).
    pub fn at_speed(mut self, speed: f64) -> Self {
        self.scene.shaft_speed = std::f64::consts::TAU * speed;
        self
    }

    /// The same with a spall of another length (degrees) and depth (m) with sharp edges, or healthy at length 0.
    pub fn with_spall(mut self, length: f64, depth: f64) -> Self {
        let radius = self.scene.bearing.outer_raceway_radius();
        self.profile = None;
        if length == 0.0 {
            self.scene.defects.clear();
        } else if let Some(defect) = self.scene.defects.first_mut() {
            let edge_slope = std::f64::consts::FRAC_PI_2;
            defect.shape = DefectShape::Spall { length: length.to_radians() * radius, depth, edge_slope };
        }
        self
    }

    /// Text of the profile, if the scene names one.
    pub fn profile(&self) -> Option<&str> {
        self.profile.as_deref()
    }

    /// Ball pass frequency of the outer ring (Hz).
    pub fn bpfo(&self) -> f64 {
        kinematics::frequencies(&self.scene.bearing, self.scene.cage.slip, self.shaft_speed()).bpfo
    }

    /// Shaft speed (Hz).
    pub fn shaft_speed(&self) -> f64 {
        self.scene.shaft_speed / std::f64::consts::TAU
    }

    /// Length of the spall (degrees); 0 of other defects and none.
    pub fn length(&self) -> f64 {
        match self.scene.defects.first().map(|defect| &defect.shape) {
            Some(DefectShape::Spall { length, .. }) => {
                let inner = self.scene.has_defect_inside();
                let raceway = if inner { Raceway::Inner } else { Raceway::Outer };
                (length / raceway.radius(&self.scene.bearing)).to_degrees()
            }
            _ => 0.0,
        }
    }

    /// When element 1 stands over the leading edge of a defect of so many degrees (s).
    pub fn entry(&self, length: f64) -> f64 {
        let centre = self.scene.defects.first().map_or(-std::f64::consts::FRAC_PI_2, |defect| defect.angle);
        let way = centre.to_degrees() - 0.5 * length - self.scene.cage.initial_angle.to_degrees();
        way.rem_euclid(360.0 / self.scene.bearing.element_count as f64) / self.travel()
    }

    /// Element travel per second (degrees).
    pub fn travel(&self) -> f64 {
        360.0 / self.scene.bearing.element_count as f64 * self.bpfo()
    }

    /// The named outputs, sampled at `rate` (Hz) for a time (s), from the start on.
    pub fn record(&self, project: &Project, names: &[&str], rate: f64, seconds: f64) -> Result<Vec<Vec<f64>>> {
        let about = || format!("scene {}", self.scene.name);
        let map = contact_map::of(&self.scene, self.profile(), project).with_context(about)?;
        let mut simulation =
            Simulation::with_map(self.scene.clone(), self.profile(), map.as_deref()).with_context(about)?;
        simulation.initialize(0.0).with_context(about)?;
        let mut columns = vec![Vec::new(); names.len()];
        for sample in simulation.samples(names, 1.0 / rate).with_context(about)?.take(1 + (seconds * rate) as usize) {
            let values = sample.with_context(about)?.values;
            columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
        }
        Ok(columns)
    }

    /// Mean of the passages of a signal recorded from the start at `rate` (Hz), each from `lead` of a period before an
    /// entry on; the first `skip` passages are left out.
    pub fn average(&self, signal: &[f64], rate: f64, length: f64, lead: f64, skip: usize) -> Vec<f64> {
        let period = rate / self.bpfo();
        let first = self.entry(length) * rate + (skip as f64 - lead) * period;
        let count = ((signal.len() as f64 - first) / period) as usize;
        let starts: Vec<f64> = (0..count).map(|i| first + i as f64 * period).collect();
        fold::mean(signal, &starts, period, period.round() as usize)
    }
}
