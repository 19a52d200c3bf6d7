//! A contact map as bytes: little-endian, with version, fingerprint of the inputs and checksum.

use super::lookup::{Accuracy, Cell, ContactMap, Patch, Stretch, Strip};
use crate::contact::error::ContactError;
use crate::numerics::bytes::Reader;
use crate::numerics::checksum::checksum;

const MAGIC: &[u8; 8] = b"BRNL-MAP";
const VERSION: u32 = 2;

/// Length of what precedes the numbers: magic, version and fingerprint.
pub const HEAD: usize = 8 + 4 + 8;
/// Length of what follows them: the checksum.
pub const TAIL: usize = 8;

/// Bytes that begin as a file of maps does: what is stored is to follow, and then [`sealed`].
pub(super) fn begun(magic: &[u8; 8], version: u32, fingerprint: u64) -> Vec<u8> {
    let mut out = magic.to_vec();
    out.extend(version.to_le_bytes());
    out.extend(fingerprint.to_le_bytes());
    out
}

/// The same with the checksum.
pub(super) fn sealed(mut out: Vec<u8>) -> Vec<u8> {
    let sum = checksum(&out);
    out.extend(sum.to_le_bytes());
    out
}

/// What [`sealed`] bytes hold.
pub(super) struct Opened<'a> {
    /// Fingerprint of the inputs.
    pub(super) fingerprint: u64,
    /// What is stored.
    pub(super) body: Reader<'a>,
}

/// Reads [`sealed`] bytes.
pub(super) fn opened<'a>(bytes: &'a [u8], magic: &[u8; 8], version: u32) -> Result<Opened<'a>, ContactError> {
    let short = || refused("the file is too short");
    let (checked, sum) = bytes.split_last_chunk::<TAIL>().ok_or_else(short)?;
    let rest = checked.strip_prefix(magic).ok_or_else(|| refused("the file is not a contact map"))?;
    let mut body = Reader(rest);
    let found = body.u32().ok_or_else(short)?;
    if found != version {
        return Err(refused(&format!("the file has format {found}, this library reads {version}")));
    }
    if checksum(checked) != u64::from_le_bytes(*sum) {
        return Err(refused("the checksum does not fit, the file is damaged"));
    }
    let fingerprint = body.u64().ok_or_else(short)?;
    Ok(Opened { fingerprint, body })
}

pub(super) fn refused(reason: &str) -> ContactError {
    ContactError::MapRefused { reason: reason.to_owned() }
}

impl ContactMap {
    /// The map as bytes for [`ContactMap::from_bytes`].
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = begun(MAGIC, VERSION, self.fingerprint);
        let mut number = |value: f64| out.extend(value.to_le_bytes());
        let a = self.accuracy;
        for value in [self.largest_approach, a.max_normal, a.rms_normal, a.max_tangential, a.rms_tangential] {
            number(value);
        }
        number(a.points as f64);
        number(self.nodes as f64);
        number(self.stretches.len() as f64);
        for &knot in &self.knots {
            number(knot);
        }
        for stretch in &self.stretches {
            match stretch {
                Stretch::Flat(depth) => {
                    number(0.0);
                    number(*depth);
                }
                Stretch::Patch(patch) => {
                    number(patch.strips.len() as f64);
                    for value in [patch.start, patch.size[0], patch.size[1], patch.lowest] {
                        number(value);
                    }
                    for strip in &patch.strips {
                        number(strip.rows);
                        for value in strip.reference {
                            number(value);
                        }
                    }
                    // A cut cell is −1: its parts follow in the order of the cuts.
                    number(patch.cells.len() as f64);
                    for cell in &patch.cells {
                        number(match cell {
                            Cell::Leaf(leaf) => f64::from(*leaf),
                            Cell::Divided(_) => -1.0,
                        });
                    }
                    number(patch.leaves.len() as f64);
                    for &value in patch.leaves.iter().flatten().flatten() {
                        number(value);
                    }
                }
            }
        }
        sealed(out)
    }

    /// Reads a map made from the inputs with this fingerprint.
    ///
    /// # Errors
    /// [`ContactError::MapRefused`] for a file that is damaged, of another version, or made from other inputs.
    pub fn from_bytes(bytes: &[u8], fingerprint: u64) -> Result<Self, ContactError> {
        let map = Self::decode(bytes)?;
        map.check_fingerprint(fingerprint)?;
        Ok(map)
    }

    /// Refuses a map that was not made from the inputs with this fingerprint.
    ///
    /// # Errors
    /// [`ContactError::MapRefused`] for a map made from other inputs.
    pub fn check_fingerprint(&self, wanted: u64) -> Result<(), ContactError> {
        check_inputs(self.fingerprint, wanted)
    }

    /// Reads a map, whatever it was made from.
    ///
    /// # Errors
    /// [`ContactError::MapRefused`] for a file that is damaged or of another version.
    pub fn decode(bytes: &[u8]) -> Result<Self, ContactError> {
        let Opened { fingerprint, body } = opened(bytes, MAGIC, VERSION)?;
        read(body, fingerprint).filter(consistent).ok_or_else(|| refused("its contents contradict each other"))
    }
}

/// Refuses what was made from inputs with another fingerprint than the one wanted.
pub(super) fn check_inputs(found: u64, wanted: u64) -> Result<(), ContactError> {
    if found == wanted {
        return Ok(());
    }
    Err(refused("it was made for another defect, bearing, load range, accuracy or version"))
}

/// Finite numbers one after the other.
struct Numbers<'a>(Reader<'a>);

impl Numbers<'_> {
    fn number(&mut self) -> Option<f64> {
        self.0.f64().filter(|value| value.is_finite())
    }

    /// A count that the remaining bytes can hold.
    fn count(&mut self) -> Option<usize> {
        let value = self.number()?;
        let count = value as usize;
        (value >= 0.0 && count as f64 == value && count <= self.0.0.len() / 8).then_some(count)
    }
}

fn read(body: Reader<'_>, fingerprint: u64) -> Option<ContactMap> {
    let mut numbers = Numbers(body);
    let largest_approach = numbers.number()?;
    let mut accuracy = Accuracy {
        max_normal: numbers.number()?,
        rms_normal: numbers.number()?,
        max_tangential: numbers.number()?,
        rms_tangential: numbers.number()?,
        points: 0,
    };
    accuracy.points = numbers.number()? as usize;
    let nodes = numbers.number()? as usize;
    let count = numbers.count()?;
    let knots = (0..if count == 0 { 0 } else { count + 1 }).map(|_| numbers.number()).collect::<Option<Vec<_>>>()?;
    let stretches = (0..count).map(|_| read_stretch(&mut numbers)).collect::<Option<Vec<_>>>()?;
    numbers.0.0.is_empty().then_some(ContactMap { knots, stretches, nodes, largest_approach, accuracy, fingerprint })
}

fn read_stretch(numbers: &mut Numbers<'_>) -> Option<Stretch> {
    let count = numbers.count()?;
    if count == 0 {
        return Some(Stretch::Flat(numbers.number()?));
    }
    let (start, size, lowest) = (numbers.number()?, [numbers.number()?, numbers.number()?], numbers.number()?);
    let (mut strips, mut first) = (Vec::new(), 0);
    for _ in 0..count {
        let rows = numbers.count()?;
        let reference = [numbers.number()?, numbers.number()?, numbers.number()?, numbers.number()?];
        strips.push(Strip { reference, first, rows: rows as f64 });
        first += rows;
    }
    let count = numbers.count()?;
    let mut cells = Vec::new();
    let mut part = u32::try_from(first).ok()?;
    for _ in 0..count {
        let leaf = numbers.number()?;
        cells.push(if leaf < 0.0 {
            part += 4;
            Cell::Divided([part - 4, part - 3, part - 2, part - 1])
        } else {
            Cell::Leaf(leaf as u32)
        });
    }
    // All parts are there, and each lies behind the cell that was cut.
    let complete = part as usize == cells.len();
    let ordered = cells.iter().zip(0..).all(|(cell, n)| !matches!(cell, Cell::Divided(parts) if parts[0] <= n));
    let count = numbers.count()?;
    let mut leaves = Vec::new();
    for _ in 0..count {
        let mut cubic = [[0.0; 4]; 4];
        for value in cubic.iter_mut().flatten() {
            *value = numbers.number()?;
        }
        leaves.push(cubic);
    }
    let known = cells.iter().all(|cell| !matches!(cell, Cell::Leaf(leaf) if *leaf as usize >= leaves.len()));
    (complete && ordered && known).then(|| Stretch::Patch(Patch::new(start, size, lowest, strips, cells, leaves)))
}

/// What a lookup relies on.
fn consistent(map: &ContactMap) -> bool {
    let patch = |stretch: &Stretch| match stretch {
        Stretch::Flat(_) => true,
        Stretch::Patch(p) => p.size.iter().all(|&side| side > 0.0) && p.strips.iter().all(|strip| strip.rows > 0.0),
    };
    map.knots.is_sorted() && map.stretches.iter().all(patch)
}
