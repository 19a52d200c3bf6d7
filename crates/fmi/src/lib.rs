//! A Brinell bearing as hosts of the Functional Mock-up Interface see it: the dynamic library inside an FMU.
//!
//! The only crate of the workspace that exports C functions, and the only one with `unsafe` code.

// Units in brackets, as in `[m]`, are no links.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod fmi2;
