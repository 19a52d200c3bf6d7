//! The table `[waviness]` of the scene file, or several of them as `[[waviness]]`.

use super::defects::Body;
use super::faults::{Faults, TableFault};
use brinell::scene::{SceneError, Waviness, WavinessError, WavyBody};
use schemars::JsonSchema;
use serde::Deserialize;

/// Waves around a body.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WavinessTable {
    /// The body that has them.
    #[serde(default)]
    on: Body,
    /// Which element, from 1; waves on an element need it.
    element: Option<i64>,
    /// Waves in one turn around the body.
    order: u32,
    /// Height of a crest over the mean.
    amplitude_um: f64,
    /// Where a crest is at the start, the radius largest, counter-clockwise from +x; on an element 0 faces the outer
    /// raceway.
    angle_deg: f64,
}

impl WavinessTable {
    pub(super) fn into_waves(self, count: usize) -> Result<Waviness, Faults> {
        const ELEMENT: &str = "waviness.element";
        let on = match (self.on, self.element) {
            (Body::Element, None) => {
                return Err(TableFault::Missing { key: ELEMENT, why: "waviness.on is \"element\"" }.into());
            }
            (Body::Element, Some(number)) => {
                let element = usize::try_from(number).ok().filter(|number| (1..=count).contains(number));
                let none = WavinessError::NoSuchElement { element: number, count };
                WavyBody::Element(element.ok_or(SceneError::from(none))? - 1)
            }
            (_, Some(number)) => return Err(TableFault::NotOnElement { key: ELEMENT, value: number as f64 }.into()),
            (Body::Outer, None) => WavyBody::Outer,
            (Body::Inner, None) => WavyBody::Inner,
        };
        Ok(Waviness { on, order: self.order, amplitude: self.amplitude_um / 1e6, crest: self.angle_deg.to_radians() })
    }
}
