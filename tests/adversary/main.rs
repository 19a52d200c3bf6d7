//! What an adversary tries: inputs that invite a wrong number. Each is refused, or answered rightly.
#![allow(clippy::unwrap_used)]

mod recordings;
