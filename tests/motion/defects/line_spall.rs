//! The paper's test bearing with a line spall, law `hertz`: the times of its events and the ringing between them.
//!
//! Times count from the moment the element's centre passes the leading edge. Expected values are those of a separate
//! prototype of the same equations; they agree with the four events that the paper describes.

use super::amplitude;
use crate::support::{Named, shipped};
use brinell::scene::ContactLaw;

/// Time after which element 1 of `er16k-tb1` passes the leading edge (s).
const ENTRY: f64 = 5e-3;
const STEP: f64 = 1e-5;

struct Passage {
    inner: Vec<f64>,
    outer: Vec<f64>,
    acceleration: Vec<f64>,
}

impl Passage {
    fn of(name: &str, stop: f64) -> Self {
        let mut scene = shipped(name);
        scene.contact.law = ContactLaw::Hertz;
        let names = ["element[1].force.inner", "element[1].force.outer", "housing.ay"];
        let course = Named::started(scene).course(names, STEP, (stop / STEP).round() as usize);
        let [inner, outer, acceleration] = [0, 1, 2].map(|k| course.iter().map(|row| row[k]).collect());
        Self { inner, outer, acceleration }
    }

    /// First time after `from` at which a force is (or is not) there, both counted from the entry (s).
    fn first(force: &[f64], from: f64, there: bool) -> f64 {
        let start = ((ENTRY + from) / STEP).round() as usize;
        let found = (start..force.len()).find(|&i| (force[i] > 0.0) == there).expect("an event");
        (found + 1) as f64 * STEP - ENTRY
    }

    /// Frequency of the strongest line between `low` and `high` of the housing's acceleration from `from` to `to`.
    fn ringing(&self, from: f64, to: f64) -> f64 {
        let range = ((ENTRY + from) / STEP) as usize..((ENTRY + to) / STEP) as usize;
        let signal = &self.acceleration[range];
        let mean = signal.iter().sum::<f64>() / signal.len() as f64;
        let signal: Vec<f64> = signal.iter().map(|value| value - mean).collect();
        let line = |hertz: &f64| amplitude(&signal, *hertz, STEP);
        (3000..15000).map(|i| f64::from(i) * 0.1).max_by(|a, b| line(a).total_cmp(&line(b))).expect("a line")
    }
}

#[test]
fn the_four_events_of_the_line_spall_come_at_their_times() {
    let passage = Passage::of("er16k-tb1", 20e-3);
    let ms = |seconds: f64| seconds * 1e3;
    let unloaded = ms(Passage::first(&passage.outer, 0.1e-3, false));
    assert!((unloaded - 0.6).abs() < 0.1, "the element is unloaded after {unloaded} ms");
    let reloaded = ms(Passage::first(&passage.inner, 9e-3, true));
    assert!((reloaded - 10.1).abs() < 0.1, "both contacts strike again after {reloaded} ms");
    // 15.8° at the cage's speed; after it the element stays loaded.
    let edge: f64 = 15.8 / 360.0 / (10.0 * 0.5 * (1.0 - 7.94 / 39.32)) * 1e3;
    assert!((edge - 11.0).abs() < 0.1, "the trailing edge is passed after {edge} ms");
    let after = ((ENTRY + 11.0e-3) / STEP) as usize;
    assert!(passage.outer[after..].iter().all(|&force| force > 0.0), "unloaded again beyond the edge");
    let peak = passage.outer[..after + 200].iter().copied().fold(0.0, f64::max);
    assert!((peak - 400.0).abs() < 20.0, "peak force {peak} N");
}

#[test]
fn the_bearing_rings_lower_while_the_element_is_in_the_spall() {
    let passage = Passage::of("er16k-tb1", 26e-3);
    for (from, to, expected) in [(0.8e-3, 9e-3, 800.0), (12e-3, 20e-3, 995.0)] {
        let found = passage.ringing(from, to);
        assert!((found / expected - 1.0).abs() < 0.03, "{found} Hz, expected {expected} Hz");
    }
}
