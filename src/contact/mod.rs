//! Contact of one rolling element with a raceway. Knows no time, no cage, no ring.
