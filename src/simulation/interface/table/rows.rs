//! The rows of the variable table for a scene: the one place where a variable is named.
//!
//! Inputs come first, then outputs, then parameters, then what was added for hosts that move a ring. A variable's index
//! is its FMI value reference, which stays as rows are added.

use crate::scene::{Motion, Scene};
use crate::simulation::interface::quantity::{Count, Quantity, Quantity as Q, RingName};
use crate::simulation::interface::table::builder::{AXES, Builder, RINGS};
use crate::simulation::interface::table::variables::{Causality, Kind, Unit, Variability, Variable};

/// The table of a scene, with what each variable stands for.
pub fn rows(scene: &Scene) -> Vec<(Variable, Quantity)> {
    let count = 60 + 4 * scene.bearing.element_count;
    let mut builder = Builder::new(scene, count);
    builder.inputs();
    builder.outputs();
    builder.parameters();
    builder.coupling();
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
    noun: &'static str,
    quantity: fn(RingName, usize) -> Quantity,
    unit: Unit,
    size: Size,
}

const PRESCRIBED: [Prescribed; 3] = [
    Prescribed {
        prefix: "",
        noun: "Position",
        quantity: Q::Position,
        unit: Unit::Metre,
        size: Size { largest: 0.01, nominal: 1e-5 },
    },
    Prescribed {
        prefix: "v",
        noun: "Velocity",
        quantity: Q::Velocity,
        unit: Unit::MetrePerSecond,
        size: Size { largest: 1e3, nominal: 1e-2 },
    },
    Prescribed {
        prefix: "a",
        noun: "Acceleration",
        quantity: Q::Acceleration,
        unit: Unit::MetrePerSecondSquared,
        size: Size { largest: 1e9, nominal: 10.0 },
    },
];
const SPEED: Size = Size { largest: 1e5, nominal: 100.0 };
const LOAD: Size = Size { largest: 1e9, nominal: 1000.0 };

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
            let (name, what, load) = match ring {
                RingName::Shaft => ("shaft", "inner ring", scene.shaft.load),
                RingName::Housing => ("housing", "outer ring", scene.housing.load),
            };
            match self.motion(ring) {
                Motion::Internal => {
                    for (axis, letter) in AXES.iter().enumerate() {
                        self.input(
                            &format!("{name}.load.{letter}"),
                            &format!("External load on the {what} along {letter}"),
                            Q::Load(ring, axis),
                            Unit::Newton,
                            load[axis],
                            LOAD,
                        );
                    }
                }
                Motion::Host => {
                    for Prescribed { prefix, noun, quantity, unit, size } in PRESCRIBED {
                        for (axis, letter) in AXES.iter().enumerate() {
                            let optional = if prefix == "a" { " (optional, extrapolates within the step)" } else { "" };
                            self.input(
                                &format!("{name}.{prefix}{letter}"),
                                &format!("{noun} of the {what} along {letter}{optional}"),
                                quantity(ring, axis),
                                unit,
                                0.0,
                                size,
                            );
                        }
                    }
                }
                Motion::Fixed => {}
            }
        }
    }

    fn outputs(&mut self) {
        for ring in RINGS {
            self.ring_outputs(ring);
        }
        self.turning_outputs();
        for (row, a) in AXES.iter().enumerate() {
            for (column, b) in AXES.iter().enumerate() {
                self.output(
                    &format!("shaft.stiffness.{a}{b}"),
                    &format!("Tangent stiffness: force along {a} per displacement of the inner ring along {b}"),
                    Q::Stiffness(row, column),
                    Unit::NewtonPerMetre,
                    1e8,
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
            for (axis, letter) in AXES.iter().enumerate() {
                let text = format!("Displacement of the inner ring against the outer along {letter}");
                self.output(&format!("probe.{letter}"), &text, Q::Probe(axis), Unit::Metre, 1e-5);
            }
        }
    }

    /// Angles of rings that bear a defect or turn, and the torque on one with a defect.
    fn turning_outputs(&mut self) {
        if self.scene.has_defect_of_inner_ring() {
            self.ring_angle(RingName::Shaft);
            self.output(
                "shaft.torque",
                "Torque of contacts at the defect on the inner ring about its centre",
                Q::ShaftTorque,
                Unit::NewtonMetre,
                0.1,
            );
        }
        if self.scene.housing_speed.is_some() {
            self.ring_angle(RingName::Housing);
        }
    }

    fn ring_angle(&mut self, ring: RingName) {
        let (name, what) = match ring {
            RingName::Shaft => ("shaft.angle", "inner ring"),
            RingName::Housing => ("housing.angle", "outer ring"),
        };
        let text = ["Angle of the ", what, ", counter-clockwise"].concat();
        self.output(name, &text, Q::RingAngle(ring), Unit::Radian, 1.0);
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
        let (name, what) = match ring {
            RingName::Shaft => ("shaft", "inner ring"),
            RingName::Housing => ("housing", "outer ring"),
        };
        let motion = self.motion(ring);
        let mut pair = |suffix: &str, text: [&str; 2], quantity: fn(RingName, usize) -> Q, unit: Unit, nominal: f64| {
            for (axis, letter) in AXES.iter().enumerate() {
                let suffix = suffix.replace('*', letter);
                self.output(
                    &[name, ".", &suffix].concat(),
                    &[text[0], " the ", what, " along ", letter, text[1]].concat(),
                    quantity(ring, axis),
                    unit,
                    nominal,
                );
            }
        };
        if motion == Motion::Internal {
            pair("*", ["Position of", ""], Q::Position, Unit::Metre, 1e-5);
            pair("v*", ["Velocity of", ""], Q::Velocity, Unit::MetrePerSecond, 1e-2);
            pair("a*", ["Acceleration of", ""], Q::Acceleration, Unit::MetrePerSecondSquared, 10.0);
        }
        // Which of the two forces belongs to which co-simulation algorithm: docs/systems.md.
        let hosted = motion == Motion::Host;
        let after =
            if hosted { "; with its derivative by time for a master that steps all units in parallel" } else { "" };
        let now = ["Force of the bearing's contacts, at this moment, on", after];
        pair("force.*", now, Q::Force, Unit::Newton, 1000.0);
        if hosted {
            let mean = [
                "Force of the bearing's contacts, mean over the last communication step, on",
                "; for a host that takes the same step after the bearing, never for one in parallel",
            ];
            pair("mean_force.*", mean, Q::MeanForce, Unit::Newton, 1000.0);
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
        // Not an output: there are masters that read every output as a real number.
        self.push(name, text, Kind::Integer, (Causality::Local, Variability::Discrete), quantity);
    }
}
