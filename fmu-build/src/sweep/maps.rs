//! The contact maps of a sweep's runs: each is computed once, before the first run, on all threads, and kept in the
//! cache; runs share them, and each is in memory from the first run that needs it to the last.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use anyhow::{Context, Result, bail};
use brinell::contact::map::{ContactMap, ContactMaps};
use brinell::scene::{ContactLaw, Scene};
use brinell::simulation::setup;
use brinell::surface::Surface;

use crate::shared::{Project, contact_map};

/// Fingerprints of the maps that a scene needs; none where its law needs none.
pub(super) fn needed(scene: &Scene, profiles: &[Arc<str>]) -> Result<Vec<u64>> {
    if scene.contact.law != ContactLaw::Map || scene.defects.is_empty() {
        return Ok(Vec::new());
    }
    let surfaces = Surface::load_all(scene, profiles.iter().map(|text| &**text))?;
    Ok(setup::needed_maps(scene, &surfaces)?.iter().map(|needed| needed.fingerprint).collect())
}

/// A map in use.
struct Kept {
    /// How many runs have not taken it yet.
    runs: usize,
    map: Option<Arc<ContactMap>>,
}

/// The maps of a sweep.
pub(super) struct Maps<'p> {
    project: &'p Project,
    kept: Mutex<HashMap<u64, Kept>>,
    /// Why there is no map.
    failed: HashMap<u64, String>,
}

impl<'p> Maps<'p> {
    /// Maps that so many runs each need.
    pub(super) fn new(project: &'p Project, runs: HashMap<u64, usize>) -> Self {
        let kept = runs.into_iter().map(|(fingerprint, runs)| (fingerprint, Kept { runs, map: None })).collect();
        Self { project, kept: Mutex::new(kept), failed: HashMap::new() }
    }

    /// Puts the maps of a scene into the cache that are not there, on so many threads. What cannot be computed shows
    /// to the runs that need it.
    pub(super) fn prepare(&mut self, scene: &Scene, profiles: &[Arc<str>], threads: usize) -> Result<()> {
        let surfaces = Surface::load_all(scene, profiles.iter().map(|text| &**text))?;
        for needed in setup::needed_maps(scene, &surfaces)? {
            if self.failed.contains_key(&needed.fingerprint) {
                continue;
            }
            match contact_map::one(scene, &needed, self.project, threads) {
                Ok(_) => {}
                // A disk that is full is nothing that a run has to do with.
                Err(error) if error.is::<crate::shared::NotWritten>() => return Err(error),
                Err(error) => {
                    self.failed.insert(needed.fingerprint, format!("contact map: {error:#}"));
                }
            }
        }
        Ok(())
    }

    /// The maps with these fingerprints, for one run.
    pub(super) fn take(&self, fingerprints: &[u64]) -> Result<Option<Arc<ContactMaps>>> {
        if fingerprints.is_empty() {
            return Ok(None);
        }
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let mut maps = Vec::with_capacity(fingerprints.len());
        for fingerprint in fingerprints {
            if let Some(why) = self.failed.get(fingerprint) {
                bail!("{why}");
            }
            let one = kept.entry(*fingerprint).or_insert(Kept { runs: 1, map: None });
            let map = match &one.map {
                Some(map) => Arc::clone(map),
                None => {
                    let map = contact_map::kept(*fingerprint, self.project);
                    Arc::new(map.context("the contact map is no longer in the cache")?)
                }
            };
            one.runs = one.runs.saturating_sub(1);
            one.map = (one.runs > 0).then(|| Arc::clone(&map));
            maps.push(map);
        }
        Ok(Some(Arc::new(ContactMaps::shared(maps))))
    }
}
