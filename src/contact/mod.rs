//! Contact of one rolling element with a raceway. Knows no time, no cage and no ring: position and approach in, force
//! out.
//!
//! ```
//! use brinell::contact::element_on_raceway::ElementOnRaceway;
//! use brinell::contact::love::LoveContact;
//! use brinell::contact::love::Resolution;
//! use brinell::contact::rolling::RacewaySide;
//! use brinell::scene::Bearing;
//! use brinell::surface::{Profile, Surface};
//!
//! let bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3);
//! let spall = Surface::Profile(Profile::spall(2e-3, 50e-6, std::f64::consts::FRAC_PI_2));
//! let outer = ElementOnRaceway::of(&bearing, RacewaySide::Outer);
//! let mut contact = LoveContact::new(outer, &spall, 1e-5, Resolution { columns: 16, rows: 16 })?;
//! // A ball pressed by 5 µm, 3 mm from the middle of the spall: Hertz's contact on the smooth raceway.
//! let smooth = contact.solve(5e-6, 3e-3)?.value;
//! assert!((smooth - 5e-6).abs() < 1e-7);
//! // Its middle over the edge it is as if it were pressed less, and in the middle of the spall it touches nothing.
//! assert!(contact.solve(5e-6, 1e-3)?.value < 0.97 * smooth);
//! assert!(contact.solve(5e-6, 0.0)?.value < 0.0);
//! # Ok::<(), brinell::contact::error::ContactError>(())
//! ```

pub mod across;
pub mod element_on_raceway;
pub mod equivalent;
pub mod error;
pub mod groove;
pub mod law;
pub mod love;
pub mod map;
pub mod near_defect;
pub mod rolled_path;
pub mod rolling;
