//! Contact maps, of one surface, of flanks for all lengths and of slices across the groove, and no allocation in any.

mod across;
mod allocations;
mod flanks;
mod laws;
mod map;
