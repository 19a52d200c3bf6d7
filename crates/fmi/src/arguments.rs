//! Arguments from C: pointers become slices and strings, or are refused.
//!
//! Null, misaligned, absurdly long and overlapping arrays are refused. What cannot be checked is whether an array is as
//! long as its caller says; there the functions rely on the standard, which makes it the caller's promise.

use std::ffi::CStr;
use std::slice;

use crate::c_interface::{FmiString, FmuState};
use crate::instance::{Failure, snapshots};

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
pub(crate) unsafe fn array<'a, T>(name: &'static str, pointer: *const T, count: usize) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    check(name, pointer, count)?;
    // SAFETY: not null and aligned by `check`; the rest is this function's contract.
    Ok(unsafe { slice::from_raw_parts(pointer, count) })
}

/// An array that the host lets us write; `pointer` may be null when `count` is 0. A host in C may leave it
/// uninitialised, so it is filled with zeros before anyone can read it.
///
/// # Safety
/// If `pointer` is neither null nor misaligned, it points to memory of `count` values of a type that has zero bytes for
/// a value, and nobody else touches it during the call.
#[inline]
pub(crate) unsafe fn array_mut<'a, T>(
    name: &'static str,
    pointer: *mut T,
    count: usize,
) -> Result<&'a mut [T], Failure> {
    if count == 0 {
        return Ok(&mut []);
    }
    check(name, pointer, count)?;
    // SAFETY: not null and aligned by `check`, initialised here; the rest is this function's contract.
    Ok(unsafe {
        pointer.write_bytes(0, count);
        slice::from_raw_parts_mut(pointer, count)
    })
}

/// Puts one value where the host wants it, without reading what is there.
///
/// # Safety
/// If `pointer` is neither null nor misaligned, it points to memory for one value that nobody else touches during the
/// call.
#[inline]
pub(crate) unsafe fn store<T>(name: &'static str, pointer: *mut T, value: T) -> Result<(), Failure> {
    check(name, pointer, 1)?;
    // SAFETY: not null and aligned by `check`; the rest is this function's contract.
    unsafe { pointer.write(value) };
    Ok(())
}

/// Puts values where the host wants them, without reading what is there; `pointer` may be null when there are none.
///
/// # Safety
/// If `pointer` is neither null nor misaligned, it points to memory for as many values that nobody else touches during
/// the call.
pub(crate) unsafe fn store_all<T: Copy>(name: &'static str, pointer: *mut T, values: &[T]) -> Result<(), Failure> {
    if !values.is_empty() {
        check(name, pointer, values.len())?;
        // SAFETY: not null and aligned by `check`; the values are ours, so they lie elsewhere; the rest is this
        // function's contract.
        unsafe { pointer.copy_from_nonoverlapping(values.as_ptr(), values.len()) };
    }
    Ok(())
}

/// The handle of a state at a host's address, NULL or an earlier one. A state itself is no address.
///
/// # Safety
/// If `pointer` is neither null, misaligned nor a state, it points to a handle, which may have any value and which
/// nobody else touches during the call.
pub(crate) unsafe fn state_handle<'a>(pointer: *mut FmuState) -> Result<&'a mut FmuState, Failure> {
    const NAME: &str = "FMUstate";
    if snapshots::is_handle(pointer.addr()) {
        return Err(Failure::NotAnAddress(NAME));
    }
    check(NAME, pointer, 1)?;
    // SAFETY: not null and aligned by `check`, and no handle; the rest is this function's contract.
    Ok(unsafe { &mut *pointer })
}

/// Refuses input and output arrays that overlap; to be asked before slices are made of them.
#[inline]
pub(crate) fn disjoint<A, B>(a: *const A, a_count: usize, b: *const B, b_count: usize) -> Result<(), Failure> {
    let (a_start, b_start) = (a.addr(), b.addr());
    let a_end = a_start.saturating_add(a_count.saturating_mul(size_of::<A>()));
    let b_end = b_start.saturating_add(b_count.saturating_mul(size_of::<B>()));
    if a_count > 0 && b_count > 0 && a_start < b_end && b_start < a_end { Err(Failure::Overlap) } else { Ok(()) }
}

/// A string from the host; must be UTF-8, as the standard says.
///
/// # Safety
/// If `pointer` is not null, it points to a string ended by a NUL that nobody writes during the call.
pub(crate) unsafe fn string<'a>(name: &'static str, pointer: FmiString) -> Result<&'a str, Failure> {
    if pointer.is_null() {
        return Err(Failure::NullPointer(name));
    }
    // SAFETY: not null; ended by a NUL by this function's contract.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map_err(|_| Failure::NotUtf8(name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::mem::MaybeUninit;
    use std::ptr;

    #[test]
    fn memory_that_a_host_leaves_uninitialised_is_not_read() {
        let mut memory = [MaybeUninit::<f64>::uninit(); 3];
        // SAFETY: as long as said.
        let values = unsafe { array_mut("value", memory.as_mut_ptr().cast::<f64>(), 3) }.unwrap();
        assert_eq!(values, [0.0; 3]);
        let mut memory = [f64::NAN; 2];
        // SAFETY: as long as said.
        assert_eq!(unsafe { array_mut("value", memory.as_mut_ptr(), 2) }.unwrap(), [0.0; 2]);
        let mut bytes = [MaybeUninit::<u8>::uninit(); 4];
        // SAFETY: as long as said; written below.
        let stored = unsafe { store_all("bytes", bytes.as_mut_ptr().cast(), b"1234") };
        assert!(stored.is_ok());
        // SAFETY: all of it was written.
        assert_eq!(bytes.map(|byte| unsafe { byte.assume_init() }), *b"1234");
    }

    #[test]
    fn nothing_may_be_null_and_something_may_not() {
        // SAFETY: NULL is refused, or goes with a count of 0.
        unsafe {
            assert!(array::<f64>("value", ptr::null(), 0).unwrap().is_empty());
            assert!(array_mut::<f64>("value", ptr::null_mut(), 0).unwrap().is_empty());
            assert!(store_all::<f64>("value", ptr::null_mut(), &[]).is_ok());
            assert!(matches!(array::<f64>("value", ptr::null(), 1), Err(Failure::NullPointer("value"))));
            assert!(matches!(array_mut::<f64>("value", ptr::null_mut(), 1), Err(Failure::NullPointer("value"))));
            assert!(matches!(store_all("value", ptr::null_mut(), &[1.0]), Err(Failure::NullPointer("value"))));
            assert!(matches!(store("value", ptr::null_mut(), 1.0), Err(Failure::NullPointer("value"))));
            assert!(matches!(state_handle(ptr::null_mut()), Err(Failure::NullPointer("FMUstate"))));
            assert!(matches!(string("name", ptr::null()), Err(Failure::NullPointer("name"))));
        }
    }

    #[test]
    fn arrays_overlap_if_they_share_a_byte() {
        let memory = [0u64; 4];
        let (words, bytes) = (memory.as_ptr(), memory.as_ptr().cast::<u8>());
        assert!(disjoint(words, 2, words.wrapping_add(2), 2).is_ok());
        assert!(disjoint(words, 2, bytes.wrapping_add(16), 1).is_ok());
        assert!(matches!(disjoint(words, 2, bytes.wrapping_add(15), 1), Err(Failure::Overlap)));
        assert!(matches!(disjoint(bytes.wrapping_add(8), 1, words, 2), Err(Failure::Overlap)));
        assert!(disjoint(words, 0, words, 4).is_ok());
        // Counts that no memory has do not come round to fitting ones.
        assert!(matches!(disjoint(words, usize::MAX, words.wrapping_add(1), 1), Err(Failure::Overlap)));
    }

    #[test]
    fn misaligned_and_absurdly_long_arrays_are_refused() {
        let memory = [0u64; 4];
        // SAFETY: refused before memory is touched.
        unsafe {
            let odd = memory.as_ptr().wrapping_byte_add(1);
            assert!(matches!(array("vr", odd, 1), Err(Failure::Misaligned("vr"))));
            assert!(matches!(array("vr", memory.as_ptr(), LONGEST + 1), Err(Failure::TooLong { .. })));
        }
    }

    #[test]
    fn a_string_must_be_utf_8() {
        // SAFETY: strings that end in NUL.
        unsafe {
            assert_eq!(string("name", c"\xc3\xa4".as_ptr()).unwrap(), "ä");
            assert!(matches!(string("name", c"\xff".as_ptr()), Err(Failure::NotUtf8("name"))));
        }
    }
}
