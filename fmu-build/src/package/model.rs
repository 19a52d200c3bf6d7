//! A scene file, read and set up: all that an FMU of it is made of, except the compiled library.

use std::collections::BTreeSet;
use std::fmt::Display;
use std::path::Path;

use anyhow::{Context, Result};
use brinell::dynamics::parameters::film;
use brinell::geometry::kinematics::frequencies;
use brinell::scene::{Bearing, Defect, DefectShape, Plain, Scene};
use brinell::simulation::Simulation;
use brinell::simulation::interface::table::guid;
use brinell::simulation::setup::{track_width, with_operating_angle};
use brinell::surface::{Surface, with_roller_profile};
use brinell_analysis::questions::{BesideTrack, NotPressed, as_measured};
use brinell_scene_file::UnitQuestion;

use super::sensor_response;
use crate::package::reference::Reference;
use crate::shared::{Project, contact_map, note, shipped};

/// A scene that was read, with its files' texts and a simulation of it.
#[derive(Debug, Clone)]
pub struct Model {
    /// The scene.
    pub scene: Scene,
    /// The scene file's text, as it goes into the FMU.
    pub scene_text: String,
    /// The profile files that defects name, in the order of the defects.
    pub profiles: Vec<Profile>,
    /// The contact map, where the scene's law needs one.
    pub map: Option<Vec<u8>>,
    /// A simulation of the scene, not initialized.
    pub simulation: Simulation,
    /// The reference run, where one is to go along with the FMU.
    pub reference: Option<Reference>,
}

/// A defect's profile file.
#[derive(Debug, Clone)]
pub struct Profile {
    /// Its name, relative to the scene file.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// Reads a scene file, or a shipped scene by its name: its text, with the modes of sensors' responses, and the scene.
/// An error names the file.
pub fn read_scene(path: &Path) -> Result<(String, Scene)> {
    let about = || path.display().to_string();
    let text = shipped::scene_text(path)?;
    let resolved = sensor_response::resolved(&text, |name| shipped::text_beside(path, name));
    let text = resolved.map_err(|error| sensor_response::beside_other_faults(error, &text)).with_context(about)?;
    let scene = brinell_scene_file::from_toml(&text).with_context(about)?;
    Ok((text, scene))
}

/// What is possible and unusual in a scene of this text.
pub fn remarks(text: &str, scene: &Scene) -> impl Iterator<Item = String> {
    let of_units = brinell_scene_file::unit_questions(text).into_iter().map(|remark| remark.to_string());
    let of_name = brinell_scene_file::name_remark(text).into_iter();
    of_units
        .chain(of_name)
        .chain(scene.remarks().into_iter().chain(film::remark(scene)).map(|remark| remark.to_string()))
}

/// By how much the contact angle under which balls run moves their passages, which a catalogue does not say; the scene
/// says the angle.
pub(crate) fn operating_angle(scene: &Scene) -> Option<String> {
    let angle = scene.bearing.given_operating_angle().filter(|angle| *angle != 0.0)?;
    let flat = Bearing { operating_angle: Some(0.0), ..scene.bearing.clone() };
    let [here, there] = [&scene.bearing, &flat].map(|bearing| frequencies(bearing, 0.0, 1.0).bpfo);
    let more = 100.0 * (here / there - 1.0);
    Some(format!(
        "balls run at a contact angle of {:.1} degrees and pass the outer raceway {more:.2} % more often than a \
         catalogue without it says",
        angle.to_degrees()
    ))
}

/// Asks about a measured surface of the scene in the file of this name. Errors in it are reported where it is read.
pub(crate) fn tell_surface(scene: &Scene, name: &str, text: &str) {
    let scene = &*with_operating_angle(scene);
    let names = |defect: &&Defect| matches!(&defect.shape, DefectShape::Profile(named) if named.file == name);
    let mut told: BTreeSet<String> = BTreeSet::new();
    for defect in scene.defects.iter().filter(names) {
        let Ok(surface) = Surface::load(defect, Some(text), &scene.bearing) else { return };
        let deepest = surface.depths().map(f64::abs).fold(0.0, f64::max);
        if let Some(question) = UnitQuestion::of(&scene.bearing, "defect.depth_um", 1e6 * deepest) {
            told.insert(format!("its depths reach {} um: {question}", Plain(question.value)));
        }
        let track = track_width(scene, defect.on);
        let measured = as_measured(&surface, defect.on, &scene.bearing, 0.5 * (track[0] + track[1]));
        told.extend(measured.iter().map(ToString::to_string));
        told.extend(BesideTrack::of(scene, defect.on, &surface).map(|beside| beside.to_string()));
    }
    for one in told {
        note!("note: {name}: {one}");
    }
}

/// What is to be asked where nothing presses at a defect. Errors are reported where the scene is set up.
pub(crate) fn not_pressed<'p>(scene: &Scene, profiles: impl IntoIterator<Item = &'p str>) -> Option<NotPressed> {
    let profiles: Vec<&str> = profiles.into_iter().collect();
    let scene = with_roller_profile(scene, profiles.iter().copied()).ok()?;
    NotPressed::of(&scene, &Surface::load_all(&scene, profiles).ok()?)
}

/// Asks about a value that is given elsewhere than in a scene, as a scene's `key` would be.
pub(crate) fn ask_unit(bearing: &Bearing, key: &str, value: f64, about: impl Display) {
    if let Some(question) = UnitQuestion::of(bearing, key, value) {
        note!("note: {about} = {}: {question}", Plain(value));
    }
}

/// A scene with the files that it is read from.
#[derive(Debug)]
pub struct SceneFiles {
    /// Text of the scene's file.
    pub text: String,
    /// The scene.
    pub scene: Scene,
    /// The profiles that it names.
    pub profiles: Vec<Profile>,
}

/// Reads a scene as [`read_scene`] does, and the profiles beside it; what is unusual in it is noted.
pub fn read_all(path: &Path) -> Result<SceneFiles> {
    let (text, scene) = read_scene(path)?;
    for remark in remarks(&text, &scene) {
        note!("note: {}: {remark}", path.display());
    }
    let profile = |name: &str| anyhow::Ok(Profile { name: name.to_owned(), text: shipped::text_beside(path, name)? });
    let profiles = scene.profile_names().into_iter().map(profile).collect::<Result<Vec<_>>>()?;
    for Profile { name, text } in &profiles {
        tell_surface(&scene, name, text);
    }
    Ok(SceneFiles { text, scene, profiles })
}

impl Model {
    /// Reads a scene file, or a shipped scene by its name, and the profile beside it. An error names the file.
    pub fn read(path: &Path) -> Result<Self> {
        Self::of_files(read_all(path)?, &path.display().to_string())
    }

    /// A scene of this text, which names no other files; `about` names it in messages.
    pub fn of_text(text: String, about: &str) -> Result<Self> {
        let scene = brinell_scene_file::from_toml(&text).with_context(|| about.to_owned())?;
        for question in brinell_scene_file::unit_questions(&text) {
            note!("note: {about}: {question}");
        }
        Self::of_files(SceneFiles { text, scene, profiles: Vec::new() }, about)
    }

    fn of_files(files: SceneFiles, about: &str) -> Result<Self> {
        let about = || about.to_owned();
        let SceneFiles { text: scene_text, scene, profiles } = files;
        let texts = || profiles.iter().map(|profile| profile.text.as_str());
        if let Some(asked) = not_pressed(&scene, texts()) {
            note!("note: {}: {asked}", about());
        }
        let map = contact_map::of(&scene, texts(), &Project::find()).with_context(about)?;
        let simulation = Simulation::with_map(scene.clone(), texts(), map.as_deref()).with_context(about)?;
        Ok(Self { scene, scene_text, profiles, map, simulation, reference: None })
    }

    /// Texts of the profile files.
    pub fn profile_texts(&self) -> impl Iterator<Item = &str> {
        self.profiles.iter().map(|profile| profile.text.as_str())
    }

    /// The identity that library and description agree on; it changes with every byte of scene or profile.
    pub fn guid(&self) -> String {
        guid(&self.scene_text, self.profile_texts())
    }
}
