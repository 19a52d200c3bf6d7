//! Bearing geometry, Hertz constants and characteristic frequencies.
