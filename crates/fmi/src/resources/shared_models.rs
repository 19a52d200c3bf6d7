//! The models of this process: each is read and set up once, for all instances that have the same resources.
//!
//! An instance begins, and begins anew, with a copy of the set-up. Its variable table and its contact map, by far the
//! largest parts, are not copied: nobody changes them. Two models that differ, but have equal maps, have one map too.
//!
//! Models are the same if their GUIDs are, a hash of scene and profile, and the labels of their maps. What is told
//! apart so cheaply is checked as a whole only when it is read first: a copy of a map that is damaged in its middle is
//! not checked while an instance that uses a sound one lives.
//!
//! A model goes with its last user, and the list with the last model, so nothing is left when the library is unloaded.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::{Arc, Mutex};

use super::error::ResourceError;
use brinell::contact::map::{ContactMaps, HEAD, TAIL};
use brinell::numerics::lists::opened;
use brinell::simulation::{Simulation, SimulationError};

/// What tells one stored map from another: length, head and tail, which hold version, fingerprint and checksum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Label {
    length: u64,
    head: [u8; HEAD],
    tail: [u8; TAIL],
}

impl Label {
    /// The label of a file's map. A file that is too short to have one is an error.
    fn read(file: &mut File) -> io::Result<Self> {
        let (mut head, mut tail) = ([0; HEAD], [0; TAIL]);
        file.read_exact(&mut head)?;
        let length = file.seek(SeekFrom::End(-(TAIL as i64)))? + TAIL as u64;
        file.read_exact(&mut tail)?;
        Ok(Self { length, head, tail })
    }
}

/// A file with a map.
#[derive(Debug)]
struct StoredMap<'p> {
    path: &'p Path,
    file: File,
    label: Label,
}

impl<'p> StoredMap<'p> {
    /// The map in this file; `None` if there is no such file.
    fn find(path: &'p Path) -> Result<Option<Self>, ResourceError> {
        match File::open(path) {
            Ok(mut file) => match Label::read(&mut file) {
                Ok(label) => Ok(Some(Self { path, file, label })),
                Err(cause) => Err(ResourceError::unreadable(path, cause)),
            },
            Err(cause) if cause.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(cause) => Err(ResourceError::unreadable(path, cause)),
        }
    }

    /// Reads and checks all of the file.
    fn read(&mut self) -> Result<ContactMaps, ResourceError> {
        let mut bytes = Vec::new();
        let all = self.file.rewind().and_then(|()| self.file.read_to_end(&mut bytes));
        all.map_err(|cause| ResourceError::unreadable(self.path, cause))?;
        Ok(ContactMaps::decode(&bytes).map_err(SimulationError::from)?)
    }
}

/// A model that is set up, and what it was made of.
#[derive(Debug)]
struct Model {
    guid: String,
    label: Option<Label>,
    map: Option<Arc<ContactMaps>>,
    /// Every variable at its start value.
    prototype: Simulation,
}

/// A model with the number of its users.
struct Entry {
    model: Arc<Model>,
    users: usize,
}

static MODELS: Mutex<Vec<Entry>> = Mutex::new(Vec::new());

/// The model of the list that is of this GUID and this map, with one more user.
fn used_again(models: &mut [Entry], guid: &str, label: Option<Label>) -> Option<SharedModel> {
    let known = models.iter_mut().find(|known| known.model.guid == guid && known.model.label == label)?;
    known.users += 1;
    Some(SharedModel(Arc::clone(&known.model)))
}

/// One user's part in a model.
#[derive(Debug)]
pub(crate) struct SharedModel(Arc<Model>);

impl SharedModel {
    /// The model of this GUID with the map in this file, if there is one: another user's, or what `set_up` makes of the
    /// map. Of users who come together each sets it up, and the first one's is that of all.
    pub(super) fn obtain(
        guid: String,
        map_file: &Path,
        set_up: impl FnOnce(Option<Arc<ContactMaps>>) -> Result<Simulation, SimulationError>,
    ) -> Result<Self, ResourceError> {
        let mut stored = StoredMap::find(map_file)?;
        let label = stored.as_ref().map(|stored| stored.label);
        let mut same_map = None;
        if let Some(mut models) = opened(&MODELS) {
            if let Some(known) = used_again(&mut models, &guid, label) {
                return Ok(known);
            }
            let of_map = models.iter().find(|known| label.is_some() && known.model.label == label);
            same_map = of_map.and_then(|known| known.model.map.clone());
        }
        let map = match (same_map, &mut stored) {
            (None, Some(stored)) => Some(Arc::new(stored.read()?)),
            (map, _) => map,
        };
        let prototype = set_up(map.clone())?;
        let model = Arc::new(Model { guid, label, map, prototype });
        // Without the list it is a model of this user alone.
        let Some(mut models) = opened(&MODELS) else { return Ok(Self(model)) };
        if let Some(first) = used_again(&mut models, &model.guid, label) {
            return Ok(first);
        }
        models.push(Entry { model: Arc::clone(&model), users: 1 });
        Ok(Self(model))
    }

    /// The GUID that belongs to the resources.
    pub(crate) fn guid(&self) -> &str {
        &self.0.guid
    }

    /// A simulation with all variables at their start values. On the heap: it is larger than a thread of a host may
    /// have stack to spare.
    pub(crate) fn simulation(&self) -> Box<Simulation> {
        Box::new(self.0.prototype.clone())
    }
}

impl Drop for SharedModel {
    fn drop(&mut self) {
        let Some(mut models) = opened(&MODELS) else { return };
        let mut last = None;
        if let Some(index) = models.iter().position(|known| Arc::ptr_eq(&known.model, &self.0)) {
            models[index].users -= 1;
            if models[index].users == 0 {
                last = Some(models.swap_remove(index));
            }
        }
        if models.is_empty() {
            *models = Vec::new();
        }
        drop(models);
        drop(last);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::resources::small_scene::SCENE;
    use std::fs;
    use std::path::PathBuf;

    fn user(guid: &str, map: &Path) -> Result<SharedModel, ResourceError> {
        let set_up = |_| Simulation::new(brinell_scene_file::from_toml(SCENE).unwrap(), None);
        SharedModel::obtain(guid.to_owned(), map, set_up)
    }

    /// A file with a map that has no stretches, known from others by its number.
    fn file(number: u64) -> PathBuf {
        let mut bytes = b"BRNL-MAP\x02\0\0\0".to_vec();
        bytes.extend(number.to_le_bytes());
        bytes.extend([0; 8 * 8]);
        let sum = brinell::numerics::checksum::checksum(&bytes);
        bytes.extend(sum.to_le_bytes());
        let path = std::env::temp_dir().join(format!("brinell-shared-map-{}-{number}.bin", std::process::id()));
        fs::write(&path, bytes).unwrap();
        path
    }

    /// Whether the list has a model of this GUID. Other tests of this program have their own.
    fn is_listed(guid: &str) -> bool {
        opened(&MODELS).unwrap().iter().any(|known| known.model.guid == guid)
    }

    #[test]
    fn equal_resources_are_one_model_until_the_last_user_is_gone() {
        let (one, other) = (file(81), file(82));
        let copy = one.with_extension("copy");
        // Miri knows no `fs::copy`.
        fs::write(&copy, fs::read(&one).unwrap()).unwrap();
        let (first, second, third) = (user("a", &one).unwrap(), user("a", &copy).unwrap(), user("a", &other).unwrap());
        assert!(Arc::ptr_eq(&first.0, &second.0));
        assert!(!Arc::ptr_eq(&first.0, &third.0));
        drop((first, third));
        assert!(is_listed("a"));
        drop(second);
        assert!(!is_listed("a"));
        [one, other, copy].iter().for_each(|path| fs::remove_file(path).unwrap());
    }

    #[test]
    fn models_that_differ_but_for_their_maps_have_one_map() {
        let path = file(83);
        let (first, second) = (user("b", &path).unwrap(), user("c", &path).unwrap());
        assert!(!Arc::ptr_eq(&first.0, &second.0));
        assert!(Arc::ptr_eq(first.0.map.as_ref().unwrap(), second.0.map.as_ref().unwrap()));
        fs::remove_file(path).unwrap();
    }

    #[test]
    fn a_damaged_map_is_refused_and_no_file_is_no_map() {
        let path = file(84);
        let mut bytes = fs::read(&path).unwrap();
        bytes[30] ^= 1;
        fs::write(&path, &bytes).unwrap();
        let refused = user("d", &path).unwrap_err().to_string();
        assert!(refused.contains("damaged"), "{refused}");
        for length in [0, 5, HEAD, HEAD + TAIL - 1] {
            fs::write(&path, &bytes[..length]).unwrap();
            assert!(user("d", &path).is_err(), "{length}");
        }
        fs::remove_file(&path).unwrap();
        assert!(user("d", &path).unwrap().0.map.is_none());
        assert!(!is_listed("d"));
    }

    #[test]
    fn users_that_come_and_go_in_eight_threads_leave_nothing() {
        let path = file(85);
        let rounds = if cfg!(miri) { 1 } else { 50 };
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    for _ in 0..rounds {
                        assert_eq!(user("e", &path).unwrap().simulation().time(), 0.0);
                    }
                });
            }
        });
        assert!(!is_listed("e"));
        fs::remove_file(path).unwrap();
    }
}
