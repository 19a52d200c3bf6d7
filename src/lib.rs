//! The physics of a rolling bearing with a real surface defect: contact, dynamics, integration.
//!
//! A [`Scene`](scene::Scene) describes a bearing and its surroundings, from a file or from Rust; a
//! [`Simulation`](simulation::Simulation) steps it. A host that moves the shaft itself sets inputs between steps.
//!
//! ```
//! use brinell::scene::{Bearing, ContactLaw, Scene};
//! use brinell::simulation::Simulation;
//!
//! // A 6205 with a spall of 2 mm under its load, 25 turns a second.
//! let scene = Scene::builder(Bearing::steel_balls(9, 7.94e-3, 39.04e-3))
//!     .shaft_speed(157.1)
//!     .shaft_load([0.0, -1500.0])
//!     .spall(-std::f64::consts::FRAC_PI_2, 2e-3, 50e-6)
//!     .law(ContactLaw::Hertz)
//!     .build()?;
//! let mut simulation = Simulation::new(scene, None)?;
//! simulation.initialize(0.0)?;
//! simulation.set("shaft.load.y", -1600.0)?;
//! simulation.step(1e-4)?;
//! assert!(simulation.get("shaft.y")? < 0.0);
//! # Ok::<(), brinell::Error>(())
//! ```
//!
//! Data flows one way through the modules, and a module imports only from those above it:
//! `numerics → scene → geometry → surface → contact → dynamics → simulation → recording`.
#![cfg_attr(doc, doc = "\n")]
#![cfg_attr(doc, doc = include_str!("../docs/explanation/theory.md"))]
#![cfg_attr(doc, doc = concat!("<script>\n", include_str!("../docs/math.js"), "</script>"))]
#![cfg_attr(doc, doc = concat!("<script>\n", include_str!("../docs/rustdoc.js"), "</script>"))]

pub mod contact;
pub mod dynamics;
pub mod geometry;
pub mod numerics;
pub mod recording;
pub mod scene;
pub mod simulation;
pub mod surface;

pub use simulation::SimulationError as Error;

/// The example in README.md compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
