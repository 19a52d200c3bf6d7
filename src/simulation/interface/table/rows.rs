//! The rows of the variable table for a scene: the one place where a variable is named.
//!
//! Inputs come first, then outputs, then parameters, then what was added later: for hosts that move a ring, and between
//! runs. A variable's index is its FMI value reference, which stays as rows are added.

use super::coordinates::{Along, COORDINATES, name, stiffness_name};
use crate::scene::{DefectOn, Motion, Scene, WavyBody};
use crate::simulation::interface::quantity::{Count, Quantity, Quantity as Q, RingName};
use crate::simulation::interface::table::builder::{Builder, RINGS};
use crate::simulation::interface::table::variables::{Causality, Kind, Unit, Variability, Variable};
use crate::surface::Surface;

/// The table of a scene with these surfaces of its defects, in the scene's order, with what each variable stands for.
pub fn rows(scene: &Scene, surfaces: &[Surface]) -> Vec<(Variable, Quantity)> {
    let count = 60 + 4 * scene.bearing.element_count;
    let mut builder = Builder::new(scene, surfaces, count);
    builder.inputs();
    builder.outputs();
    builder.parameters();
    builder.coupling();
    builder.between_runs();
    builder.coupling_error();
    builder.into_rows()
}

/// Sizes of an input: from -`largest` to `largest`, in its unit.
#[derive(Debug, Clone, Copy)]
struct Size {
    largest: f64,
    nominal: f64,
}

/// An input of a prescribed ring along each axis.
struct Prescribed {
    /// What the axis has before it in the name.
    prefix: &'static str,
    noun: Along<&'static str>,
    quantity: fn(RingName, usize) -> Quantity,
    unit: Along<Unit>,
    size: Along<Size>,
}

const PRESCRIBED: [Prescribed; 3] = [
    Prescribed {
        prefix: "",
        noun: Along { axis: "Position", tilt: "Tilt" },
        quantity: Q::Position,
        unit: Along { axis: Unit::Metre, tilt: Unit::Radian },
        size: Along { axis: Size { largest: 0.01, nominal: 1e-5 }, tilt: Size { largest: 0.05, nominal: 1e-3 } },
    },
    Prescribed {
        prefix: "v",
        noun: Along { axis: "Velocity", tilt: "Tilting velocity" },
        quantity: Q::Velocity,
        unit: Along { axis: Unit::MetrePerSecond, tilt: Unit::RadianPerSecond },
        size: Along { axis: Size { largest: 1e3, nominal: 1e-2 }, tilt: Size { largest: 1e4, nominal: 1.0 } },
    },
    Prescribed {
        prefix: "a",
        noun: Along { axis: "Acceleration", tilt: "Tilting acceleration" },
        quantity: Q::Acceleration,
        unit: Along { axis: Unit::MetrePerSecondSquared, tilt: Unit::RadianPerSecondSquared },
        size: Along { axis: Size { largest: 1e9, nominal: 10.0 }, tilt: Size { largest: 1e10, nominal: 1000.0 } },
    },
];
const SPEED: Size = Size { largest: 1e5, nominal: 100.0 };
const LOAD: Along<Size> =
    Along { axis: Size { largest: 1e9, nominal: 1000.0 }, tilt: Size { largest: 1e9, nominal: 10.0 } };

impl Builder<'_> {
    fn inputs(&mut self) {
        let scene = self.scene;
        self.input(
            "shaft.speed",
            "Speed of the inner ring, counter-clockwise",
            Q::Speed(RingName::Shaft),
            Unit::RadianPerSecond,
            scene.shaft_speed,
            SPEED,
        );
        if let Some(speed) = scene.housing_speed {
            let text = "Speed of the outer ring, counter-clockwise";
            let (quantity, unit) = (Q::Speed(RingName::Housing), Unit::RadianPerSecond);
            self.input("housing.speed", text, quantity, unit, speed, SPEED);
        }
        for ring in RINGS {
            let ([of, what], parts) = (ring.names(), self.ring(ring));
            let loads = parts.loads();
            match self.motion(ring) {
                Motion::Internal => {
                    for axis in self.moving(ring) {
                        let [letter, along] = COORDINATES[axis];
                        self.input(
                            &[of, [".load.", ".load_moment."][usize::from(axis > 2)], letter].concat(),
                            &format!(
                                "External {} on the {what} {along}{letter}",
                                ["load", "moment"][usize::from(axis > 2)]
                            ),
                            Q::Load(ring, axis),
                            Along { axis: Unit::Newton, tilt: Unit::NewtonMetre }.of(axis),
                            loads[axis],
                            LOAD.of(axis),
                        );
                    }
                }
                Motion::Host => {
                    for Prescribed { prefix, noun, quantity, unit, size } in PRESCRIBED {
                        for axis in self.moving(ring) {
                            let [letter, along] = COORDINATES[axis];
                            let optional = if prefix == "a" { " (optional, extrapolates within the step)" } else { "" };
                            self.input(
                                &name(of, prefix, axis),
                                &format!("{} of the {what} {along}{letter}{optional}", noun.of(axis)),
                                quantity(ring, axis),
                                unit.of(axis),
                                0.0,
                                if prefix.is_empty() && axis == 2 { self.along(ring) } else { size.of(axis) },
                            );
                        }
                    }
                }
                Motion::Fixed => {}
            }
        }
    }

    /// How far a host may move a ring along the axis: against one that stands, up to where the grooves end.
    fn along(&self, ring: RingName) -> Size {
        let other = if ring == RingName::Shaft { RingName::Housing } else { RingName::Shaft };
        let Along { axis, .. } = PRESCRIBED[0].size;
        match self.motion(other) {
            // To a nanometre, as nobody wants to read the rounding of a sum.
            Motion::Fixed => Size { largest: (self.scene.bearing.groove_distance() * 1e9).round() / 1e9, ..axis },
            _ => axis,
        }
    }

    fn outputs(&mut self) {
        for ring in RINGS {
            self.ring_outputs(ring);
        }
        self.turning_outputs();
        let count = self.scene.bearing.degrees_of_freedom.count();
        for row in 0..count {
            for column in 0..count {
                let ([a, along], [b, moved]) = (COORDINATES[row], COORDINATES[column]);
                let (force, moves) =
                    (Along { axis: "force", tilt: "moment" }, Along { axis: "displacement", tilt: "tilt" });
                let unit = match (row > 2, column > 2) {
                    (false, false) => Unit::NewtonPerMetre,
                    (true, false) => Unit::Newton,
                    (false, true) => Unit::NewtonPerRadian,
                    (true, true) => Unit::NewtonMetrePerRadian,
                };
                let (force, moves) = (force.of(row), moves.of(column));
                let nominal = [1e8, 1e6, 1e4][usize::from(row > 2) + usize::from(column > 2)];
                self.output(
                    &stiffness_name(row, column),
                    &format!("Tangent stiffness: {force} {along}{a} per {moves} of the inner ring {moved}{b}"),
                    Q::Stiffness(row, column),
                    unit,
                    nominal,
                );
            }
        }
        self.measurements();
        self.output("cage.angle", "Angle of element 1, counter-clockwise from +x", Q::CageAngle, Unit::Radian, 1.0);
        self.output("cage.speed", "Speed of the cage", Q::CageSpeed, Unit::RadianPerSecond, 100.0);
        self.output(
            "cage.torque",
            "Torque of the elements on the cage about the outer ring's centre",
            Q::CageTorque,
            Unit::NewtonMetre,
            0.1,
        );
        for j in 0..self.scene.bearing.element_count {
            self.element_outputs(j);
        }
        self.counters();
    }

    /// What sensors and probe show.
    fn measurements(&mut self) {
        for (k, sensor) in self.scene.sensors.iter().enumerate() {
            let name = self.scene.sensor_variable(k);
            let called = if sensor.name.is_empty() { String::new() } else { format!(" {}", sensor.name) };
            let along = match sensor.unit() {
                [0.0, 1.0] => "y".to_owned(),
                [1.0, 0.0] => "x".to_owned(),
                _ => format!("{} degrees from +x", (sensor.direction.to_degrees() * 1e9).round() / 1e9),
            };
            let text = format!("Acceleration that the sensor{called} on the housing shows, along {along}");
            self.output(&name, &text, Q::SensorAcceleration(k), Unit::MetrePerSecondSquared, 10.0);
        }
        if self.scene.probe {
            let count = self.scene.bearing.degrees_of_freedom.count().min(3);
            for (axis, [letter, _]) in COORDINATES.iter().enumerate().take(count) {
                let text = format!("Displacement of the inner ring against the outer along {letter}");
                self.output(&format!("probe.{letter}"), &text, Q::Probe(axis), Unit::Metre, 1e-5);
            }
        }
    }

    /// Angles of rings that have a defect or waves or turn, and the torque on an inner one that has them.
    fn turning_outputs(&mut self) {
        if self.scene.marks_inner_ring() {
            self.ring_angle(RingName::Shaft);
            let defects = self.scene.defects.iter().any(|defect| defect.on == DefectOn::Inner);
            let waves = self.scene.waviness.iter().any(|waves| waves.on == WavyBody::Inner);
            let at = match (defects, waves) {
                (true, false) => "at the defect on",
                (true, true) => "at the defect and the waves of",
                (false, _) => "at the waves of",
            };
            let text = ["Torque of contacts ", at, " the inner ring about its centre"].concat();
            self.output("shaft.torque", &text, Q::ShaftTorque, Unit::NewtonMetre, 0.1);
        }
        if self.scene.housing_speed.is_some() {
            self.ring_angle(RingName::Housing);
        }
    }

    fn ring_angle(&mut self, ring: RingName) {
        let [of, what] = ring.names();
        let text = ["Angle of the ", what, ", counter-clockwise"].concat();
        self.output(&[of, ".angle"].concat(), &text, Q::RingAngle(ring), Unit::Radian, 1.0);
    }

    fn element_outputs(&mut self, j: usize) {
        let n = (j + 1).to_string();
        // Concatenated: setting up an instance is mostly writing names.
        let name = |part: &str| ["element[", &n, part].concat();
        let text = |before: &str, after: &str| [before, &n, after].concat();
        self.output(
            &name("].angle"),
            &text("Angle of element ", ", counter-clockwise from +x"),
            Q::ElementAngle(j),
            Unit::Radian,
            1.0,
        );
        self.output(
            &name("].path"),
            &text("Radial path of element ", ": 0 where it touches the smooth outer raceway, positive outwards"),
            Q::ElementPath(j),
            Unit::Metre,
            1e-5,
        );
        if self.in_space() {
            self.output(
                &name("].axial"),
                &text("Axial position of element ", ", along z"),
                Q::ElementAxial(j),
                Unit::Metre,
                1e-5,
            );
        }
        self.output(
            &name("].force.inner"),
            &text("Normal force between element ", " and the inner raceway"),
            Q::ElementInnerForce(j),
            Unit::Newton,
            100.0,
        );
        self.output(
            &name("].force.outer"),
            &text("Normal force between element ", " and the outer raceway"),
            Q::ElementOuterForce(j),
            Unit::Newton,
            100.0,
        );
        if self.in_space() {
            self.element_angles(j);
        }
        if self.scene.first_defect_of(j).is_some() {
            self.output(
                &name("].spin_angle"),
                &text("Angle of the defect of element ", ", counter-clockwise from where it faces the outer raceway"),
                Q::ElementSpinAngle(j),
                Unit::Radian,
                1.0,
            );
        }
    }

    fn counters(&mut self) {
        self.counter("solver.steps", "Integration steps taken since the start", Q::Count(Count::Steps));
        self.counter(
            "solver.rejected_steps",
            "Integration steps taken again with a shorter one, for error or to land",
            Q::Count(Count::RejectedSteps),
        );
        if self.has_shoulders() {
            let text = "Ends of integration steps at which a shoulder cuts the contact of an element";
            self.counter("solver.truncated_contacts", text, Q::Count(Count::TruncatedContacts));
        }
        if self.meets_topography_beside_its_track() {
            let text = "Ends of integration steps at which a contact is beside the slices of a topography";
            self.counter("solver.off_track_contacts", text, Q::Count(Count::OffTrackContacts));
        }
        if !self.scene.defects.is_empty() {
            self.counter(
                "solver.contact_solves",
                "Contacts near the defect that were solved on a grid since the start",
                Q::Count(Count::ContactSolves),
            );
            self.counter(
                "solver.map_lookups",
                "Approaches near the defect that were looked up in the path or map since the start",
                Q::Count(Count::MapLookups),
            );
        }
    }

    fn ring_outputs(&mut self, ring: RingName) {
        let [of, what] = ring.names();
        let motion = self.motion(ring);
        if motion == Motion::Internal {
            for Prescribed { prefix, noun, quantity, unit, size } in PRESCRIBED {
                for axis in self.moving(ring) {
                    let ([letter, along], noun) = (COORDINATES[axis], noun.of(axis));
                    let text = [noun, " of the ", what, " ", along, letter].concat();
                    self.output(
                        &name(of, prefix, axis),
                        &text,
                        quantity(ring, axis),
                        unit.of(axis),
                        size.of(axis).nominal,
                    );
                }
            }
        }
        // Which of the two forces belongs to which co-simulation algorithm: docs/how-to/systems.md.
        let hosted = motion == Motion::Host;
        let after =
            if hosted { "; with its derivative by time for a host that steps all units in parallel" } else { "" };
        self.forces(ring, "", [" of the bearing's contacts, at this moment, on", after], Q::Force);
        if hosted {
            let mean = [
                " of the bearing's contacts, mean over the last communication step, on",
                "; for a host that takes the same step after the bearing, never for one in parallel",
            ];
            self.forces(ring, "mean_", mean, Q::MeanForce);
        }
    }

    fn input(&mut self, name: &str, text: &str, quantity: Quantity, unit: Unit, start: f64, size: Size) {
        let Size { largest, nominal } = size;
        let kind = Kind::Real { unit, start: Some(start), min: Some(-largest), max: Some(largest), nominal };
        let derivatives = quantity.as_input().map_or("no derivative acts", |input| input.derivatives().1);
        let text = [text, "; ", derivatives].concat();
        self.push(name, &text, kind, (Causality::Input, Variability::Continuous), quantity);
    }

    fn counter(&mut self, name: &str, text: &str, quantity: Quantity) {
        // Not an output: there are hosts that read every output as a real number.
        self.push(name, text, Kind::Integer, (Causality::Local, Variability::Discrete), quantity);
    }
}
