//! Deterministic elementary functions and small numerical tools that know nothing of bearings.
