//! The pressure of one contact on a fine grid, and the stresses below it.

mod conjugate_gradients;
mod contact_pressure;
mod defect_below;
mod fft_product;
mod grid;
mod report;
mod subsurface;

pub use conjugate_gradients::ConjugateGradients;
pub use contact_pressure::{BallOnRaceway, Hertz, Pressed, PressureError};
pub use defect_below::DefectBelow;
pub use fft_product::FftProduct;
pub use grid::{GridContact, GridProblem, at_force};
pub use report::{ContactReport, DentReport, Highest, PatchReport, Section, StressAt, StressReport};
pub use subsurface::{Corners, Stress, maximum};
