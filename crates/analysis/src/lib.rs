//! What an engineer reads out of a bearing's scene or a recording: stiffness, critical load, which part is damaged, the
//! length of a spall.

pub mod modes;
pub mod pressure;
pub mod questions;
pub mod recording;
pub mod sizing;
pub mod spectra;
pub mod statics;
pub mod statistics;

pub use brinell_spectrum as spectrum;
