//! How the force of a smooth contact grows with its approach: a point or a line, crowned, damped, on a compliant seat,
//! or separated by a film.

mod compliant;
mod crown;
mod elasticity;
mod force_law;
pub mod smooth_laws;
mod squeeze_film;

pub use compliant::CompliantContact;
pub use crown::{Carrying, Crown};
pub use elasticity::{Elastic, Elasticity, Line, Point};
pub use force_law::{DampedLaw, ForceLaw};
pub use smooth_laws::{elastic_law, smooth_laws};
pub use squeeze_film::SqueezeFilm;

pub(crate) use force_law::PUSHING_LENGTH;
