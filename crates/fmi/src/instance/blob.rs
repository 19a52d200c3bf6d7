//! A saved state as bytes that can be put into another instance, in another process, on another machine of the same
//! byte order or not: everything is little-endian.
//!
//! ```text
//! "Brinell\0" | format u32 | checksum u64 | length u64 | GUID 38 | mode u8 | last step u8 | clock u8 + 6 f64 | ...
//!                                         \_____________ covered by the checksum, with the simulation's state after it
//! ```
//! `length` is that of the whole blob. The checksum is 64-bit FNV-1a: each of its steps is a bijection of the running
//! value, so a blob that differs in a single byte never passes.

use super::clock::Clock;
use super::mode::Mode;
use super::snapshot::Snapshot;
use crate::c_interface::Status;
use brinell::numerics::bytes::Reader;
use brinell::numerics::checksum::checksum;
use brinell::simulation::Simulation;

const MAGIC: &[u8; 8] = b"Brinell\0";
/// Raised whenever the layout, here or in the simulation's state, changes.
const FORMAT: u32 = 8;
const GUID_LENGTH: usize = 38;
const CHECKED_FROM: usize = 8 + 4 + 8;
/// Numbers of the clock.
const TIMES: usize = 6;

/// Why bytes are refused as a state.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub(crate) enum BlobError {
    /// Not begun like a state.
    #[error("these bytes are not a serialized state of a Brinell FMU")]
    Foreign,
    /// Another layout.
    #[error("serialized state of format {found}: this FMU reads format {FORMAT}; serialize it anew with this version")]
    Format { found: u32 },
    /// Shorter or longer than it was.
    #[error("serialized state of {given} bytes: it was written with {written}")]
    Length { given: u64, written: u64 },
    /// Changed since it was written.
    #[error("serialized state: its checksum is wrong, it was damaged")]
    Damaged,
    /// Of another model.
    #[error("serialized state of the FMU with GUID {found}: this one has {own}")]
    OtherModel { found: String, own: String },
    /// The checksum is right, but the contents cannot be a state of this model.
    #[error("serialized state: its contents are not what a run of this model leaves behind: {0}")]
    Contents(&'static str),
}

/// Number of bytes of [`encode`].
pub(crate) fn length(snapshot: &Snapshot) -> usize {
    encoded_length(snapshot.simulation.to_bytes().len())
}

/// The bytes of a state.
pub(crate) fn encode(snapshot: &Snapshot, guid: &str) -> Vec<u8> {
    let simulation = snapshot.simulation.to_bytes();
    let mut bytes = Vec::with_capacity(encoded_length(simulation.len()));
    bytes.extend_from_slice(MAGIC);
    bytes.extend_from_slice(&FORMAT.to_le_bytes());
    bytes.extend_from_slice(&[0; 8]);
    bytes.extend_from_slice(&(encoded_length(simulation.len()) as u64).to_le_bytes());
    bytes.extend_from_slice(&guid_field(guid));
    bytes.push(snapshot.mode as u8);
    bytes.push(snapshot.last_step as u8);
    let (present, times) = match snapshot.clock {
        None => (0, [0.0; TIMES]),
        Some(Clock { start, stop, time, last, drift, rounded }) => {
            (1 + u8::from(stop.is_some()), [start, stop.unwrap_or(0.0), time, last, drift, rounded])
        }
    };
    bytes.push(present);
    for value in times {
        bytes.extend_from_slice(&value.to_le_bytes());
    }
    bytes.extend_from_slice(&simulation);
    let sum = checksum(&bytes[CHECKED_FROM..]);
    bytes[CHECKED_FROM - 8..CHECKED_FROM].copy_from_slice(&sum.to_le_bytes());
    bytes
}

/// The state in bytes that an instance of this simulation's model has written.
pub(crate) fn decode(bytes: &[u8], guid: &str, simulation: &Simulation) -> Result<Snapshot, BlobError> {
    let mut rest = Reader(bytes);
    if rest.array().ok_or(BlobError::Foreign)? != *MAGIC {
        return Err(BlobError::Foreign);
    }
    let short = BlobError::Length { given: bytes.len() as u64, written: encoded_length(0) as u64 };
    let found = rest.u32().ok_or(short.clone())?;
    if found != FORMAT {
        return Err(BlobError::Format { found });
    }
    let sum = rest.u64().ok_or(short.clone())?;
    let damaged = checksum(rest.0) != sum;
    let written = rest.u64().ok_or(short.clone())?;
    if written != bytes.len() as u64 {
        return Err(BlobError::Length { given: bytes.len() as u64, written });
    }
    if damaged {
        return Err(BlobError::Damaged);
    }
    let found: [u8; GUID_LENGTH] = rest.array().ok_or(short)?;
    if found != guid_field(guid) {
        return Err(BlobError::OtherModel {
            found: String::from_utf8_lossy(&found).into_owned(),
            own: guid.to_owned(),
        });
    }
    contents(rest, simulation).map_err(BlobError::Contents)
}

fn contents(mut rest: Reader, simulation: &Simulation) -> Result<Snapshot, &'static str> {
    let (mode, last_step, clock) =
        instance_part(&mut rest).ok_or("mode, status or time of the instance is impossible")?;
    Ok(Snapshot { mode, last_step, clock, simulation: simulation.state_from_bytes(rest.0)? })
}

fn instance_part(rest: &mut Reader) -> Option<(Mode, Status, Option<Clock>)> {
    let [mode, last_step, clock] = rest.array()?;
    let mut times = [0.0; TIMES];
    for time in &mut times {
        *time = rest.f64()?;
    }
    let [start, stop, time, last, drift, rounded] = times;
    let last_step = [Status::Ok, Status::Warning, Status::Discard, Status::Error]
        .into_iter()
        .find(|status| *status as u8 == last_step)?;
    let possible = times.iter().all(|time| time.is_finite()) && last >= 0.0 && rounded >= 0.0;
    let clock = match clock {
        0 => None,
        1 if possible => Some(Clock { start, stop: None, time, last, drift, rounded }),
        2 if possible && stop > start => Some(Clock { start, stop: Some(stop), time, last, drift, rounded }),
        _ => return None,
    };
    Some((Mode::from_number(mode)?, last_step, clock))
}

fn encoded_length(simulation: usize) -> usize {
    CHECKED_FROM + 8 + GUID_LENGTH + 3 + TIMES * 8 + simulation
}

fn guid_field(guid: &str) -> [u8; GUID_LENGTH] {
    let mut field = [0; GUID_LENGTH];
    for (byte, character) in field.iter_mut().zip(guid.bytes()) {
        *byte = character;
    }
    field
}
