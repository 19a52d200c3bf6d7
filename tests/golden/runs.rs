//! What the golden runs are: which law, which steps, how a host moves the rings. The libraries of other machines are
//! driven through the same runs.

/// Communication step (s). The recorded events of the shipped scenes lie within the first 20 ms: entry, flight, impact.
pub(crate) const STEP: f64 = 1e-4;
pub(crate) const STEPS: usize = 200;
/// Scenes of which two runs are kept: one under law `hertz`, and one as shipped, with [`AS_SHIPPED`] behind its name.
pub(crate) const BY_PATH: [&str; 5] =
    ["6205-inner-5deg", "6205-two-defects", "er16k-inner", "er16k-element", "nu205-inner"];
pub(crate) const AS_SHIPPED: &str = "-map";

/// The scene of a golden run.
pub(crate) fn scene_of(run: &str) -> &str {
    run.strip_suffix(AS_SHIPPED).unwrap_or(run)
}

/// A host's motion of a ring, smooth and exactly repeatable: it presses the rings together by 12 µm and swings.
pub(crate) fn ring_motion(ring: &str, t: f64) -> [(&'static str, f64); 4] {
    let depth = if ring == "shaft" { -12e-6 } else { 0.0 };
    let (swing, rate) = (t * (0.02 - t) * 1e4, (0.02 - 2.0 * t) * 1e4);
    [("x", 2e-6 * swing), ("y", depth + 1e-6 * swing), ("vx", 2e-6 * rate), ("vy", 1e-6 * rate)]
}
