//! The contacts of the elements with both raceways, and the forces in them.

mod element_forces;
mod element_motion;
mod forces;
mod kernel;
mod linearized;
mod meetings;
mod non_smooth_contacts;
mod own_elements;
mod record;
mod shortcuts;
mod smooth;

pub use forces::{Forces, RingForces, UnsolvedContact};
pub use record::Record;
pub use shortcuts::Shortcuts;

pub(in crate::dynamics) use element_forces::{BodyTorque, ContactForces, ElementForces};
pub(in crate::dynamics) use element_motion::ElementMotion;
pub(in crate::dynamics) use kernel::{InnerGap, Meeting, Near};
pub(in crate::dynamics) use linearized::{FirstOrder, Linearized};
pub(in crate::dynamics) use non_smooth_contacts::NonSmoothOuter;
