//! Noise of a measured spectrum.

use super::*;

/// 1 m/s²/√Hz up to half of the sampling rate: a square of 12 800 (m/s²)².
const FLAT: &str = "frequency_hz,amplitude_m_s2_per_sqrt_hz\n0,1\n12800,1\n";

/// No other noise, and the file of a spectrum beside the sweep's.
fn with_spectrum(folder: &Path, spectrum: &str) -> PathBuf {
    fs::write(folder.join("floor.csv"), spectrum).unwrap();
    file(folder, &QUICK.replace("noise_db = [0, 30]", "noise_spectrum = \"floor.csv\""))
}

#[test]
fn runs_of_every_class_have_the_power_of_the_table_in_physical_units() {
    let folder = common::folder("sweep-spectrum");
    let path = with_spectrum(&folder, FLAT);
    let (noisy, clean) = (folder.join("noisy"), folder.join("clean"));
    sweep(&path, &noisy, &[]);
    sweep(&file(&folder, &QUICK.replace("noise_db = [0, 30]\n", "")), &clean, &[]);
    let [noisy, clean] =
        [noisy, clean].map(|out| all(&out, "rms_m_s2").iter().map(|rms| rms * rms).collect::<Vec<_>>());
    for class in 0..3 {
        let runs = || noisy.iter().zip(&clean).skip(class).step_by(3);
        let power = runs().map(|(noisy, clean)| noisy - clean).sum::<f64>() / 8.0;
        let signal = runs().map(|(_, clean)| clean).sum::<f64>() / 8.0;
        // Eight times 512 samples: four standard errors of their squares, and of twice their products with the signal.
        let samples = 8.0 * 512.0;
        let bound = 4.0 * ((2.0 + 4.0 * signal / 12_800.0) / samples).sqrt();
        assert!((power / 12_800.0 - 1.0).abs() < bound, "class {class}: {power}, {bound}");
    }
}

#[test]
fn noise_of_a_spectrum_has_equal_bits_in_parts_and_another_spectrum_is_another_sweep() {
    let folder = common::folder("sweep-spectrum-parts");
    let path = with_spectrum(&folder, FLAT);
    let (one, parts) = (folder.join("one"), folder.join("parts"));
    sweep(&path, &one, &["--signals", "array", "--jobs", "1"]);
    sweep(&path, &parts, &["--signals", "array", "--part", "2/2"]);
    sweep(&path, &parts, &["--signals", "array", "--jobs", "3"]);
    same_bits(&one, &parts);
    with_spectrum(&folder, &FLAT.replace("12800,1", "12800,2"));
    assert!(refused(&path, &one, &["--signals", "array"]).contains("file \"floor.csv\""));
}
