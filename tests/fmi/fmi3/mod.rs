//! The FMI 3.0 rules, each shown by a test that calls the exported C functions as a host would.

mod derivatives;
mod instantiate;
mod model_exchange;
mod modes;
mod outliving;
mod saved_states;
mod steps;
mod updates;
mod variables;
