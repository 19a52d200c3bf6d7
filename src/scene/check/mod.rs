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
//! less; the limit is not scaled for them. For cylindrical rollers ISO 76 has 4000 MPa, which a straight one of 7.5 ×
//! 9 mm reaches at 0.0043 D_w in each contact: the limit is the same.

mod defect;
mod faults;
mod freedom;
pub mod quantity;
mod remark;
mod roller;
mod waviness;

pub use remark::Remark;

use super::{
    Bearing, BearingError, Contact, ContactEdge, ContactLaw, Damping, DefectError, DegreesOfFreedom, ElementInertia,
    Film, LONGEST_NAME, Motion, Recorder, RecorderFilter, Ring, Scene, SceneError, Sensor, SensorMode,
};
use faults::Faults;
use quantity::*;
use std::f64::consts::{PI, TAU};

/// Smallest clearance over element diameter; see the head of this file.
const SMALLEST_RELATIVE_CLEARANCE: f64 = -0.0075;

/// Largest difference of an element's diameter from the nominal one, as a share of that: 8 µm of a 6205's ball, where
/// grade 28 of ISO 3290-1 allows 1.4 µm a lot. Near a defect contacts are those of a nominal element, whose curvature
/// is off by as much.
const MOST_UNEQUAL: f64 = 1e-3;

/// Offset and jitter of an element from its position in an even cage, as a share of the spacing, at most: what is
/// farther off cannot be in its pocket.
const FARTHEST: f64 = 0.25;

impl Scene {
    /// Checks every physical quantity.
    ///
    /// # Errors
    /// All quantities that are outside their limits. What follows from one that is wrong is not checked.
    pub fn check(&self) -> Result<(), SceneError> {
        let mut faults = Faults::default();
        faults.passes(check_name(&self.name));
        faults.passes(GRAVITY.check_all(&self.gravity));
        let sound = faults.passes(self.bearing.check());
        faults.passes(self.contact.check());
        faults.passes(self.film.map_or(Ok(()), |film| film.check()));
        faults.passes(CAGE_SLIP.check(self.cage.slip));
        faults.passes(INITIAL_ANGLE.check(self.cage.initial_angle));
        faults.passes(SPIN_SLIP.check(self.cage.spin_slip));
        faults.passes(self.check_irregularity());
        faults.passes(SHAFT_INITIAL_ANGLE.check(self.shaft_initial_angle));
        faults.passes(HOUSING_INITIAL_ANGLE.check(self.housing_initial_angle));
        if sound {
            faults.passes(self.check_crown_law());
            faults.passes(self.check_balls_only());
            faults.passes(self.check_inertia());
            faults.passes(self.check_unequal());
            faults.passes(self.check_waviness());
        }
        let bearing = Some(&self.bearing).filter(|_| sound);
        for (index, defect) in self.defects.iter().enumerate() {
            faults.passes(defect.check(bearing).map_err(|of| of.in_table("defect", index, self.defects.len())));
        }
        faults.passes(self.check_rings());
        faults.passes(self.check_freedom());
        faults.passes(self.check_sensors());
        faults.passes(TOLERANCE.check(self.tolerance));
        faults.passes(MAX_STEPS.check(self.max_steps as f64));
        faults.passes(self.check_recorder());
        faults.passes(self.check_experiment());
        faults.into_result()
    }

    /// Films and soft edges are those of balls.
    fn check_balls_only(&self) -> Result<(), SceneError> {
        let asked =
            [("[film]", self.film.is_some()), ("contact.edge = \"step\"", self.contact.edge == ContactEdge::Step)];
        match asked.into_iter().find(|(_, asked)| *asked && self.bearing.roller().is_some()) {
            Some((key, _)) => Err(BearingError::NotOfRollers { key }.into()),
            None => Ok(()),
        }
    }

    /// The squeeze film of a loose element resists the motion that its inertia keeps up.
    fn check_inertia(&self) -> Result<(), SceneError> {
        match self.film {
            Some(_) if self.bearing.element_inertia == ElementInertia::None => {
                Err(BearingError::FilmWithoutInertia.into())
            }
            _ => Ok(()),
        }
    }

    /// Elements of unequal size run in the plane, and each must fit by itself.
    fn check_unequal(&self) -> Result<(), SceneError> {
        let (bearing, offsets) = (&self.bearing, &self.bearing.diameter_offsets);
        if offsets.is_empty() {
            return Ok(());
        }
        let (found, count, freedom) = (offsets.len(), bearing.element_count, bearing.degrees_of_freedom);
        if found != count {
            return Err(BearingError::DiameterCount { found, count }.into());
        }
        if freedom != DegreesOfFreedom::Two {
            return Err(BearingError::UnequalInSpace { given: freedom.count() }.into());
        }
        let limit_um = shown(MOST_UNEQUAL * bearing.element_diameter * 1e6);
        for (j, &offset) in offsets.iter().enumerate() {
            DIAMETER_OFFSET.check(offset)?;
            let (element, offset_um) = (j + 1, shown(offset * 1e6));
            if offset_um.abs() > limit_um {
                return Err(BearingError::TooUnequal { element, offset_um, limit_um }.into());
            }
            let own = bearing.with_elements_larger(offset).check();
            own.map_err(|of| BearingError::UnequalElement { element, offset_um, of: Box::new(of) })?;
        }
        Ok(())
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
        let mut faults = Faults::default();
        faults.passes(check_ring(&self.shaft, "shaft", &SHAFT));
        faults.passes(check_ring(&self.housing, "housing", &HOUSING));
        faults.passes(SPEED.check(self.shaft_speed));
        faults.passes(HOUSING_SPEED.check_all(self.housing_speed.as_slice()));
        let free = |ring: &Ring| ring.motion == Motion::Internal && ring.stiffness == 0.0;
        if free(&self.shaft) && free(&self.housing) {
            faults.passes(Err(SceneError::NothingHolds));
        }
        faults.into_result()
    }

    fn check_sensors(&self) -> Result<(), SceneError> {
        if self.sensors.is_empty() {
            return Ok(());
        }
        let mut faults = Faults::default();
        if self.housing.motion == Motion::Fixed {
            faults.passes(Err(SceneError::SensorOnFixedHousing));
        }
        faults.passes(SENSOR_COUNT.check(self.sensors.len() as f64));
        for (index, sensor) in self.sensors.iter().enumerate() {
            faults.passes(sensor.check().map_err(|of| of.in_table("sensor", index, self.sensors.len())));
        }
        faults.into_result()
    }

    fn check_recorder(&self) -> Result<(), SceneError> {
        let Some(Recorder { rate, filter }) = self.recorder else { return Ok(()) };
        RECORDER_RATE.check(rate)?;
        if filter == RecorderFilter::LinearPhase { FILTERED_RATE.check(rate) } else { Ok(()) }
    }

    fn check_experiment(&self) -> Result<(), SceneError> {
        let (stop, step) = (self.experiment.stop, self.experiment.step);
        let mut faults = Faults::default();
        let possible = [faults.passes(STOP.check(stop)), faults.passes(STEP.check(step))];
        if possible == [true; 2] && step > stop {
            faults.passes(Err(SceneError::StepBeyondStop { step, stop }));
        }
        faults.into_result()
    }
}

impl Sensor {
    fn check(&self) -> Result<(), SceneError> {
        let mut faults = Faults::default();
        faults.passes(SENSOR_DIRECTION.check(self.direction));
        faults.passes(SENSOR_ELEVATION.check(self.elevation));
        faults.passes(SENSOR_MASS.check(self.mass));
        faults.passes(SENSOR_STIFFNESS.check(self.stiffness));
        faults.passes(SENSOR_DAMPING.check(self.damping));
        faults.passes(SENSOR_MODE_COUNT.check(self.modes.len() as f64));
        for (index, mode) in self.modes.iter().enumerate() {
            faults.passes(mode.check().map_err(|of| of.in_table("sensor.mode", index, self.modes.len())));
        }
        if self.name.chars().any(char::is_control) || self.name.len() > LONGEST_NAME {
            faults.passes(Err(SceneError::SensorName(self.name.clone())));
        }
        faults.into_result()
    }
}

impl Bearing {
    /// Smallest radial clearance (m); negative. Below it the contacts leave the elastic range.
    pub fn smallest_radial_clearance(&self) -> f64 {
        SMALLEST_RELATIVE_CLEARANCE * self.element_diameter
    }

    /// Largest radial clearance (m): the radius of an element.
    pub fn largest_radial_clearance(&self) -> f64 {
        self.element_radius()
    }

    fn check(&self) -> Result<(), SceneError> {
        let mut faults = Faults::default();
        let count = faults.passes(ELEMENT_COUNT.check(self.element_count as f64));
        let diameter = faults.passes(ELEMENT_DIAMETER.check(self.element_diameter));
        let pitch = faults.passes(PITCH_DIAMETER.check(self.pitch_diameter));
        let fits = count && diameter && pitch && faults.passes(self.check_overlap());
        faults.passes(if fits { self.check_clearance() } else { CLEARANCE.check(self.radial_clearance) });
        if diameter {
            // Conformity and density may have been computed with it.
            match self.roller() {
                None => {
                    faults.passes(check_groove("inner", self.conformity_inner, &CONFORMITY_INNER));
                    faults.passes(check_groove("outer", self.conformity_outer, &CONFORMITY_OUTER));
                }
                Some(roller) => {
                    faults.passes(self.check_roller(roller));
                }
            }
            let density = if self.element_mass.is_some() { &DENSITY_BY_MASS } else { &DENSITY };
            faults.passes(density.check(self.density));
        }
        faults.passes(YOUNGS_MODULUS.check(self.youngs_modulus));
        faults.passes(POISSONS_RATIO.check(self.poissons_ratio));
        faults.passes(ELEMENT_YOUNGS_MODULUS.check_all(self.element_youngs_modulus.as_slice()));
        faults.passes(ELEMENT_POISSONS_RATIO.check_all(self.element_poissons_ratio.as_slice()));
        faults.passes(ELEMENT_MASS.check_all(self.element_mass.as_slice()));
        faults.passes(HERTZ_INNER.check_all(self.hertz_inner.as_slice()));
        faults.passes(HERTZ_OUTER.check_all(self.hertz_outer.as_slice()));
        faults.passes(OUTER_COMPLIANCE.check(self.outer_compliance));
        faults.into_result()
    }

    fn check_overlap(&self) -> Result<(), SceneError> {
        // Neighbours' centres are a chord of D_pw sin(π/Z) apart. One element has no neighbour.
        let chord = self.pitch_diameter * libm::sin(PI / self.element_count as f64);
        if self.element_count > 1 && self.element_diameter > chord {
            return Err(BearingError::ElementsOverlap {
                count: self.element_count,
                diameter_mm: shown(self.element_diameter * 1e3),
                pitch_diameter_mm: shown(self.pitch_diameter * 1e3),
                limit_mm: shown(chord * 1e3),
            }
            .into());
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
            return Err(BearingError::NoRoom { clearance_um, limit_um }.into());
        }
        let limit_um = shown(self.largest_radial_clearance() * 1e6);
        if clearance_um > limit_um {
            return Err(BearingError::TooLoose { clearance_um, limit_um }.into());
        }
        if self.inner_raceway_radius() <= 0.0 {
            return Err(BearingError::NoInnerRaceway {
                pitch_diameter_mm: shown(self.pitch_diameter * 1e3),
                limit_mm: shown((self.element_diameter + self.radial_clearance) * 1e3),
            }
            .into());
        }
        Ok(())
    }
}

impl Contact {
    fn check(&self) -> Result<(), SceneError> {
        let mut faults = Faults::default();
        faults.passes(match self.damping {
            Damping::HuntCrossley(chi) => DAMPING_CHI.check(chi),
            Damping::Proportional(tau) => DAMPING_TAU.check(tau),
        });
        if self.edge == ContactEdge::Step && self.law == ContactLaw::Hertz {
            faults.passes(Err(DefectError::EdgeOfHertz.into()));
        }
        faults.passes(LARGEST_FORCE.check_all(self.largest_force.as_slice()));
        let cells = self.cells.map(|cells| CONTACT_CELLS.check_all(&cells.map(f64::from)));
        faults.passes(cells.unwrap_or(Ok(())));
        faults.passes(MAP_ACCURACY.check_all(self.map_accuracy.as_slice()));
        faults.into_result()
    }
}

impl Film {
    fn check(&self) -> Result<(), SceneError> {
        let mut faults = Faults::default();
        faults.passes(VISCOSITY.check(self.viscosity));
        faults.passes(PRESSURE_VISCOSITY.check(self.pressure_viscosity));
        faults.passes(FILM_LAYER.check_all(self.layer.as_slice()));
        faults.into_result()
    }
}

fn check_name(name: &str) -> Result<(), SceneError> {
    let legal = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if name.is_empty() || name.len() > LONGEST_NAME || !name.chars().all(legal) {
        return Err(SceneError::Name(name.to_owned()));
    }
    Ok(())
}

fn check_groove(ring: &'static str, conformity: f64, range: &Quantity) -> Result<(), SceneError> {
    if conformity > 0.0 && conformity < SMALLEST_CONFORMITY {
        return Err(
            BearingError::GrooveTooNarrow { ring, conformity: shown(conformity), limit: SMALLEST_CONFORMITY }.into()
        );
    }
    range.check(conformity)
}

impl SensorMode {
    /// Whether a scene may have it.
    ///
    /// # Errors
    /// What is out of range.
    pub fn check(&self) -> Result<(), SceneError> {
        let mut faults = Faults::default();
        faults.passes(SENSOR_MODE_FREQUENCY.check(self.frequency));
        faults.passes(SENSOR_MODE_DAMPING_RATIO.check(self.damping_ratio));
        faults.passes(SENSOR_MODE_GAIN.check(self.gain));
        faults.passes(SENSOR_MODE_QUADRATURE_GAIN.check(self.quadrature_gain));
        faults.into_result()
    }
}

fn check_ring(ring: &Ring, name: &'static str, of: &RingQuantities) -> Result<(), SceneError> {
    let mut faults = Faults::default();
    faults.passes(of.load.check_all(&ring.load));
    if ring.motion == Motion::Internal {
        faults.passes(of.mass.check(ring.mass));
        faults.passes(of.damping.check(ring.damping));
        faults.passes(of.stiffness.check(ring.stiffness));
    } else if ring.load != [0.0; 2] {
        faults.passes(Err(SceneError::LoadNotInternal { ring: name, load: ring.load }));
    }
    if ring.motion == Motion::Host && ring.mass != 0.0 {
        faults.passes(HOST_MASS.check(ring.mass));
    }
    faults.into_result()
}
