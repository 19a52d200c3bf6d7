//! What a bearing is made of, as numbers of the equations, and what acts on it.

mod element_block;
mod excitation;
pub mod film;
mod irregularity;
mod kinematics;
mod layout;
mod model;
mod raceway;
mod ring_motion;
mod spatial;
mod supports;

pub use excitation::{COORDINATES, Cubic, Excitation, Frame, Frames, Quadratic, Turn, Turning, WholeAngle};
pub use irregularity::{Irregularity, Lead, LeadPieces};
pub use kinematics::{CageState, FramedKinematics, Kinematics, RingState};
pub use layout::Layout;
pub use model::Model;
pub use raceway::{Ahead, Cells, Centred, DefectiveElement, Defects, Raceway, SMOOTH, SurfaceDefect};
pub use spatial::{FEW_SPATIAL_BODIES, RINGS, RingInSpace, SPATIAL_BODIES, Space, SpatialBodies, force_slot};
pub use supports::{
    BODIES, Bodies, BodyMatrix, FEW_BODIES, PLANE_RINGS, SensorModes, SensorSupport, Support, Supports,
};

pub(crate) use kinematics::Stage;
pub(crate) use supports::StepEnds;

pub(in crate::dynamics) use element_block::ElementBlock;
pub(in crate::dynamics) use film::{FilmsNow, OilFilms};
pub(in crate::dynamics) use kinematics::{PathMotion, moved};
