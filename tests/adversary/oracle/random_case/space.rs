//! What random scenes have beyond a defect of an outer raceway at rest.

use crate::case::{Case, Defect, On, Shape};
use crate::draw::Draw;

/// Which scenes are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Space {
    OuterRaceway,
    Whole,
}

impl Space {
    /// The body with the defect.
    pub(crate) fn body(self, draw: &mut Draw, count: usize) -> On {
        match self {
            Self::OuterRaceway => On::Outer,
            Self::Whole => match draw.below(10) {
                0..3 => On::Outer,
                3..7 => On::Inner,
                _ => On::Element { element: draw.below(count), tilt_deg: 0.0 },
            },
        }
    }

    /// How many defects there are besides the first.
    pub(super) fn more(self, draw: &mut Draw) -> usize {
        match self {
            Self::OuterRaceway => 0,
            Self::Whole => [0, 0, 0, 0, 0, 0, 0, 1, 1, 2][draw.below(10)],
        }
    }

    /// Whether the defect is one that varies across the track.
    pub(super) fn topography(self, draw: &mut Draw) -> bool {
        self == Self::Whole && draw.chance(0.02)
    }

    /// Moves some pits of elements off the track, as far as it still meets them and their flanks do not.
    pub(crate) fn tilt(self, draw: &mut Draw, defect: &mut Defect, r: f64) {
        let (On::Element { tilt_deg, .. }, Shape::Spall { length, depth_um, slope_deg }) =
            (&mut defect.on, &defect.shape)
        else {
            return;
        };
        if self == Self::OuterRaceway || draw.chance(0.5) {
            return;
        }
        let length = length.on(r);
        let off = draw.unit() * length / (2.0 * r);
        let met = (length * length - 4.0 * r * r * off * off).sqrt();
        if off < 1.0 && depth_um * 1e-6 < 0.49 * met * slope_deg.to_radians().tan().abs() {
            *tilt_deg = off.asin().to_degrees() * draw.sign();
        }
    }

    /// Speeds of the rings against each other, initial angles and how clearance and spin are said.
    pub(super) fn way(self, draw: &mut Draw, case: &mut Case) -> [f64; 2] {
        if self == Self::OuterRaceway {
            return [1.0, 0.0];
        }
        case.catalogue = draw.chance(0.3);
        if draw.chance(0.7) {
            case.rings_deg[0] = draw.between(-400.0, 400.0);
        }
        if draw.chance(0.5) {
            case.rings_deg[1] = draw.between(-400.0, 400.0);
        }
        if !case.defective_elements().is_empty() && draw.chance(0.2) {
            case.spin_slip = draw.between(-1.0, 1.0);
        }
        if draw.chance(0.6) {
            return [1.0, 0.0];
        }
        case.housing_hz = Some(0.0);
        if draw.chance(0.3) { [0.0, 1.0] } else { [1.0, draw.log(0.05, 3.0) * draw.sign()] }
    }
}

/// What a body is called in the tables.
pub(super) fn body_name(on: On) -> &'static str {
    match on {
        On::Outer => "outer raceway",
        On::Inner => "inner raceway",
        On::Element { tilt_deg: 0.0, .. } => "element",
        On::Element { .. } => "element, off the track",
    }
}

/// The same of several.
pub(super) fn bodies_name(defects: &[Defect]) -> &'static str {
    if defects.iter().all(|defect| defect.on.is_body_of(defects[0].on)) {
        "several, one body"
    } else {
        "several bodies"
    }
}
