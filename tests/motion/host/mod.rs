//! What a host does: names, parameters between runs, derivatives, a mass coupled to a ring.

mod between_runs;
mod by_name;
mod catalogue_rows;
mod coupling;
mod coupling_error;
mod dependencies;
mod derivatives;
mod wirings;
