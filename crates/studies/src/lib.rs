//! The laboratory: what the pages in `docs/` say, measured and computed anew. Never shipped.

// Units in brackets, as in `[m]`, are no links.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod cli;
pub mod dist;
pub mod report;
pub mod scene_page;
pub mod site;
pub mod validation;
