//! Which part is damaged and how long its spall is, from signals that are made here or simulated.
#![allow(clippy::unwrap_used)]

mod fault;
mod found_speed;
mod frequency_response;
mod length;
#[path = "../support/machine.rs"]
mod machine;
