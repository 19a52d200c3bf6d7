//! The contact of an element with a damaged raceway: grid, map, and their joint with the closed form.

use std::f64::consts::FRAC_PI_2;
use std::sync::OnceLock;

use crate::er16k::OUTER as ER16K;
use brinell::contact::element_on_raceway::{Across, ElementOnRaceway};
use brinell::contact::error::ContactError;
use brinell::contact::love::{LoveContact, Resolution};
use brinell::contact::map::{ContactMap, MapSpecification};
use brinell::surface::{Profile, Surface, Topography};

const LENGTH: f64 = 6.517e-3;
const LARGEST: f64 = 10e-6;

fn line_spall() -> Surface {
    Surface::Profile(Profile::spall(LENGTH, 100e-6, FRAC_PI_2))
}

fn specification(accuracy: f64) -> MapSpecification {
    MapSpecification { accuracy, ..MapSpecification::new(LARGEST) }
}

fn love() -> LoveContact {
    LoveContact::new(ER16K, &line_spall(), 1.5 * LARGEST, Resolution { columns: 64, rows: 16 }).unwrap()
}

/// One map for all tests that do not ask for accuracy.
fn coarse_map() -> &'static ContactMap {
    static MAP: OnceLock<ContactMap> = OnceLock::new();
    MAP.get_or_init(|| build(1e-2))
}

fn build(accuracy: f64) -> ContactMap {
    crate::built(&line_spall(), ER16K, specification(accuracy))
}

#[test]
fn far_from_the_edges_the_grid_is_the_closed_form_without_a_jump() {
    let mut contact = love();
    for u in [2e-6, 6e-6, 10e-6] {
        for i in 0..20 {
            let s = -0.5 * LENGTH - 1e-3 + 1.3e-6 * f64::from(i);
            let smooth = contact.solve(u, s).unwrap();
            // The grid's ripple under a moving element; full scale is LARGEST^1.5.
            let force = smooth.forces(crate::hertz).map(|f| f / LARGEST.powf(1.5));
            assert!((force[0] - (u / LARGEST).powf(1.5)).abs() < 1e-4, "{u} {s}: {force:?}");
            assert!(force[1].abs() < 1e-5, "{u} {s}: {force:?}");
            let floor = contact.solve(u + 100e-6, 1.3e-6 * f64::from(i)).unwrap().forces(crate::hertz);
            assert!((floor[0] / LARGEST.powf(1.5) - (u / LARGEST).powf(1.5)).abs() < 1e-4);
        }
    }
}

#[test]
fn an_element_centred_on_an_edge_keeps_some_87_percent_of_its_force() {
    let mut contact = love();
    for u in [4e-6, 6e-6, 10e-6] {
        let edge = contact.solve(u, -0.5 * LENGTH).unwrap();
        let ratio = edge.forces(crate::hertz)[0] / u.powf(1.5);
        // Two digits: the reference says 0.87 of the smooth force.
        assert!((ratio - 0.87).abs() < 0.01, "{u}: {ratio}");
    }
}

#[test]
fn derivatives_are_those_of_the_equivalent_approach() {
    let mut contact = love();
    let h = 1e-9;
    for (u, s) in [(4e-6, -0.5 * LENGTH), (9e-6, -0.5 * LENGTH + 0.1e-3), (34e-6, -0.5 * LENGTH + 0.4e-3)] {
        let a = contact.solve(u, s).unwrap();
        let mut at = |u: f64, s: f64| contact.solve(u, s).unwrap();
        let by_u = (at(u + h, s).value - at(u - h, s).value) / (2.0 * h);
        let by_s = (at(u, s + h).value - at(u, s - h).value) / (2.0 * h);
        // Differences over 2 nm of values exact to 1e-19 m, curvature 1e5 /m.
        assert!((a.du - by_u).abs() < 1e-6, "{} {by_u}", a.du);
        assert!((a.ds - by_s).abs() < 1e-6, "{} {by_s}", a.ds);
    }
}

#[test]
fn the_map_meets_its_accuracy_and_closed_paths_cost_no_work() {
    let map = build(3e-3);
    let accuracy = map.accuracy();
    assert!(accuracy.max() <= 3e-3, "{accuracy:?}");
    assert!(accuracy.rms_normal <= 6e-4 && accuracy.rms_tangential <= 3e-4, "{accuracy:?}");
    // A closed ellipse across the flank; trapezoids on a smooth closed path converge quickly, steps of nodes limit
    // them.
    let (n, mut work, mut moved) = (200_000, 0.0, 0.0);
    let at = |i: usize| {
        let angle = std::f64::consts::TAU * (i % n) as f64 / n as f64;
        let (s, c) = angle.sin_cos();
        ([5e-6 + 3e-6 * s, -0.5 * LENGTH + 0.1e-3 * c], [3e-6 * c, -0.1e-3 * s])
    };
    for i in 0..n {
        let ([u, s], [du, ds]) = at(i);
        let [normal, tangential] = map.lookup(u, s).unwrap().forces(crate::hertz);
        let power = (normal * du - tangential * ds) * std::f64::consts::TAU / n as f64;
        work += power;
        moved += power.abs();
    }
    assert!(work.abs() < 1e-9 * moved, "{}", work / moved);
}

#[test]
fn the_map_joins_the_closed_forms_in_value_and_slope() {
    let map = coarse_map();
    for (index, &knot) in map.knots().iter().enumerate() {
        let depth = if index == 0 || index + 1 == map.knots().len() { 0.0 } else { 100e-6 };
        for u in [1e-6, 5e-6, 9e-6] {
            for s in [knot - 1e-12, knot + 1e-12] {
                let a = map.lookup(u + depth, s).unwrap();
                // Rounding of 3 mm and 1 pm beside the knot.
                let is_joined = (a.value - u).abs() < 1e-15 && (a.du - 1.0).abs() < 1e-8 && a.ds.abs() < 1e-8;
                assert!(is_joined, "{knot} {u}: {a:?}");
            }
        }
    }
}

#[test]
fn the_far_half_of_a_symmetric_spall_is_the_near_ones_mirror_image() {
    let short = Surface::Profile(Profile::spall(0.4e-3, 100e-6, FRAC_PI_2));
    let short = crate::built(&short, ER16K, specification(1e-2));
    assert_eq!((coarse_map().knots().len(), short.knots().len()), (4, 2), "flanks apart, and in one patch");
    [coarse_map(), &short].into_iter().for_each(is_its_mirror_image);
}

fn is_its_mirror_image(map: &ContactMap) {
    let [from, to] = [map.knots()[0], map.knots()[1].min(0.0)];
    let mut compared = 0;
    for n in 0..200 {
        let [q, t] = crate::spread(n);
        let (s, u) = (from + q * (to - from), t * (LARGEST + 20e-6));
        let (Ok(near), Ok(far)) = (map.lookup(u, s), map.lookup(u, -s)) else { continue };
        // Rounding of the arc, 3 mm, times slopes of up to 0.1.
        assert!((near.value - far.value).abs() < 1e-18, "{s} {u}: {near:?} {far:?}");
        assert!((near.du - far.du).abs() < 1e-12 && (near.ds + far.ds).abs() < 1e-12, "{s} {u}: {near:?} {far:?}");
        compared += 1;
    }
    // The map ends a little below the highest of these.
    assert!(compared > 100, "{compared}");
}

#[test]
fn a_defect_that_is_hardly_asymmetric_has_a_map_of_each_flank() {
    let depth = 100e-6;
    let [half, shifted] = [0.5 * LENGTH, 0.5 * LENGTH + 1e-9];
    let points = vec![(-half, 0.0), (-half, depth), (shifted, depth), (shifted, 0.0)];
    let surface = Surface::Profile(Profile::from_points(points).unwrap());
    let map = crate::built(&surface, ER16K, specification(1e-2));
    // The far flank is where the profile has it.
    let ends = [map.knots()[0] + half, map.knots()[3] - shifted];
    assert!((ends[0] + ends[1]).abs() < 1e-15, "{ends:?}");
    assert!((map.knots()[0] + map.knots()[3]).abs() > 0.9e-9);
}

#[test]
fn beyond_the_largest_approach_a_lookup_is_an_error() {
    let map = coarse_map();
    assert!(map.lookup(3.0 * LARGEST, -0.5 * LENGTH).is_err());
    // Between its largest approach and half as much again a map continues: some per cent of the force.
    let (above, exact) = (1.4 * LARGEST, love().solve(1.4 * LARGEST, -0.5 * LENGTH).unwrap().forces(crate::hertz)[0]);
    let found = map.lookup(above, -0.5 * LENGTH).unwrap().forces(crate::hertz)[0];
    assert!((found / exact - 1.0).abs() < 0.03, "{found} {exact}");
    assert!(map.lookup(-1e-3, -0.5 * LENGTH).unwrap().value < 0.0);
}

#[test]
fn damaged_and_foreign_maps_are_refused() {
    let map = coarse_map();
    let bytes = map.to_bytes();
    let own = ContactMap::fingerprint_of(&line_spall(), ER16K, specification(1e-2));
    assert_eq!(ContactMap::from_bytes(&bytes, own).unwrap(), *map);
    let other = Surface::Profile(Profile::spall(LENGTH, 99e-6, FRAC_PI_2));
    let foreign = ContactMap::fingerprint_of(&other, ER16K, specification(1e-2));
    let refused = |bytes: &[u8], fingerprint: u64| match ContactMap::from_bytes(bytes, fingerprint) {
        Err(ContactError::MapRefused { reason }) => reason,
        other => panic!("{other:?}"),
    };
    assert!(refused(&bytes, foreign).contains("another defect"));
    for index in [0, 9, 30, bytes.len() / 2, bytes.len() - 1] {
        let mut damaged = bytes.clone();
        damaged[index] ^= 1;
        refused(&damaged, own);
    }
    for length in [0, 7, 40, bytes.len() - 8] {
        refused(&bytes[..length], own);
    }
}

#[test]
fn a_trace_coarser_than_the_cells_is_refused_and_a_polygon_is_not() {
    let text = "arc_mm,depth_um\n-0.5,0\n-0.4,40\n0.4,40\n0.5,0\n";
    let trace = Surface::Profile(Profile::from_csv(text).unwrap());
    let resolution = Resolution { columns: 32, rows: 16 };
    let refused = LoveContact::new(ER16K, &trace, LARGEST, resolution).unwrap_err();
    assert!(matches!(refused, ContactError::TooCoarse { step_um, .. } if (step_um - 100.0).abs() < 1e-6), "{refused}");
    assert!(refused.to_string().contains("100.00 um apart along the raceway"), "{refused}");
    assert!(!refused.to_string().contains("  "), "blanks in a row: {refused}");
    let corners = vec![(-0.5e-3, 0.0), (-0.4e-3, 40e-6), (0.4e-3, 40e-6), (0.5e-3, 0.0)];
    let polygon = Surface::Profile(Profile::from_points(corners).unwrap());
    assert!(LoveContact::new(ER16K, &polygon, LARGEST, resolution).is_ok());
    let text = "arc_mm,axial_mm,depth_um\n0,-1,0\n0,1,0\n0.001,-1,1\n0.001,1,2\n";
    let topography = Surface::Topography(Topography::from_csv(text).unwrap());
    let refused = LoveContact::new(ER16K, &topography, LARGEST, resolution).unwrap_err();
    assert!(refused.to_string().contains("across the raceway"), "{refused}");
}

#[test]
fn impossible_elements_and_approaches_are_refused() {
    let resolution = Resolution { columns: 16, rows: 8 };
    for element in [
        ElementOnRaceway { across: Across::Groove(3.9e-3), ..ER16K },
        ElementOnRaceway { element_radius: f64::NAN, ..ER16K },
        ElementOnRaceway { raceway_radius: 1e-3, ..ER16K },
    ] {
        let refused = LoveContact::new(element, &line_spall(), 1e-5, resolution);
        assert!(matches!(refused, Err(ContactError::BadInput { .. })));
    }
    for approach in [0.0, -1e-6, f64::NAN, 1e-3] {
        assert!(LoveContact::new(ER16K, &line_spall(), approach, resolution).is_err());
    }
}

#[test]
fn a_contact_map_holds_for_clearances_half_a_step_of_theirs_away() {
    // A clearance 2.5 µm larger makes the raceway's radius 1.25 µm larger.
    let other = ElementOnRaceway { raceway_radius: ER16K.raceway_radius + 1.25e-6, ..ER16K };
    let resolution = Resolution { columns: 64, rows: 16 };
    let mut own = love();
    let mut wider = LoveContact::new(other, &line_spall(), 1.5 * LARGEST, resolution).unwrap();
    let (mut largest, mut most) = (0.0_f64, 0.0_f64);
    for i in 0..40 {
        let s = -0.5 * LENGTH - 3e-4 + 1.7e-5 * f64::from(i);
        for height in [1e-6, 4e-6, 7e-6] {
            let u = own.first_touch(s) + height;
            let (Ok(a), Ok(b)) = (own.solve(u, s), wider.solve(u, s)) else { continue };
            let [a, b] = [a, b].map(|approach| approach.forces(crate::hertz).map(|force| force / LARGEST.powf(1.5)));
            largest = largest.max((a[0] - b[0]).abs()).max((a[1] - b[1]).abs());
            most = most.max(a[0]);
        }
    }
    // A tenth of a map's usual error, 1e-3; a shift of the edge by a hundredth of a cell would be as much.
    assert!(most > 0.5 && largest < 1e-4, "{most} {largest:e}");
}
