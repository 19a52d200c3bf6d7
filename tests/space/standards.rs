//! Balances that others have published: ISO/TS 16281's linear geometry, and bearings at high speed after Jones.

use super::*;
use brinell::numerics::elementary::elliptic;
use brinell::scene::{Damping, ElementInertia, Gyroscopic};
use nalgebra::SVector;
use std::f64::consts::{PI, TAU};

/// Place of a ring (m, rad), and loads on it (N, N m).
type Five = SVector<f64, 5>;

/// Displacement of the inner ring of ISO/TS 16281's deep groove bearing (7 balls of 11.5 mm on 43.5 mm, ball 1 at 0°)
/// under a load, by its linear geometry: where the energy ⅖ Σ K δ^(5/2) less the load's work is least, with
/// δ = √(a² + b²) − A, a = A cos α° + δ_r, b = δ_z + ½ D_pw (φ_x sin θ − φ_y cos θ), z counted from the middle.
fn of_iso_16281(load: Five, diametral_clearance: f64, near: Five) -> Five {
    let series = |[a, b]: [f64; 2]| (a.powf(-2.0 / 3.0) + b.powf(-2.0 / 3.0)).powf(-1.5);
    let (constant, arm, distance) = (series([3.07370231e10, 2.89807829e10]), 21.75e-3, 0.05 * 11.5e-3);
    let free = distance - 0.5 * diametral_clearance;
    let mut place = near;
    for _ in 0..100 {
        let (mut rest, mut stiffness) = (load, nalgebra::SMatrix::<f64, 5, 5>::zeros());
        for ball in 0..7 {
            let (sin, cos) = (TAU * f64::from(ball) / 7.0).sin_cos();
            let (along_a, along_b) =
                (Five::from([cos, sin, 0.0, 0.0, 0.0]), Five::from([0.0, 0.0, 1.0, arm * sin, -arm * cos]));
            let (a, b) = (free + along_a.dot(&place), along_b.dot(&place));
            let length = a.hypot(b);
            let approach = (length - distance).max(0.0);
            let normal = (along_a * a + along_b * b) / length;
            let force = constant * approach.powf(1.5);
            let turning = along_a * along_a.transpose() + along_b * along_b.transpose() - normal * normal.transpose();
            rest -= force * normal;
            stiffness += 1.5 * constant * approach.sqrt() * normal * normal.transpose() + force / length * turning;
        }
        let step = stiffness.lu().solve(&rest).unwrap();
        place += step;
        if step.norm() < 1e-15 {
            break;
        }
    }
    place
}

#[test]
fn the_linear_geometry_of_iso_16281_has_the_published_displacements() {
    // As its examples print them, in micrometres and milliradians.
    let near = Five::from([10e-6, 0.0, 140e-6, 0.0, 2e-3]);
    for (clearance, z) in [(0.0, "133.5381"), (10e-6, "149.1717")] {
        let found = of_iso_16281(Five::from([0.0, 0.0, 1000.0, 0.0, 0.0]), clearance, near);
        // One's last digit is an iteration's.
        assert!((1e6 * found[2] - z.parse::<f64>().unwrap()).abs() < 1.2e-4, "{} {z}", found[2]);
    }
    let both = of_iso_16281(Five::from([1000.0, 0.0, 1000.0, 0.0, 0.0]), 10e-6, near);
    printed(&[both[0], both[2]], 1e-6, "19.591770 146.459965");
    printed(&[both[4]], 1e-3, "2.687109");
    // The published iteration ends 2 to 4e-5 beside where it goes.
    let close = |found: f64, published: f64| assert!((found / published - 1.0).abs() < 4e-5, "{found} {published}");
    [(both[0], 19.5923e-6), (both[2], 146.4603e-6), (both[4], 2.6872e-3)]
        .into_iter()
        .for_each(|(found, of)| close(found, of));
    // A moment about the radial load's own axis needs all five degrees of freedom.
    let all = of_iso_16281(Five::from([1000.0, 0.0, 1000.0, 1.0, 0.0]), 10e-6, both);
    printed(&[all[0], all[1], all[2]], 1e-6, "19.531598 -2.676938 146.308305");
    printed(&[all[3], all[4]], 1e-3, "0.496955 2.678172");
    let found = [all[0].hypot(all[1]), all[2], all[3].hypot(all[4])];
    found.into_iter().zip([19.7144e-6, 146.3084e-6, 2.7239e-3]).for_each(|(found, of)| close(found, of));
    let alone = of_iso_16281(Five::from([0.0, 0.0, 0.0, 1.0, 0.0]), 0.0, Five::from([0.0, 0.0, 0.0, 4e-3, 0.0]));
    printed(&[alone[3]], 1e-3, "3.695576");
    close(alone[3], 3.6957e-3);
}

/// A bearing of the public program OpenJones (Sudhof 2015), of which the outer ring stands and the outer raceway holds
/// the balls' gyroscopic couple.
struct Jones {
    count: usize,
    /// Of balls, pitch circle, inner and outer groove (m).
    lengths: [f64; 4],
    angle_deg: f64,
    /// E (Pa) and ν.
    elastic: [f64; 2],
    thrust: f64,
    rpm: f64,
}

impl Jones {
    /// Constants of the inner and the outer contact at contact angles (rad) by the program's correlation: the ellipse
    /// has the axes' ratio κ = 1.0339 (R_x/R_y)^0.636.
    fn constants(&self, angles: [f64; 2]) -> [f64; 2] {
        let ([ball, pitch, inner, outer], [modulus, ratio]) = (self.lengths, self.elastic);
        let of = |sense: f64, groove: f64, angle: f64| {
            let gamma = ball / pitch * angle.cos();
            let along = 2.0 / ball * (1.0 + sense * gamma / (1.0 - sense * gamma));
            let across = 2.0 / ball - 1.0 / groove;
            let kappa = 1.0339 * (along / across).powf(0.636);
            let (f, e) = elliptic::complete(1.0 - 1.0 / (kappa * kappa));
            let compliance = 2.0 * (1.0 - ratio * ratio) / modulus;
            PI * kappa * 2.0 / compliance * (2.0 * e / (9.0 * (along + across) * f.powi(3))).sqrt()
        };
        [of(1.0, inner, angles[0]), of(-1.0, outer, angles[1])]
    }

    /// The bearing in balance, with the program's constants, the cage's speed and the centrifugal force at contact
    /// angles (degrees).
    fn balanced(&self, gyroscopic: Gyroscopic, angles: [f64; 2]) -> Simulation {
        let ([ball, pitch, inner, outer], angles) = (self.lengths, angles.map(f64::to_radians));
        let shaft = self.rpm * PI / 30.0;
        // The outer raceway controls the spin.
        let turning = shaft * (1.0 - ball / pitch * angles[0].cos()) / (1.0 + (angles[0] - angles[1]).cos());
        let mass = 7750.37 * PI / 6.0 * ball.powi(3);
        let [hertz_inner, hertz_outer] = self.constants(angles).map(Some);
        let mut found = None;
        // It has the balls go round on the pitch circle: as much force and couple at the radius where they are.
        let mut radius = 0.5 * pitch;
        for _ in 0..4 {
            let slower = 0.5 * pitch / radius;
            let mut bearing = Bearing {
                conformity_inner: inner / ball,
                conformity_outer: outer / ball,
                element_mass: Some(mass / slower),
                element_inertia: ElementInertia::None,
                operating_angle: Some(((1.0 - 2.0 * slower * turning / shaft) * pitch / ball).acos()),
                ..Bearing::steel_balls(self.count, ball, pitch)
            };
            (bearing.hertz_inner, bearing.hertz_outer, bearing.gyroscopic) = (hertz_inner, hertz_outer, gyroscopic);
            bearing.set_contact_angle(self.angle_deg.to_radians());
            let outermost = bearing.outer_raceway_radius() - 0.5 * ball;
            let scene = free_shaft(bearing, DegreesOfFreedom::Three).gravity([0.0; 2]).axial_load(self.thrust);
            let scene = scene.damping(Damping::HuntCrossley(0.0)).shaft_speed(shaft);
            let mut simulation = started(scene.build().unwrap());
            radius = outermost + simulation.get("element[1].path").unwrap();
            found = Some(simulation);
        }
        found.unwrap()
    }
}

#[test]
fn bearings_at_high_speed_stand_where_a_program_after_jones_has_them_with_its_constants() {
    let turbopump = Jones {
        count: 10,
        lengths: [7.938e-3, 38.5e-3, 0.56 * 7.938e-3, 0.52 * 7.938e-3],
        angle_deg: 20.0,
        elastic: [199.948e9, 0.25],
        thrust: 2670.0,
        rpm: 50_000.0,
    };
    let spindle = Jones {
        count: 18,
        lengths: [12.7e-3, 90e-3, 6.8e-3, 6.66e-3],
        angle_deg: 25.0,
        elastic: [210.08e9, 0.3],
        thrust: 4150.0,
        rpm: 11_111.111,
    };
    for (bearing, gyroscopic, angles, z) in [
        (&turbopump, Gyroscopic::Outer, "26.23263299 18.60543818", "51.92830266"),
        (&turbopump, Gyroscopic::None, "25.87727737 20.11593294", "53.46738701"),
        (&spindle, Gyroscopic::Outer, "29.55578486 22.97209711", "27.65604391"),
        (&spindle, Gyroscopic::None, "28.93529092 24.13155537", "29.28847594"),
    ] {
        let mut found =
            bearing.balanced(gyroscopic, [0, 1].map(|k| angles.split(' ').nth(k).unwrap().parse().unwrap()));
        let named = ["element[1].contact_angle.inner", "element[1].contact_angle.outer"];
        printed(&values(&mut found, named), PI / 180.0, angles);
        printed(&values(&mut found, ["shaft.z"]), 1e-6, z);
    }
}
