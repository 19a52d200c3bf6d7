//! Natural frequencies, damping ratios and mode shapes of a scene's assembly over the cage angle.

mod assembly;
mod defect_edge_angles;
mod eigenmodes;
mod lines;
mod report;

pub use assembly::{Assembly, Body, DefectPosition, Hold, loaded};
pub use eigenmodes::{Kind, Mode, Modes, ModesError};
pub use lines::sweep;
pub use report::{AngleReport, LineReport, ModeReport, ModesReport};
