//! What a cylindrical roller must satisfy for its contact law to hold.

use super::defect::check_profile_name;
use super::faults::Faults;
use super::quantity::*;
use crate::scene::{Bearing, BearingError, ContactLaw, Roller, RollerProfile, Scene, SceneError};

/// Effective length of a roller over its diameter: what is shorter is a disc, what is longer a needle.
const SHORTEST: f64 = 0.3;
const LONGEST: f64 = 3.0;

impl Bearing {
    /// What the lamina law holds for.
    pub(super) fn check_roller(&self, roller: &Roller) -> Result<(), SceneError> {
        let mut faults = Faults::default();
        let [length_mm, low_mm, high_mm] =
            [roller.length, SHORTEST * self.element_diameter, LONGEST * self.element_diameter].map(|x| shown(x * 1e3));
        if faults.passes(ROLLER_LENGTH.check(roller.length)) && !(low_mm..=high_mm).contains(&length_mm) {
            faults.passes(Err(BearingError::RollerLength { length_mm, low_mm, high_mm }.into()));
        }
        faults.passes(ROLLER_LAMINAE.check(f64::from(roller.laminae)));
        if let RollerProfile::Measured(crown) = &roller.profile {
            faults.passes(check_profile_name(&crown.name));
        }
        let not_steel = |of: SceneError| match of {
            SceneError::OutOfRange { quantity, key, value, limits } => {
                BearingError::NotSteel { quantity, key, value, limits }.into()
            }
            other => other,
        };
        faults.passes(STEELS_MODULUS.check(self.youngs_modulus).map_err(not_steel));
        faults.passes(STEELS_RATIO.check(self.poissons_ratio).map_err(not_steel));
        for (key, given) in
            [("bearing.hertz_inner_n_m1_5", self.hertz_inner), ("bearing.hertz_outer_n_m1_5", self.hertz_outer)]
        {
            faults.passes(given.map_or(Ok(()), |_| Err(BearingError::OnlyBalls { key }.into())));
        }
        faults.into_result()
    }
}

impl Scene {
    /// Grids and maps near defects are of rollers with a crown by formula.
    pub(super) fn check_crown_law(&self) -> Result<(), SceneError> {
        match self.bearing.roller() {
            Some(Roller { profile: RollerProfile::Measured(crown), .. })
                if !self.defects.is_empty() && self.contact.law != ContactLaw::Hertz =>
            {
                let (law, _) = self.contact.law.described();
                Err(BearingError::CrownLaw { law, name: crown.name.clone() }.into())
            }
            _ => Ok(()),
        }
    }
}
