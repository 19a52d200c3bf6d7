//! What more than two degrees of freedom ask of a scene, and what only they know.

use super::faults::Faults;
use super::quantity::*;
use crate::scene::{
    AxialSupport, Bearing, DegreesOfFreedom, ElementInertia, FreedomError, Gyroscopic, Motion, Ring, Scene, SceneError,
};
use DegreesOfFreedom::{Five, Three, Two};

/// Largest radial clearance over the distance of the grooves' centres: a free contact angle of 60 degrees.
const LARGEST_RELATIVE_CLEARANCE: f64 = 0.5;
/// Smallest free contact angle other than 0 (rad): below one degree a bearing is closed as tightly as a preload of a
/// hundredth of a micrometre closes it, and what it carries along its axis is nothing.
const SMALLEST_CONTACT_ANGLE: f64 = std::f64::consts::PI / 180.0;

impl Scene {
    /// Keys of more degrees of freedom than there are, and what those that there are need.
    pub(super) fn check_freedom(&self) -> Result<(), SceneError> {
        let mut faults = Faults::default();
        let freedom = self.bearing.degrees_of_freedom;
        for (key, given, needs) in self.of_more_freedom() {
            if given && freedom < needs {
                faults
                    .passes(Err(FreedomError::NeedsMore { key, least: needs.count(), given: freedom.count() }.into()));
            }
        }
        if freedom == Two {
            return faults.into_result();
        }
        faults.passes(self.bearing.check_angles());
        if self.bearing.gyroscopic != Gyroscopic::None && self.bearing.element_inertia == ElementInertia::Full {
            faults.passes(Err(FreedomError::GyroscopicInMotion.into()));
        }
        faults.passes(ACROSS_DAMPING.check_all(self.contact.across_damping.as_slice()));
        faults.passes(GRAVITY.check(self.axial_gravity));
        for (ring, name, of) in [(&self.shaft, "shaft", &SHAFT), (&self.housing, "housing", &HOUSING)] {
            faults.passes(self.check_axial(ring, name, of));
        }
        let free = |ring: &Ring| ring.motion == Motion::Internal && ring.axial.stiffness == 0.0;
        if free(&self.shaft) && free(&self.housing) {
            faults.passes(Err(FreedomError::NothingHoldsAxially.into()));
        }
        if freedom == Five {
            faults.passes(self.check_tilt());
        }
        faults.into_result()
    }

    /// Keys, whether they are given, and the degrees of freedom that they need.
    fn of_more_freedom(&self) -> impl Iterator<Item = (&'static str, bool, DegreesOfFreedom)> {
        let (bearing, [shaft, housing]) = (&self.bearing, [self.shaft, self.housing]);
        [
            ("bearing.contact_angle_deg", bearing.contact_angle.is_some(), Three),
            ("bearing.operating_angle_deg", bearing.operating_angle.is_some(), Three),
            ("bearing.shoulder_inner_mm", bearing.shoulder_inner.is_some(), Three),
            ("bearing.shoulder_outer_mm", bearing.shoulder_outer.is_some(), Three),
            ("bearing.gyroscopic", bearing.gyroscopic != Gyroscopic::None, Three),
            ("contact.across_damping_s_m", self.contact.across_damping.is_some(), Three),
            ("the third number of gravity_m_s2", self.axial_gravity != 0.0, Three),
            ("the third number of shaft.load_n", shaft.axial.load != 0.0, Three),
            ("the third number of housing.load_n", housing.axial.load != 0.0, Three),
            ("shaft.preload_n", shaft.axial.preload != 0.0, Three),
            ("housing.preload_n", housing.axial.preload != 0.0, Three),
            ("sensor.direction", self.sensors.iter().any(|sensor| sensor.elevation != 0.0), Three),
            ("shaft.load_moment_n_m", shaft.tilt.load_moment != [0.0; 2], Five),
        ]
        .into_iter()
    }

    fn check_axial(&self, ring: &Ring, name: &'static str, of: &RingQuantities) -> Result<(), SceneError> {
        let AxialSupport { load, preload, damping, stiffness } = ring.axial;
        let mut faults = Faults::default();
        let loads = [of.load.check(load), of.preload.check(preload)].map(|checked| faults.passes(checked));
        if ring.motion == Motion::Internal {
            faults.passes(of.axial_damping.check(damping));
            let held = faults.passes(of.axial_stiffness.check(stiffness)) && stiffness > 0.0;
            // What presses the ring against the bearing: without it no place is its own.
            let pressed = load != 0.0 || preload != 0.0 || self.axial_gravity != 0.0;
            if loads == [true; 2] && !held && !pressed {
                faults.passes(Err(FreedomError::FreeAlongTheAxis { ring: name }.into()));
            }
        } else if load != 0.0 || preload != 0.0 {
            faults.passes(Err(FreedomError::AxialLoadNotInternal { ring: name, load, preload }.into()));
        }
        faults.into_result()
    }

    /// Of the shaft: the housing's tilt is held.
    fn check_tilt(&self) -> Result<(), SceneError> {
        let (mut faults, tilt) = (Faults::default(), self.shaft.tilt);
        faults.passes(LOAD_MOMENT.check_all(&tilt.load_moment));
        if self.shaft.motion != Motion::Internal {
            if tilt.load_moment != [0.0; 2] {
                faults.passes(Err(FreedomError::MomentNotInternal { moment: tilt.load_moment }.into()));
            }
            return faults.into_result();
        }
        let transverse = faults.passes(TRANSVERSE_INERTIA.check(tilt.transverse_inertia));
        let polar = faults.passes(POLAR_INERTIA.check(tilt.polar_inertia));
        let (polar_kg_m2, limit_kg_m2) = (shown(tilt.polar_inertia), shown(2.0 * tilt.transverse_inertia));
        // No body is farther from its axis than from both others together.
        if transverse && polar && polar_kg_m2 > limit_kg_m2 {
            faults.passes(Err(FreedomError::TooMuchPolarInertia { polar_kg_m2, limit_kg_m2 }.into()));
        }
        faults.passes(TILT_DAMPING.check(tilt.damping));
        let held = !faults.passes(TILT_STIFFNESS.check(tilt.stiffness)) || tilt.stiffness > 0.0;
        if !held && !self.is_pressed() {
            faults.passes(Err(FreedomError::FreeInTilt.into()));
        }
        faults.into_result()
    }

    /// Whether anything presses balls against both rings: in contact they hold a tilt, also without a contact angle.
    fn is_pressed(&self) -> bool {
        let loads = [&self.shaft, &self.housing].map(|ring| [ring.load[0], ring.load[1], ring.axial.load]);
        let gravity = [self.gravity[0], self.gravity[1], self.axial_gravity];
        let pushes = loads.into_iter().flatten().chain(gravity).chain([self.shaft.axial.preload]);
        let pushes = pushes.chain(self.shaft.tilt.load_moment);
        self.bearing.radial_clearance < 0.0 || pushes.into_iter().any(|push| push != 0.0)
    }
}

impl Bearing {
    /// Of a bearing with more than two degrees of freedom.
    fn check_angles(&self) -> Result<(), SceneError> {
        if self.roller().is_some() {
            return Err(FreedomError::OfRollers { given: self.degrees_of_freedom.count() }.into());
        }
        let mut faults = Faults::default();
        if self.outer_compliance != 0.0 {
            let given = self.degrees_of_freedom.count();
            faults.passes(Err(FreedomError::WithCompliance { compliance_m_n: self.outer_compliance, given }.into()));
        }
        let mut sound = self.element_diameter > 0.0;
        for (ring, conformity) in [("inner", self.conformity_inner), ("outer", self.conformity_outer)] {
            let (conformity, limit) = (shown(conformity), LARGEST_CONFORMITY_OF_ANGLES);
            if conformity > limit {
                faults.passes(Err(FreedomError::OpenGroove { ring, conformity, limit }.into()));
            }
            // What is too narrow is refused with any degrees of freedom.
            sound &= (SMALLEST_CONFORMITY..=limit).contains(&conformity);
        }
        let in_range = self.contact_angle.is_none_or(|angle| faults.passes(check_contact_angle(angle)));
        faults.passes(OPERATING_ANGLE.check_all(self.operating_angle.as_slice()));
        if sound && in_range {
            faults.passes(self.check_free_angle());
            let [inner, outer] = self.groove_radii();
            faults.passes(check_shoulder(self.shoulder_inner, inner, &SHOULDER_INNER));
            faults.passes(check_shoulder(self.shoulder_outer, outer, &SHOULDER_OUTER));
        }
        faults.into_result()
    }

    /// Clearance and contact angle, of grooves that are possible.
    fn check_free_angle(&self) -> Result<(), SceneError> {
        let clearance_um = shown(self.radial_clearance * 1e6);
        match self.contact_angle {
            Some(angle) => {
                let limit_um = shown(self.clearance_at(angle) * 1e6);
                // Twelve digits, of a clearance that was worked out from the same angle.
                if (clearance_um - limit_um).abs() > 1e-9 * limit_um.abs() {
                    let angle_deg = shown(angle.to_degrees());
                    return Err(FreedomError::AngleAndClearance { angle_deg, clearance_um, limit_um }.into());
                }
            }
            None => {
                let limit_um = shown(LARGEST_RELATIVE_CLEARANCE * self.groove_distance() * 1e6);
                if clearance_um > limit_um {
                    return Err(FreedomError::TooSteep { clearance_um, limit_um }.into());
                }
            }
        }
        Ok(())
    }
}

fn check_contact_angle(angle: f64) -> Result<(), SceneError> {
    CONTACT_ANGLE.check(angle)?;
    let (contact_angle_deg, limit_deg) = (shown(angle.to_degrees()), shown(SMALLEST_CONTACT_ANGLE.to_degrees()));
    if contact_angle_deg != 0.0 && contact_angle_deg.abs() < limit_deg {
        return Err(FreedomError::TooFlat { contact_angle_deg }.into());
    }
    Ok(())
}

fn check_shoulder(height: Option<f64>, groove: f64, of: &Quantity) -> Result<(), SceneError> {
    let Some(height) = height else { return Ok(()) };
    of.check(height)?;
    let (height_mm, limit_mm) = (shown(height * 1e3), shown(groove * 1e3));
    if height_mm >= limit_mm {
        return Err(FreedomError::ShoulderTooHigh { key: of.key, height_mm, limit_mm }.into());
    }
    Ok(())
}

impl Bearing {
    /// Radial clearance (m) that belongs to a total axial play (m).
    ///
    /// # Errors
    /// A play below 0, or one at which the free contact angle is above 60 degrees.
    pub fn clearance_of_play(&self, axial_play: f64) -> Result<f64, SceneError> {
        let sine = 0.5 * axial_play / self.groove_distance();
        let steepest = libm::sqrt(3.0) / 2.0;
        if !(0.0..=steepest).contains(&sine) {
            let limit_um = shown(2.0 * self.groove_distance() * steepest * 1e6);
            return Err(FreedomError::AxialPlay { play_um: shown(axial_play * 1e6), limit_um }.into());
        }
        Ok(self.clearance_at(libm::asin(sine)))
    }
}
