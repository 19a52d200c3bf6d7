//! Arguments from C: pointers become slices and strings, or are refused.
//!
//! Null, misaligned, absurdly long and overlapping arrays are refused. What cannot be checked is whether an array is as
//! long as its caller says; there the functions rely on the standard, which makes it the caller's promise.

use std::ffi::CStr;
use std::slice;

use super::failure::Failure;
use super::types::FmiString;

/// Longest array in one call. No model has that many variables, so a longer one is a miscount, not a wish.
const LONGEST: usize = 1 << 20;

fn check<T>(name: &'static str, pointer: *const T, count: usize) -> Result<(), Failure> {
    if pointer.is_null() {
        Err(Failure::NullPointer(name))
    } else if !pointer.is_aligned() {
        Err(Failure::Misaligned(name))
    } else if count > LONGEST {
        Err(Failure::TooLong { name, count, limit: LONGEST })
    } else {
        Ok(())
    }
}

/// An array that the host lets us read; `pointer` may be null when `count` is 0.
///
/// # Safety
/// If `pointer` is neither null nor misaligned, it points to `count` initialised values that nobody writes during the
/// call.
#[inline]
pub(super) unsafe fn array<'a, T>(name: &'static str, pointer: *const T, count: usize) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    check(name, pointer, count)?;
    // SAFETY: not null and aligned by `check`; the rest is this function's contract.
    Ok(unsafe { slice::from_raw_parts(pointer, count) })
}

/// An array that the host lets us write; `pointer` may be null when `count` is 0.
///
/// # Safety
/// If `pointer` is neither null nor misaligned, it points to memory of `count` values of a type for which every bit
/// pattern is valid, and nobody else touches it during the call.
#[inline]
pub(super) unsafe fn array_mut<'a, T>(
    name: &'static str,
    pointer: *mut T,
    count: usize,
) -> Result<&'a mut [T], Failure> {
    if count == 0 {
        return Ok(&mut []);
    }
    check(name, pointer, count)?;
    // SAFETY: not null and aligned by `check`; the rest is this function's contract.
    Ok(unsafe { slice::from_raw_parts_mut(pointer, count) })
}

/// A place where the host wants one value.
///
/// # Safety
/// As for [`array_mut`] with a count of 1.
#[inline]
pub(super) unsafe fn place<'a, T>(name: &'static str, pointer: *mut T) -> Result<&'a mut T, Failure> {
    check(name, pointer, 1)?;
    // SAFETY: not null and aligned by `check`; the rest is this function's contract.
    Ok(unsafe { &mut *pointer })
}

/// Puts one value where the host wants it, without reading what is there.
///
/// # Safety
/// If `pointer` is neither null nor misaligned, it points to memory for one value that nobody else touches during the
/// call.
#[inline]
pub(super) unsafe fn store<T>(name: &'static str, pointer: *mut T, value: T) -> Result<(), Failure> {
    check(name, pointer, 1)?;
    // SAFETY: not null and aligned by `check`; the rest is this function's contract.
    unsafe { pointer.write(value) };
    Ok(())
}

/// Refuses input and output arrays that overlap; to be asked before slices are made of them.
#[inline]
pub(super) fn disjoint<A, B>(a: *const A, a_count: usize, b: *const B, b_count: usize) -> Result<(), Failure> {
    let (a_start, b_start) = (a.addr(), b.addr());
    let a_end = a_start.saturating_add(a_count.saturating_mul(size_of::<A>()));
    let b_end = b_start.saturating_add(b_count.saturating_mul(size_of::<B>()));
    if a_count > 0 && b_count > 0 && a_start < b_end && b_start < a_end { Err(Failure::Overlap) } else { Ok(()) }
}

/// A string from the host; must be UTF-8, as the standard says.
///
/// # Safety
/// If `pointer` is not null, it points to a string ended by a NUL that nobody writes during the call.
pub(super) unsafe fn string<'a>(name: &'static str, pointer: FmiString) -> Result<&'a str, Failure> {
    if pointer.is_null() {
        return Err(Failure::NullPointer(name));
    }
    // SAFETY: not null; ended by a NUL by this function's contract.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map_err(|_| Failure::NotUtf8(name))
}
