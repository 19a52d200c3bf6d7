//! What can be wrong with waviness.

use crate::scene::WavyBody;

/// Waviness that cannot be, or not in this bearing.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum WavinessError {
    /// Waves between grooves at a contact angle.
    #[error(
        "[[waviness]] is given: it needs bearing.degrees_of_freedom 2, and there are {given}; waves at a contact angle \
         are not modelled, so far"
    )]
    InSpace { given: usize },
    /// An element that the bearing does not have.
    #[error("waviness.element is {element}: the bearing has elements 1 to {count}")]
    NoSuchElement { element: i64, count: usize },
    /// A wavy element on a ring with waves or defects, or an element with a defect on a wavy ring.
    #[error(
        "[[waviness]] of an element stands beside waves or defects of a ring, or that of a ring beside a defect of an \
         element: two surfaces that turn against each other under one contact are not modelled, so far"
    )]
    TwoUnderOneContact,
    /// Waves so steep that their forces are not those of small slopes.
    #[error(
        "slope of all waves of {} together (waviness.amplitude_um, waviness.order) is {slope}: it must be at most \
         {limit}, what is left out goes with its square; a deeper form is a defect with defect.profile",
        named(*body)
    )]
    TooSteep { body: WavyBody, slope: f64, limit: f64 },
    /// Waves so curved that the element does not follow them.
    #[error(
        "curvature of all waves of {} together (waviness.amplitude_um, waviness.order) is {share} of that of the gap: \
         it must be at most {limit}, or the element touches crests and does not follow; such a surface is a defect \
         with defect.profile",
        named(*body)
    )]
    TooCurved { body: WavyBody, share: f64, limit: f64 },
}

fn named(body: WavyBody) -> String {
    match body {
        WavyBody::Outer => "the outer raceway".to_owned(),
        WavyBody::Inner => "the inner raceway".to_owned(),
        WavyBody::Element(element) => format!("element {}", element + 1),
    }
}
