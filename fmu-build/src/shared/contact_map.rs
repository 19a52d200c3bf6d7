//! Contact maps: computed on several threads with a progress bar, kept in the cache by the fingerprint of their
//! inputs.

use std::fs;
use std::path::PathBuf;
use std::thread;

use anyhow::Result;
use brinell::contact::error::ContactError;
use brinell::contact::map::{ContactMap, ContactMaps, Runner};
use brinell::contact::rolling::RacewaySide;
use brinell::scene::{ContactLaw, Scene};
use brinell::simulation::setup::{self, NeededMap};
use brinell::surface::Surface;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::project::Project;
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

/// The map with this fingerprint, if the cache has it.
pub(crate) fn kept(fingerprint: u64, project: &Project) -> Option<ContactMap> {
    ContactMap::from_bytes(&fs::read(cache_file(project, fingerprint)).ok()?, fingerprint).ok()
}

/// One map, computed on so many threads and kept by its own fingerprint: scenes with the same surface share it.
pub(crate) fn one(scene: &Scene, needed: &NeededMap, project: &Project, threads: usize) -> Result<ContactMap> {
    let file = cache_file(project, needed.fingerprint);
    if let Some(map) = kept(needed.fingerprint, project) {
        return Ok(map);
    }
    let mut cores = Cores { pool: ThreadPoolBuilder::new().num_threads(threads).build()?, bar: bar(&scene.name) };
    let map = needed.build(&mut cores)?;
    cores.bar.finish_and_clear();
    let (reached, wanted) = (map.accuracy().max(), setup::map_specification(scene, RacewaySide::Outer).accuracy);
    if reached > 1.5 * wanted {
        eprintln!(
            "contact map of {}: error up to {reached:.1e} of the largest force, {wanted:.0e} was wanted; more cells \
             (contact.cells) may help, and a scene that gives contact.map_accuracy refuses such a map",
            scene.name
        );
    }
    whole_file::write(&file, map.to_bytes())?;
    Ok(map)
}

fn cache_file(project: &Project, fingerprint: u64) -> PathBuf {
    project.cache().join("maps").join(format!("{fingerprint:016x}.bin"))
}

fn bar(name: &str) -> ProgressBar {
    let style = ProgressStyle::with_template("contact map of {msg} [{bar:30}] {pos}/{len} columns, {elapsed}");
    let bar = ProgressBar::new(0).with_message(name.to_owned());
    if let Ok(style) = style { bar.with_style(style) } else { bar }
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
