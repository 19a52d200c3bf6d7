//! What a contact pushes with: elastic, by oil, and on a half-space over a defect.

pub mod growth;
pub mod half_space;
pub(crate) mod hertz;
pub mod oil;
