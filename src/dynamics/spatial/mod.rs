//! Rings with three and five degrees of freedom: balls that move along the bearing's axis as well, between grooves that
//! are shifted and tilted.
//!
//! It is a second instance beside the plane's: one text of a ball between two grooves, for every kind of number. Cage,
//! excitation, defects, supports of the plane, layout and methods of integration are shared.

mod ball;
mod right_hand_side;
mod tangent;

pub(in crate::dynamics) use ball::{BallForces, BallMotion, MOVING, accelerations, rates};
pub(in crate::dynamics) use tangent::Balls;
