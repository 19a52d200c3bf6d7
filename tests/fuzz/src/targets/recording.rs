//! Bytes as a recording of a machine: text, NumPy, MATLAB or WAV as they come, and numbers under a sound NumPy header,
//! so that times and signals are tried too. Refused with a reason, or sized: what is resolved is a length.

use std::path::Path;

use brinell_analysis::recording::{Recording, Source, Speed, TextFormat};
use brinell_analysis::sizing::{Verdict, size};

/// 67 samples a passage at 10 Hz: 8 passages, the fewest that are sized, fit into a short input.
const RATE: f64 = 2400.0;

pub(super) fn run(data: &[u8]) -> bool {
    let [choice, content @ ..] = data else { return false };
    let choice = usize::from(*choice);
    let text = TextFormat { delimiter: [None, Some(';')][choice >> 6 & 1], decimal: [None, Some(',')][choice >> 7] };
    let source = Source {
        text,
        rate: [None, Some(RATE)][choice >> 2 & 1],
        speed: match choice >> 3 & 3 {
            0 | 1 => Speed::Constant(10.0),
            2 => Speed::Tachometer("2".to_owned(), 1),
            _ => Speed::Column("2".to_owned()),
        },
        signal: [None, Some("1".to_owned())][choice >> 5 & 1].clone(),
    };
    let (ending, content) = match choice & 3 {
        0 => ("csv", content.to_vec()),
        1 => (["npy", "npz"][choice >> 7], content.to_vec()),
        2 => (["wav", "mat"][choice >> 7], content.to_vec()),
        _ => ("npy", under_a_header(choice >> 6, content)),
    };
    let path = Path::new("recording").with_extension(ending);
    let Ok(recording) = Recording::of_file(&path, &content, &source) else { return false };
    assert!(recording.rate() > 0.0 && recording.speed() > 0.0 && !recording.samples().is_empty());
    assert!(recording.samples().iter().all(|x| x.is_finite()));
    // A scene of a hosted bearing: no rig to simulate.
    let scene = brinell_scene_file::from_toml(super::SCENES[2]).unwrap();
    let Ok(report) = size(&[recording], &scene) else { return false };
    let found = [report.length_mm, report.uncertainty_mm];
    match report.verdict {
        Verdict::Resolved => assert!(found.iter().all(|x| x.is_some_and(|x| x.is_finite() && x > 0.0)), "{found:?}"),
        Verdict::Unresolved => assert!(found == [None; 2] && !report.reason.is_empty()),
    }
    true
}

/// A `.npy` file of these numbers, with or without named fields.
fn under_a_header(kind: usize, numbers: &[u8]) -> Vec<u8> {
    let (descr, row) = [
        ("'<f4'", 4),
        ("'<i2'", 2),
        ("[('time', '<f4'), ('acc', '<f4')]", 8),
        ("[('n', '|u1'), ('acc', '|i1'), ('', '|V1'), ('tacho', '|u1')]", 4),
    ][kind];
    let rows = numbers.len() / row;
    let header = format!("{{'descr': {descr}, 'fortran_order': False, 'shape': ({rows},), }}\n");
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend((header.len() as u16).to_le_bytes());
    file.extend(header.bytes());
    file.extend(&numbers[..rows * row]);
    file
}
