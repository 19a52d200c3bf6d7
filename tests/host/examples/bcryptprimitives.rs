//! `bcryptprimitives.dll` for Wine 8, which lacks it: the one function that Rust's standard library takes from it.
#![allow(unsafe_code)]
#![cfg_attr(windows, no_std)]
#[cfg(windows)]
mod random {
    #[link(name = "advapi32")]
    unsafe extern "system" {
        #[link_name = "SystemFunction036"]
        fn rtl_gen_random(buffer: *mut u8, length: u32) -> u8;
    }

    /// Fills the buffer with random numbers.
    ///
    /// # Safety
    /// `buffer` has room for `length` bytes.
    #[unsafe(no_mangle)]
    pub unsafe extern "system" fn ProcessPrng(buffer: *mut u8, length: usize) -> i32 {
        // SAFETY: what the caller promises is what is asked for; Rust asks for a few bytes.
        i32::from(unsafe { rtl_gen_random(buffer, length as u32) })
    }

    #[panic_handler]
    fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
        loop {}
    }
}
