//! Common deep groove and angular contact ball bearings and cylindrical roller bearings by their catalogue's name.

mod clearance;
mod designation;
mod estimates;
mod in_scene;
mod name;
mod not_found;
mod suffixes;

pub use clearance::{ClearanceClass, ClearanceRange};
pub use designation::Designation;
pub use in_scene::name_remark;
pub use name::designation;
pub use not_found::NotInCatalogue;

use estimates::{angular_contact_bearings, ball_bearings, inserted, roller_bearings};

/// A bearing of the catalogue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CatalogueBearing {
    /// Its name.
    pub designation: &'static str,
    /// Bore, outside diameter and width (mm).
    pub boundary: [f64; 3],
    /// What is inside.
    pub inside: Inside,
}

/// The rolling elements of a bearing of the catalogue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inside {
    /// Number of balls or rollers.
    pub element_count: usize,
    /// Their diameter (mm).
    pub element_diameter: f64,
    /// Pitch diameter (mm).
    pub pitch_diameter: f64,
    /// Effective length of a roller (mm); `None` of balls.
    pub roller_length: Option<f64>,
    /// Contact angle of an angular contact bearing (°), by its letter.
    pub contact_angle: Option<f64>,
    /// Who has published that; `None` where it is estimated.
    pub source: Option<&'static str>,
}

/// What rolls, and whether it leans.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    DeepGroove,
    /// The same with a bore below 10 mm.
    Miniature,
    Angular,
    Roller,
}

/// All bearings of the catalogue: deep groove, insert, angular contact, cylindrical roller bearings.
pub fn catalogue() -> impl Iterator<Item = CatalogueBearing> {
    ball_bearings().chain(inserted()).chain(angular_contact_bearings()).chain(roller_bearings())
}

/// The bearing of a name as [`designation`] reads it; `None` if there is none.
///
/// ```
/// let bearing = brinell_scene_file::catalogued("6205-2RS").unwrap();
/// assert_eq!((bearing.boundary, bearing.inside.element_count), ([25.0, 52.0, 15.0], 9));
/// ```
pub fn catalogued(name: &str) -> Option<CatalogueBearing> {
    designation(name).ok().map(|read| read.bearing)
}

impl CatalogueBearing {
    /// Clearance of bearings of this kind and bore whose name says nothing: ISO 5753-1's class N; `None` where the
    /// contact angle gives it.
    pub fn normal_clearance(&self) -> Option<ClearanceRange> {
        let rollers = self.inside.roller_length.is_some();
        let class = self.inside.contact_angle.is_none().then_some(ClearanceClass::NORMAL)?;
        class.range(self.boundary[0], rollers)
    }
}
