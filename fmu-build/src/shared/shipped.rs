//! What is compiled into this program: the scenes of the repository and, in a program made for users, the model
//! libraries of all platforms. `build.rs` lists them.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail};
use brinell_scene_file::nearest;

use super::talk::note;
use super::whole_file;

include!(concat!(env!("OUT_DIR"), "/shipped.rs"));

/// The model libraries, by `<platform>.<extension>`; none in a program that builds them from source.
pub fn libraries() -> &'static [(&'static str, &'static [u8])] {
    LIBRARIES
}

/// Names of the shipped scenes, without extension.
pub fn scenes() -> impl Iterator<Item = &'static str> {
    SCENES.iter().filter_map(|(name, _)| name.strip_suffix(".toml"))
}

/// The text of a shipped file, by its whole name.
pub fn text(name: &str) -> Option<&'static str> {
    SCENES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// Which shipped scene was probably meant by a name, or which there are.
pub fn meant(name: &str) -> String {
    nearest(scenes(), name).map_or_else(
        || format!("shipped are {}", scenes().collect::<Vec<_>>().join(", ")),
        |near| format!("did you mean {near}? `brinell scenes` lists those that are shipped"),
    )
}

/// The files of a shipped scene, names and texts: its own, and those that it names.
pub fn files_of(scene: &str) -> Option<Vec<(&'static str, &'static str)>> {
    let own = SCENES.iter().find(|(file, _)| file.strip_suffix(".toml") == Some(scene))?;
    let named = |(file, _): &&(&str, &str)| own.1.contains(&format!("\"{file}\""));
    Some(std::iter::once(own).chain(SCENES.iter().filter(named)).copied().collect())
}

/// The text of a scene: of a file, which may be named without its `.toml`, or of a shipped scene by its bare name. A
/// file of that very name comes first.
///
/// # Errors
/// Of the system, with the path; of a bare name that is neither, with the scenes there are.
pub fn scene_text(path: &Path) -> Result<String> {
    let toml = whole_file::beside(path, ".toml");
    let without_ending = !path.is_file() && toml.is_file();
    if !path.exists()
        && let Some(name) = bare(path)
    {
        if let Some(text) = text(&format!("{name}.toml")) {
            if without_ending && !fs::read_to_string(&toml).is_ok_and(|own| own == text) {
                note!("note: {name} is the shipped scene; the file here, which differs, is {name}.toml");
            }
            return Ok(text.to_owned());
        }
        if path.extension().is_none() && !without_ending {
            bail!("{name}: neither a file nor a shipped scene; {}", meant(name));
        }
    }
    if without_ending {
        return fs::read_to_string(&toml).with_context(|| toml.display().to_string());
    }
    if !path.exists()
        && let Some(scene) = path.file_stem().and_then(|stem| stem.to_str())
        // Of a file in another folder nothing is guessed.
        && (bare(path).is_some_and(|name| name.ends_with(".toml")) || text(&format!("{scene}.toml")).is_some())
    {
        bail!("{}: no such file; {}", path.display(), missing(scene));
    }
    fs::read_to_string(path).with_context(|| path.display().to_string())
}

/// What to do where the file of a scene is not there.
fn missing(scene: &str) -> String {
    if text(&format!("{scene}.toml")).is_some() {
        return format!(
            "{scene} is a shipped scene: name it as {scene} alone, or write its file here by `brinell scenes {scene}`"
        );
    }
    nearest(scenes(), scene).map_or_else(
        || "`brinell scenes` lists those that are shipped".to_owned(),
        |near| format!("did you mean the shipped scene {near}?"),
    )
}

/// The text of a file that a scene names, beside the scene's own file or among the shipped ones.
///
/// # Errors
/// Of the system, with the path.
pub fn text_beside(scene: &Path, name: &str) -> Result<String> {
    let of_shipped = || {
        bare(scene).filter(|bare| text(&format!("{bare}.toml")).is_some())?;
        text(name)
    };
    if !scene.exists()
        && let Some(text) = of_shipped()
    {
        return Ok(text.to_owned());
    }
    let file = scene.parent().unwrap_or(Path::new("")).join(name);
    fs::read_to_string(&file).with_context(|| file.display().to_string())
}

/// The name of a path that is nothing but one.
fn bare(path: &Path) -> Option<&str> {
    path.to_str().filter(|_| path.parent() == Some(Path::new("")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_that_a_shipped_scene_names_is_shipped_with_it() {
        assert!(scenes().count() >= 12);
        for name in scenes() {
            let text = scene_text(Path::new(name)).unwrap();
            let mut wanted = vec![format!("{name}.toml")];
            for line in text.lines().filter(|line| line.starts_with("profile")) {
                let profile = line.split('"').nth(1).unwrap();
                assert!(!text_beside(Path::new(name), profile).unwrap().is_empty(), "{name}: {profile}");
                wanted.push(profile.to_owned());
            }
            // The scene first, its files by their names.
            wanted[1..].sort();
            let files: Vec<_> = files_of(name).unwrap().into_iter().map(|(file, _)| file.to_owned()).collect();
            assert_eq!(files, wanted);
        }
        assert!(text_beside(Path::new("no/6205-epps"), "6205-epps-trace.csv").is_err(), "another folder's scene");
    }
}
