//! Handles: which instances are alive, told without dereferencing anything that a host hands in.
//!
//! A handle is not an address but a number made of a slot and of the slot's generation. Looking it up in a static
//! table tells a live handle from a null, stale or invented one, and the same atomic operation marks the instance as
//! in use: a logger that calls back into its own instance, or a second thread in the same instance, is turned away
//! instead of aliasing it. The standard allows neither, so turning away is all that is owed.
//!
//! ```text
//! key and handle:  generation (44 bits) | slot (16 bits) | 1 (live) | 00 | 0 (in use)
//! ```
//! The table is zero-initialised memory of the library: it costs pages only as far as slots are used, and goes
//! away with the library.

use std::ops::{Deref, DerefMut};
use std::ptr;
use std::sync::atomic::{AtomicPtr, AtomicU64, AtomicUsize, Ordering};

use super::life::Instance;
use crate::c_interface::Component;

const IN_USE: u64 = 1;
const LIVE: u64 = 8;
const SLOT_SHIFT: u32 = 4;
const GENERATION_SHIFT: u32 = 20;
/// Most instances that can be alive at once.
const SLOT_COUNT: usize = 1 << (GENERATION_SHIFT - SLOT_SHIFT);

const _: () = assert!(usize::BITS == 64, "a handle needs 64 bits");

struct Slot {
    key: AtomicU64,
    instance: AtomicPtr<Instance>,
}

static SLOTS: [Slot; SLOT_COUNT] =
    [const { Slot { key: AtomicU64::new(0), instance: AtomicPtr::new(ptr::null_mut()) } }; SLOT_COUNT];
/// Where to begin the search for a free slot: a hint, so that low slots are used again first.
static HINT: AtomicUsize = AtomicUsize::new(0);

/// Why a handle was refused. The boundary cannot log it: there is no instance whose logger could be asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Refused {
    /// Null, freed, or never given out.
    Unknown,
    /// The instance is in the middle of another call.
    InUse,
}

/// An instance, borrowed for the length of one call.
pub(crate) struct Borrowed {
    slot: &'static Slot,
    key: u64,
    instance: *mut Instance,
}

impl Borrowed {
    /// Lets the host's own calls have the instance while `f` runs. The mode decides which of them may; it must be one
    /// in which nobody can free the instance.
    pub(crate) fn lend<R>(&mut self, f: impl FnOnce() -> R) -> R {
        /// Takes the instance back, also when `f` unwinds.
        struct TakeBack<'b>(&'b Borrowed);
        impl Drop for TakeBack<'_> {
            fn drop(&mut self) {
                let Borrowed { slot, key, .. } = *self.0;
                // A second thread that is in the instance, against the standard, leaves it in a moment.
                while slot.key.compare_exchange(key, key | IN_USE, Ordering::Acquire, Ordering::Relaxed).is_err() {
                    std::thread::yield_now();
                }
            }
        }
        self.slot.key.store(self.key, Ordering::Release);
        let _taken_back = TakeBack(self);
        f()
    }
}

impl Deref for Borrowed {
    type Target = Instance;
    #[inline]
    fn deref(&self) -> &Instance {
        // SAFETY: the slot's key is marked in use by this value alone, so the box that `insert` leaked is neither freed
        // nor borrowed elsewhere until it is dropped.
        unsafe { &*self.instance }
    }
}

impl DerefMut for Borrowed {
    #[inline]
    fn deref_mut(&mut self) -> &mut Instance {
        // SAFETY: as in `deref`; `&mut self` makes it exclusive.
        unsafe { &mut *self.instance }
    }
}

impl Drop for Borrowed {
    #[inline]
    fn drop(&mut self) {
        self.slot.key.store(self.key, Ordering::Release);
    }
}

/// A host may use an instance from one thread after another: nothing in it may depend on the thread.
const _: () = {
    const fn wanders<T: Send>() {}
    wanders::<Instance>();
};

/// Gives an instance a handle. Hands it back when all slots are taken.
pub(crate) fn insert(instance: Box<Instance>) -> Result<Component, Box<Instance>> {
    let start = HINT.load(Ordering::Relaxed);
    for index in (start..SLOT_COUNT).chain(0..start.min(SLOT_COUNT)) {
        let slot = &SLOTS[index];
        let key = slot.key.load(Ordering::Relaxed);
        if key & (LIVE | IN_USE) != 0 {
            continue;
        }
        let generation = (key >> GENERATION_SHIFT) + 1;
        let handle = generation << GENERATION_SHIFT | (index as u64) << SLOT_SHIFT | LIVE;
        if slot.key.compare_exchange(key, handle | IN_USE, Ordering::Acquire, Ordering::Relaxed).is_ok() {
            slot.instance.store(Box::into_raw(instance), Ordering::Relaxed);
            slot.key.store(handle, Ordering::Release);
            HINT.store(index + 1, Ordering::Relaxed);
            return Ok(ptr::without_provenance_mut(handle as usize));
        }
    }
    Err(instance)
}

/// Borrows the instance behind a handle.
#[inline]
pub(crate) fn borrow(component: Component) -> Result<Borrowed, Refused> {
    let handle = component.addr() as u64;
    // An in-use mark or a missing live mark in the handle itself would confuse the exchange below.
    if handle & 15 != LIVE {
        return Err(Refused::Unknown);
    }
    let slot = &SLOTS[(handle >> SLOT_SHIFT) as usize % SLOT_COUNT];
    match slot.key.compare_exchange(handle, handle | IN_USE, Ordering::Acquire, Ordering::Relaxed) {
        Ok(_) => Ok(Borrowed { slot, key: handle, instance: slot.instance.load(Ordering::Relaxed) }),
        Err(key) if key == handle | IN_USE => Err(Refused::InUse),
        Err(_) => Err(Refused::Unknown),
    }
}

/// Takes a borrowed instance out of the table: its handle is dead from here on.
pub(crate) fn remove(mut borrowed: Borrowed) -> Box<Instance> {
    let instance = borrowed.slot.instance.swap(ptr::null_mut(), Ordering::Relaxed);
    let index = (borrowed.key >> SLOT_SHIFT) as usize % SLOT_COUNT;
    borrowed.key = borrowed.key >> GENERATION_SHIFT << GENERATION_SHIFT;
    HINT.fetch_min(index, Ordering::Relaxed);
    drop(borrowed);
    // SAFETY: the pointer came from `Box::into_raw` in `insert`; `borrowed` was the only one to hold it, and no handle
    // leads to it any more.
    unsafe { Box::from_raw(instance) }
}
