//! Depth, exact means and edges of described and measured surfaces.

use brinell::scene::{Defect, DefectShape};
use brinell::surface::{Profile, Surface, Topography};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

#[test]
fn a_spall_with_vertical_edges_is_a_box() {
    let spall = Profile::spall(6.5e-3, 1e-4, 90.0_f64.to_radians());
    let half = 3.25e-3;
    assert_eq!(spall.points(), [(-half, 0.0), (-half, 1e-4), (half, 1e-4), (half, 0.0)]);
    assert_eq!(spall.edges(), [-half, half]);
    assert_eq!(spall.extent(), (-half, half));
    assert_eq!(spall.depth_at(0.0), 1e-4);
    assert_eq!(spall.depth_at(half), 5e-5);
    assert_eq!(spall.depth_at(1.001 * half), 0.0);
    assert_eq!(spall.depth_at(-1.001 * half), 0.0);
}

#[test]
fn sloped_flanks_lie_within_the_length() {
    let spall = Profile::spall(1e-3, 1e-4, FRAC_PI_4);
    assert!(spall.edges().is_empty());
    assert_eq!(spall.extent(), (-5e-4, 5e-4));
    // At 45° the flank is as long as it is deep. 1e-18: rounding of a depth of 1e-4.
    assert!((spall.depth_at(-4.5e-4) - 5e-5).abs() < 1e-18);
    assert!((spall.depth_at(3.9e-4) - 1e-4).abs() < 1e-18);
}

#[test]
fn flanks_that_just_meet_make_a_v() {
    let spall = Profile::spall(2e-4, 1e-4, FRAC_PI_4 - 1e-12);
    assert_eq!(spall.points(), [(-1e-4, 0.0), (0.0, 1e-4), (1e-4, 0.0)]);
}

#[test]
fn a_cell_mean_over_a_spall_is_its_area() {
    let spall = Profile::spall(1e-3, 1e-4, FRAC_PI_4);
    // Trapezoid: (1 mm + 0.8 mm)/2 × 0.1 mm, spread over 4 mm. 1e-18: rounding.
    let mean = 0.9e-3 * 1e-4 / 4e-3;
    assert!((spall.mean_depth(-2e-3, 2e-3) - mean).abs() < 1e-18);
    assert!((spall.mean_depth(2e-3, -2e-3) - mean).abs() < 1e-18);
    assert_eq!(spall.mean_depth(1e-3, 2e-3), 0.0);
    assert_eq!(spall.mean_depth(0.0, 0.0), 1e-4);
}

#[test]
fn a_trace_is_centred_and_ends_at_depth_zero() {
    let trace = Profile::from_csv("# trace\r\ndepth_um, arc_mm\r\n2, 10.0\r\n4, 10.5\r\n0, 11.0\r\n").unwrap();
    let expected = [(-5e-4, 0.0), (-5e-4, 2e-6), (0.0, 4e-6), (5e-4, 0.0)];
    assert_eq!(trace.points().len(), expected.len());
    for (point, expected) in trace.points().iter().zip(expected) {
        // 1e-17: half of the rounding of 10 mm would be seen if the middle were taken off in metres.
        assert!((point.0 - expected.0).abs() < 1e-17 && (point.1 - expected.1).abs() < 1e-20, "{point:?}");
    }
    assert_eq!(trace.edges(), [-5e-4]);
}

#[test]
fn a_file_with_an_axial_column_is_a_topography() {
    let bearing = brinell_scene_file::from_toml(include_str!("../../scenes/er16k-tb1.toml")).unwrap().bearing;
    let shape = DefectShape::Profile("x.csv".into());
    let text = "arc_mm,axial_mm,depth_um\n0,0,0\n0,1,0\n1,0,3\n1,1,5\n";
    let Surface::Topography(topography) = Surface::load(&Defect::outer(0.0, shape), Some(text), &bearing).unwrap()
    else {
        panic!("not a topography");
    };
    // 1e-20: rounding of a depth of micrometres.
    assert!((topography.depth_at(5e-4, 5e-4) - 4e-6).abs() < 1e-20);
    assert!((topography.depth_at(0.0, 0.0) - 1.5e-6).abs() < 1e-20);
    assert_eq!(topography.depth_at(0.0, -1e-6), 0.0);
    assert_eq!(topography.edges(), [5e-4]);
    assert_eq!(topography.axials(), [0.0, 1e-3]);
}

#[test]
fn the_order_of_a_topographys_lines_does_not_matter() {
    let header = "arc_mm,axial_mm,depth_um";
    let lines = ["0,-1,1", "0,2,2", "0.5,-1,3", "0.5,2,4", "0.7,-1,5", "0.7,2,6"];
    let text = |order: [usize; 6]| format!("{header}\n{}", order.map(|i| lines[i]).join("\n"));
    let by_arc = Topography::from_csv(&text([0, 1, 2, 3, 4, 5])).unwrap();
    let by_axial = Topography::from_csv(&text([4, 2, 0, 5, 3, 1])).unwrap();
    assert_eq!(by_arc, by_axial);
}

#[test]
fn a_topography_need_not_be_symmetric() {
    let text = "arc_mm,axial_mm,depth_um\n0,-1,0\n0,1,10\n1,-1,0\n1,1,10\n";
    let topography = Topography::from_csv(text).unwrap();
    let left = topography.mean_depth([-1e-4, 1e-4], [-1e-3, 0.0]);
    let right = topography.mean_depth([-1e-4, 1e-4], [0.0, 1e-3]);
    // 1e-19: rounding of micrometres over a cell of fractions of a millimetre.
    assert!((left - 2.5e-6).abs() < 1e-19 && (right - 7.5e-6).abs() < 1e-19, "{left} {right}");
}

/// Points of an arbitrary profile, vertical edges among them.
fn points() -> impl Strategy<Value = Vec<(f64, f64)>> {
    prop::collection::vec((0_u32..40, -10.0..100.0_f64), 2..30).prop_map(|raw| {
        let mut raw = raw;
        raw.sort_by_key(|&(arc, _)| arc);
        let mut points: Vec<(f64, f64)> = Vec::new();
        for (arc, depth) in raw {
            let point = (f64::from(arc) * 1e-5, depth * 1e-6);
            if points.len() < 2 || points[points.len() - 2].0 != point.0 {
                points.push(point);
            }
        }
        points
    })
}

proptest! {
    #[test]
    fn cell_means_add_up_to_the_whole(points in points(), cells in 1_usize..200) {
        let profile = Profile::from_points(points).unwrap();
        let (from, to) = (-1.3e-4, 5.1e-4);
        let edge = |i: usize| from + (to - from) * i as f64 / cells as f64;
        let sum: f64 = (0..cells).map(|i| profile.mean_depth(edge(i), edge(i + 1)) * (edge(i + 1) - edge(i))).sum();
        let whole = profile.mean_depth(from, to) * (to - from);
        // Depths below 1e-4 m over 6.4e-4 m: 6.4e-8 m² with some 200 roundings.
        prop_assert!((sum - whole).abs() < 1e-20, "{sum} {whole}");
    }

    #[test]
    fn a_narrow_cells_mean_is_the_depth(points in points(), arc in -1e-5..4.1e-4_f64) {
        let profile = Profile::from_points(points).unwrap();
        let width = 1e-12;
        prop_assume!(profile.points().iter().all(|point| (point.0 - arc).abs() > width));
        let mean = profile.mean_depth(arc - width, arc + width);
        // No point within the cell, so it is linear there; the width carries the arc's rounding, 5e-20 in 2e-12.
        prop_assert!((mean - profile.depth_at(arc)).abs() < 1e-4 * 1e-6, "{mean}");
    }

    #[test]
    fn a_topography_without_axial_change_is_its_profile(
        depths in prop::collection::vec(-10.0..100.0_f64, 2..12),
        from in -0.1..1.2_f64,
        width in 1e-3..1.0_f64,
    ) {
        let mut text = String::from("arc_mm,axial_mm,depth_um\n");
        let mut trace = String::from("arc_mm,depth_um\n");
        for (i, depth) in depths.iter().enumerate() {
            let arc = 0.1 * i as f64;
            trace += &format!("{arc},{depth}\n");
            for axial in [-1.0, -0.3, 0.4, 2.0] {
                text += &format!("{arc},{axial},{depth}\n");
            }
        }
        let topography = Topography::from_csv(&text).unwrap();
        let profile = Profile::from_csv(&trace).unwrap();
        let (a, b) = ((from - 0.5) * 1e-3, (from + width - 0.5) * 1e-3);
        let mean = topography.mean_depth([a, b], [-0.7e-3, 1.1e-3]);
        // Rounding: depths of 1e-4 m, a few dozen operations.
        prop_assert!((mean - profile.mean_depth(a, b)).abs() < 1e-17);
        prop_assert!((topography.depth_at(a, 0.0) - profile.depth_at(a)).abs() < 1e-17
            || profile.edges().contains(&a));
        prop_assert_eq!(topography.profile_at(0.0).points().len(), profile.points().len());
    }
}

#[test]
fn a_vertical_edge_survives_the_conversion_from_degrees() {
    for slope in [90.0_f64.to_radians(), FRAC_PI_2, FRAC_PI_2 + 1e-16, 89.999_999_99_f64.to_radians()] {
        assert_eq!(Profile::spall(1e-3, 1e-4, slope).edges().len(), 2, "{slope}");
    }
}
