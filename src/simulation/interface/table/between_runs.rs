//! What an engineer changes between runs: sizes of spalls, the cage's seed, the film's viscosity, a sensor's resonance,
//! the recorder's rate, the seed of the elements' diameters and the clearance.
//!
//! These rows stand after all others, so that older ones keep their references.

use super::builder::{Builder, Limited};
use super::variables::{Causality, Kind, Unit, Variability};
use crate::scene::quantity::{RECORDER_RATE, VISCOSITY};
use crate::scene::{DefectShape, RecorderFilter};
use crate::simulation::interface::quantity::{Parameter, Quantity as Q};

impl Builder<'_> {
    pub(super) fn between_runs(&mut self) {
        let scene = self.scene;
        self.spalls();
        let seed = scene.cage.irregularity.as_ref().map(|cage| cage.seed);
        self.seed("cage.seed", "Seed of what is random in the cage", seed, Parameter::CageSeed);
        if let Some(film) = &scene.film {
            self.parameter(
                "film.viscosity",
                "Viscosity of the oil at the contacts' inlets",
                Q::Parameter(Parameter::FilmViscosity),
                Unit::PascalSecond,
                Limited::of(&VISCOSITY, film.viscosity, 0.01),
            );
        }
        for (k, sensor) in scene.sensors.iter().enumerate() {
            let start = sensor.resonance();
            self.parameter(
                &scene.sensor_variable(k).replace("acceleration", "resonance"),
                "Resonance of the sensor on its mounting; the damping ratio stays",
                Q::Parameter(Parameter::SensorResonance(k)),
                Unit::Hertz,
                Limited { start, min: start.min(1.0), max: start.max(1e6), nominal: 1e4 },
            );
        }
        if let Some(recorder) = &scene.recorder {
            let min = if recorder.filter == RecorderFilter::None { 0.0 } else { 100.0 };
            self.parameter(
                "recorder.rate",
                "Rows of the recording per second",
                Q::Parameter(Parameter::RecorderRate),
                Unit::Hertz,
                Limited { min, ..Limited::of(&RECORDER_RATE, recorder.rate, 1e4) },
            );
        }
        let seed = scene.bearing.drawn_diameters.map(|drawn| drawn.seed);
        let what = "Seed of the elements' diameters";
        self.seed("bearing.element_diameter_seed", what, seed, Parameter::DiameterSeed);
        self.clearance_of_catalogues();
    }

    /// Clearance as catalogues count, of bearings whose contact angle does not give it.
    fn clearance_of_catalogues(&mut self) {
        let bearing = &self.scene.bearing;
        if bearing.contact_angle.is_none() {
            let largest = 2.0 * bearing.element_diameter;
            self.parameter(
                "bearing.internal_clearance",
                "Radial internal clearance (ISO 5753), from stop to stop; negative is a preload",
                Q::Parameter(Parameter::InternalClearance),
                Unit::Metre,
                Limited { start: 2.0 * bearing.radial_clearance, min: -largest, max: largest, nominal: 1e-5 },
            );
        }
    }

    /// A seed, where something is drawn. Larger ones are none of FMI 2.0's integers: the scene's own holds.
    fn seed(&mut self, name: &str, what: &str, of: Option<u64>, parameter: Parameter) {
        if let Some(start) = of.and_then(|seed| i32::try_from(seed).ok()) {
            let fixed = (Causality::Parameter, Variability::Fixed);
            self.push(name, what, Kind::Whole { start }, fixed, Q::Parameter(parameter));
        }
    }

    fn spalls(&mut self) {
        let scene = self.scene;
        for (index, defect) in scene.defects.iter().enumerate() {
            let DefectShape::Spall { length, depth, .. } = defect.shape else { continue };
            let ([shortest, longest], deepest) =
                (defect.on.lengths(&scene.bearing), defect.on.largest_depth(&scene.bearing));
            self.parameter(
                &self.of_defect(index, "length"),
                "Length of the spall along the surface",
                Q::Parameter(Parameter::SpallLength(index)),
                Unit::Metre,
                Limited { start: length, min: shortest.min(length), max: longest.max(length), nominal: 1e-3 },
            );
            self.parameter(
                &self.of_defect(index, "depth"),
                "Depth of the spall's floor",
                Q::Parameter(Parameter::SpallDepth(index)),
                Unit::Metre,
                Limited { start: depth, min: depth.min(1e-9), max: deepest.max(depth), nominal: 1e-5 },
            );
        }
    }
}
