//! What bytes become, target by target, and what must hold then.
//!
//! A target fails on a crash, on a panic even if the interface would catch it, on a call that takes longer than
//! libFuzzer's timeout, on memory that leaks, and on a number that is not finite under `fmi2OK`.
#![allow(dead_code)] // the walks and their host serve tests as well

#[path = "../../adversary/misuse/mod.rs"]
mod misuse;
mod targets;
#[path = "../../fmi/fmi2/host.rs"]
mod two;

/// Makes of bytes what the target of this name makes of them.
pub fn run(target: &str, data: &[u8]) {
    match target {
        "calls" => misuse::walk_of_bytes(data),
        _ => drop(targets::run(target, data)),
    }
}
