//! Packs Brinell scenes into FMUs and runs them.
fn main() {}
