//! The contacts of the elements with both raceways, and the forces in them.

pub mod contact_lanes;
mod element_contacts;
mod element_variation;
mod forces;
mod gap_lanes;
mod linearized;
mod non_smooth_contacts;

pub use contact_lanes::Record;
pub use forces::{Forces, UnsolvedContact};

pub(in crate::dynamics) use contact_lanes::Sums;
pub(in crate::dynamics) use element_contacts::{DIFFERENCE, InnerGap, Meeting};
pub(in crate::dynamics) use element_variation::ElementVariation;
pub(in crate::dynamics) use gap_lanes::{Distance, dot, radial};
pub(in crate::dynamics) use linearized::{Bends, ElementChange, Linearized};
pub(in crate::dynamics) use non_smooth_contacts::NonSmoothOuter;
