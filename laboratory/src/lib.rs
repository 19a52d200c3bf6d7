//! The laboratory: what the pages in `docs/` say, measured and computed anew. Never shipped.

pub mod cli;
pub mod diagnosis;
pub mod dist;
pub mod packed;
pub mod report;
#[cfg(test)]
mod scene_page;
pub mod site;
pub mod validation;
