//! The table `[defect]` of the scene file, or several of them as `[[defect]]`.

use super::faults::{Faults, TableFault, only_one};
use super::profile::ProfileTable;
use brinell::scene::{Bearing, Defect, DefectError, DefectOn, DefectShape, SceneError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

const EDGE_SLOPE_DEG: f64 = 90.0;

/// A defect.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DefectTable {
    /// The body that has it.
    #[serde(default)]
    on: Body,
    /// Which element, from 1; a defect on an element needs it.
    element: Option<i64>,
    /// How far the defect of a ball lies off its rolling track.
    #[schemars(extend("default" = 0.0))]
    tilt_deg: Option<f64>,
    /// Where its middle is at the start, counter-clockwise from +x; on an element 0 faces the outer raceway.
    angle_deg: f64,
    /// Length as an angle about the centre of the body; this or length_mm, without a profile. A host that sets another
    /// clearance keeps the length, not the angle.
    length_deg: Option<f64>,
    /// Length of the arc; instead of the angle.
    length_mm: Option<f64>,
    /// Depth of the floor; needed without a profile.
    depth_um: Option<f64>,
    /// Slope of the edges.
    #[schemars(extend("default" = EDGE_SLOPE_DEG))]
    edge_slope_deg: Option<f64>,
    /// File of a measured trace or topography, instead of length and depth; as a table with what is done to it.
    profile: Option<ProfileTable>,
}

/// The body that has a defect or waves.
#[derive(JsonSchema, Serialize, Deserialize, Default, Clone, Copy, PartialEq)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Body {
    #[default]
    Outer,
    Inner,
    Element,
}

const DEGREES: &str = "defect.length_deg";
const MILLIMETRES: &str = "defect.length_mm";

impl DefectTable {
    fn on(&self, bearing: &Bearing) -> Result<DefectOn, Faults> {
        if self.on != Body::Element {
            let given =
                [("defect.element", self.element.map(|number| number as f64)), ("defect.tilt_deg", self.tilt_deg)];
            if let Some((key, value)) = given.into_iter().find_map(|(key, value)| value.map(|value| (key, value))) {
                return Err(TableFault::NotOnElement { key, value }.into());
            }
        }
        Ok(match self.on {
            Body::Outer => DefectOn::Outer,
            Body::Inner => DefectOn::Inner,
            Body::Element => {
                const MISSING: TableFault =
                    TableFault::Missing { key: "defect.element", why: "defect.on is \"element\"" };
                let (number, count) = (self.element.ok_or(MISSING)?, bearing.element_count);
                let element = usize::try_from(number).ok().filter(|number| (1..=count).contains(number));
                let none = DefectError::NoSuchElement { element: number, count };
                let element = element.ok_or(SceneError::from(none))? - 1;
                DefectOn::Element { element, tilt: self.tilt_deg.unwrap_or(0.0).to_radians() }
            }
        })
    }

    pub(super) fn into_defect(self, bearing: &Bearing) -> Result<Defect, Faults> {
        let on = self.on(bearing)?;
        let angle = self.angle_deg.to_radians();
        only_one(&[
            ("defect.profile", self.profile.is_some()),
            (DEGREES, self.length_deg.is_some()),
            (MILLIMETRES, self.length_mm.is_some()),
            ("defect.depth_um", self.depth_um.is_some()),
            ("defect.edge_slope_deg", self.edge_slope_deg.is_some()),
        ])?;
        let shape = match self.profile {
            Some(table) => DefectShape::Profile(table.into_measured()),
            None => DefectShape::Spall {
                length: spall_length(self.length_deg, self.length_mm, on.radius(bearing))?,
                depth: self
                    .depth_um
                    .ok_or(TableFault::Neither { first: "defect.depth_um", second: "defect.profile" })?
                    / 1e6,
                edge_slope: self.edge_slope_deg.unwrap_or(EDGE_SLOPE_DEG).to_radians(),
            },
        };
        Ok(Defect { on, angle, shape })
    }
}

fn spall_length(degrees: Option<f64>, millimetres: Option<f64>, radius: f64) -> Result<f64, TableFault> {
    match (degrees, millimetres) {
        (Some(degrees), _) => Ok(degrees.to_radians() * radius),
        (None, Some(millimetres)) => Ok(millimetres / 1e3),
        (None, None) => Err(TableFault::Neither { first: DEGREES, second: MILLIMETRES }),
    }
}
