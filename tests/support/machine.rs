//! A machine that is made here: what the vibration of a bearing with a spall looks like, by the kinematics of an
//! element of finite size. No recording of a machine is needed.
// Not every test that makes recordings makes all of them.
#![allow(unreachable_pub, dead_code, clippy::unwrap_used)]

use brinell::geometry::kinematics;
use brinell::scene::{Bearing, ContactLaw, Scene};
use brinell::simulation::Simulation;
use brinell_analysis::statistics::Random;
use std::f64::consts::TAU;

/// Sampling rate (Hz).
pub const RATE: f64 = 51_200.0;

/// A 6205 under 49 N whose rig is not described: nothing to simulate.
pub fn scene() -> Scene {
    let bearing = Bearing::steel_balls(9, 7.94 / 1e3, 39.04 / 1e3);
    Scene::builder(bearing).name("rig").shaft_speed(10.0 * TAU).shaft_load([0.0, -49.0]).build().unwrap()
}

/// A shipped scene under the contact law that needs no map.
pub fn shipped(name: &str) -> Scene {
    let text = std::fs::read_to_string(brinell_tests::root().join(format!("scenes/{name}.toml"))).unwrap();
    let mut scene = brinell_scene_file::from_toml(&text).unwrap();
    scene.contact.law = ContactLaw::Hertz;
    scene
}

/// What the sensor of a scene records at a rate (Hz).
pub fn recorded(scene: Scene, rate: f64, seconds: f64) -> Vec<f64> {
    let mut simulation = Simulation::new(scene, None).unwrap();
    simulation.initialize(0.0).unwrap();
    let samples = simulation.samples(&["sensor.acceleration"], 1.0 / rate).unwrap();
    samples.skip(1).take((seconds * rate) as usize).map(|sample| sample.unwrap().values[0]).collect()
}

/// A spall as its events show it.
#[derive(Clone, Copy)]
pub struct Spall {
    /// Length [degrees of its raceway].
    pub length: f64,
    /// Whether it is on the inner raceway, turns with the shaft and is struck in the load zone only.
    pub inner: bool,
    /// Whether an element strikes its floor or, in a short one, is caught.
    pub first_impact: bool,
    /// Degrees by which the last impact comes early in a part of the passages, drawn by chance.
    pub early: f64,
}

/// A machine's answer to elements that pass a spall of `length` degrees at shaft speed `speed` (Hz): the force that
/// the element loses moves the housing (a mode at 700 Hz), and impacts on entry and exit excite a resonance at 9 kHz.
/// Noise of `noise` times the signal's root mean square. Passages scatter by 0.2 degrees. `length` 0 is a healthy
/// bearing: noise and shaft harmonics.
pub fn signal(length: f64, speed: f64, noise: f64) -> Vec<f64> {
    signal_of(Spall { length, inner: false, first_impact: true, early: 0.0 }, speed, noise)
}

/// The same of any spall.
pub fn signal_of(spall: Spall, speed: f64, noise: f64) -> Vec<f64> {
    let Spall { length, inner, first_impact, early } = spall;
    let count = (4.0 * RATE) as usize;
    let frequencies = kinematics::frequencies(&scene().bearing, 0.004, speed);
    let travel = 40.0 * if inner { frequencies.bpfi } else { frequencies.bpfo };
    // Free after 0.42 degrees: 49 N on nine elements; inside these are 0.52. The first impact falls in the middle of a
    // short spall, or on its floor.
    let (unloading, floor) = if inner { (0.52, 1.35) } else { (0.42, 1.1) };
    let mut random = Random::new(7);
    let mut force = vec![0.0; count];
    let mut high = vec![0.0; count];
    if length > 0.0 {
        for k in 0..(4.0 * travel / 40.0) as usize {
            let edge = (k as f64 * 40.0 + 7.0 + 0.2 * random.normal()) / travel;
            // The load zone, through which an inner ring turns: eight times as strong as opposite to it.
            let load = if inner { (TAU * speed * edge).cos().max(0.12) } else { 1.0 };
            let first = (0.5 * length).min(floor);
            let sooner = if early > 0.0 && random.uniform() < 0.5 { early } else { 0.0 };
            let last = length - 0.5 * unloading - sooner;
            let strength = if first_impact { 0.8 } else { 0.0 };
            for (impact, strength) in [(first, strength), (last, 1.0)] {
                add_impact(&mut high, edge + impact / travel, load * strength);
            }
            let from = (edge * RATE) as usize;
            for (i, f) in force.iter_mut().enumerate().skip(from).take((length / travel * RATE) as usize + 2) {
                let s = (i as f64 / RATE - edge) * travel;
                let depth = s.min(length - s).clamp(0.0, unloading) / unloading;
                *f -= load * (1.0 - (1.0 - depth * depth).powf(1.5));
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
