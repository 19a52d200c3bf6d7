//! What a host does: names, parameters between runs, derivatives, a mass coupled to a ring.

mod between_runs;
mod by_name;
mod coupling;
mod dependencies;
mod derivatives;
