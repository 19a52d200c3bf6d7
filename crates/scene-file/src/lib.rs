//! Scenes in TOML files, for people: every key carries its unit, which is converted to SI units here and nowhere else.
//!
//! [`from_toml`] reads a file into a checked [`Scene`]; what it refuses it reports at once, each fault with its line,
//! its value, the limit, and the nearest word that is known. [`unit_questions`] asks about values that look as if they
//! were in another unit.

mod catalogue;
mod diagnosis;
mod quantities;
mod rivals;
mod schema;
mod spelling;
mod tables;
mod units;

pub use catalogue::{
    CatalogueBearing, ClearanceClass, ClearanceRange, Designation, Inside, NotInCatalogue, catalogue, catalogued,
    designation, name_remark,
};
pub use diagnosis::{Hint, KeyFault, SceneFileError, toml_fault};
pub use rivals::replaces;
pub use schema::{description, schema};
pub use spelling::nearest;
pub use units::{UnitQuestion, UnitRemark};

use brinell::scene::Scene;

/// Reads the text of a scene file and checks it.
///
/// ```
/// let text = r#"
///     name = "6205"
///     [bearing]
///     catalogue = "6205"
///     [shaft]
///     motion = "internal"
///     speed_hz = 25.0
///     load_n = [0.0, -1500.0]
///     [housing]
///     motion = "internal"
/// "#;
/// assert_eq!(brinell_scene_file::from_toml(text)?.bearing.element_count, 9);
///
/// let fault = brinell_scene_file::from_toml(&text.replace("25.0", "\"fast\"")).unwrap_err();
/// assert!(fault.to_string().contains("speed_hz"));
/// # Ok::<(), brinell_scene_file::SceneFileError>(())
/// ```
///
/// # Errors
/// Broken TOML; unknown, missing and contradicting keys and every value that [`Scene::check`] refuses, all of them at
/// once, as far as one does not hide the other.
pub fn from_toml(text: &str) -> Result<Scene, SceneFileError> {
    diagnosis::scene_of(text)
}

/// Values of a scene file that are far from what is usual, and would be usual in another unit. What is no scene file
/// has none.
pub fn unit_questions(text: &str) -> Vec<UnitRemark> {
    diagnosis::unit_questions(text)
}
