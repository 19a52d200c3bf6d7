//! What an FMU holds: archive, library, licences, description, reference results.

mod archive;
#[path = "../common/mod.rs"]
mod common;
mod library;
mod licenses;
mod model_description;
mod reference;
