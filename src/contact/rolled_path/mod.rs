//! Law `hertz`: the path of a rigid element that rolls over a defect.

mod rigid_path;
mod rigid_roller;

pub use rigid_path::{PathPoint, RigidPath};
