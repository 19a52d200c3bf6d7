//! The three contact laws where they must agree, and laws `map` and `love` against a half-space solved here.
//!
//! One element stands somewhere over a defect, pressed outwards by the inner ring, which the host holds.

use super::course;
use crate::case::{Case, Damping, Defect, Grooves, Host, Length, Motion, On, Ring, Shape, Step, Topography, bowl};
use crate::draw::{Draw, for_seeds};
use crate::oracle::Bearing;
use crate::oracle::half_space::HalfSpace;
use crate::subject::Subject;

/// A bearing of one element without a defect, and how far it is pressed outwards [m].
fn standing(draw: &mut Draw) -> (Case, f64) {
    let diameter_mm = draw.log(2.0, 40.0);
    let ring = Ring { motion: Motion::Host, load: [0.0; 2], mass: 0.0, damping: 0.0, stiffness: 0.0 };
    let case = Case {
        gravity: [0.0; 2],
        count: 1,
        diameter_mm,
        pitch_mm: diameter_mm * draw.between(2.5, 8.0),
        grooves: Grooves::Each(draw.between(0.51, 0.56), draw.between(0.51, 0.56)),
        catalogue: false,
        clearance_um: diameter_mm * draw.log(0.1, 3.0),
        modulus_gpa: draw.log(50.0, 400.0),
        poisson: draw.between(0.1, 0.45),
        density: Some(7800.0),
        mass_g: None,
        hertz: [None; 2],
        compliance: 0.0,
        damping: Damping::HuntCrossley(0.5),
        law: "hertz",
        grid: None,
        slip: 0.0,
        spin_slip: 0.0,
        rings_deg: [0.0; 2],
        cage_deg: draw.between(-180.0, 180.0),
        defects: Vec::new(),
        rings: [ring; 2],
        speed_hz: 0.0,
        housing_hz: None,
        sensor: None,
        tolerance: 1e-6,
        steps: Vec::new(),
    };
    let approach = 0.5e-3 * diameter_mm * draw.log(1e-4, 2e-3);
    (case, approach)
}

/// The same pressed by the inner ring, so that it would go `approach` [m] into a smooth raceway.
fn pressed(case: &Case, approach: f64) -> Case {
    let bearing = Bearing::smooth(case);
    // Both contacts carry the same.
    let inner = approach * (bearing.stiffness[1] / bearing.stiffness[0]).cbrt().powi(2);
    let (sin, cos) = case.cage_deg.to_radians().sin_cos();
    let way = bearing.clearance + inner + approach;
    let place = [[way * cos, 0.0, 0.0], [way * sin, 0.0, 0.0]];
    let host = Host { speeds: [[0.0; 2]; 2], rings: [place, [[0.0; 3]; 2]] };
    Case { steps: vec![Step { length: 1e-6, host: Some(host) }], ..case.clone() }
}

/// The grid for a force that is a few times the standing one.
fn grid(case: &Case, approach: f64, cells: [u32; 2]) -> (f64, [u32; 2], f64) {
    (4.0 * Bearing::smooth(case).stiffness[1] * approach.powf(1.5), cells, 0.02)
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

/// Half the contact's length on the smooth raceway, roughly [m].
fn half_contact(case: &Case, approach: f64) -> f64 {
    (approach * case.diameter_mm * 0.5e-3).sqrt()
}

/// Samples of a depth along a length, all [m], `step` apart.
fn trace(length: f64, step: f64, depth: impl Fn(f64) -> f64) -> Shape {
    let count = (length / step).ceil() as usize;
    let points = (0..=count).map(|i| i as f64 / count as f64);
    Shape::Trace(points.map(|share| (share * length * 1e3, depth(share) * 1e6)).collect())
}

/// Stands `at` [m] before the defect's middle, counter-clockwise.
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
            course(&case, |_| {})
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
    for_seeds(6, |_, draw| {
        let (case, approach) = standing(draw);
        let half = half_contact(&case, approach);
        let length = 60.0 * half;
        let depth = approach * draw.between(0.2, 0.6) * draw.sign();
        let cells = [16, 10];
        let shape = trace(length, 0.03 * half, |share| depth * bowl(share));
        let place = draw.between(-0.5, 0.5) * length;
        let at = |law| {
            let mut case = over(&pressed(&case, approach), shape.clone(), place);
            (case.law, case.grid) = (law, (law != "hertz").then(|| grid(&case, approach, cells)));
            force(&case)
        };
        let (hertz, love, smooth) = (at("hertz")?, at("love")?, force(&pressed(&case, approach))?);
        // The hollow's curvature is up to 8 d/(l/2)² = 1 % of 1/r: as much of the stiffness's square root, and of the coarse grid.
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
            let place = draw.between(-1.0, 1.0) * length;
            let at = |law| {
                let mut case = over(&pressed(&case, approach), shape.clone(), place);
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

/// Random depths over a patch as wide as the contact or wider, or not as wide.
fn patch(draw: &mut Draw, step: f64, half: f64, depth: f64) -> Topography {
    let (long, wide) = (draw.between(1.0, 5.0) * half, draw.between(0.5, 6.0) * half);
    let lines = |length: f64, from: f64| -> Vec<f64> {
        let count = (length / step).ceil().max(2.0) as usize;
        (0..=count).map(|i| (from + length * (i as f64 / count as f64)) * 1e3).collect()
    };
    let (arcs, axials) = (lines(long, 0.0), lines(wide, -draw.between(0.2, 0.8) * wide));
    // A few bowls, some of them hills.
    let bowls: Vec<[f64; 5]> = (0..1 + draw.below(4))
        .map(|_| {
            let sizes = [draw.between(0.3, 1.0), draw.between(0.3, 1.0)];
            [draw.unit(), draw.unit(), sizes[0], sizes[1], draw.between(-0.2, 1.0)]
        })
        .collect();
    let mut depths = Vec::new();
    for i in 0..arcs.len() {
        for j in 0..axials.len() {
            let (s, y) = (i as f64 / (arcs.len() - 1) as f64, j as f64 / (axials.len() - 1) as f64);
            let of = |b: &[f64; 5]| b[4] * bowl((s - b[0]) / b[2] + 0.5) * bowl((y - b[1]) / b[3] + 0.5);
            depths.push(depth * 1e6 * bowls.iter().map(of).sum::<f64>());
        }
    }
    Topography { arcs, axials, depths }
}

/// Depth [m] at a place of a shape [m]; bilinear, and 0 outside.
fn depth_at(shape: &Shape, arc: f64, axial: f64) -> f64 {
    let between = |lines: &[f64], at: f64| -> Option<(usize, f64)> {
        let k = lines.windows(2).position(|pair| pair[0] <= at && at <= pair[1])?;
        Some((k, (at - lines[k]) / (lines[k + 1] - lines[k])))
    };
    match shape {
        Shape::Spall { length: Length::Millimetres(length), depth_um, slope_deg } => {
            let inside = 0.5e-3 * length - arc.abs();
            let flank = if *slope_deg == 90.0 { f64::INFINITY } else { slope_deg.to_radians().tan() };
            if inside <= 0.0 { 0.0 } else { (depth_um * 1e-6).min(inside * flank) }
        }
        Shape::Spall { .. } => unreachable!("lengths are given in millimetres here"),
        Shape::Trace(points) => {
            let arcs: Vec<f64> = points.iter().map(|point| point.0).collect();
            let middle = 0.5 * (arcs[0] + arcs[arcs.len() - 1]);
            let Some((k, share)) = between(&arcs, arc * 1e3 + middle) else { return 0.0 };
            1e-6 * (points[k].1 + share * (points[k + 1].1 - points[k].1))
        }
        Shape::Topography(Topography { arcs, axials, depths }) => {
            let middle = 0.5 * (arcs[0] + arcs[arcs.len() - 1]);
            let places = (between(arcs, arc * 1e3 + middle), between(axials, axial * 1e3));
            let (Some((i, p)), Some((j, q))) = places else { return 0.0 };
            let at = |i: usize, j: usize| depths[i * axials.len() + j];
            let along = |j: usize| at(i, j) + p * (at(i + 1, j) - at(i, j));
            1e-6 * (along(j) + q * (along(j + 1) - along(j)))
        }
    }
}

/// Radial and tangential force at the path `u` by the oracle's own half-space, on so many cells.
fn half_space(case: &Case, shape: &Shape, (u, at): (f64, f64), cells: [usize; 2]) -> [f64; 2] {
    let bearing = Bearing::smooth(case);
    let Grooves::Each(_, conformity) = case.grooves else { unreachable!("drawn so") };
    let (r, d) = (bearing.r, 2.0 * bearing.r);
    let modulus = case.modulus_gpa * 1e9 / (2.0 * (1.0 - case.poisson * case.poisson));
    let curvatures = [1.0 / r - 1.0 / (bearing.rho_0 + r), 1.0 / r - 1.0 / (conformity * d)];
    let solver = HalfSpace { curvatures, modulus, cells };
    let high = match shape {
        Shape::Topography(topography) => -1e-6 * topography.depths.iter().fold(0.0f64, |m, depth| m.min(*depth)),
        _ => 0.0,
    };
    let mean = |s: [f64; 2], y: [f64; 2]| {
        let part = |range: [f64; 2], k: i32| range[0] + (range[1] - range[0]) * (f64::from(k) + 0.5) / 8.0;
        let sum: f64 = (0..64).map(|k| depth_at(shape, at + part(s, k / 8), part(y, k % 8))).sum();
        sum / 64.0
    };
    let [normal, tangential] = solver.forces(u, high, mean);
    // As the laws do: what the grid makes of the smooth raceway at this force is Hertz's.
    let own = (normal.max(1e-12) / bearing.stiffness[1]).cbrt().powi(2);
    let smooth = solver.forces(own, high + u - own, |_, _| 0.0)[0];
    let hertz = bearing.stiffness[1] * own.powf(1.5) / smooth;
    // The energy changes by the arc at the raceway, the force acts at the element's centre.
    [normal * hertz, tangential * hertz * (bearing.rho_0 + r) / (bearing.rho_0 + u)]
}

#[test]
fn love_agrees_with_a_half_space_of_its_own() {
    for_seeds(5, |_, draw| {
        let (case, approach) = standing(draw);
        let half = half_contact(&case, approach);
        let depth = approach * draw.log(0.1, 3.0);
        let shape = match draw.below(3) {
            0 => Shape::Spall {
                length: Length::Millimetres(draw.between(0.5, 4.0) * half * 1e3),
                depth_um: depth * 1e6,
                slope_deg: draw.pick(&[90.0, 45.0]),
            },
            1 => trace(draw.between(0.5, 6.0) * half, 0.03 * half, |share| depth * bowl(share)),
            _ => Shape::Topography(patch(draw, 0.06 * half, half, depth)),
        };
        let raceway = Bearing::smooth(&case).rho_0 + 0.5e-3 * case.diameter_mm;
        let at = draw.between(-0.6, 0.6) * shape.length(raceway);
        let mut case = over(&pressed(&case, approach), shape.clone(), at);
        (case.law, case.grid) = ("love", Some(grid(&case, approach, [24, 16])));
        let [u, radial, tangential] = force(&case)?;
        let smooth = Bearing::smooth(&case).stiffness[1] * approach.powf(1.5);
        let (coarse, fine) =
            (half_space(&case, &shape, (u, at), [14, 10]), half_space(&case, &shape, (u, at), [28, 20]));
        for (found, coarse, fine) in [(radial, coarse[0], fine[0]), (tangential, coarse[1], fine[1])] {
            // Both grids' errors: this one's by its coarser self.
            let limit = 0.03 * smooth + 2.0 * (coarse - fine).abs();
            if !((found - fine).abs() <= limit) {
                return Err(format!(
                    "{found:e} N, the oracle says {fine:e} N ({coarse:e} N), allowed {limit:e}; smooth {smooth:e} N"
                ));
            }
        }
        Ok(())
    });
}
