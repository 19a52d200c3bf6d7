//! A measured surface as its instrument leaves it: heights instead of depths, ends that are not at depth 0, the form of
//! the ring, a spike. What an instrument does is known; what the user wants is not, so that each is a question.
//!
//! All but spikes is judged by running medians of five points, which pass edges and leave spikes out. A trace that
//! begins and ends at depth 0 is levelled; the form is that of a tenth of the trace at either end, as `remove_form`
//! takes it off.

use crate::statistics::{extent, median};
use brinell::scene::{Bearing, DefectOn};
use brinell::surface::{Surface, curvature_of_ends, line_through_ends};
use std::fmt;

/// Points from which on a trace is taken for measured, and not for a polygon that somebody has written down.
const MEASURED: usize = 20;
/// Depths (m) that count beside the roughness of raceways, which have Rz below 1 µm.
const ROUGHNESS: f64 = 1e-6;
/// Share of the whole height beyond which ends count where that is small.
const SMALL: f64 = 0.1;
/// A spike is so many times the largest step near it, and these are the points near it.
const ALONE: f64 = 4.0;
const NEAR: usize = 6;
/// Curvature of the ends over that of the body which counts as the body's own.
const OWN: std::ops::RangeInclusive<f64> = 0.85..=1.18;

/// A surface as an instrument leaves it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AsMeasured {
    /// A point that stands alone.
    Spike {
        /// Its arc from the middle of the trace (mm).
        arc_mm: f64,
        /// Its depth (µm).
        depth_um: f64,
        /// Depth of the points about it (µm).
        around_um: f64,
    },
    /// Ends that are curved as the body is.
    Form {
        /// Their radius (mm).
        radius_mm: f64,
        /// That of the body (mm).
        body_mm: f64,
    },
    /// Ends at another depth than 0 (µm): both, the farthest of all lines of a topography.
    Ends([f64; 2]),
    /// More height than depth (µm): of the highest and of the deepest point.
    Heights([f64; 2]),
}

/// A trace, or a line along the arc of a topography.
struct Line<'a> {
    arcs: &'a [f64],
    depths: Vec<f64>,
    smooth: Vec<f64>,
}

/// What is to be asked about a surface of this body; the track on a topography is at `track` (m) across.
pub fn as_measured(surface: &Surface, on: DefectOn, bearing: &Bearing, track: f64) -> Vec<AsMeasured> {
    let (arcs, lines, middle) = match surface {
        Surface::Profile(profile) => {
            let (arcs, depths) = samples(profile.points());
            (arcs, vec![depths], 0)
        }
        Surface::Topography(surface) => {
            let width = surface.axials().len();
            let line = |j: usize| surface.depths().iter().skip(j).step_by(width).copied().collect();
            let middle = surface.axials().partition_point(|&at| at < track).min(width - 1);
            (surface.arcs().to_vec(), (0..width).map(line).collect(), middle)
        }
    };
    let lines: Vec<Line> = lines.into_iter().map(|depths| Line::new(&arcs, depths)).collect();
    let mut asked: Vec<AsMeasured> = Vec::new();
    if arcs.len() >= MEASURED {
        asked.extend(spike(&lines));
        let form = lines[middle].form(on.radius(bearing));
        if form.is_some() {
            // Ends and heights are those of the form until it is off.
            asked.extend(form);
            return asked;
        }
        asked.extend(ends(&lines));
    }
    let levelled = asked.iter().any(|one| matches!(one, AsMeasured::Ends(_)));
    asked.extend(heights(&lines, levelled));
    asked
}

/// Points of a trace without the edges that close it.
fn samples(points: &[(f64, f64)]) -> (Vec<f64>, Vec<f64>) {
    let last = points.len() - 1;
    let first = usize::from(points[0].0 == points[1].0);
    let end = last - usize::from(points[last].0 == points[last - 1].0 && last > first + 1);
    points[first..=end].iter().copied().unzip()
}

/// The highest spike of all lines; a groove across the raceway, which has neighbours on the lines beside, is none.
fn spike(lines: &[Line]) -> Option<AsMeasured> {
    let mut found: Option<(f64, AsMeasured)> = None;
    for (j, line) in lines.iter().enumerate() {
        for k in line.spikes() {
            let height = line.depths[k] - line.smooth[k];
            let beside = [j.checked_sub(1), Some(j + 1)].into_iter().flatten().filter_map(|j| lines.get(j));
            let is_groove = beside.into_iter().any(|other| (other.depths[k] - other.smooth[k]) / height > 0.5);
            if !is_groove && found.as_ref().is_none_or(|(highest, _)| height.abs() > *highest) {
                let [arc_mm, depth_um, around_um] = [1e3 * line.arcs[k], 1e6 * line.depths[k], 1e6 * line.smooth[k]];
                found = Some((height.abs(), AsMeasured::Spike { arc_mm, depth_um, around_um }));
            }
        }
    }
    found.map(|(_, spike)| spike)
}

/// The ends that are farthest from depth 0.
fn ends(lines: &[Line]) -> Option<AsMeasured> {
    let [low, high] = extent(lines.iter().flat_map(|line| line.levelled()));
    let limit = ROUGHNESS.min(SMALL * (high - low));
    let far = |[first, last]: &[f64; 2]| first.abs().max(last.abs());
    let farthest = lines.iter().map(Line::ends).max_by(|a, b| far(a).total_cmp(&far(b)))?;
    (far(&farthest) > limit).then(|| AsMeasured::Ends(farthest.map(|depth| 1e6 * depth)))
}

/// More height than depth, of all lines together.
fn heights(lines: &[Line], levelled: bool) -> Option<AsMeasured> {
    let all = lines.iter().flat_map(|line| if levelled { line.levelled() } else { line.smooth.clone() });
    let [low, high] = extent(all.chain([0.0]));
    (-low > high).then(|| AsMeasured::Heights([-low, high].map(|size| 1e6 * size)))
}

impl<'a> Line<'a> {
    fn new(arcs: &'a [f64], depths: Vec<f64>) -> Self {
        let of_five = |k: usize| median(&depths[k.saturating_sub(2)..(k + 3).min(depths.len())]);
        let is_measured = depths.len() >= MEASURED;
        let smooth = (0..depths.len()).map(|k| if is_measured { of_five(k) } else { depths[k] }).collect();
        Self { arcs, depths, smooth }
    }

    /// Points that stand alone.
    fn spikes(&self) -> impl Iterator<Item = usize> {
        let step = |k: usize| (self.depths[k + 1] - self.depths[k]).abs();
        let alone = move |&k: &usize| {
            let height = (self.depths[k] - self.smooth[k]).abs();
            if height <= 2.0 * ROUGHNESS {
                return false;
            }
            let last = self.depths.len() - 1;
            let before = k.saturating_sub(NEAR)..k.saturating_sub(2);
            let after = (k + 2).min(last)..(k + NEAR).min(last);
            // An end that is nearer to 0 than the points beside it is where a defect's edge begins.
            let is_edge = (k < 2 || k + 2 > last) && self.depths[k].abs() < self.smooth[k].abs();
            !is_edge && height > ALONE * before.chain(after).map(step).fold(0.0, f64::max)
        };
        (0..self.depths.len()).filter(alone)
    }

    /// The form of a body of this radius (m), if the ends have it and it is more than the roughness.
    fn form(&self, radius: f64) -> Option<AsMeasured> {
        let curvature = curvature_of_ends(self.arcs, &self.smooth)?;
        let length = self.arcs[self.arcs.len() - 1] - self.arcs[0];
        let height = curvature.abs() * length * length / 8.0;
        let is_own = OWN.contains(&(curvature.abs() * radius)) && height > 2.0 * ROUGHNESS;
        is_own.then(|| AsMeasured::Form { radius_mm: 1e3 / curvature.abs(), body_mm: 1e3 * radius })
    }

    /// Depths of the first and the last point (m), by themselves or with those beside them: neither a spike there nor a
    /// slope that begins there is an end off depth 0.
    fn ends(&self) -> [f64; 2] {
        let nearer =
            |k: usize| if self.depths[k].abs() < self.smooth[k].abs() { self.depths[k] } else { self.smooth[k] };
        [0, self.depths.len() - 1].map(nearer)
    }

    /// Depths from the line through both ends (m).
    fn levelled(&self) -> Vec<f64> {
        let line = line_through_ends(self.arcs, &self.smooth);
        self.arcs.iter().zip(&self.smooth).map(|(arc, depth)| depth - line(*arc)).collect()
    }
}

impl fmt::Display for AsMeasured {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Spike { arc_mm, depth_um, around_um } => write!(
                f,
                "one point, {arc_mm:.4} mm from the middle of its arcs, is {depth_um:.1} um deep and those about it \
                 are {around_um:.1}: a spike of the instrument? Leave its line out of a trace, or put its neighbours' \
                 depth there"
            ),
            Self::Form { radius_mm, body_mm } => write!(
                f,
                "its ends are curved with a radius of {radius_mm:.1} mm, and the body has {body_mm:.1} mm: does it \
                 keep the ring's form? remove_form = \"circle\" in [defect.profile] takes that off"
            ),
            Self::Ends([first, last]) => write!(
                f,
                "its ends are at {first:.1} and {last:.1} um, and raceways at 0: is it not levelled? level = \"ends\" \
                 in [defect.profile] puts the line through both ends at 0"
            ),
            Self::Heights([above, below]) => write!(
                f,
                "it rises by {above:.1} um and falls by {below:.1} um, and depth_um is positive into the body: are \
                 they heights? invert = true in [defect.profile] turns them round"
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::statistics::Random;
    use brinell::scene::{Defect, DefectShape, Measured, MeasuredForm, MeasuredLevel};

    fn bearing() -> Bearing {
        Bearing::steel_balls(9, 7.94e-3, 39.04e-3)
    }

    fn asked(on: DefectOn, of: Measured, text: &str) -> Vec<AsMeasured> {
        let defect = Defect { on, angle: 0.0, shape: DefectShape::Profile(of) };
        as_measured(&Surface::load(&defect, Some(text), &bearing()).unwrap(), on, &bearing(), 0.0)
    }

    /// A trace of `length` (mm) whose middle half is a spall 30 µm deep, of 401 points with this roughness (µm).
    fn trace(length: f64, roughness: f64, spoilt: impl Fn(f64, f64) -> f64) -> String {
        let mut random = Random::new(62);
        let points = (-200..=200i32).map(|k| {
            let arc = length / 400.0 * f64::from(k);
            let depth = if k.abs() < 100 { 30.0 } else { 0.0 } + roughness * random.normal();
            format!("{arc:.6},{:.6}\n", spoilt(arc, depth))
        });
        format!("arc_mm,depth_um\n{}", points.collect::<String>())
    }

    #[test]
    fn what_an_instrument_leaves_on_a_trace_is_asked_about_until_it_is_mended() {
        let (level, form) = (Some(MeasuredLevel::Ends), Some(MeasuredForm::Circle));
        for (on, length, roughness) in [
            (DefectOn::Outer, 8.0, 0.0),
            (DefectOn::Inner, 8.0, 0.3),
            (DefectOn::Outer, 3.0, 0.1),
            (DefectOn::Element { element: 0, tilt: 0.0 }, 2.0, 0.05),
        ] {
            let trace = |spoilt: &dyn Fn(f64, f64) -> f64| trace(length, roughness, spoilt);
            let none = asked(on, Measured::default(), &trace(&|_, depth| depth));
            assert_eq!(none, [], "{on:?} {length} {roughness}");
            let radius = 1e3 * on.radius(&bearing());
            let round = |arc: f64| 1e3 * (radius - (radius * radius - arc * arc).sqrt());
            let heights = |found: &AsMeasured| matches!(found, AsMeasured::Heights(_));
            let ends = |found: &AsMeasured| matches!(found, AsMeasured::Ends(_));
            let curved = |found: &AsMeasured| matches!(found, AsMeasured::Form { .. });
            type Is<'a> = &'a dyn Fn(&AsMeasured) -> bool;
            type Case<'a> = (&'a str, &'a dyn Fn(f64, f64) -> f64, Is<'a>, Measured);
            let cases: [Case; 6] = [
                ("heights", &|_, depth| -depth, &heights, Measured { invert: true, ..Measured::default() }),
                ("not zeroed", &|_, depth| depth + 12.0, &ends, Measured { level, ..Measured::default() }),
                ("tilted", &|arc, depth| depth - 4.0 * arc, &ends, Measured { level, ..Measured::default() }),
                (
                    "heights not zeroed",
                    &|_, depth| 80.0 - depth,
                    &ends,
                    Measured { level, invert: true, ..Measured::default() },
                ),
                ("round", &|arc, depth| depth - round(arc), &curved, Measured { form, ..Measured::default() }),
                (
                    "round heights",
                    &|arc, depth| round(arc) - depth,
                    &curved,
                    Measured { form, invert: true, ..Measured::default() },
                ),
            ];
            for (what, spoilt, is_it, mended) in cases {
                let text = trace(spoilt);
                let found = asked(on, Measured::default(), &text);
                assert!(found.iter().any(is_it), "{what} {on:?} {length} {roughness}: {found:?}");
                assert_eq!(asked(on, mended, &text), [], "{what} {on:?} {length} {roughness}");
            }
        }
    }

    #[test]
    fn one_spike_is_asked_about_and_edges_grooves_and_rough_floors_are_not() {
        let inside = [(3.0, 60.0), (-2.6, -15.0), (0.4, 40.0), (-0.7, -25.0)];
        let at_ends = [(-4.0, 60.0), (-3.98, 40.0), (3.98, -20.0), (4.0, -40.0)];
        for (at, height) in inside.into_iter().chain(at_ends) {
            let spiked = trace(8.0, 0.2, |arc, depth| if (arc - at).abs() < 1e-3 { depth + height } else { depth });
            let found = asked(DefectOn::Outer, Measured::default(), &spiked);
            assert!(matches!(found[..], [AsMeasured::Spike { arc_mm, .. }] if (arc_mm - at).abs() < 1e-3), "{found:?}");
        }
        let floor = |arc: f64, depth: f64| if depth > 15.0 { depth + 20.0 * (700.0 * arc).sin() } else { depth };
        let wedge = |arc: f64, _: f64| 15.0 * (2.0 - arc.abs()).max(0.0);
        for text in [trace(8.0, 0.2, floor), trace(8.0, 0.0, wedge)] {
            assert_eq!(asked(DefectOn::Outer, Measured::default(), &text), []);
        }
    }

    #[test]
    fn nothing_is_asked_about_shipped_traces() {
        for (on, text) in [
            (DefectOn::Outer, include_str!("../../../../scenes/6205-epps-trace.csv")),
            (DefectOn::Inner, include_str!("../../../../scenes/6205-machine-lobes.csv")),
            (DefectOn::Outer, include_str!("../../../../scenes/6205-machine-spall.csv")),
            (DefectOn::Inner, include_str!("../../../../scenes/6205-machine-spall-inner.csv")),
        ] {
            assert_eq!(asked(on, Measured::default(), text), []);
        }
    }

    #[test]
    fn a_polygon_that_somebody_has_written_ends_where_it_likes() {
        let deep = "arc_mm,depth_um\n0,50\n2,50\n";
        assert_eq!(asked(DefectOn::Outer, Measured::default(), deep), []);
        let risen = asked(DefectOn::Outer, Measured::default(), &deep.replace(",50", ",-50"));
        assert!(matches!(risen[..], [AsMeasured::Heights(_)]), "{risen:?}");
    }

    #[test]
    fn a_topography_is_asked_what_its_lines_are_asked() {
        let text = |spoilt: &dyn Fn(f64, f64, f64) -> f64| {
            let mut text = "arc_mm,axial_mm,depth_um\n".to_owned();
            for (i, j) in (-50..=50).flat_map(|i| (-10..=10).map(move |j| (i, j))) {
                let (arc, axial) = (0.05 * f64::from(i), 0.1 * f64::from(j));
                let depth = if arc.abs() < 1.0 && axial.abs() < 0.6 { 30.0 } else { 0.0 };
                text += &format!("{arc:.4},{axial:.4},{:.5}\n", spoilt(arc, axial, depth));
            }
            text
        };
        let asked = |of: Measured, spoilt: &dyn Fn(f64, f64, f64) -> f64| asked(DefectOn::Outer, of, &text(spoilt));
        assert_eq!(asked(Measured::default(), &|_, _, depth| depth), []);
        // A scratch across the raceway is none of the instrument's.
        assert_eq!(asked(Measured::default(), &|arc, _, depth| if arc == -2.0 { 40.0 } else { depth }), []);
        let spike =
            asked(Measured::default(), &|arc, axial, depth| if [arc, axial] == [-2.0, 0.5] { 40.0 } else { depth });
        assert!(matches!(spike[..], [AsMeasured::Spike { .. }]), "{spike:?}");
        // The groove's own circle across.
        let groove = |_: f64, axial: f64, depth: f64| 1e3 * axial * axial / (2.0 * 4.13) - depth;
        let found = asked(Measured::default(), &groove);
        assert!(found.iter().any(|one| matches!(one, AsMeasured::Ends(_))), "{found:?}");
        let mended = Measured { level: Some(MeasuredLevel::Ends), invert: true, ..Measured::default() };
        assert_eq!(asked(mended, &groove), []);
    }
}
