//! Commands that report on a scene, on a recording or on the paper.

mod contact;
mod modes;
mod paper;
pub(crate) mod size;
mod stiffness;
