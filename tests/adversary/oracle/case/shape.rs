//! What defects are as a scene file's tables and as files of their own, and how long they are.

use super::{Defect, Length, On, Shape, Topography};
use std::fmt::Write;

/// The tables of a scene's defects.
pub(crate) fn tables(defects: &[Defect]) -> String {
    let mut text = String::new();
    let title = if defects.len() == 1 { "[defect]" } else { "[[defect]]" };
    for (number, defect) in defects.iter().enumerate() {
        writeln!(text, "{title}\nangle_deg = {:?}", defect.angle_deg).unwrap();
        match defect.on {
            On::Outer => {}
            On::Inner => text.push_str("on = \"inner\"\n"),
            On::Element { element, tilt_deg } => {
                writeln!(text, "on = \"element\"\nelement = {}\ntilt_deg = {tilt_deg:?}", element + 1).unwrap();
            }
        }
        match &defect.shape {
            Shape::Spall { length, depth_um, slope_deg } => {
                match length {
                    Length::Degrees(degrees) => writeln!(text, "length_deg = {degrees:?}").unwrap(),
                    Length::Millimetres(length) => writeln!(text, "length_mm = {length:?}").unwrap(),
                }
                writeln!(text, "depth_um = {depth_um:?}\nedge_slope_deg = {slope_deg:?}").unwrap();
            }
            Shape::Trace(_) | Shape::Topography(_) => writeln!(text, "profile = \"trace-{number}.csv\"").unwrap(),
        }
    }
    text
}

/// Texts of their files, in the order of the defects.
pub(crate) fn files(defects: &[Defect]) -> Vec<String> {
    defects.iter().filter_map(|defect| defect.shape.csv()).collect()
}

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
