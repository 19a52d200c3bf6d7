//! What scenes and profiles may say, and what is said of those that may not be.
#![allow(clippy::unwrap_used)]

mod answers;
mod bad_profile;
mod bad_scene;
mod good_scene;
mod ratings;
mod shipped_scenes;
