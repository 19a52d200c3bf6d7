//! A contact map as bytes: little-endian, with version, fingerprint of the inputs and checksum.

use std::hash::Hasher;

use super::{
    error::ContactError,
    map::{Accuracy, Column, ContactMap, Patch, Stretch, Strip},
};

const MAGIC: &[u8; 8] = b"BRNL-MAP";
const VERSION: u32 = 1;

/// FNV-1a, 64 bits: guards against damage and mix-ups, not against malice.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fingerprint(u64);

impl Default for Fingerprint {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Hasher for Fingerprint {
    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

fn checksum(bytes: &[u8]) -> u64 {
    let mut hash = Fingerprint::default();
    hash.write(bytes);
    hash.finish()
}

impl ContactMap {
    /// The map as bytes for [`ContactMap::from_bytes`].
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = MAGIC.to_vec();
        out.extend(VERSION.to_le_bytes());
        out.extend(self.fingerprint.to_le_bytes());
        let mut number = |value: f64| out.extend(value.to_le_bytes());
        let a = self.accuracy;
        for value in [self.largest_approach, a.max_normal, a.rms_normal, a.max_tangential, a.rms_tangential] {
            number(value);
        }
        number(a.points as f64);
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
                    number(patch.start);
                    number(patch.width);
                    for strip in &patch.strips {
                        number(f64::from(strip.parts));
                        number(strip.path_step);
                        number(f64::from(strip.lowest));
                        for column in &patch.columns[strip.first..=strip.first + strip.parts as usize] {
                            number(column.reference[0]);
                            number(column.reference[1]);
                            number(column.count as f64);
                        }
                    }
                    for &value in patch.nodes.iter().flatten() {
                        number(value);
                    }
                }
            }
        }
        let sum = checksum(&out);
        out.extend(sum.to_le_bytes());
        out
    }

    /// Reads a map made from the inputs with this fingerprint.
    ///
    /// # Errors
    /// [`ContactError::MapRefused`] for a file that is damaged, of another version, or made from other inputs.
    pub fn from_bytes(bytes: &[u8], fingerprint: u64) -> Result<Self, ContactError> {
        let refused = |reason: &str| ContactError::MapRefused { reason: reason.to_owned() };
        let Some((body, sum)) = bytes.split_last_chunk::<8>() else { return Err(refused("the file is too short")) };
        let Some(rest) = body.strip_prefix(MAGIC) else { return Err(refused("the file is not a contact map")) };
        let Some((version, rest)) = rest.split_first_chunk::<4>() else { return Err(refused("the file is too short")) };
        let version = u32::from_le_bytes(*version);
        if version != VERSION {
            return Err(refused(&format!("the file has format {version}, this library reads {VERSION}")));
        }
        if checksum(body) != u64::from_le_bytes(*sum) {
            return Err(refused("the checksum does not fit, the file is damaged"));
        }
        let Some((own, rest)) = rest.split_first_chunk::<8>() else { return Err(refused("the file is too short")) };
        if u64::from_le_bytes(*own) != fingerprint {
            return Err(refused("it was made for another defect, bearing, load range, accuracy or version"));
        }
        read(rest, fingerprint).filter(consistent).ok_or_else(|| refused("its contents contradict each other"))
    }
}

/// Numbers one after the other.
struct Numbers<'a>(std::slice::ChunksExact<'a, u8>);

impl Numbers<'_> {
    fn number(&mut self) -> Option<f64> {
        let chunk = self.0.next()?;
        let value = f64::from_le_bytes(chunk.try_into().ok()?);
        value.is_finite().then_some(value)
    }

    /// A count that the remaining bytes can hold.
    fn count(&mut self) -> Option<usize> {
        let value = self.number()?;
        let count = value as usize;
        (value >= 0.0 && count as f64 == value && count <= self.0.len()).then_some(count)
    }
}

fn read(body: &[u8], fingerprint: u64) -> Option<ContactMap> {
    let mut numbers = Numbers(body.chunks_exact(8));
    let largest_approach = numbers.number()?;
    let mut accuracy = Accuracy {
        max_normal: numbers.number()?,
        rms_normal: numbers.number()?,
        max_tangential: numbers.number()?,
        rms_tangential: numbers.number()?,
        points: 0,
    };
    accuracy.points = numbers.number()? as usize;
    let count = numbers.count()?;
    let knots = (0..if count == 0 { 0 } else { count + 1 }).map(|_| numbers.number()).collect::<Option<Vec<_>>>()?;
    let stretches = (0..count).map(|_| read_stretch(&mut numbers)).collect::<Option<Vec<_>>>()?;
    let complete = numbers.0.next().is_none() && body.len().is_multiple_of(8);
    complete.then_some(ContactMap { knots, stretches, largest_approach, accuracy, fingerprint })
}

fn read_stretch(numbers: &mut Numbers<'_>) -> Option<Stretch> {
    let count = numbers.count()?;
    if count == 0 {
        return Some(Stretch::Flat(numbers.number()?));
    }
    let (start, width) = (numbers.number()?, numbers.number()?);
    let (mut strips, mut columns) = (Vec::new(), Vec::new());
    let mut at = 0;
    for _ in 0..count {
        let parts = numbers.count()?;
        let path_step = numbers.number()?;
        let lowest = numbers.number()? as i32;
        strips.push(Strip::new(columns.len(), i32::try_from(parts).ok()?, width, path_step, lowest));
        for _ in 0..=parts {
            let reference = [numbers.number()?, numbers.number()?];
            let count = numbers.count()?;
            columns.push(Column { reference, at, count });
            at += count;
        }
    }
    let mut nodes = Vec::new();
    for _ in 0..at {
        nodes.push([numbers.number()?, numbers.number()?, numbers.number()?, numbers.number()?]);
    }
    Some(Stretch::Patch(Patch { start, width, per_width: 1.0 / width, strips, columns, nodes }))
}

/// What a lookup relies on.
fn consistent(map: &ContactMap) -> bool {
    let patch = |stretch: &Stretch| match stretch {
        Stretch::Flat(_) => true,
        Stretch::Patch(p) => {
            p.width > 0.0 && p.strips.iter().all(|s| s.parts > 0 && s.arc_step > 0.0 && s.path_step > 0.0)
        }
    };
    map.knots.is_sorted() && map.stretches.iter().all(patch)
}
