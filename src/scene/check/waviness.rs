//! What waviness must satisfy for an element to follow it as a rigid one.

use super::faults::Faults;
use super::quantity::*;
use crate::scene::{Bearing, DefectOn, DegreesOfFreedom, Scene, SceneError, Waviness, WavinessError, WavyBody};

/// Curvature of all waves of a body together over that of the gap to the other one: the path of the element's centre
/// differs from the wave by half as much of its height.
const MOST_CURVED: f64 = 0.1;
/// Slope of all waves of a body together: what is left out goes with its square.
const STEEPEST: f64 = 0.01;

impl Scene {
    /// Of a bearing that is possible itself.
    pub(super) fn check_waviness(&self) -> Result<(), SceneError> {
        let (mut faults, count) = (Faults::default(), self.waviness.len());
        if count == 0 {
            return Ok(());
        }
        let freedom = self.bearing.degrees_of_freedom;
        if freedom != DegreesOfFreedom::Two {
            return Err(WavinessError::InSpace { given: freedom.count() }.into());
        }
        for (index, waves) in self.waviness.iter().enumerate() {
            faults.passes(waves.check(&self.bearing).map_err(|of| of.in_table("waviness", index, count)));
        }
        faults.into_result()?;
        self.check_pairs()?;
        self.waviness.iter().try_for_each(|waves| self.check_waves_of(waves.on))
    }

    /// Bodies that turn against each other under one contact.
    fn check_pairs(&self) -> Result<(), SceneError> {
        let of_element = |body: &WavyBody| matches!(body, WavyBody::Element(_));
        let wavy = |element: bool| self.waviness.iter().any(|waves| of_element(&waves.on) == element);
        let defect =
            |element: bool| self.defects.iter().any(|defect| matches!(defect.on, DefectOn::Element { .. }) == element);
        if wavy(true) && (wavy(false) || defect(false)) || wavy(false) && defect(true) {
            return Err(WavinessError::TwoUnderOneContact.into());
        }
        Ok(())
    }

    /// All waves of a body together.
    fn check_waves_of(&self, body: WavyBody) -> Result<(), SceneError> {
        let (bearing, radius) = (&self.bearing, body.radius(&self.bearing));
        let sum = |power: i32| -> f64 {
            let each = self.waviness.iter().filter(|waves| waves.on == body);
            each.map(|waves| waves.amplitude * (f64::from(waves.order) / radius).powi(power)).sum()
        };
        let slope = shown(sum(1));
        if slope > STEEPEST {
            return Err(WavinessError::TooSteep { body, slope, limit: STEEPEST }.into());
        }
        let share = shown(sum(2) / body.gap_curvature(bearing));
        if share > MOST_CURVED {
            return Err(WavinessError::TooCurved { body, share, limit: MOST_CURVED }.into());
        }
        Ok(())
    }
}

impl Waviness {
    fn check(&self, bearing: &Bearing) -> Result<(), SceneError> {
        let mut faults = Faults::default();
        if let WavyBody::Element(element) = self.on
            && element >= bearing.element_count
        {
            let (element, count) = (element as i64 + 1, bearing.element_count);
            faults.passes(Err(WavinessError::NoSuchElement { element, count }.into()));
        }
        faults.passes(WAVINESS_ORDER.check(f64::from(self.order)));
        faults.passes(WAVINESS_AMPLITUDE.check(self.amplitude));
        faults.passes(WAVINESS_ANGLE.check(self.crest));
        faults.into_result()
    }
}

impl WavyBody {
    /// Curvature (1/m) along rolling of the gap between this body and the other one, the flatter of two gaps.
    fn gap_curvature(self, bearing: &Bearing) -> f64 {
        let curvature = |radius: f64| 1.0 / bearing.element_radius() + 1.0 / radius;
        match self {
            Self::Inner => curvature(bearing.inner_raceway_radius()),
            Self::Outer | Self::Element(_) => curvature(-bearing.outer_raceway_radius()),
        }
    }
}
