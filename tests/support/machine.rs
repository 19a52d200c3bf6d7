//! A machine that is made here: what the vibration of a bearing with a spall looks like, by the kinematics of an
//! element of finite size. No recording of a machine is needed.
#![allow(unreachable_pub, clippy::unwrap_used)]

use brinell::geometry::kinematics;
use brinell::scene::Scene;
use brinell_analysis::statistics::Random;
use std::f64::consts::TAU;

/// Sampling rate [Hz].
pub const RATE: f64 = 51_200.0;

/// A 6205 under 49 N whose rig is not described: nothing to simulate.
pub fn scene() -> Scene {
    Scene::from_toml(
        r#"
        name = "rig"
        [bearing]
        element_count = 9
        element_diameter_mm = 7.94
        pitch_diameter_mm = 39.04
        conformity_inner = 0.52
        conformity_outer = 0.52
        radial_clearance_um = 5.0
        youngs_modulus_gpa = 207.0
        poissons_ratio = 0.3
        density_kg_m3 = 7800.0
        [shaft]
        motion = "internal"
        speed_hz = 10.0
        load_n = [0.0, -49.0]
        [housing]
        motion = "internal"
        "#,
    )
    .unwrap()
}

/// A machine's answer to elements that pass a spall of `length` degrees at shaft speed `speed` [Hz]: the force that
/// the element loses moves the housing (a mode at 700 Hz), and impacts on entry and exit excite a resonance at 9 kHz.
/// Noise of `noise` times the signal's root mean square. Passages scatter by 0.2 degrees. `length` 0 is a healthy
/// bearing: noise and shaft harmonics.
pub fn signal(length: f64, speed: f64, noise: f64) -> Vec<f64> {
    let count = (4.0 * RATE) as usize;
    let bearing = scene().bearing;
    let travel = 40.0 * kinematics::frequencies(&bearing, 0.004, speed).bpfo;
    let mut random = Random::new(7);
    let mut force = vec![0.0; count];
    let mut high = vec![0.0; count];
    if length > 0.0 {
        for k in 0..(4.0 * travel / 40.0) as usize {
            let edge = (k as f64 * 40.0 + 7.0 + 0.2 * random.normal()) / travel;
            // Free after 0.42 degrees: 49 N on nine elements. The first impact falls in the middle of a short spall, or
            // on its floor.
            let unloading = 0.42;
            let first = (0.5 * length).min(1.1);
            for (impact, strength) in [(first, 0.8), (length - 0.5 * unloading, 1.0)] {
                add_impact(&mut high, edge + impact / travel, strength);
            }
            let from = (edge * RATE) as usize;
            for (i, f) in force.iter_mut().enumerate().skip(from).take((length / travel * RATE) as usize + 2) {
                let s = (i as f64 / RATE - edge) * travel;
                let depth = s.min(length - s).clamp(0.0, unloading) / unloading;
                *f -= 1.0 - (1.0 - depth * depth).powf(1.5);
            }
        }
    }
    let low = housing(&force);
    let mut all: Vec<f64> = low.iter().zip(&high).map(|(l, h)| l + 3.0 * h).collect();
    let rms = (all.iter().map(|x| x * x).sum::<f64>() / count as f64).sqrt().max(if length > 0.0 { 0.0 } else { 1.0 });
    for (i, x) in all.iter_mut().enumerate() {
        let shaft = if length > 0.0 { 0.0 } else { (TAU * 3.0 * speed * i as f64 / RATE).sin() };
        *x += rms * (noise * random.normal() + shaft);
    }
    all
}

fn add_impact(signal: &mut [f64], at: f64, strength: f64) {
    let from = (at * RATE).ceil() as usize;
    for (i, x) in signal.iter_mut().enumerate().skip(from).take(400) {
        let t = i as f64 / RATE - at;
        *x += strength * (-t / 1.5e-4).exp() * (TAU * 9000.0 * t).sin();
    }
}

/// Acceleration of a mass of 1 on a spring and damper (700 Hz, 5 %) under `force`.
fn housing(force: &[f64]) -> Vec<f64> {
    let (omega, dt) = (TAU * 700.0, 1.0 / RATE);
    let (mut x, mut v) = (0.0, 0.0);
    force
        .iter()
        .map(|f| {
            let a = f - omega * omega * x - 0.1 * omega * v;
            v += dt * a;
            x += dt * v;
            a
        })
        .collect()
}
