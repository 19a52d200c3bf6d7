//! Scenes that have failed once, each with what was wrong.
