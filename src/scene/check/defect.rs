//! What a defect must satisfy to be possible in its bearing.

use super::faults::Faults;
use super::quantity::*;
use crate::scene::{Bearing, Defect, DefectError, DefectLimit, DefectOn, DefectShape, SceneError};

impl Defect {
    /// `bearing` where that is possible itself.
    pub(super) fn check(&self, bearing: Option<&Bearing>) -> Result<(), SceneError> {
        let mut faults = Faults::default();
        faults.passes(DEFECT_ANGLE.check(self.angle));
        if let DefectOn::Element { element, tilt } = self.on {
            if let Some(count) = bearing.map(|bearing| bearing.element_count).filter(|count| element >= *count) {
                let element = element as i64 + 1;
                faults.passes(Err(DefectError::NoSuchElement { element, count }.into()));
            }
            let with_rollers = bearing.is_some_and(|bearing| bearing.roller().is_some());
            if faults.passes(TILT.check(tilt)) && with_rollers && tilt != 0.0 {
                faults.passes(Err(DefectError::TiltOnRoller { tilt_deg: shown(tilt.to_degrees()) }.into()));
            }
        }
        faults.passes(match &self.shape {
            DefectShape::Spall { length, depth, edge_slope } => {
                self.check_spall([*length, *depth, *edge_slope], bearing)
            }
            DefectShape::Profile(measured) => self.check_profile(&measured.file),
        });
        faults.into_result()
    }

    fn check_spall(&self, [length, depth, edge_slope]: [f64; 3], bearing: Option<&Bearing>) -> Result<(), SceneError> {
        let mut faults = Faults::default();
        faults.passes(SPALL_DEPTH.check(depth));
        faults.passes(EDGE_SLOPE.check(edge_slope));
        // A length in degrees has become one in metres by the bearing's dimensions.
        let Some(bearing) = bearing else { return faults.into_result() };
        faults.passes(SPALL_LENGTH.check(length));
        faults.into_result()?;
        self.check_proportions([length, depth, edge_slope], bearing)
    }

    /// Of a spall whose length, depth and slope are possible by themselves.
    fn check_proportions(&self, [length, depth, edge_slope]: [f64; 3], bearing: &Bearing) -> Result<(), SceneError> {
        let mut faults = Faults::default();
        let (length_mm, depth_um) = (shown(length * 1e3), shown(depth * 1e6));
        let DefectLimit { size: longest, what: limit } = self.on.longest(bearing);
        let limit_mm = shown(longest * 1e3);
        if length_mm >= limit_mm {
            faults.passes(Err(DefectError::SpallTooLong { length_mm, limit_mm, limit }.into()));
        }
        let limit_mm = shown(DefectOn::shortest(bearing) * 1e3);
        if length_mm < limit_mm {
            faults.passes(Err(DefectError::SpallTooShort { length_mm, limit_mm }.into()));
        }
        let DefectLimit { size: deepest, what: limit } = self.on.deepest(bearing);
        let limit_um = shown(deepest * 1e6);
        if depth_um >= limit_um {
            faults.passes(Err(DefectError::SpallTooDeep { depth_um, limit_um, limit }.into()));
        }
        faults.into_result()?;
        let met = self.on.met_length(length, bearing);
        if met <= 0.0 {
            return Err(DefectError::PitNotMet { length_mm, limit_mm: shown(self.on.off_track(bearing) * 1e3) }.into());
        }
        // tan of the right angle is large, not infinite, which is all that is asked of it here.
        let limit_um = shown(0.5 * met * libm::tan(edge_slope).abs() * 1e6);
        if depth_um > limit_um {
            let edge_slope_deg = shown(edge_slope.to_degrees());
            return Err(
                DefectError::FlanksMeet { depth_um, edge_slope_deg, limit_um, length_mm: shown(met * 1e3) }.into()
            );
        }
        Ok(())
    }

    fn check_profile(&self, name: &str) -> Result<(), SceneError> {
        if let DefectOn::Element { tilt, .. } = self.on
            && tilt != 0.0
        {
            return Err(DefectError::TiltedProfile { tilt_deg: shown(tilt.to_degrees()) }.into());
        }
        check_profile_name(name)
    }
}

/// The packed model holds the profile beside the scene, so a name that leads elsewhere would not be found there.
pub(super) fn check_profile_name(name: &str) -> Result<(), SceneError> {
    let illegal = |c: char| matches!(c, '/' | '\\' | ':') || c.is_control();
    if name.is_empty() || name == "." || name == ".." || name.chars().any(illegal) {
        return Err(SceneError::ProfileName(name.to_owned()));
    }
    Ok(())
}
