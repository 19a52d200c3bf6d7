//! The commands that print what a scene or a recording says, one file each.

pub mod catalogue;
pub mod check;
pub mod contact;
pub mod demo;
pub mod modes;
pub mod new_scene;
pub mod scenes;
pub mod schema;
pub mod size;
mod size_report;
pub mod stiffness;

pub use contact::On;

pub(crate) use new_scene::{Asked, Spall};
