//! The three contact laws where they must agree.
//!
//! One element stands somewhere over a defect, pressed outwards by the inner ring, which the host holds.

use super::trajectory;
use crate::case::{Case, Defect, Grooves, Host, Length, Motion, On, Ring, Shape, Step};
use crate::draw::{Draw, for_seeds};
use crate::oracle::Bearing;
use crate::random_case::bowl;
use crate::subject::Subject;

/// A bearing of one element without a defect, and how far it is pressed outwards (m).
pub(super) fn standing(draw: &mut Draw) -> (Case, f64) {
    let diameter_mm = draw.log(2.0, 40.0);
    let case = Case {
        count: 1,
        diameter_mm,
        pitch_mm: diameter_mm * draw.between(2.5, 8.0),
        grooves: Grooves::Each(draw.between(0.51, 0.56), draw.between(0.51, 0.56)),
        clearance_um: diameter_mm * draw.log(0.1, 3.0),
        modulus_gpa: draw.log(50.0, 400.0),
        poisson: draw.between(0.1, 0.45),
        cage_deg: draw.between(-180.0, 180.0),
        rings: [Ring { motion: Motion::Host, ..Ring::FIXED }; 2],
        tolerance: 1e-6,
        ..Case::at_rest()
    };
    let approach = 0.5e-3 * diameter_mm * draw.log(1e-4, 2e-3);
    (case, approach)
}

/// The same pressed by the inner ring, so that it would go `approach` (m) into a smooth raceway.
pub(super) fn pressed(case: &Case, approach: f64) -> Case {
    let bearing = Bearing::smooth(case);
    // Both contacts carry the same.
    let inner = approach * (bearing.growth[1].constant() / bearing.growth[0].constant()).cbrt().powi(2);
    let (sin, cos) = case.cage_deg.to_radians().sin_cos();
    let way = bearing.clearance + inner + approach;
    let motion = [[way * cos, 0.0, 0.0], [way * sin, 0.0, 0.0]];
    let host = Host { speeds: [[0.0; 2]; 2], rings: [motion, [[0.0; 3]; 2]] };
    Case { steps: vec![Step { length: 1e-6, host: Some(host) }], ..case.clone() }
}

/// The grid for a force that is a few times the standing one.
fn grid(case: &Case, approach: f64, cells: [u32; 2]) -> (f64, [u32; 2], f64) {
    (4.0 * Bearing::smooth(case).growth[1].constant() * approach.powf(1.5), cells, 0.02)
}

/// Path of the element, and the raceway's force on it, radial inwards and along the raceway counter-clockwise.
fn force(case: &Case) -> Result<[f64; 3], String> {
    let mut subject = Subject::new(case).map_err(|error| error.to_string())?;
    let sample = subject.start(case).map_err(|error| error.to_string())?;
    let names = crate::oracle::signals::signals(case);
    let value = |name: &str| sample[names.iter().position(|(other, _)| other == name).unwrap()];
    let (sin, cos) = case.cage_deg.to_radians().sin_cos();
    let [x, y] = [value("housing.force.x"), value("housing.force.y")];
    Ok([value("element[1].path"), x * cos + y * sin, x * sin - y * cos])
}

/// Half the contact's length on the smooth raceway, roughly (m).
pub(super) fn half_contact(case: &Case, approach: f64) -> f64 {
    (approach * case.diameter_mm * 0.5e-3).sqrt()
}

/// Samples of a depth along a length, all (m), `step` apart.
pub(super) fn trace(length: f64, step: f64, depth: impl Fn(f64) -> f64) -> Shape {
    let count = (length / step).ceil() as usize;
    let points = (0..=count).map(|i| i as f64 / count as f64);
    Shape::Trace(points.map(|share| (share * length * 1e3, depth(share) * 1e6)).collect())
}

/// Stands `at` (m) before the defect's middle, counter-clockwise.
fn over(case: &Case, shape: Shape, at: f64) -> Case {
    let raceway = Bearing::smooth(case).rho_0 + 0.5e-3 * case.diameter_mm;
    let angle_deg = case.cage_deg - (at / raceway).to_degrees();
    Case { defects: vec![Defect { on: On::Outer, angle_deg, shape }], ..case.clone() }
}

#[test]
fn on_the_smooth_raceway_all_laws_are_one() {
    for_seeds(6, |_, draw| {
        let (case, approach) = standing(draw);
        let half = half_contact(&case, approach);
        let length = draw.between(0.5, 4.0) * half;
        let shape =
            Shape::Spall { length: Length::Millimetres(length * 1e3), depth_um: 0.2 * approach * 1e6, slope_deg: 90.0 };
        // The quarter turn leaves the defect far away.
        let far = |law| {
            let mut case = over(&pressed(&case, approach), shape.clone(), 0.0);
            (case.law, case.grid) = (law, (law != "hertz").then(|| grid(&case, approach, [12, 8])));
            case.defects[0].angle_deg += 90.0;
            case.steps[0].length = 1e-4;
            trajectory(&case, |_| {})
        };
        let [hertz, love, map] = ["hertz", "love", "map"].map(far);
        match (&hertz.failed, &love.failed, &map.failed) {
            (None, None, None) if hertz.samples == love.samples && hertz.samples == map.samples => Ok(()),
            (None, None, None) => Err(format!("{:?}, {:?}, {:?}", hertz.samples, love.samples, map.samples)),
            failed => Err(format!("{failed:?}")),
        }
    });
}

#[test]
fn over_a_shallow_and_long_hollow_love_agrees_with_the_rigid_path() {
    for_seeds(3, |_, draw| {
        let (case, approach) = standing(draw);
        let half = half_contact(&case, approach);
        let length = 60.0 * half;
        let depth = approach * draw.between(0.2, 0.6) * draw.sign();
        let cells = [16, 10];
        let shape = trace(length, 0.03 * half, |share| depth * bowl(share));
        let offset = draw.between(-0.5, 0.5) * length;
        let at = |law| {
            let mut case = over(&pressed(&case, approach), shape.clone(), offset);
            (case.law, case.grid) = (law, (law != "hertz").then(|| grid(&case, approach, cells)));
            force(&case)
        };
        let (hertz, love, smooth) = (at("hertz")?, at("love")?, force(&pressed(&case, approach))?);
        // The hollow's curvature is up to 8 d/(l/2)² = 1 % of 1/r: as much of the stiffness's square root, and of the
        // coarse grid.
        for i in 1..3 {
            if !((hertz[i] - love[i]).abs() <= 0.02 * smooth[1]) {
                return Err(format!("hertz {hertz:?}, love {love:?}, smooth {smooth:?}"));
            }
        }
        Ok(())
    });
}

#[test]
fn the_map_agrees_with_the_grid_that_it_was_made_of() {
    for_seeds(3, |_, draw| {
        let (case, approach) = standing(draw);
        let half = half_contact(&case, approach);
        let length = draw.between(0.5, 3.0) * half;
        let depth = approach * draw.log(0.1, 2.0);
        let shape = if draw.chance(0.5) {
            Shape::Spall {
                length: Length::Millimetres(length * 1e3),
                depth_um: depth * 1e6,
                slope_deg: draw.pick(&[90.0, 60.0]),
            }
        } else {
            trace(length, 0.03 * half, |share| depth * bowl(share))
        };
        for _ in 0..2 {
            let offset = draw.between(-1.0, 1.0) * length;
            let at = |law| {
                let mut case = over(&pressed(&case, approach), shape.clone(), offset);
                let (largest, cells, _) = grid(&case, approach, [12, 8]);
                (case.law, case.grid) = (law, Some((largest, cells, 0.005)));
                force(&case).map(|force| (force, largest))
            };
            let ((love, largest), (map, _)) = (at("love")?, at("map")?);
            // The map's accuracy is 0.5 % of the largest force, along either direction.
            for i in 1..3 {
                if !((love[i] - map[i]).abs() <= 0.0075 * largest) {
                    return Err(format!("love {love:?}, map {map:?} of {largest:e}"));
                }
            }
        }
        Ok(())
    });
}
