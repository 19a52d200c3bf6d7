//! The contact maps of one scene: one for each surface on a ring, two for one on an element, which meets both raceways.
//!
//! As bytes one map is itself; several are kept together, with a head and a checksum like a map's.

use std::hash::Hasher;
use std::sync::Arc;

use super::format::{HEAD, Opened, TAIL, begun, check_inputs, opened, refused, sealed};
use super::lookup::{Accuracy, ContactMap};
use crate::contact::error::ContactError;
use crate::numerics::checksum::Checksum;

const MAGIC: &[u8; 8] = b"BRNL-MPS";
const VERSION: u32 = 1;

/// Maps in the order of the surfaces, of each the inner raceway's first.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactMaps(Vec<Arc<ContactMap>>);

impl ContactMaps {
    /// One map or several.
    pub fn new(maps: impl IntoIterator<Item = ContactMap>) -> Self {
        Self(maps.into_iter().map(Arc::new).collect())
    }

    /// Maps that others may use as well.
    pub fn shared(maps: Vec<Arc<ContactMap>>) -> Self {
        Self(maps)
    }

    /// The map made from the inputs with this fingerprint.
    pub fn find(&self, fingerprint: u64) -> Option<&Arc<ContactMap>> {
        self.0.iter().find(|map| map.fingerprint() == fingerprint)
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Fingerprint of maps with these fingerprints.
    pub fn fingerprint_of(fingerprints: &[u64]) -> u64 {
        if let [one] = fingerprints {
            return *one;
        }
        let mut hash = Checksum::default();
        fingerprints.iter().for_each(|part| hash.write(&part.to_le_bytes()));
        hash.finish()
    }

    /// Fingerprint of all inputs.
    pub fn fingerprint(&self) -> u64 {
        let each: Vec<u64> = self.0.iter().map(|map| map.fingerprint()).collect();
        Self::fingerprint_of(&each)
    }

    /// Accuracy of the worst of them.
    pub fn accuracy(&self) -> Accuracy {
        let each = self.0.iter().map(|map| map.accuracy());
        each.reduce(|worst, other| if other.max() > worst.max() { other } else { worst }).unwrap_or_default()
    }

    /// The maps as bytes for [`from_bytes`](Self::from_bytes).
    pub fn to_bytes(&self) -> Vec<u8> {
        if let [one] = &self.0[..] {
            return one.to_bytes();
        }
        let mut out = begun(MAGIC, VERSION, self.fingerprint());
        for map in &self.0 {
            let bytes = map.to_bytes();
            out.extend((bytes.len() as u64).to_le_bytes());
            out.extend(bytes);
        }
        sealed(out)
    }

    /// Reads maps made from the inputs with this fingerprint.
    ///
    /// # Errors
    /// [`ContactError::MapRefused`] for bytes that are damaged, of another version, or made from other inputs.
    pub fn from_bytes(bytes: &[u8], fingerprint: u64) -> Result<Self, ContactError> {
        let maps = Self::decode(bytes)?;
        maps.check_fingerprint(fingerprint)?;
        Ok(maps)
    }

    /// Refuses maps that were not made from the inputs with this fingerprint.
    ///
    /// # Errors
    /// [`ContactError::MapRefused`].
    pub fn check_fingerprint(&self, wanted: u64) -> Result<(), ContactError> {
        check_inputs(self.fingerprint(), wanted)
    }

    /// Reads maps, whatever they were made from.
    ///
    /// # Errors
    /// [`ContactError::MapRefused`] for bytes that are damaged or of another version.
    pub fn decode(bytes: &[u8]) -> Result<Self, ContactError> {
        if !bytes.starts_with(MAGIC) {
            return Ok(Self::new([ContactMap::decode(bytes)?]));
        }
        let short = || refused("the file is too short");
        if bytes.len() < HEAD + TAIL {
            return Err(short());
        }
        let Opened { fingerprint, mut body } = opened(bytes, MAGIC, VERSION)?;
        let mut maps = Vec::new();
        while !body.0.is_empty() {
            let length = body.u64().and_then(|length| usize::try_from(length).ok()).ok_or_else(short)?;
            maps.push(ContactMap::decode(body.bytes(length).ok_or_else(short)?)?);
        }
        let maps = Self::new(maps);
        if maps.fingerprint() == fingerprint { Ok(maps) } else { Err(refused("its contents contradict each other")) }
    }
}
