//! The FMI 2.0 co-simulation C interface. The only module with `unsafe` code.
