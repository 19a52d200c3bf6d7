//! A defect at which no element is pressed between the raceways: nothing is heard of it. Judged in the balance of the
//! start on smooth raceways, with an element in the defect.

use crate::statics::{InBalance, in_balance};
use brinell::dynamics::parameters::{Excitation, Model, Quadratic, WholeAngle};
use brinell::numerics::wrap;
use brinell::scene::{Defect, DefectOn, Motion, Ring, Scene};
use brinell::simulation::setup::build_model;
use brinell::surface::Surface;
use std::f64::consts::{PI, TAU};
use std::fmt;

/// Places within the spacing of the elements at which balances are looked for.
const PLACES: usize = 8;

/// What presses, and where.
#[derive(Debug, Clone, PartialEq)]
pub struct NotPressed {
    /// Where nothing presses.
    pub why: Why,
    /// What presses the rings against each other.
    pub forces: Vec<String>,
    /// First and last direction (°) in which elements are pressed; `None` where none is.
    pub zone_deg: Option<[f64; 2]>,
}

/// What is hardly meant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Why {
    /// No ring has a load.
    NoLoad,
    /// A defect that stands outside the load zone.
    AtDefect {
        /// Its number, from 1, and how many there are.
        number: [usize; 2],
        /// Its angle (°).
        angle_deg: f64,
        /// What was probably meant.
        meant: Option<Meant>,
    },
}

/// How a defect would be in the load zone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Meant {
    /// With its angle in radians: that in degrees.
    Radians(f64),
    /// With the load the other way.
    OtherSign,
}

/// A scene without its defects, in balance at any angle of the cage.
struct Healthy {
    model: Model,
    excitation: Excitation,
}

impl NotPressed {
    /// What there is to ask about a scene and the surfaces of its defects; nothing where a host moves a ring.
    pub fn of(scene: &Scene, surfaces: &[Surface]) -> Option<Self> {
        let rings = [&scene.shaft, &scene.housing];
        if scene.defects.is_empty() || rings.iter().any(|ring| ring.motion == Motion::Host) {
            return None;
        }
        let healthy = Healthy::of(scene)?;
        let why = match rings.iter().all(|ring| is_free_of_load(ring)) && scene.bearing.radial_clearance >= 0.0 {
            true => Why::NoLoad,
            false => outside(scene, surfaces, &healthy)?,
        };
        let zone_deg = healthy.zone().map(|[middle, half]| [middle - half, middle + half].map(f64::to_degrees));
        Some(Self { why, forces: forces(scene), zone_deg })
    }
}

fn is_free_of_load(ring: &Ring) -> bool {
    let (axial, tilt) = (ring.axial, ring.tilt);
    ring.load == [0.0; 2] && axial.load == 0.0 && axial.preload == 0.0 && tilt.load_moment == [0.0; 2]
}

/// The first defect at which no element is pressed.
fn outside(scene: &Scene, surfaces: &[Surface], healthy: &Healthy) -> Option<Why> {
    let turned = scene.housing_initial_angle;
    let stands = |defect: &Defect| defect.on == DefectOn::Outer && scene.housing_speed.unwrap_or(0.0) == 0.0;
    let outside = |(defect, surface): (&Defect, &Surface)| match stands(defect) {
        true => {
            let radius = defect.on.radius(&scene.bearing);
            let (first, last) = surface.extent();
            !healthy.presses(defect.angle + turned, [first / radius, last / radius])
        }
        // It passes all places.
        false => healthy.everywhere().all(|pressed| pressed.is_empty()),
    };
    let index = scene.defects.iter().zip(surfaces).position(outside)?;
    let defect = &scene.defects[index];
    let angle_deg = defect.angle.to_degrees();
    let near = |angle: f64| stands(defect) && healthy.presses(angle + turned, [0.0; 2]);
    // As it is written, in radians.
    let meant = match angle_deg.abs() <= TAU && near(angle_deg) {
        true => Some(Meant::Radians(angle_deg.to_degrees())),
        false => near(defect.angle + PI).then_some(Meant::OtherSign),
    };
    Some(Why::AtDefect { number: [index + 1, scene.defects.len()], angle_deg, meant })
}

impl Healthy {
    fn of(scene: &Scene) -> Option<Self> {
        let mut scene = scene.clone();
        (scene.defects, scene.waviness) = (Vec::new(), Vec::new());
        let model = build_model(&scene, &[], None).ok()?;
        let speeds = [scene.shaft_speed, scene.housing_speed.unwrap_or(0.0)];
        let cage = model.ratios.cage[0] * speeds[0] + model.ratios.cage[1] * speeds[1];
        let load = [scene.shaft, scene.housing].map(|ring| ring.loads().map(Quadratic::constant));
        let cage = Quadratic([0.0, cage, 0.0]);
        let excitation = Excitation { cage, load, ..Excitation::standing(scene.cage.initial_angle, [0.0; 3]) };
        Some(Self { model, excitation })
    }

    /// Directions (rad) of the elements that are pressed between both raceways, and of each its force (N), with
    /// element 1 at an angle of the cage (rad); element 1 itself is the first of them. A balance that there is not is
    /// reported where the start is looked for: here all elements are taken for pressed.
    fn pressed(&self, cage_angle: f64) -> Vec<(usize, f64, f64)> {
        let excitation = Excitation { cage_start: cage_angle, ..self.excitation };
        let cage = WholeAngle::in_first_turn(cage_angle);
        let angle = |j: usize| self.model.element_angle(j, cage);
        let count = self.model.element_count;
        match in_balance(&self.model, &excitation) {
            Ok(InBalance { forces, .. }) => {
                let force = |j: usize| forces.contacts.inner[j].min(forces.contacts.outer[j]);
                (0..count).map(|j| (j, angle(j), force(j))).filter(|(.., force)| *force > 0.0).collect()
            }
            Err(_) => (0..count).map(|j| (j, angle(j), 1.0)).collect(),
        }
    }

    /// Whether an element is pressed anywhere between two angles (rad) from a direction (rad).
    fn presses(&self, direction: f64, [first, last]: [f64; 2]) -> bool {
        let spacing = TAU / self.model.element_count as f64;
        let count = (((last - first) / spacing * PLACES as f64).ceil() as usize).min(PLACES * self.model.element_count);
        // From the middle outwards.
        let places = (0..=count).flat_map(|k| [1.0, -1.0].map(|side| side * 0.5 * k as f64 / count.max(1) as f64));
        let middle = direction + 0.5 * (first + last);
        let mut at = places.map(|share| middle + share * (last - first));
        at.any(|angle| self.pressed(angle).first().is_some_and(|(j, ..)| *j == 0))
    }

    /// Those that are pressed at places of the cage within a spacing.
    fn everywhere(&self) -> impl Iterator<Item = Vec<(usize, f64, f64)>> {
        let step = TAU / (self.model.element_count * PLACES) as f64;
        (0..PLACES).map(move |k| self.pressed(step * k as f64))
    }

    /// Direction (rad) about which elements are pressed, and how far to either side (rad).
    fn zone(&self) -> Option<[f64; 2]> {
        let all: Vec<_> = self.everywhere().flatten().collect();
        let [x, y] = all
            .iter()
            .fold([0.0; 2], |[x, y], (_, angle, force)| [x + force * libm::cos(*angle), y + force * libm::sin(*angle)]);
        let middle = libm::atan2(y, x);
        all.iter().map(|(_, angle, _)| wrap(angle - middle).abs()).reduce(f64::max).map(|half| [middle, half])
    }
}

/// What presses the rings against each other, in words.
fn forces(scene: &Scene) -> Vec<String> {
    let mut forces = Vec::new();
    for (name, ring) in [("shaft", &scene.shaft), ("housing", &scene.housing)] {
        let [x, y] = ring.load;
        let (size, towards) = (libm::hypot(x, y), libm::atan2(y, x).to_degrees());
        if size > 0.0 {
            forces.push(format!("{name}.load_n with {size:.1} N towards {towards:.0} degrees"));
        }
        for (what, force) in [("load", ring.axial.load), ("preload", ring.axial.preload)] {
            if force != 0.0 {
                forces.push(format!("the {what} of the {name} along the axis with {force:.1} N"));
            }
        }
    }
    if scene.bearing.radial_clearance < 0.0 {
        forces.push("a negative clearance".to_owned());
    }
    forces
}

impl fmt::Display for NotPressed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.why {
            Why::NoLoad => write!(f, "no ring has a load (shaft.load_n, housing.load_n)")?,
            Why::AtDefect { number: [number, count], angle_deg, .. } => {
                let which = if count > 1 { format!("defect {number}") } else { "the defect".to_owned() };
                write!(f, "no element is pressed at {which}, at {angle_deg:.4} degrees")?;
            }
        }
        match self.zone_deg {
            Some([first, last]) if last - first < 359.0 => {
                write!(f, "; elements are pressed from {first:.0} to {last:.0} degrees")?;
            }
            Some(_) => write!(f, "; elements are pressed all around")?,
            None => write!(f, "; no element is pressed anywhere")?,
        }
        match self.forces.as_slice() {
            [] => {}
            all => write!(f, ", by {}", all.join(", "))?,
        }
        match self.why {
            Why::AtDefect { meant: Some(Meant::Radians(degrees)), .. } => {
                write!(f, ". {degrees:.4} degrees given in radians (defect.angle_deg)?")
            }
            Why::AtDefect { meant: Some(Meant::OtherSign), .. } => write!(f, ". Is the sign of the load meant?"),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use brinell::scene::{Bearing, DegreesOfFreedom};

    /// What is asked about a spall at an angle (°) of a bearing under a load (N), also along its axis where it has one.
    fn asked(angle: f64, load: [f64; 2], change: impl Fn(&mut Scene)) -> Option<NotPressed> {
        let bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3);
        let builder = Scene::builder(bearing).shaft_speed(100.0).shaft_load(load);
        let mut scene = builder.spall(angle.to_radians(), 1e-3, 50e-6).build().unwrap();
        change(&mut scene);
        scene.check().unwrap();
        NotPressed::of(&scene, &Surface::load_all(&scene, None).unwrap())
    }

    #[test]
    fn one_question_says_that_nothing_presses_and_what_was_probably_meant() {
        let as_it_is = |_: &mut Scene| {};
        let meant = |asked: Option<NotPressed>| match asked.unwrap().why {
            Why::AtDefect { meant, .. } => meant,
            Why::NoLoad => panic!("there is a load"),
        };
        for (direction, load) in [(-90.0f64, [0.0, -500.0]), (0.0, [300.0, 0.0]), (135.0, [-200.0, 200.0])] {
            assert_eq!(asked(direction, load, as_it_is), None);
            assert_eq!(meant(asked(direction + 180.0, load, as_it_is)), Some(Meant::OtherSign));
            assert_eq!(asked(direction, load.map(|force| 1e-3 * force), as_it_is), None);
        }
        let Some(Meant::Radians(degrees)) = meant(asked(-1.5, [0.0, -500.0], as_it_is)) else { panic!("radians") };
        assert!((degrees + 1.5f64.to_degrees()).abs() < 1e-9, "{degrees}");
        assert_eq!(meant(asked(-20.0, [300.0, 900.0], as_it_is)), None);
    }

    #[test]
    fn a_defect_that_turns_needs_a_load_and_no_angle() {
        for load in [[0.0, -500.0], [0.0; 2]] {
            let inner = asked(90.0, load, |scene| scene.defects[0].on = DefectOn::Inner);
            let element = asked(90.0, load, |scene| scene.defects[0].on = DefectOn::Element { element: 0, tilt: 0.0 });
            let turning = asked(90.0, load, |scene| scene.housing_speed = Some(5.0));
            for found in [inner, element, turning] {
                assert_eq!(found.map(|found| found.why), (load == [0.0; 2]).then_some(Why::NoLoad));
            }
        }
    }

    #[test]
    fn what_presses_without_a_load_on_the_shaft_is_known() {
        let preloaded = |scene: &mut Scene| scene.bearing.radial_clearance = -2e-6;
        assert_eq!(asked(90.0, [0.0; 2], preloaded), None);
        let by_thrust = |scene: &mut Scene| {
            scene.bearing.degrees_of_freedom = DegreesOfFreedom::Three;
            scene.shaft.axial.load = 500.0;
        };
        assert_eq!(asked(90.0, [0.0; 2], by_thrust), None);
        let by_host = |scene: &mut Scene| (scene.shaft.motion, scene.shaft.load) = (Motion::Host, [0.0; 2]);
        assert_eq!(asked(90.0, [0.0; 2], by_host), None);
    }
}
