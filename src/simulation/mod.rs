//! One bearing that is stepped through time: integrator, variable table, plain state. Does no I/O and reads no clock.
//!
//! This is the whole of what `fmi2` and `fmu-build` see of the model.

pub mod variables;
