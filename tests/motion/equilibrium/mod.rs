//! Bearings in balance: where runs start from, stiffness, modes.

mod clearance;
mod modes;
mod starts;
mod stiffness;
