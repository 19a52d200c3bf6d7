//! The FMI 2.0 rules, each shown by a test that calls the exported C functions as a host would.

mod derivatives;
mod hostile;
mod input_derivatives;
mod instantiate;
mod logging;
mod model_exchange;
mod modes;
mod output_derivatives;
mod panics;
mod parameter_derivatives;
mod processes;
mod recordings;
mod saved_states;
mod steps;
mod variables;
