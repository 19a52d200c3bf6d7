//! Bearings in balance: where runs start from, elements without inertia, stiffness, modes.

mod clearance;
mod element_inertia;
mod modes;
mod starts;
mod stiffness;
