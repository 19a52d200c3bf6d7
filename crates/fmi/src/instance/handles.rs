//! Handles: which instances are alive, known without dereferencing anything that a host hands in.
//!
//! A handle is not an address but a number made of a slot and of the slot's generation. Looking it up in a static
//! table tells a live handle from a null, stale or invented one, and the same atomic operation marks the instance as
//! in use: a logger that calls back into its own instance, or a second thread in the same instance, is turned away
//! instead of aliasing it. The standard allows neither, so turning away is all that is owed.
//!
//! ```text
//! key and handle:  generation (44 bits) | slot (16 bits) | 1 (live) | 0 | 0 (abandoned) | 0 (in use)
//! ```
//! A step that lends its instance to calls of the host never waits for one to end: the standard wants them to have
//! ended when the host's function returns. If one has not, the step gives the instance up and fails, and the call
//! leaves the instance in error.
//!
//! The table is zero-initialised memory of the library: it costs pages only as far as slots are used, and goes
//! away with the library.

use std::ops::{Deref, DerefMut};
use std::ptr;
use std::sync::atomic::{AtomicPtr, AtomicU64, AtomicUsize, Ordering};

use super::life::Instance;
use super::mode::Mode;
use crate::c_interface::Component;

const IN_USE: u64 = 1;
/// The step that had lent the instance has given it up to the call that is in it.
const ABANDONED: u64 = 2;
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

/// An instance, borrowed for the length of one call.
pub(crate) struct Borrowed {
    slot: &'static Slot,
    key: u64,
    /// Null once it has been given up.
    instance: *mut Instance,
}

/// A call was still in the instance when the function to whose calls it had been lent returned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct GivenUp;

impl Borrowed {
    /// Lets the host's own calls have the instance while `f` runs. The mode decides which of them may; it must be one
    /// in which nobody can free the instance.
    ///
    /// # Errors
    /// Another thread is in the instance when `f` returns: it is no longer this one's, which may not use it again.
    pub(crate) fn lend<R>(&mut self, f: impl FnOnce() -> R) -> Result<R, GivenUp> {
        /// Takes the instance back, also when `f` unwinds.
        struct TakeBack<'b>(&'b mut Borrowed);
        impl Drop for TakeBack<'_> {
            fn drop(&mut self) {
                self.0.take_back();
            }
        }
        self.slot.key.store(self.key, Ordering::Release);
        let taken_back = TakeBack(self);
        let result = f();
        drop(taken_back);
        if self.is_given_up() { Err(GivenUp) } else { Ok(result) }
    }

    /// Whether the instance has been given up.
    #[inline]
    pub(crate) fn is_given_up(&self) -> bool {
        self.instance.is_null()
    }

    /// Whether the step that had lent the instance has given it up to this call.
    #[inline]
    pub(crate) fn is_abandoned(&self) -> bool {
        self.slot.key.load(Ordering::Relaxed) & ABANDONED != 0
    }

    /// Takes the instance back, or gives it up to the call that is in it. It waits for nobody: each exchange fails only
    /// if that call has just begun or ended.
    fn take_back(&mut self) {
        let Self { slot, key, .. } = *self;
        let exchange = |from, to| slot.key.compare_exchange(from, to, Ordering::Acquire, Ordering::Relaxed).is_ok();
        while !exchange(key, key | IN_USE) {
            if exchange(key | IN_USE, key | IN_USE | ABANDONED) {
                self.instance = ptr::null_mut();
                return;
            }
        }
    }
}

impl Deref for Borrowed {
    type Target = Instance;
    #[inline]
    fn deref(&self) -> &Instance {
        assert!(!self.is_given_up(), "an instance that was given up is used");
        // SAFETY: the slot's key is marked in use by this value alone, so the box that `insert` leaked is neither freed
        // nor borrowed elsewhere until it is dropped or given up.
        unsafe { &*self.instance }
    }
}

impl DerefMut for Borrowed {
    #[inline]
    fn deref_mut(&mut self) -> &mut Instance {
        assert!(!self.is_given_up(), "an instance that was given up is used");
        // SAFETY: as in `deref`; `&mut self` makes it exclusive.
        unsafe { &mut *self.instance }
    }
}

impl Drop for Borrowed {
    #[inline]
    fn drop(&mut self) {
        if self.is_given_up() {
            return;
        }
        // Only a call within an update can have been abandoned.
        if self.mode == Mode::IntermediateUpdate {
            let (from, to) = (self.key | IN_USE, self.key);
            if self.slot.key.compare_exchange(from, to, Ordering::Release, Ordering::Relaxed).is_ok() {
                return;
            }
            self.mode = Mode::Error;
        }
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

/// Borrows the instance behind a handle; not if that is null, freed or never given out, or in the middle of another
/// call. Nobody can log why: there is no instance whose logger could be asked.
#[inline]
pub(crate) fn borrow(component: Component) -> Option<Borrowed> {
    let handle = component.addr() as u64;
    // An in-use mark or a missing live mark in the handle itself would confuse the exchange below.
    if handle & 15 != LIVE {
        return None;
    }
    let slot = &SLOTS[(handle >> SLOT_SHIFT) as usize % SLOT_COUNT];
    slot.key.compare_exchange(handle, handle | IN_USE, Ordering::Acquire, Ordering::Relaxed).ok()?;
    Some(Borrowed { slot, key: handle, instance: slot.instance.load(Ordering::Relaxed) })
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
