//! The recorder samples inside the step, and the recording is a file that NumPy reads.
#![allow(clippy::unwrap_used)]

mod support;

use brinell::recording::Recording;
use brinell::scene::Scene;
use std::fs;
use std::path::PathBuf;
use support::{Named, shipped};

const RATE: f64 = 51_200.0;

/// Element 1 enters the spall at the start: impacts, contact changes, knots.
fn scene() -> Scene {
    let mut scene = shipped("er16k-tb1");
    scene.recorder_rate = Some(RATE);
    scene.tolerance = 1e-7;
    scene
}

fn recorded(scene: Scene) -> Named {
    let mut run = Named::new(scene);
    run.0.record_into("somewhere");
    run.0.initialize(0.0).unwrap();
    run
}

fn samples(run: &Named) -> (usize, Vec<f64>) {
    let samples = run.0.recorder().unwrap().samples();
    (samples.width, samples.values.to_vec())
}

/// Number of the column of a signal.
fn column(run: &Named, name: &str) -> usize {
    let reference = run.reference(name);
    1 + run.0.recorder().unwrap().references().position(|r| r == reference).unwrap()
}

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("brinell-recorder-{}-{name}", std::process::id()));
    drop(fs::remove_dir_all(&folder));
    folder
}

#[test]
fn recording_changes_no_bit_of_the_run() {
    let (mut with, mut without) = (recorded(scene()), Named::started(scene()));
    for _ in 0..12 {
        with.0.step(1e-3).unwrap();
        without.0.step(1e-3).unwrap();
    }
    assert_eq!(with.0.state_vector(), without.0.state_vector());
    for counter in ["solver.steps", "solver.rejected_steps", "solver.map_lookups"] {
        assert_eq!(with.count(counter), without.count(counter), "{counter}");
    }
    assert!(without.0.recorder().is_none());
}

#[test]
fn a_host_that_steps_by_milliseconds_gets_what_one_gets_that_stops_at_each_sample() {
    let (mut far, mut near) = (recorded(scene()), Named::started(scene()));
    for _ in 0..12 {
        far.0.step(1e-3).unwrap();
    }
    let (width, rows) = samples(&far);
    let names = ["housing.ay", "shaft.force.y", "element[1].path", "element[1].force.outer", "cage.angle"];
    // Largest values in these 12 ms: 30 m/s², 500 N, 0.1 mm, 400 N, 1 rad. The tolerance is 1e-7 of an approach, which
    // gives about 1e-6 of a force or an acceleration; dense output and impacts cost the rest of the margin.
    let margins = [30.0 * 1e-4, 500.0 * 1e-4, 1e-4 * 1e-4, 400.0 * 1e-4, 1e-12];
    let columns = names.map(|name| column(&far, name));
    for (i, row) in rows.chunks(width).enumerate() {
        assert!((row[0] - i as f64 / RATE).abs() < 1e-15, "sample {i} is at {} s", row[0]);
        for ((name, at), margin) in names.iter().zip(columns).zip(margins) {
            let expected = near.get(name);
            let found = row[at];
            assert!((found - expected).abs() < margin, "{name} at sample {i}: {found}, by itself {expected}");
        }
        near.0.step(1.0 / RATE).unwrap();
    }
    // 12 ms at 51.2 kHz are 614.4 periods: samples 0 to 614.
    assert_eq!(rows.len(), 615 * width);
}

#[test]
fn every_sample_comes_once_however_time_is_split() {
    let mut scene = shipped("6205-healthy");
    scene.recorder_rate = Some(RATE);
    // Steps shorter and longer than a period, multiples of it, and lengths that no binary number has.
    let splits: [&[f64]; 4] = [&[0.02], &[1e-4], &[1.0 / RATE], &[3e-6, 7e-4, 1.0 / RATE, 1e-5]];
    for steps in splits {
        let mut run = recorded(scene.clone());
        let mut time = 0.0;
        for &step in steps.iter().cycle() {
            if time + step > 0.02 + 1e-12 {
                break;
            }
            run.0.step(step).unwrap();
            time += step;
        }
        let (width, rows) = samples(&run);
        let expected = (time * RATE - 1e-6).ceil() as usize;
        assert_eq!(rows.len(), expected * width, "steps {steps:?} to {time} s");
        for (i, row) in rows.chunks(width).enumerate() {
            assert!((row[0] - i as f64 / RATE).abs() < 1e-12, "steps {steps:?}, sample {i} at {} s", row[0]);
        }
    }
}

#[test]
fn samples_of_time_taken_back_are_taken_back() {
    let (mut straight, mut wavering) = (recorded(scene()), recorded(scene()));
    for index in 0..8 {
        let saved = wavering.0.save();
        wavering.set("shaft.load.y", -900.0);
        wavering.0.step(2e-3).unwrap();
        wavering.0.restore(&saved).unwrap();
        for run in [&mut straight, &mut wavering] {
            run.0.step(1e-3).unwrap();
            if index == 4 {
                run.0.forget_samples();
            }
        }
    }
    assert_eq!(straight.0.recorder().unwrap().samples(), wavering.0.recorder().unwrap().samples());
}

#[test]
fn the_file_holds_all_samples_and_its_header_counts_them() {
    let folder = folder("file");
    let mut run = Named::new(scene());
    run.0.record_into(folder.to_str().unwrap());
    run.0.initialize(0.0).unwrap();
    let mut recording = Recording::begin(&run.0, "left/bearing: ä").unwrap().unwrap();
    assert_eq!(recording.path(), folder.join("left_bearing__ä.npy"));
    let mut all = Vec::new();
    for index in 0..10 {
        let saved = run.0.save();
        run.0.step(1e-3).unwrap();
        if index == 3 {
            // Stored, and then taken back.
            recording.store(&mut run.0).unwrap();
            run.0.restore(&saved).unwrap();
            run.0.step(1e-3).unwrap();
        }
        all.extend(samples(&run).1);
        recording.store(&mut run.0).unwrap();
    }
    let bytes = fs::read(recording.path()).unwrap();
    assert_eq!(&bytes[..8], b"\x93NUMPY\x02\x00");
    let length = u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize;
    assert_eq!((12 + length) % 64, 0);
    let header = std::str::from_utf8(&bytes[12..12 + length]).unwrap();
    assert!(header.starts_with("{'descr': [('time', '<f8'), ("), "{header}");
    let width = run.0.recorder().unwrap().samples().width;
    assert!(header.contains(&format!("'shape': ({},)", all.len() / width)), "{header}");
    let values: Vec<f64> =
        bytes[12 + length..].chunks(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap())).collect();
    assert_eq!(values, all);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_folder_that_cannot_be_made_is_named() {
    let folder = folder("blocked");
    fs::write(&folder, "a file").unwrap();
    let mut run = Named::new(scene());
    run.0.record_into(folder.to_str().unwrap());
    run.0.initialize(0.0).unwrap();
    let error = Recording::begin(&run.0, "bearing").unwrap_err().to_string();
    assert!(error.contains(folder.to_str().unwrap()) && error.contains("recorder.folder"), "{error}");
    fs::remove_file(folder).unwrap();
}

#[test]
fn no_folder_means_no_recording_and_a_scene_without_recorder_has_no_such_variable() {
    let run = Named::started(scene());
    assert!(Recording::begin(&run.0, "bearing").unwrap().is_none());
    let named = |scene: Scene| Named::new(scene).0.table().iter().any(|variable| variable.name == "recorder.folder");
    assert!(named(scene()));
    assert!(!named(shipped("er16k-tb1")));
}
