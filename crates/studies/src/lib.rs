//! The laboratory: what the pages in `docs/` say, measured and computed anew. Never shipped.

pub mod cli;
pub mod report;
pub mod validation;
