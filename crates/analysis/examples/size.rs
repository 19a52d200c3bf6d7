//! Sizes the spall in recordings of one bearing and prints the report as JSON:
//! `cargo run --release -p brinell-analysis --example size -- SCENE RATE_HZ FILE@SPEED_HZ…`

use brinell_analysis::recording::{Recording, Source, Speed, TextFormat};
use brinell_analysis::sizing::size;
use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, scene, rate, files @ ..] = &arguments[..] else { return Err("SCENE RATE_HZ FILE@SPEED_HZ…".into()) };
    let scene = brinell_scene_file::from_toml(&std::fs::read_to_string(scene)?)?;
    let rate: f64 = rate.parse()?;
    let mut recordings = Vec::new();
    for file in files {
        let (path, speed) = file.rsplit_once('@').ok_or("FILE@SPEED_HZ")?;
        let text = TextFormat::default();
        let source = Source { rate: Some(rate), speed: Speed::Constant(speed.parse()?), signal: None, text };
        recordings.push(Recording::read(Path::new(path), &source)?);
    }
    println!("{}", serde_json::to_string_pretty(&size(&recordings, &scene)?)?);
    Ok(())
}
