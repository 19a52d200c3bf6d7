//! The program `brinell` as its users run it: commands, options, what it writes and what it says.

mod answers;
mod commands;
#[path = "../common/mod.rs"]
mod common;
mod contact;
mod hours;
mod manners;
mod many_elements;
mod messages;
mod modes;
mod notebooks;
mod paper;
mod run_figure;
mod run_motion;
mod run_options;
mod run_page;
mod run_player;
mod schema;
mod size;
mod stiffness;
mod sweep;
mod whole_files;
