//! What pages and notebooks show is what happens.

mod commands;
mod hours;
mod notebooks;
