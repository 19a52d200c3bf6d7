//! What can be wrong with a defect.

/// A defect that cannot exist, or not in this bearing.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DefectError {
    /// A defect off the track of a roller, whose track is as wide as the roller.
    #[error("defect.tilt_deg is {tilt_deg}: it must be 0 on a roller, which touches over its whole length")]
    TiltOnRoller {
        /// Tilt (°).
        tilt_deg: f64,
    },
    /// A spall as long as the raceway or longer.
    #[error(
        "spall length (defect.length_deg or defect.length_mm) is {length_mm} mm: it must be below {limit_mm} mm, \
         {limit}"
    )]
    SpallTooLong {
        /// Length (mm).
        length_mm: f64,
        /// Limit (mm).
        limit_mm: f64,
        /// What that is.
        limit: &'static str,
    },
    /// A spall into which no element sinks.
    #[error(
        "spall length (defect.length_deg or defect.length_mm) is {length_mm} mm: it must be at least {limit_mm} mm, a \
         thousandth of the element's diameter, or no element sinks into it"
    )]
    SpallTooShort {
        /// Length (mm).
        length_mm: f64,
        /// Limit (mm).
        limit_mm: f64,
    },
    /// A spall as deep as the element's radius or deeper.
    #[error("spall depth (defect.depth_um) is {depth_um}: it must be below {limit_um}, {limit}")]
    SpallTooDeep {
        /// Depth (µm).
        depth_um: f64,
        /// Limit (µm).
        limit_um: f64,
        /// What that is.
        limit: &'static str,
    },
    /// A defect of an element that the bearing does not have.
    #[error("defect.element is {element}: the bearing has elements 1 to {count}")]
    NoSuchElement {
        /// Number given, from 1.
        element: i64,
        /// Number of elements.
        count: usize,
    },
    /// A pit so far off the rolling track that the track does not cross it.
    #[error(
        "defect length (defect.length_mm) is {length_mm}: at this defect.tilt_deg the rolling track crosses a pit only \
         if it is more than {limit_mm} across"
    )]
    PitNotMet {
        /// Diameter (mm).
        length_mm: f64,
        /// Diameter at which its rim touches the track (mm).
        limit_mm: f64,
    },
    /// A measured profile off the rolling track.
    #[error(
        "defect.tilt_deg is {tilt_deg}: it must be 0 with defect.profile, which is measured along the rolling track"
    )]
    TiltedProfile {
        /// Tilt (°).
        tilt_deg: f64,
    },
    /// A key that belongs to a defect of an element.
    #[error("{key} is {value}: only a defect with defect.on = \"element\" has it")]
    NotOnElement {
        /// The key.
        key: &'static str,
        /// What was given.
        value: f64,
    },
    /// Flanks that meet before they reach the floor.
    #[error(
        "spall depth (defect.depth_um) is {depth_um}: flanks of {edge_slope_deg} degrees (defect.edge_slope_deg) meet \
         at {limit_um} um in a spall of {length_mm} mm"
    )]
    FlanksMeet {
        /// Depth (µm).
        depth_um: f64,
        /// Steepness of the flanks (°).
        edge_slope_deg: f64,
        /// Depth at which they meet (µm).
        limit_um: f64,
        /// Length (mm).
        length_mm: f64,
    },
    /// A softness of edges that the law knows nothing of.
    #[error(
        "contact.edge is \"step\" and contact.law is \"hertz\" (the default without a defect), which knows no edges: \
         it needs \"map\" or \"love\""
    )]
    EdgeOfHertz,
}

impl DefectError {
    /// Whether it follows from the bearing's dimensions, so that it means nothing where those are not known.
    pub(super) fn is_of_dimensions(&self) -> bool {
        matches!(
            self,
            Self::SpallTooLong { .. }
                | Self::SpallTooShort { .. }
                | Self::SpallTooDeep { .. }
                | Self::NoSuchElement { .. }
                | Self::PitNotMet { .. }
                | Self::FlanksMeet { .. }
        )
    }
}
