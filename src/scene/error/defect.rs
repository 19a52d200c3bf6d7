//! What can be wrong with a defect.

/// A defect that cannot exist, or not in this bearing.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum DefectError {
    /// A defect off the track of a roller, whose track is as wide as the roller.
    #[error("defect.tilt_deg is {tilt_deg}: it must be 0 on a roller, which touches over its whole length")]
    TiltOnRoller { tilt_deg: f64 },
    /// A spall as long as the raceway or longer.
    #[error(
        "spall length (defect.length_deg or defect.length_mm) is {length_mm} mm: it must be below {limit_mm} mm, \
         {limit}"
    )]
    SpallTooLong { length_mm: f64, limit_mm: f64, limit: &'static str },
    /// A spall into which no element sinks.
    #[error(
        "spall length (defect.length_deg or defect.length_mm) is {length_mm} mm: it must be at least {limit_mm} mm, a \
         thousandth of the element's diameter, or no element sinks into it"
    )]
    SpallTooShort { length_mm: f64, limit_mm: f64 },
    /// A spall as deep as the element's radius or deeper.
    #[error("spall depth (defect.depth_um) is {depth_um}: it must be below {limit_um}, {limit}")]
    SpallTooDeep { depth_um: f64, limit_um: f64, limit: &'static str },
    /// A defect of an element that the bearing does not have.
    #[error("defect.element is {element}: the bearing has elements 1 to {count}")]
    NoSuchElement { element: i64, count: usize },
    /// A pit so far off the rolling track that the track does not cross it.
    #[error(
        "defect length (defect.length_mm) is {length_mm}: at this defect.tilt_deg the rolling track crosses a pit only \
         if it is more than {limit_mm} across"
    )]
    PitNotMet { length_mm: f64, limit_mm: f64 },
    /// A measured profile off the rolling track.
    #[error(
        "defect.tilt_deg is {tilt_deg}: it must be 0 with defect.profile, which is measured along the rolling track"
    )]
    TiltedProfile { tilt_deg: f64 },
    /// Flanks that meet before they reach the floor.
    #[error(
        "spall depth (defect.depth_um) is {depth_um}: flanks of {edge_slope_deg} degrees (defect.edge_slope_deg) meet \
         at {limit_um} um in a spall of {length_mm} mm"
    )]
    FlanksMeet { depth_um: f64, edge_slope_deg: f64, limit_um: f64, length_mm: f64 },
    /// A softness of edges that the law knows nothing of.
    #[error(
        "contact.edge is \"step\" and contact.law is \"hertz\" (the default without a defect), which knows no edges: \
         it needs \"map\" or \"love\""
    )]
    EdgeOfHertz,
}
