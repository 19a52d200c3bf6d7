//! What a further instance of a scene costs: memory, and time to create, start and free it, through the compiled
//! library.
//!
//! `cargo bench --bench fmi2_instances`. The scene is `er16k-tb1` with its contact map, the memory that of the process
//! (Linux) when a thousand instances are at their first communication point.
#![allow(unsafe_code)]
// A benchmark stops at the first surprise.
#![allow(clippy::unwrap_used, missing_docs)]

#[path = "../fmi2/library.rs"]
#[allow(dead_code)]
mod library;
#[path = "../support/mod.rs"]
mod support;

use libloading::Library;
use library::{Api, Scene, library};
use std::fs;
use std::time::Instant;

const COUNT: usize = 1000;

/// Memory of this process in bytes.
fn resident() -> usize {
    let text = fs::read_to_string("/proc/self/statm").unwrap_or_default();
    text.split_whitespace().nth(1).map_or(0, |pages| pages.parse::<usize>().unwrap() * 4096)
}

fn main() {
    let map = support::map_of(&support::shipped_as_it_is("er16k-tb1"), None).unwrap();
    let size = map.len();
    let scene = Scene::with_map("instances", &map);
    drop(map);
    println!("{}, a map of {} kB", library().display(), size / 1000);
    // SAFETY: the library runs no code when it is loaded.
    let library = unsafe { Library::new(library()).unwrap() };
    let api = Api::of(&library);
    let first = api.start(c"first", &scene);
    let before = resident();
    let mut fastest = [f64::INFINITY; 2];
    let mut all = Vec::with_capacity(COUNT);
    for _ in 0..COUNT {
        let begin = Instant::now();
        let c = api.create(c"further", &scene);
        let created = begin.elapsed().as_secs_f64();
        api.begin(c);
        fastest = [fastest[0].min(created), fastest[1].min(begin.elapsed().as_secs_f64())];
        all.push(c);
    }
    let each = resident().saturating_sub(before) as f64 / COUNT as f64;
    let begin = Instant::now();
    // SAFETY: any handle may be passed.
    all.into_iter().chain([first]).for_each(|c| unsafe { (api.free)(c) });
    let freed = begin.elapsed().as_secs_f64() / (COUNT + 1) as f64;
    println!("a further instance          {:8.1} kB", each / 1e3);
    println!(
        "created, and initialized    {:8.1} {:8.1} µs, the fastest of {COUNT}",
        1e6 * fastest[0],
        1e6 * fastest[1]
    );
    println!("freed                       {:8.1} µs, the mean", 1e6 * freed);
    println!("left behind                 {:8.1} kB", (resident() as f64 - before as f64) / 1e3);
}
