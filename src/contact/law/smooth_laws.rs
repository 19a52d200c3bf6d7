//! The laws of a bearing's contacts on smooth raceways.

use super::crown::Crown;
use super::elasticity::Elasticity;
use super::force_law::ForceLaw;
use crate::contact::rolling::RacewaySide;
use crate::geometry::hertz_constant::HertzConstants;
use crate::geometry::line_contact::{lamina_depths, line_constant_of};
use crate::scene::{Bearing, Damping};

/// Laws of the contacts with the smooth raceways, the inner one first, with this damping.
pub fn smooth_laws(bearing: &Bearing, damping: Damping) -> [ForceLaw; 2] {
    let Some(roller) = bearing.roller() else {
        let hertz = HertzConstants::of(bearing);
        return [hertz.inner, hertz.outer].map(|stiffness| ForceLaw {
            stiffness,
            elasticity: Elasticity::Point,
            damping,
        });
    };
    let depths = lamina_depths(roller, bearing.element_diameter);
    let straight = depths.iter().all(|&depth| depth == 0.0);
    let elasticity = if straight { Elasticity::Line } else { Elasticity::Crowned(Crown::shared(&depths)) };
    let law = ForceLaw { stiffness: line_constant_of(bearing, roller.length), elasticity, damping };
    [law.clone(), law]
}

/// Law of the contact with one smooth raceway, without damping: for whoever asks for approaches and forces alone.
pub fn elastic_law(bearing: &Bearing, side: RacewaySide) -> ForceLaw {
    smooth_laws(bearing, Damping::HuntCrossley(0.0))[side as usize].clone()
}
