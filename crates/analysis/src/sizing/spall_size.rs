//! Length of a spall of a raceway from vibration recordings, with its uncertainty, or why there is none.
//!
//! Each recording is sized by similarity to the scene's own rig if the scene describes the rig
//! ([`waveform`](super::waveform)), else by the events of its passages, which needs nothing but the bearing's
//! dimensions ([`event_length`](super::event_length)). A rig that is similar to the recording also distinguishes a
//! line spall from an extended one; otherwise ringing does ([`ringing`](super::waveform::ringing)), or nothing does.
//!
//! Several recordings are of one spall: their lengths are averaged with their statistical weights, and a scatter that
//! is larger than these explain widens the interval. What all share (what the events mean, the contact's law) is not
//! averaged away.

use super::combined::{self, Combined, Wandering};
use super::measured::Measured;
use super::raceway::Raceway;
use super::report::{RecordingReport, Report, Verdict};
use super::sized::{COVERAGE, Length, Sized};
use crate::recording::{Recording, SizingError};
use crate::sizing::waveform::Maps;
use crate::statistics;
use brinell::scene::Scene;

/// Sizes the spall in recordings of one bearing. The scene gives bearing, load and rig; its defect is ignored.
///
/// ```
/// use brinell::scene::{ContactLaw, Scene};
/// use brinell::simulation::Simulation;
/// use brinell_analysis::recording::Recording;
/// use brinell_analysis::sizing::Verdict;
/// use brinell_analysis::sizing::size;
///
/// // A healthy bearing, as its sensor records it for half a second at 25.6 kHz.
/// let mut scene = brinell_scene_file::from_toml(include_str!("../../../../scenes/6205-spall-5deg.toml"))?;
/// scene.contact.law = ContactLaw::Hertz;
/// let mut simulation = Simulation::new(Scene { defects: Vec::new(), ..scene.clone() }, None)?;
/// simulation.initialize(0.0)?;
/// let samples = simulation.samples(&["sensor.acceleration"], 1.0 / 25.6e3)?.skip(2560).take(12_800);
/// let signal = samples.map(|sample| Ok(sample?.values[0])).collect::<Result<Vec<f64>, brinell::Error>>()?;
///
/// let report = size(&[Recording::new("healthy", signal, 25.6e3, 10.0)?], &scene)?;
/// assert_eq!((report.verdict, report.length_deg), (Verdict::Unresolved, None));
/// println!("{}", report.reason);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Recordings that cannot be sized whatever the bearing's state: too short, or too coarse for their speed.
pub fn size(recordings: &[Recording], scene: &Scene) -> Result<Report, SizingError> {
    size_with(recordings, scene, &|_| None, &mut |_| ())
}

/// The same with contact maps from elsewhere, reporting after each recording its result.
///
/// # Errors
/// As [`size`].
pub fn size_with(
    recordings: &[Recording],
    scene: &Scene,
    maps: Maps<'_>,
    done: &mut dyn FnMut(&RecordingReport),
) -> Result<Report, SizingError> {
    refuse_twins(recordings)?;
    let measured: Vec<Measured> =
        recordings.iter().map(|recording| Measured::new(recording, &scene.bearing)).collect::<Result<_, _>>()?;
    let sized: Vec<Sized> = measured
        .into_iter()
        .map(|measured| {
            let sized = Sized::of(measured, scene, maps);
            done(&sized.report());
            sized
        })
        .collect();
    let first = sized.first().ok_or(SizingError::NoRecordings)?;
    let mut report = Report {
        fault: combined::common_fault(&sized),
        grade: combined::common_grade(&sized),
        next: combined::next_step(&sized),
        bpfo_hz: first.measured.bpfo,
        slip: statistics::mean(&sized.iter().map(|s| s.measured.slip).collect::<Vec<_>>()),
        passages: sized.iter().map(|s| s.measured.passages.starts.len()).sum(),
        recordings: sized.iter().map(Sized::report).collect(),
        figures: sized.iter().map(|s| s.figure(scene)).collect(),
        ..Report::default()
    };
    let lengths: Vec<&Length> = sized.iter().filter_map(|s| s.length.as_ref().ok()).collect();
    let onset = combined::steady_onset(&sized);
    match combined::of_one_fault(&sized)
        .and_then(|()| onset.as_ref().map_err(ToString::to_string).copied())
        .and_then(|()| combined::combine(&lengths, sized.len()))
        .and_then(|combined| combined::firm_inside(&sized).map(|()| combined))
    {
        Err(why) => {
            let each = report
                .recordings
                .iter()
                .filter_map(|r| r.reason.as_ref().map(|reason| format!("{}: {reason}", r.name)));
            let why = Some(why).filter(|_| sized.len() > 1);
            report.reason = why.into_iter().chain(each).chain(combined::cuts(&sized)).collect::<Vec<_>>().join("; ");
            report.at_least_deg = at_least(onset, &sized);
        }
        Ok(Combined { length, uncertainty }) => {
            let mm_per_degree = 1e3 * Raceway::of(report.fault).radius(&scene.bearing) * 1f64.to_radians();
            report.verdict = Verdict::Resolved;
            report.standing = Some(combined::standing(&sized));
            report.length_deg = Some(length);
            report.length_mm = Some(length * mm_per_degree);
            report.uncertainty_mm = Some(COVERAGE * uncertainty * mm_per_degree);
            report.kind = combined::common_kind(&lengths);
            report.method = lengths.first().map(|l| l.method);
            let critical = sized.iter().find_map(|s| s.classification.critical_load.as_ref());
            report.critical_load_n = critical.and_then(|load| load.as_ref().ok().copied());
            report.critical_load_reason = critical.and_then(|found| found.as_ref().err().map(ToString::to_string));
            report.critical_depth_um =
                sized.iter().find_map(|s| s.classification.critical_depth).map(|depth| 1e6 * depth);
            report.reason = combined::basis(&report, &sized, scene);
        }
    }
    Ok(report)
}

/// What is left of a length (degrees): the least that recordings with wandering onsets have, or the most that one has.
fn at_least(onset: Result<(), Wandering>, sized: &[Sized]) -> Option<f64> {
    let wandering = onset.err().map(|wandering| wandering.at_least);
    wandering.or_else(|| sized.iter().filter_map(Sized::at_least).reduce(f64::max))
}

/// Equal recordings are one: counted twice it would narrow the interval.
fn refuse_twins(recordings: &[Recording]) -> Result<(), SizingError> {
    for (k, one) in recordings.iter().enumerate() {
        if let Some(other) = recordings[..k].iter().find(|other| other.samples() == one.samples()) {
            return Err(SizingError::Twice { name: one.name().to_owned(), other: other.name().to_owned() });
        }
    }
    Ok(())
}
