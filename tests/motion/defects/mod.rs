//! Defects of every body: one by one, several together, and a cage that turns back over them.

mod anywhere;
mod line_spall;
mod lines;
mod reversals;
mod several;
