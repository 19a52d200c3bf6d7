//! The program's allocator, counting for the threads that ask for it.
//!
//! A test program that includes this file has it as its allocator.
// Each test program uses a part of this; `unsafe` is what an allocator takes.
#![allow(dead_code, unreachable_pub, unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

struct Counting;

thread_local! {
    static ASKS: Cell<bool> = const { Cell::new(false) };
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

// SAFETY: every call goes to the system allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if ASKS.with(Cell::get) {
            COUNT.set(COUNT.get() + 1);
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
    COUNT.set(0);
    ASKS.with(|asks| asks.set(true));
    let result = work();
    ASKS.with(|asks| asks.set(false));
    (result, COUNT.get())
}
