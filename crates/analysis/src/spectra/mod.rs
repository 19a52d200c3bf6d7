//! Spectra of signals, and what is read out of them.

pub(crate) mod combs;
pub mod envelope_spectrum;
mod fault;
mod found_speed;
mod frequency_response;
mod lines;
mod order_spectrum;
pub(crate) mod other_speed;
pub(crate) mod shaft_lines;
mod strengths;

pub use combs::{Comb, Combs};
pub use envelope_spectrum::EnvelopeSpectrum;
pub use fault::{EXISTS, Fault, Grade};
pub use found_speed::{WIDEST, find_speed};
pub use frequency_response::{Fit, FrequencyResponse, ResponseError, response};
pub use order_spectrum::{EvenAngles, OrderSpectrum};
