//! The program `brinell` as its users run it: commands, options, what it writes and what it says.

mod answers;
#[path = "../common/mod.rs"]
mod common;
mod files;
mod messages;
mod pages;
mod reports;
mod run;
mod schema;
mod sweep;
mod whole_files;
