//! The model library for every platform: which there are, how cargo compiles and links for them.

pub mod compile;
pub mod platform;
pub mod toolchain;
pub mod universal;
pub mod zig;

pub use platform::{Linking, PLATFORMS, Platform, Target};
pub use toolchain::{Toolchain, check_installed};
pub use zig::{OLDEST_GLIBC, Zig, needed_glibc};
