//! Brinell turns a rolling bearing with a real surface defect into an FMI 2.0 co-simulation unit.
//!
//! Data flows one way through the modules, and a module imports only from those above it:
//! `numerics → scene → geometry → surface → contact → dynamics → simulation → recording → fmi2`.
//! `analysis` is a leaf: it may import everything but `fmi2`, and nothing imports it.

// Units in brackets, as in `[m]`, are no links.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod analysis;
pub mod contact;
pub mod dynamics;
pub mod fmi2;
pub mod geometry;
pub mod numerics;
pub mod recording;
pub mod scene;
pub mod simulation;
pub mod surface;
