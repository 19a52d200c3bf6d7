//! What an FMU is made of, and how it is packed.

pub mod archive;
pub mod description;
pub mod documentation;
pub mod fmu;
pub mod library;
pub mod model;
pub mod reference;
pub mod sensor_response;
mod template;

pub use archive::{Archive, ArchiveError, Compressed};
pub use fmu::write;
pub use library::{Binary, Choice, Library};
pub use model::{Model, Profile, SceneFiles, read_all, read_scene};
pub use reference::Reference;
pub use template::render;
