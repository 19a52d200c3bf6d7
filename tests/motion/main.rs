//! How bearings move: against laws of mechanics, closed forms and each other.

mod between_runs;
mod by_name;
mod cage;
mod clearance;
#[path = "../support/counting.rs"]
mod counting;
mod coupling;
mod defect_lines;
mod defects_anywhere;
mod derivatives;
#[path = "../element_inertia/mod.rs"]
mod element_inertia;
mod exactness;
mod exchange;
mod fastest_eigenvalue;
mod film;
mod line_spall;
mod modes;
mod physics;
mod recorder;
mod recorder_filter;
mod reversals;
mod rollers_in_motion;
mod sensor_modes;
mod sensors;
mod several_defects;
mod starts;
mod stiffness;
#[path = "../support/mod.rs"]
mod support;
mod trajectories;
mod unequal_elements;
mod waviness;
