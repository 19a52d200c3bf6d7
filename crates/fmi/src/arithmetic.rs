//! The processor's arithmetic during a call: rounding to nearest, small numbers as they are. Some hosts round otherwise
//! or take denormals for 0 in their threads; what the model gives, and what instances share, must not depend on the
//! thread that it was made in.

/// The usual arithmetic in this thread, until it is dropped; then the host's is back.
pub(crate) struct UsualArithmetic {
    hosts: Option<Control>,
}

impl UsualArithmetic {
    #[inline(always)]
    pub(crate) fn begin() -> Self {
        let now = control() & !FLAGS;
        let hosts = (now != USUAL).then_some(now);
        if hosts.is_some() {
            set_control(USUAL);
        }
        Self { hosts }
    }
}

impl Drop for UsualArithmetic {
    #[inline(always)]
    fn drop(&mut self) {
        if let Some(hosts) = self.hosts {
            set_control(hosts);
        }
    }
}

#[cfg(target_arch = "x86_64")]
use x86::{Control, FLAGS, USUAL, control, set_control};
#[cfg(target_arch = "x86_64")]
mod x86 {
    use std::arch::asm;

    pub(super) type Control = u32;
    /// MXCSR at the start of a process: all exceptions masked.
    pub(super) const USUAL: u32 = 0x1f80;
    /// What arithmetic leaves there.
    pub(super) const FLAGS: u32 = 0x3f;

    #[inline(always)]
    pub(super) fn control() -> u32 {
        let mut word = 0u32;
        // SAFETY: stores 32 bits in `word`.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut word, options(nostack)) };
        word
    }

    #[cold]
    pub(super) fn set_control(word: u32) {
        // SAFETY: loads a word that was stored, or that every process begins with.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const word, options(nostack)) };
    }
}

#[cfg(target_arch = "aarch64")]
use arm::{Control, FLAGS, USUAL, control, set_control};
#[cfg(target_arch = "aarch64")]
mod arm {
    use std::arch::asm;

    pub(super) type Control = u64;
    /// FPCR at the start of a process; flags are in a register of their own.
    pub(super) const USUAL: u64 = 0;
    pub(super) const FLAGS: u64 = 0;

    #[inline(always)]
    pub(super) fn control() -> u64 {
        let word: u64;
        // SAFETY: reads a register.
        unsafe { asm!("mrs {}, fpcr", out(reg) word, options(nostack)) };
        word
    }

    #[cold]
    pub(super) fn set_control(word: u64) {
        // SAFETY: writes what was read, or what every process begins with.
        unsafe { asm!("msr fpcr, {}", in(reg) word, options(nostack)) };
    }
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
use elsewhere::{Control, FLAGS, USUAL, control, set_control};
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
mod elsewhere {
    pub(super) type Control = u32;
    pub(super) const USUAL: u32 = 0;
    pub(super) const FLAGS: u32 = 0;

    pub(super) fn control() -> u32 {
        USUAL
    }

    pub(super) fn set_control(_: u32) {}
}
