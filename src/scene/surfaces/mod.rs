//! What raceways and elements are beyond their radius: defects and waves.

mod defect;
mod waviness;

pub use defect::{Defect, DefectLimit, DefectOn, DefectShape, Measured, MeasuredForm, MeasuredLevel};
pub use waviness::{Waviness, WavyBody};
