//! What a scene must satisfy to be possible. Run once when the file is read, and again when a host has changed
//! parameters.
//!
//! Three kinds of limit. *Physical*: a negative mass, elements that overlap. *Of the model*: a preload beyond the
//! elastic range, a defect deeper than an element's radius. *Of plausibility*: upper bounds far beyond any bearing
//! built, which catch a value in the wrong unit before it becomes an overflow in the equations.
//!
//! Smallest clearance. With both rings concentric an element is squeezed by −G_r, half of it in each contact. ISO 76
//! puts the limit of elastic behaviour of a ball bearing at 4200 MPa. For bearing steel and conformities near 0.52 this
//! pressure belongs to an approach of 0.0037 D_w in each contact (30 µm for D_w = 7.94 mm; Hertzian approach at a given
//! pressure grows in proportion to size), hence G_r ≥ −0.0075 D_w. Ceramic or very open grooves would allow somewhat
//! less; the limit is not scaled for them.

use super::error::{LONGEST_NAME, SceneError};
use super::quantity::*;
use super::{
    Bearing, Contact, Damping, Defect, DefectOn, DefectShape, Motion, Recorder, RecorderFilter, Ring, Scene, SensorMode,
};
use std::f64::consts::{PI, TAU};

/// Smallest clearance over element diameter; see the head of this file.
const SMALLEST_RELATIVE_CLEARANCE: f64 = -0.0075;

/// Offset and jitter of an element from its place in an even cage, as a share of the spacing, at most: what is farther
/// off is no place in a pocket.
const FARTHEST: f64 = 0.25;

impl Scene {
    /// Checks every physical quantity.
    ///
    /// # Errors
    /// The first quantity that is outside its limits.
    pub fn check(&self) -> Result<(), SceneError> {
        check_name(&self.name)?;
        GRAVITY.check_all(&self.gravity)?;
        self.bearing.check()?;
        self.contact.check()?;
        CAGE_SLIP.check(self.cage.slip)?;
        INITIAL_ANGLE.check(self.cage.initial_angle)?;
        SPIN_SLIP.check(self.cage.spin_slip)?;
        self.check_irregularity()?;
        SHAFT_INITIAL_ANGLE.check(self.shaft_initial_angle)?;
        HOUSING_INITIAL_ANGLE.check(self.housing_initial_angle)?;
        for (index, defect) in self.defects.iter().enumerate() {
            defect.check(&self.bearing).map_err(|of| of.in_table("defect", index, self.defects.len()))?;
        }
        self.check_rings()?;
        self.check_sensors()?;
        TOLERANCE.check(self.tolerance)?;
        MAX_STEPS.check(self.max_steps as f64)?;
        if let Some(Recorder { rate, filter }) = self.recorder {
            RECORDER_RATE.check(rate)?;
            if filter == RecorderFilter::LinearPhase {
                FILTERED_RATE.check(rate)?;
            }
        }
        self.check_experiment()
    }

    fn check_irregularity(&self) -> Result<(), SceneError> {
        let Some(cage) = &self.cage.irregularity else { return Ok(()) };
        let count = self.bearing.element_count;
        CAGE_JITTER.check(cage.jitter)?;
        CAGE_WANDER.check(cage.wander)?;
        if cage.offsets.len() != count {
            return Err(SceneError::SpacingCount { found: cage.offsets.len(), count });
        }
        let limit = FARTHEST * TAU / count as f64;
        for (element, &offset) in cage.offsets.iter().enumerate() {
            CAGE_SPACING.check(offset)?;
            if offset.abs() + cage.jitter > limit {
                let [offset_deg, jitter_deg, limit_deg] =
                    [offset.abs(), cage.jitter, limit].map(|angle| shown(angle.to_degrees()));
                return Err(SceneError::OffPocket { element: element + 1, offset_deg, jitter_deg, limit_deg });
            }
        }
        Ok(())
    }

    fn check_rings(&self) -> Result<(), SceneError> {
        check_ring(&self.shaft, "shaft", &SHAFT)?;
        check_ring(&self.housing, "housing", &HOUSING)?;
        SPEED.check(self.shaft_speed)?;
        HOUSING_SPEED.check_all(self.housing_speed.as_slice())?;
        let free = |ring: &Ring| ring.motion == Motion::Internal && ring.stiffness == 0.0;
        if free(&self.shaft) && free(&self.housing) {
            return Err(SceneError::NothingHolds);
        }
        Ok(())
    }

    fn check_sensors(&self) -> Result<(), SceneError> {
        if self.sensors.is_empty() {
            return Ok(());
        }
        if self.housing.motion == Motion::Fixed {
            return Err(SceneError::SensorOnFixedHousing);
        }
        SENSOR_COUNT.check(self.sensors.len() as f64)?;
        for (index, sensor) in self.sensors.iter().enumerate() {
            let check = || {
                SENSOR_DIRECTION.check(sensor.direction)?;
                SENSOR_MASS.check(sensor.mass)?;
                SENSOR_STIFFNESS.check(sensor.stiffness)?;
                SENSOR_DAMPING.check(sensor.damping)?;
                SENSOR_MODE_COUNT.check(sensor.modes.len() as f64)?;
                for (index, mode) in sensor.modes.iter().enumerate() {
                    mode.check().map_err(|of| of.in_table("sensor.mode", index, sensor.modes.len()))?;
                }
                if sensor.name.chars().any(char::is_control) || sensor.name.len() > LONGEST_NAME {
                    return Err(SceneError::SensorName(sensor.name.clone()));
                }
                Ok(())
            };
            check().map_err(|of: SceneError| of.in_table("sensor", index, self.sensors.len()))?;
        }
        Ok(())
    }

    fn check_experiment(&self) -> Result<(), SceneError> {
        let (stop, step) = (self.experiment.stop, self.experiment.step);
        STOP.check(stop)?;
        STEP.check(step)?;
        if step > stop {
            return Err(SceneError::StepBeyondStop { step, stop });
        }
        Ok(())
    }
}

impl Bearing {
    /// Smallest radial clearance [m]; negative. Below it the contacts leave the elastic range.
    pub fn smallest_radial_clearance(&self) -> f64 {
        SMALLEST_RELATIVE_CLEARANCE * self.element_diameter
    }

    /// Largest radial clearance [m]: the radius of an element.
    pub fn largest_radial_clearance(&self) -> f64 {
        self.element_radius()
    }

    fn check(&self) -> Result<(), SceneError> {
        ELEMENT_COUNT.check(self.element_count as f64)?;
        ELEMENT_DIAMETER.check(self.element_diameter)?;
        PITCH_DIAMETER.check(self.pitch_diameter)?;
        self.check_overlap()?;
        check_groove("inner", self.conformity_inner, &CONFORMITY_INNER)?;
        check_groove("outer", self.conformity_outer, &CONFORMITY_OUTER)?;
        self.check_clearance()?;
        YOUNGS_MODULUS.check(self.youngs_modulus)?;
        POISSONS_RATIO.check(self.poissons_ratio)?;
        ELEMENT_MASS.check_all(self.element_mass.as_slice())?;
        DENSITY.check(self.density)?;
        HERTZ_INNER.check_all(self.hertz_inner.as_slice())?;
        HERTZ_OUTER.check_all(self.hertz_outer.as_slice())?;
        OUTER_COMPLIANCE.check(self.outer_compliance)
    }

    fn check_overlap(&self) -> Result<(), SceneError> {
        // Neighbours' centres are a chord of D_pw sin(π/Z) apart. One element has no neighbour.
        let chord = self.pitch_diameter * libm::sin(PI / self.element_count as f64);
        if self.element_count > 1 && self.element_diameter > chord {
            return Err(SceneError::ElementsOverlap {
                count: self.element_count,
                diameter_mm: shown(self.element_diameter * 1e3),
                pitch_diameter_mm: shown(self.pitch_diameter * 1e3),
                limit_mm: shown(chord * 1e3),
            });
        }
        Ok(())
    }

    fn check_clearance(&self) -> Result<(), SceneError> {
        CLEARANCE.check(self.radial_clearance)?;
        // Far from every limit nothing needs to be rounded.
        let well_inside = self.radial_clearance > 0.99 * self.smallest_radial_clearance()
            && self.radial_clearance < 0.99 * self.largest_radial_clearance();
        if well_inside && self.inner_raceway_radius() > 0.0 {
            return Ok(());
        }
        let clearance_um = shown(self.radial_clearance * 1e6);
        let limit_um = shown(self.smallest_radial_clearance() * 1e6);
        if clearance_um < limit_um {
            return Err(SceneError::NoRoom { clearance_um, limit_um });
        }
        let limit_um = shown(self.largest_radial_clearance() * 1e6);
        if clearance_um > limit_um {
            return Err(SceneError::TooLoose { clearance_um, limit_um });
        }
        if self.inner_raceway_radius() <= 0.0 {
            return Err(SceneError::NoInnerRaceway {
                pitch_diameter_mm: shown(self.pitch_diameter * 1e3),
                limit_mm: shown((self.element_diameter + self.radial_clearance) * 1e3),
            });
        }
        Ok(())
    }
}

impl Contact {
    fn check(&self) -> Result<(), SceneError> {
        match self.damping {
            Damping::HuntCrossley(chi) => DAMPING_CHI.check(chi),
            Damping::Proportional(tau) => DAMPING_TAU.check(tau),
        }?;
        self.largest_force.map_or(Ok(()), |force| LARGEST_FORCE.check(force))?;
        self.cells.into_iter().flatten().try_for_each(|cells| CONTACT_CELLS.check(f64::from(cells)))?;
        self.map_accuracy.map_or(Ok(()), |accuracy| MAP_ACCURACY.check(accuracy))
    }
}

impl Defect {
    fn check(&self, bearing: &Bearing) -> Result<(), SceneError> {
        DEFECT_ANGLE.check(self.angle)?;
        if let DefectOn::Element { element, tilt } = self.on {
            if element >= bearing.element_count {
                let (element, count) = (element as i64 + 1, bearing.element_count);
                return Err(SceneError::NoSuchElement { element, count });
            }
            TILT.check(tilt)?;
        }
        match &self.shape {
            DefectShape::Spall { length, depth, edge_slope } => {
                self.check_spall([*length, *depth, *edge_slope], bearing)
            }
            DefectShape::Profile(name) => self.check_profile(name),
        }
    }

    fn check_spall(&self, [length, depth, edge_slope]: [f64; 3], bearing: &Bearing) -> Result<(), SceneError> {
        SPALL_LENGTH.check(length)?;
        SPALL_DEPTH.check(depth)?;
        EDGE_SLOPE.check(edge_slope)?;
        let (length_mm, depth_um) = (shown(length * 1e3), shown(depth * 1e6));
        let (longest, limit) = self.on.longest(bearing);
        let limit_mm = shown(longest * 1e3);
        if length_mm >= limit_mm {
            return Err(SceneError::SpallTooLong { length_mm, limit_mm, limit });
        }
        let (deepest, limit) = self.on.deepest(bearing);
        let limit_um = shown(deepest * 1e6);
        if depth_um >= limit_um {
            return Err(SceneError::SpallTooDeep { depth_um, limit_um, limit });
        }
        let met = self.on.met_length(length, bearing);
        if met <= 0.0 {
            return Err(SceneError::PitNotMet { length_mm, limit_mm: shown(self.off_track(bearing) * 1e3) });
        }
        // tan of the right angle is large, not infinite, which is all that is asked of it here.
        let limit_um = shown(0.5 * met * libm::tan(edge_slope).abs() * 1e6);
        if depth_um > limit_um {
            let edge_slope_deg = shown(edge_slope.to_degrees());
            return Err(SceneError::FlanksMeet { depth_um, edge_slope_deg, limit_um, length_mm: shown(met * 1e3) });
        }
        Ok(())
    }

    fn check_profile(&self, name: &str) -> Result<(), SceneError> {
        if let DefectOn::Element { tilt, .. } = self.on
            && tilt != 0.0
        {
            return Err(SceneError::TiltedProfile { tilt_deg: shown(tilt.to_degrees()) });
        }
        check_profile_name(name)
    }

    /// Diameter of a pit whose rim the rolling track touches [m].
    fn off_track(&self, bearing: &Bearing) -> f64 {
        match self.on {
            DefectOn::Element { tilt, .. } => 2.0 * bearing.element_radius() * libm::sin(tilt).abs(),
            _ => 0.0,
        }
    }
}

fn check_name(name: &str) -> Result<(), SceneError> {
    let legal = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if name.is_empty() || name.len() > LONGEST_NAME || !name.chars().all(legal) {
        return Err(SceneError::Name(name.to_owned()));
    }
    Ok(())
}

/// The packed model holds the profile beside the scene, so a name that leads elsewhere would not be found there.
fn check_profile_name(name: &str) -> Result<(), SceneError> {
    let illegal = |c: char| matches!(c, '/' | '\\' | ':') || c.is_control();
    if name.is_empty() || name == "." || name == ".." || name.chars().any(illegal) {
        return Err(SceneError::ProfileName(name.to_owned()));
    }
    Ok(())
}

fn check_groove(ring: &'static str, conformity: f64, range: &Quantity) -> Result<(), SceneError> {
    if conformity > 0.0 && conformity < SMALLEST_CONFORMITY {
        return Err(SceneError::GrooveTooNarrow { ring, conformity: shown(conformity), limit: SMALLEST_CONFORMITY });
    }
    range.check(conformity)
}

impl SensorMode {
    fn check(&self) -> Result<(), SceneError> {
        SENSOR_MODE_FREQUENCY.check(self.frequency)?;
        SENSOR_MODE_DAMPING_RATIO.check(self.damping_ratio)?;
        SENSOR_MODE_GAIN.check(self.gain)?;
        SENSOR_MODE_QUADRATURE_GAIN.check(self.quadrature_gain)
    }
}

fn check_ring(ring: &Ring, name: &'static str, of: &RingQuantities) -> Result<(), SceneError> {
    of.load.check_all(&ring.load)?;
    if ring.motion != Motion::Internal {
        if ring.load != [0.0; 2] {
            return Err(SceneError::LoadNotInternal { ring: name, load: ring.load });
        }
        return Ok(());
    }
    of.mass.check(ring.mass)?;
    of.damping.check(ring.damping)?;
    of.stiffness.check(ring.stiffness)
}
