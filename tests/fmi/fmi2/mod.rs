//! The FMI 2.0 rules, each shown by a test that calls the exported C functions as a host would.

mod derivatives;
mod hostile;
mod instances;
mod logging;
mod model_exchange;
mod modes;
mod processes;
mod saved_states;
mod steps;
mod variables;
