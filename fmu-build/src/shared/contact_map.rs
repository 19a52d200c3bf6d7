//! Contact maps: computed on several threads with a progress bar, kept in the cache by the fingerprints of their inputs
//! and of the code that computes them.

use std::path::PathBuf;
use std::{fs, thread};

use anyhow::Result;
use brinell::contact::error::ContactError;
use brinell::contact::map::{ContactMap, ContactMaps, REFUSED, Runner};
use brinell::contact::rolling::RacewaySide;
use brinell::scene::{ContactLaw, Scene};
use brinell::simulation::setup::{self, NeededMap};
use brinell::surface::Surface;
use indicatif::ProgressBar;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::project::Project;
use super::talk::{self, detail, note};
use super::whole_file;

/// The bytes of a scene's contact map, `None` where its law or its healthy raceway needs none.
pub fn of<'p>(
    scene: &Scene,
    profiles: impl IntoIterator<Item = &'p str>,
    project: &Project,
) -> Result<Option<Vec<u8>>> {
    if scene.defects.is_empty() || scene.contact.law != ContactLaw::Map {
        return Ok(None);
    }
    let surfaces = Surface::load_all(scene, profiles)?;
    let needed = setup::needed_maps(scene, &surfaces)?;
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let maps = needed.iter().map(|needed| one(scene, needed, project, threads)).collect::<Result<Vec<_>>>()?;
    Ok(Some(ContactMaps::new(maps).to_bytes()))
}

/// The map with this fingerprint, if the cache has it of this program's code.
pub(crate) fn kept(fingerprint: u64, project: &Project) -> Option<ContactMap> {
    ContactMap::from_bytes(&fs::read(cache_file(project, fingerprint)).ok()?, fingerprint).ok()
}

/// One map, computed on so many threads and kept by its own fingerprint: scenes with the same surface share it.
pub(crate) fn one(scene: &Scene, needed: &NeededMap, project: &Project, threads: usize) -> Result<ContactMap> {
    let file = cache_file(project, needed.fingerprint);
    if let Some(map) = kept(needed.fingerprint, project) {
        detail!("contact map of {}: {}", scene.name, file.display());
        return Ok(map);
    }
    let mut cores = Cores { pool: ThreadPoolBuilder::new().num_threads(threads).build()?, bar: bar(&scene.name) };
    let map = needed.build(&mut cores)?;
    cores.bar.finish_and_clear();
    let (reached, wanted) = (map.accuracy().max(), setup::map_specification(scene, RacewaySide::Outer).accuracy);
    if reached > REFUSED * wanted {
        note!(
            "contact map of {}: error up to {reached:.1e} of the largest force, {wanted:.0e} was wanted; more cells \
             (contact.cells) may help, and a scene that gives contact.map_accuracy refuses such a map",
            scene.name
        );
    }
    whole_file::write(&file, map.to_bytes())?;
    Ok(map)
}

fn cache_file(project: &Project, fingerprint: u64) -> PathBuf {
    project.cache().join("maps").join(format!("{fingerprint:016x}-{}.bin", env!("BRINELL_MAP_SOURCES")))
}

fn bar(name: &str) -> ProgressBar {
    talk::bar(0, "contact map of {msg} [{bar:30}] {pos}/{len} columns, {elapsed}").with_message(name.to_owned())
}

/// Runs jobs on several threads; results keep their order, so the map has the same bits however many there are.
struct Cores {
    pool: ThreadPool,
    bar: ProgressBar,
}

impl Runner for Cores {
    fn run<T: Send>(
        &mut self,
        count: usize,
        job: &(dyn Fn(usize) -> Result<T, ContactError> + Sync),
    ) -> Result<Vec<T>, ContactError> {
        self.bar.inc_length(count as u64);
        let job = |index| job(index).inspect(|_| self.bar.inc(1));
        // Every job is done, and the error is that of the first by index, whichever thread failed first.
        let results: Vec<_> = self.pool.install(|| (0..count).into_par_iter().with_max_len(1).map(job).collect());
        results.into_iter().collect()
    }
}

#[cfg(test)]
#[path = "../../map_sources.rs"]
mod map_sources;
#[cfg(test)]
mod tests {
    use super::*;
    use crate::package::model;

    /// A scene whose map takes little time.
    fn scene(folder: &std::path::Path) -> Scene {
        let file = folder.join("coarse.toml");
        let (text, _) = model::read_scene("er16k-tb1".as_ref()).unwrap();
        let coarse = "[contact]\ncells = [24, 12]\nmap_accuracy = 0.05\nlargest_force_n = 200.0";
        fs::write(&file, text.replace("[contact]", coarse)).unwrap();
        model::read_scene(&file).unwrap().1
    }

    #[test]
    fn a_map_that_other_code_has_computed_is_computed_anew() {
        let folder = tempfile::tempdir().unwrap();
        let project = Project::at(folder.path());
        let scene = scene(folder.path());
        let maps = || of(&scene, [], &project).unwrap().unwrap();
        let kept_files = || fs::read_dir(project.cache().join("maps")).unwrap().count();
        let first = maps();
        let surfaces = Surface::load_all(&scene, []).unwrap();
        let fingerprint = setup::needed_maps(&scene, &surfaces).unwrap()[0].fingerprint;
        assert!(kept(fingerprint, &project).is_some());
        assert_eq!((maps() == first, kept_files()), (true, 1));
        // As earlier programs named it, and as this one would with another constant somewhere.
        let own = cache_file(&project, fingerprint);
        let of_others = [format!("{fingerprint:016x}.bin"), format!("{fingerprint:016x}-{:016x}.bin", 1)];
        for name in of_others {
            fs::rename(&own, own.with_file_name(name)).unwrap();
            assert!(kept(fingerprint, &project).is_none());
            let before = kept_files();
            assert_eq!((maps() == first, kept_files()), (true, before + 1));
        }
    }

    #[test]
    fn any_change_of_the_code_below_a_map_is_another_fingerprint_and_a_change_elsewhere_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let put = |name: &str, text: &str| {
            let file = folder.path().join(name);
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            fs::write(file, text).unwrap();
        };
        let found = || map_sources::fingerprint(folder.path()).unwrap();
        let below = |source: &str| if source == "Cargo.lock" { source.into() } else { format!("{source}/deep/x.rs") };
        let files = map_sources::SOURCES.map(below);
        files.iter().for_each(|file| put(file, "const SHARE: f64 = 0.17;"));
        let first = found();
        put("src/dynamics/x.rs", "const SHARE: f64 = 0.18;");
        assert_eq!(found(), first);
        for file in files {
            put(&file, "const SHARE: f64 = 0.18;");
            assert_ne!(found(), first, "{file}");
            put(&file, "const SHARE: f64 = 0.17;");
            assert_eq!(found(), first, "{file}");
        }
        put("src/contact/new.rs", "");
        assert_ne!(found(), first);
    }

    #[test]
    fn this_program_knows_the_fingerprint_of_the_code_that_it_was_built_from() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        assert_eq!(map_sources::fingerprint(&root).unwrap(), env!("BRINELL_MAP_SOURCES"));
    }
}
