//! Instants on which steps end: knots of profiles, and contacts that begin or end.

mod contact_changes;
mod crossings;
mod knots;

pub(in crate::simulation) use contact_changes::first_change;
pub(in crate::simulation) use crossings::{Crossing, first_crossing, watched};
pub(in crate::simulation) use knots::{Contact, Knot, Legs, next_knot};
