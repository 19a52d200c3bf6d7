//! Benchmarks of the contact, in `benches/contact.rs`.
