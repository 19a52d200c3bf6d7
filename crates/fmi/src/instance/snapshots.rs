//! Saved states (`fmi2FMUstate`): the instance owns them, the host holds handles.
//!
//! As with instances, a handle is a number and not an address, so a stale, foreign or uninitialised one is refused
//! without being dereferenced. Two thousand million states are saved before a number comes again. A state that its host
//! forgets to free goes with its instance; the memory of a freed one serves the next.

use std::ptr;
use std::sync::atomic::{AtomicU64, Ordering};

use super::failure::Failure;
use super::snapshot::Snapshot;
use crate::c_interface::FmuState;

/// ```text
/// handle:  00000000 | 1 | serial number (31 bits) | index (20 bits) | 1000
/// ```
/// No memory of a host has an address with bit 55 set and none above it, tagged pointers included: processors keep it
/// for their kernels' half. So a handle that is passed where its address belongs differs from an address.
const INDEX_BITS: u32 = 20;
const SERIAL_BITS: u32 = 31;
const TAG: u64 = 8;
const MARK: u64 = 1 << 55;

/// Whether this is the number of a handle, living or not, and hence no address.
pub(crate) fn is_handle(address: usize) -> bool {
    address as u64 & !(MARK - 1) == MARK
}

static SERIAL: AtomicU64 = AtomicU64::new(1);

#[derive(Debug)]
struct Entry {
    /// The handle while the entry is taken, 0 while it is free.
    handle: u64,
    snapshot: Snapshot,
}

impl Entry {
    fn rewrite(&mut self, write: impl FnOnce(Option<&mut Snapshot>) -> Option<Snapshot>) {
        if let Some(snapshot) = write(Some(&mut self.snapshot)) {
            self.snapshot = snapshot;
        }
    }
}

/// The saved states of one instance.
#[derive(Debug, Default)]
pub(crate) struct Snapshots {
    entries: Vec<Entry>,
    free: Vec<u32>,
}

impl Snapshots {
    fn index(&self, handle: FmuState) -> Result<usize, Failure> {
        let handle = handle.addr() as u64;
        let index = (handle >> 4) as usize % (1 << INDEX_BITS);
        match self.entries.get(index) {
            Some(entry) if handle != 0 && entry.handle == handle => Ok(index),
            _ => Err(Failure::UnknownState),
        }
    }

    /// The state behind a handle.
    pub(crate) fn get(&self, handle: FmuState) -> Result<&Snapshot, Failure> {
        self.index(handle).map(|index| &self.entries[index].snapshot)
    }

    /// Stores a state: over the one behind `handle`, or as a new one if `handle` is null. Gives its handle.
    ///
    /// `write` gets the memory of an old state, if there is one, to write the new one there; if not, it makes one.
    pub(crate) fn put(
        &mut self,
        handle: FmuState,
        write: impl FnOnce(Option<&mut Snapshot>) -> Option<Snapshot>,
    ) -> Result<FmuState, Failure> {
        if !handle.is_null() {
            let index = self.index(handle)?;
            self.entries[index].rewrite(write);
            return Ok(handle);
        }
        let index = match self.free.pop() {
            Some(index) => index as usize,
            None if self.entries.len() < 1 << INDEX_BITS => self.entries.len(),
            None => {
                let limit = 1 << INDEX_BITS;
                return Err(Failure::TooLong { name: "FMUstate", count: limit + 1, limit });
            }
        };
        let serial = SERIAL.fetch_add(1, Ordering::Relaxed) % (1 << SERIAL_BITS);
        let handle = MARK | serial << (INDEX_BITS + 4) | (index as u64) << 4 | TAG;
        match self.entries.get_mut(index) {
            Some(old) => {
                old.rewrite(write);
                old.handle = handle;
            }
            None => self.entries.extend(write(None).map(|snapshot| Entry { handle, snapshot })),
        }
        Ok(ptr::without_provenance_mut(handle as usize))
    }

    /// Frees the state behind a handle.
    pub(crate) fn free(&mut self, handle: FmuState) -> Result<(), Failure> {
        let index = self.index(handle)?;
        self.entries[index].handle = 0;
        self.free.push(index as u32);
        Ok(())
    }
}
