//! Elementary functions with equal bits on every machine, where the standard library's may differ.

pub mod counter_noise;
pub mod elliptic;
pub(in crate::numerics) mod ninth_root;
pub(in crate::numerics) mod power;
pub(in crate::numerics) mod trigonometry;
