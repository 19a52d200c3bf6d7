//! The FMU's folder `resources/`, read once for all instances of a process.

mod error;
mod folder;
mod shared_models;
#[cfg(test)]
mod small_scene;

pub(crate) use error::ResourceError;
pub(crate) use folder::load;
pub(crate) use shared_models::SharedModel;
#[cfg(test)]
pub(crate) use small_scene::SCENE;
