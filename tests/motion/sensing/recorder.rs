//! The recorder samples inside the step, and the recording is a file that NumPy reads.

use crate::support::defects::short_spall;
use crate::support::{Named, shipped};
use brinell::recording::Recording;
use brinell::scene::{ContactLaw, Defect, Recorder, RecorderFilter, Scene};
use std::f64::consts::FRAC_PI_2;
use std::fs;
use std::path::PathBuf;

const RATE: f64 = 51_200.0;

const FILTERS: [RecorderFilter; 2] = [RecorderFilter::None, RecorderFilter::LinearPhase];

/// Element 1 enters the spall at the start: impacts, contact changes, knots.
fn scene(filter: RecorderFilter) -> Scene {
    let mut scene = shipped("er16k-tb1");
    scene.recorder = Some(Recorder { rate: RATE, filter });
    scene.tolerance = 1e-7;
    scene
}

fn samples(run: &Named) -> (usize, Vec<f64>) {
    let samples = run.0.recorder().unwrap().samples();
    (samples.width, samples.values.to_vec())
}

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("brinell-recorder-{}-{name}", std::process::id()));
    drop(fs::remove_dir_all(&folder));
    folder
}

#[test]
fn recording_changes_no_bit_of_the_run() {
    for filter in FILTERS {
        let (mut with, mut without) = (Named::recorded(scene(filter)), Named::started(scene(filter)));
        with.run(1e-3, 12);
        without.run(1e-3, 12);
        assert_same(&mut with, &mut without);
        assert!(without.0.recorder().is_none());
    }
}

#[test]
fn recording_changes_no_bit_of_a_run_whose_contacts_are_solved_on_a_grid() {
    let mut scene = scene(RecorderFilter::LinearPhase);
    scene.contact.law = ContactLaw::Love;
    scene.contact.largest_force = Some(1000.0);
    // Element 1 enters a short shallow spall 0.1 mm from where it starts.
    scene.defects = vec![Defect::outer(-FRAC_PI_2, short_spall())];
    scene.cage.initial_angle = -FRAC_PI_2 - 3e-4 / scene.bearing.outer_raceway_radius();
    let (mut with, mut without) = (Named::recorded(scene.clone()), Named::started(scene));
    with.run(2e-5, 20);
    without.run(2e-5, 20);
    assert!(with.count("solver.contact_solves") > 0, "no element was near the defect");
    assert_same(&mut with, &mut without);
}

fn assert_same(with: &mut Named, without: &mut Named) {
    assert_eq!(with.0.state_vector(), without.0.state_vector());
    for counter in ["solver.steps", "solver.rejected_steps", "solver.map_lookups", "solver.contact_solves"] {
        assert_eq!(with.count(counter), without.count(counter), "{counter}");
    }
}

/// Rows that are complete when so many have begun.
fn complete(begun: usize, filter: RecorderFilter) -> usize {
    match filter {
        RecorderFilter::None => begun,
        RecorderFilter::LinearPhase => begun.saturating_sub(15),
    }
}

#[test]
fn a_host_that_steps_by_milliseconds_gets_what_one_gets_that_stops_at_each_sample() {
    let names = ["housing.ay", "shaft.force.y", "element[1].path", "element[1].force.outer", "cage.angle"];
    // Largest values in these 12 ms: 30 m/s², 500 N, 0.1 mm, 400 N, 1 rad. The tolerance is 1e-7 of an approach, which
    // gives about 1e-6 of a force or an acceleration; dense output and impacts cost the rest of the margin.
    let margins = [30.0 * 1e-4, 500.0 * 1e-4, 1e-4 * 1e-4, 400.0 * 1e-4, 1e-12];
    for filter in FILTERS {
        let (mut far, mut near) = (Named::recorded(scene(filter)), Named::started(scene(filter)));
        far.run(1e-3, 12);
        let (width, rows) = samples(&far);
        let columns = far.columns(&names);
        for (i, row) in rows.chunks(width).enumerate() {
            assert!((row[0] - i as f64 / RATE).abs() < 1e-15, "sample {i} is at {} s", row[0]);
            for ((name, column), margin) in names.iter().zip(&columns).zip(margins) {
                // What is filtered is no value of an instant.
                if filter == RecorderFilter::LinearPhase && (name.ends_with(".ay") || name.ends_with("force.y")) {
                    continue;
                }
                let (found, expected) = (column[i], near.get(name));
                assert!((found - expected).abs() < margin, "{name} at sample {i}: {found}, by itself {expected}");
            }
            near.0.step(1.0 / RATE).unwrap();
        }
        // 12 ms at 51.2 kHz are 614.4 periods: samples 0 to 614.
        assert_eq!(rows.len(), complete(615, filter) * width);
    }
}

#[test]
fn every_sample_comes_once_however_time_is_split() {
    // Steps shorter and longer than a period, multiples of it, and lengths that no binary number has.
    let splits: [&[f64]; 4] = [&[0.02], &[1e-4], &[1.0 / RATE], &[3e-6, 7e-4, 1.0 / RATE, 1e-5]];
    for (steps, filter) in splits.into_iter().flat_map(|steps| FILTERS.map(|filter| (steps, filter))) {
        let mut scene = shipped("6205-healthy");
        scene.recorder = Some(Recorder { rate: RATE, filter });
        let mut run = Named::recorded(scene);
        let mut time = 0.0;
        for &step in steps.iter().cycle() {
            if time + step > 0.02 + 1e-12 {
                break;
            }
            run.0.step(step).unwrap();
            time += step;
        }
        let (width, rows) = samples(&run);
        let begun = (time * RATE - 1e-6).ceil() as usize;
        assert_eq!(rows.len(), complete(begun, filter) * width, "steps {steps:?} to {time} s");
        for (i, row) in rows.chunks(width).enumerate() {
            assert!((row[0] - i as f64 / RATE).abs() < 1e-12, "steps {steps:?}, sample {i} at {} s", row[0]);
        }
    }
}

#[test]
fn samples_of_time_taken_back_are_taken_back() {
    for filter in FILTERS {
        let (mut straight, mut wavering) = (Named::recorded(scene(filter)), Named::recorded(scene(filter)));
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
}

#[test]
fn a_run_that_is_taken_up_where_nothing_was_recorded_is_recorded_from_there() {
    for filter in FILTERS {
        let (mut on, mut off) = (Named::recorded(scene(filter)), Named::started(scene(filter)));
        on.run(1e-3, 3);
        off.0.restore(&on.0.save()).unwrap();
        off.run(1e-3, 3);
        on.0.restore(&off.0.save()).unwrap();
        on.run(1e-3, 3);
        let (width, rows) = samples(&on);
        assert_eq!(on.0.recorder().unwrap().samples().first, 0);
        // 3 ms at 51.2 kHz are 153.6 periods.
        assert_eq!(rows.len(), complete(154, filter) * width);
        assert!((rows[0] - 6e-3).abs() < 1e-15, "the first is at {} s", rows[0]);
        let steady = off.get("shaft.force.y");
        // Where it begins, all stood as it is: a filter that took what was 3 ms ago or nothing would show it.
        let force = on.columns(&["shaft.force.y"])[0][0];
        assert!((force - steady).abs() < 0.1 * steady.abs(), "{force} N after {steady} N");
    }
}

#[test]
fn the_file_holds_all_samples_and_its_header_counts_them() {
    for filter in FILTERS {
        check_file(scene(filter));
    }
}

fn check_file(scene: Scene) {
    let folder = folder("file");
    let mut run = Named::new(scene);
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
    let mut run = Named::new(scene(RecorderFilter::None));
    run.0.record_into(folder.to_str().unwrap());
    run.0.initialize(0.0).unwrap();
    let error = Recording::begin(&run.0, "bearing").unwrap_err().to_string();
    assert!(error.contains(folder.to_str().unwrap()) && error.contains("recorder.folder"), "{error}");
    fs::remove_file(folder).unwrap();
}

#[test]
fn no_folder_means_no_recording_and_a_scene_without_recorder_has_no_such_variable() {
    let run = Named::started(scene(RecorderFilter::None));
    assert!(Recording::begin(&run.0, "bearing").unwrap().is_none());
    let named = |scene: Scene| Named::new(scene).0.table().iter().any(|variable| variable.name == "recorder.folder");
    assert!(named(scene(RecorderFilter::None)));
    assert!(!named(shipped("er16k-tb1")));
}

#[test]
fn a_step_that_is_inspected_and_parted_records_what_a_plain_one_does() {
    for filter in FILTERS {
        let (mut plain, mut inspected, mut parted) =
            (Named::recorded(scene(filter)), Named::recorded(scene(filter)), Named::recorded(scene(filter)));
        let speed = plain.reference("shaft.speed");
        for _ in 0..8 {
            plain.0.step(1e-3).unwrap();
            for (run, nudge) in [(&mut inspected, 0.0), (&mut parted, 1e-9)] {
                let mut under_way = run.0.begin_step(1e-3).unwrap();
                while !under_way.is_done() {
                    run.0.advance_once(&mut under_way).unwrap();
                    let inspection = run.0.inspect(&under_way);
                    let mut value = [0.0];
                    run.0.reals(&[speed], &mut value).unwrap();
                    run.0.get("sensor.acceleration").unwrap();
                    run.0.set_reals(&[speed], &[value[0] + nudge]).unwrap();
                    run.0.resume(&mut under_way, inspection).unwrap();
                }
                run.0.end_step(under_way);
            }
        }
        let (width, expected) = samples(&plain);
        assert_eq!(samples(&inspected), (width, expected.clone()), "inspecting changes no bit");
        // A speed that has been nudged some hundred times is another run, but its samples are as many, and at the
        // same instants except for the roundings of the parts.
        let (_, found) = samples(&parted);
        assert_eq!(found.len(), expected.len());
        for (a, b) in found.chunks_exact(width).zip(expected.chunks_exact(width)) {
            assert!((a[0] - b[0]).abs() < 1e-12, "{} and {} s", a[0], b[0]);
        }
    }
}
