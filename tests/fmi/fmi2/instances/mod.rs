//! Instances: how they come, and what one may not do to its host or to another.

mod instantiate;
mod panics;
mod recordings;
