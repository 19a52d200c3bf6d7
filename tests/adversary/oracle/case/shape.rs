//! What a defect's shape is as a file's text, and how long it is.

use super::{Length, Shape, Topography};

impl Shape {
    /// Text of its file, if it is from one.
    pub fn csv(&self) -> Option<String> {
        match self {
            Self::Spall { .. } => None,
            Self::Trace(points) => {
                let lines: String = points.iter().map(|(arc, depth)| format!("{arc},{depth}\n")).collect();
                Some(format!("arc_mm,depth_um\n{lines}"))
            }
            Self::Topography(Topography { arcs, axials, depths }) => {
                let coordinates = |k: usize| format!("{},{}", arcs[k / axials.len()], axials[k % axials.len()]);
                let lines: String =
                    depths.iter().enumerate().map(|(k, depth)| format!("{},{depth}\n", coordinates(k))).collect();
                Some(format!("arc_mm,axial_mm,depth_um\n{lines}"))
            }
        }
    }

    /// Its length along a body of this radius (m).
    pub fn length(&self, bearer: f64) -> f64 {
        let range = |arcs: [f64; 2]| (arcs[1] - arcs[0]) * 1e-3;
        match self {
            Self::Spall { length: Length::Millimetres(length), .. } => length * 1e-3,
            Self::Spall { length: Length::Degrees(degrees), .. } => degrees.to_radians() * bearer,
            Self::Trace(points) => range([points[0].0, points[points.len() - 1].0]),
            Self::Topography(topography) => range([topography.arcs[0], topography.arcs[topography.arcs.len() - 1]]),
        }
    }
}

impl Length {
    /// In metres, along a body of this radius.
    pub fn on(self, radius: f64) -> f64 {
        match self {
            Self::Degrees(degrees) => degrees.to_radians() * radius,
            Self::Millimetres(length) => length * 1e-3,
        }
    }
}
