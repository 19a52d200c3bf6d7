//! What differs from element to element, eight of them at a time.

use super::kinematics::CageState;
use crate::contact::law::{CompliantContact, ForceLaw, smooth_laws};
use crate::numerics::lanes::{WIDEST, padded};
use crate::numerics::sin_cos;
use crate::scene::Bearing;

/// What differs between elements, for eight of them; where there is none, all zeros.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub(in crate::dynamics) struct ElementBlock {
    /// cos and sin of the element's angle ahead of the nominal cage.
    pub(in crate::dynamics) cos: [f64; WIDEST],
    pub(in crate::dynamics) sin: [f64; WIDEST],
    /// 1 where there is an element.
    pub(in crate::dynamics) present: [f64; WIDEST],
    /// Mass (kg).
    pub(in crate::dynamics) mass: [f64; WIDEST],
    /// 1/mass (1/kg).
    pub(in crate::dynamics) per_mass: [f64; WIDEST],
    /// Diameter beyond the nominal one Δ (m): the element's centre is at R_o − r − Δ/2 where it touches the smooth
    /// outer raceway, and its clearance is G − Δ.
    pub(in crate::dynamics) larger: [f64; WIDEST],
    /// Constant K of the inner contact (N/m^n), n = 3/2 of balls and 10/9 of rollers.
    pub(in crate::dynamics) inner: [f64; WIDEST],
    /// That of the outer contact on the smooth rigid raceway; 0 for an element that is not on it.
    pub(in crate::dynamics) outer: [f64; WIDEST],
    /// Acceleration of w by an outer contact that is not on it (m/s²).
    pub(in crate::dynamics) other: [f64; WIDEST],
    /// Angle of the element ahead of its position in an even cage (rad).
    pub(in crate::dynamics) lead: [f64; WIDEST],
    /// Angular speed of the element about the outer ring's centre by that of the nominal cage.
    pub(in crate::dynamics) pace: [f64; WIDEST],
    /// How that changes with the nominal cage's angle (1/rad).
    pub(in crate::dynamics) pace_by_angle: [f64; WIDEST],
}

impl ElementBlock {
    /// Speed (rad/s) and acceleration (rad/s²) of an element about the outer ring's centre
    /// ([`Lead::speed`](super::irregularity::Lead::speed)).
    #[inline(always)]
    pub(in crate::dynamics) fn turning(&self, i: usize, cage: &CageState) -> [f64; 2] {
        let alpha = cage.acceleration * self.pace[i] + cage.speed * cage.speed * self.pace_by_angle[i];
        [cage.speed * self.pace[i], alpha]
    }
}

/// One element by itself: how large it is, and its contacts with the inner and the outer raceway.
#[derive(Debug, Clone)]
pub(in crate::dynamics) struct OwnElement {
    /// Diameter beyond the nominal one (m).
    larger: f64,
    /// Mass (kg).
    mass: f64,
    /// Contacts as its motion has them.
    pub(in crate::dynamics) contacts: [CompliantContact; 2],
    /// The same with their damping, of an element in balance.
    pub(in crate::dynamics) dampers: Option<[CompliantContact; 2]>,
}

impl OwnElement {
    /// Each element of a bearing whose elements are unequal, with these contacts of a nominal one; none of equal ones.
    ///
    /// Raceways and grooves keep their radii. Of a ball that is 1 µm larger in a 6205 Hertz's constants grow by 0.12 %,
    /// by the groove that is closer; of a roller neither the constant nor the crown changes.
    pub(super) fn all(
        bearing: &Bearing,
        contacts: [&CompliantContact; 2],
        dampers: Option<&[CompliantContact; 2]>,
    ) -> Box<[Self]> {
        let own = |&larger: &f64| {
            let bearing = bearing.with_elements_larger(larger);
            let stiffness = smooth_laws(&bearing, contacts[0].law.damping).map(|law| law.stiffness);
            let of = |side: usize, nominal: &CompliantContact| {
                let law = ForceLaw { stiffness: stiffness[side], ..nominal.law.clone() };
                CompliantContact { law, ..*nominal }
            };
            Self {
                larger,
                mass: bearing.mass_of_element(),
                contacts: [of(0, contacts[0]), of(1, contacts[1])],
                dampers: dampers.map(|[inner, outer]| [of(0, inner), of(1, outer)]),
            }
        };
        bearing.diameter_offsets.iter().map(own).collect()
    }
}

/// All elements of a bearing at these angles (rad) ahead of the cage, of this `mass` (kg) and with these constants of
/// the inner and the outer contact (N/m^n), except for those that are given by themselves.
pub(super) fn blocks(offsets: &[f64], mass: f64, [inner, outer]: [f64; 2], own: &[OwnElement]) -> Vec<ElementBlock> {
    let count = offsets.len();
    let mut blocks = vec![ElementBlock::default(); padded(count) / WIDEST];
    for (j, &offset) in offsets.iter().enumerate() {
        let (sin, cos) = sin_cos(offset);
        let (block, i) = (&mut blocks[j / WIDEST], j % WIDEST);
        (block.cos[i], block.sin[i], block.present[i], block.pace[i]) = (cos, sin, 1.0, 1.0);
        (block.mass[i], block.inner[i], block.outer[i]) = (mass, inner, outer);
        if let Some(OwnElement { larger, mass, contacts, .. }) = own.get(j) {
            (block.larger[i], block.mass[i]) = (*larger, *mass);
            [block.inner[i], block.outer[i]] = [0, 1].map(|side: usize| contacts[side].law.stiffness);
        }
        block.per_mass[i] = 1.0 / block.mass[i];
    }
    blocks
}
