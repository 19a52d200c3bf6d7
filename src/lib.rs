//! The physics of a rolling bearing with a real surface defect.
//!
//! Data flows one way through the modules, and a module imports only from those above it:
//! `numerics → scene → geometry → surface → contact → dynamics → simulation → recording`.

// Units in brackets, as in `[m]`, are no links.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod contact;
pub mod dynamics;
pub mod geometry;
pub mod numerics;
pub mod recording;
pub mod scene;
pub mod simulation;
pub mod surface;
