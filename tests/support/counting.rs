//! The program's allocator, counting for the threads that ask for it.
//!
//! A test program that includes this file has it as its allocator.
#![allow(dead_code, unreachable_pub, unsafe_code)] // each test program uses a part of this; `unsafe` is what an allocator takes

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::atomic::{AtomicU64, Ordering};

struct Counting;

static BY_THOSE_THAT_ASK: AtomicU64 = AtomicU64::new(0);

thread_local! {
    static ASKS: Cell<bool> = const { Cell::new(false) };
}

// SAFETY: every call goes to the system allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if ASKS.with(Cell::get) {
            BY_THOSE_THAT_ASK.fetch_add(1, Ordering::Relaxed);
        }
        // SAFETY: as promised by the caller.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as promised by the caller.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// What `work` gives, and how often this thread allocated in it: other tests may run beside it.
pub fn counted<T>(work: impl FnOnce() -> T) -> (T, u64) {
    let before = BY_THOSE_THAT_ASK.load(Ordering::Relaxed);
    ASKS.with(|asks| asks.set(true));
    let result = work();
    ASKS.with(|asks| asks.set(false));
    (result, BY_THOSE_THAT_ASK.load(Ordering::Relaxed) - before)
}
