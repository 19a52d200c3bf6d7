//! How a row of the variable table is added, and what rows have in common.

use super::variables::{Causality, Kind, Unit, Variability, Variable};
use crate::scene::quantity;
use crate::scene::{ContactLaw, Motion, RepeatedInputs, Ring, Scene};
use crate::simulation::interface::quantity::{Quantity, RingName};
use crate::surface::Surface;

/// Items of the enumeration type of `contact.law`, the first having value 1.
pub(super) const CONTACT_LAWS: &[(&str, &str)] = &{
    let laws = ContactLaw::ALL;
    [laws[0].described(), laws[1].described(), laws[2].described()]
};

/// Items of the enumeration type of `host.repeated_inputs`.
pub(super) const REPEATED_INPUTS: &[(&str, &str)] =
    &[RepeatedInputs::ALL[0].described(), RepeatedInputs::ALL[1].described()];

/// A table in the making.
pub(super) struct Builder<'a> {
    pub(super) scene: &'a Scene,
    /// Surfaces of its defects.
    pub(super) surfaces: &'a [Surface],
    rows: Vec<(Variable, Quantity)>,
}

pub(super) const RINGS: [RingName; 2] = [RingName::Shaft, RingName::Housing];
/// Start value, limits and nominal value of a parameter, in its unit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limited {
    pub(in crate::simulation) start: f64,
    pub(super) min: f64,
    pub(super) max: f64,
    pub(super) nominal: f64,
}

impl Limited {
    /// What a scene may say a host may set.
    pub(super) fn of(quantity: &quantity::Quantity, start: f64, nominal: f64) -> Self {
        let [min, max] = quantity.si_limits();
        Self { start, min, max, nominal }
    }
}

impl<'a> Builder<'a> {
    /// A table without rows, with room for `count`.
    pub(in crate::simulation) fn new(scene: &'a Scene, surfaces: &'a [Surface], count: usize) -> Self {
        Self { scene, surfaces, rows: Vec::with_capacity(count) }
    }

    /// The rows added, in their order.
    pub(super) fn into_rows(self) -> Vec<(Variable, Quantity)> {
        self.rows
    }

    pub(super) fn motion(&self, ring: RingName) -> Motion {
        self.ring(ring).motion
    }

    /// A ring of the scene.
    pub(super) fn ring(&self, ring: RingName) -> Ring {
        [self.scene.shaft, self.scene.housing][ring.index()]
    }

    pub(in crate::simulation) fn parameter(
        &mut self,
        name: &str,
        text: &str,
        quantity: Quantity,
        unit: Unit,
        Limited { start, min, max, nominal }: Limited,
    ) {
        let kind = Kind::Real { unit, start: Some(start), min: Some(min), max: Some(max), nominal };
        self.push(name, text, kind, (Causality::Parameter, Variability::Fixed), quantity);
    }

    pub(super) fn push(
        &mut self,
        name: &str,
        text: &str,
        kind: Kind,
        causality: (Causality, Variability),
        quantity: Quantity,
    ) {
        let variable = Variable {
            name: name.to_owned(),
            description: text.to_owned(),
            reference: self.rows.len() as u32,
            kind,
            causality: causality.0,
            variability: causality.1,
        };
        self.rows.push((variable, quantity));
    }

    pub(super) fn output(&mut self, name: &str, text: &str, quantity: Quantity, unit: Unit, nominal: f64) {
        let kind = Kind::Real { unit, start: None, min: None, max: None, nominal };
        let variability = match quantity {
            // A mean belongs to a communication step.
            Quantity::MeanForce(..) | Quantity::NextMeanForce(..) => Variability::Discrete,
            Quantity::CouplingError | Quantity::LargestCouplingError => Variability::Discrete,
            _ => Variability::Continuous,
        };
        self.push(name, text, kind, (Causality::Output, variability), quantity);
    }
}
