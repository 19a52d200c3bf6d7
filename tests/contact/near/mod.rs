//! One contact near a defect: the path of a rigid element, and the half-space on either raceway.

mod inner;
mod rigid_path;
mod second_derivatives;
mod whole_raceway;
