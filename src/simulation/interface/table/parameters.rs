//! The parameters in the variable table: what a host may set before the start, with limits.

use super::builder::{Builder, CONTACT_LAWS, Limited, RINGS};
use super::variables::{Causality, Kind, Unit, Variability};
use crate::scene::{Damping, DefectOn, Motion};
use crate::simulation::interface::quantity::{Parameter, Quantity as Q, RingName};

impl Builder<'_> {
    pub(super) fn parameters(&mut self) {
        let scene = self.scene;
        let bearing = &scene.bearing;
        self.parameter(
            "bearing.radial_clearance",
            "Radial internal clearance; negative is a preload",
            Q::Parameter(Parameter::RadialClearance),
            Unit::Metre,
            Limited {
                start: bearing.radial_clearance,
                min: -bearing.element_diameter,
                max: bearing.element_diameter,
                nominal: 1e-5,
            },
        );
        self.damping();
        self.push(
            "contact.law",
            "Law of the contacts near defects",
            Kind::Enumeration { type_name: "ContactLaw", items: CONTACT_LAWS, start: scene.contact.law.number() },
            (Causality::Parameter, Variability::Fixed),
            Q::Parameter(Parameter::ContactLaw),
        );
        self.parameter(
            "cage.slip",
            "Lag of the cage behind pure rolling",
            Q::Parameter(Parameter::CageSlip),
            Unit::One,
            Limited { start: scene.cage.slip, min: 0.0, max: 1.0, nominal: 0.01 },
        );
        self.parameter(
            "cage.initial_angle",
            "Angle of element 1 at the start, counter-clockwise from +x",
            Q::Parameter(Parameter::CageInitialAngle),
            Unit::Radian,
            Limited { start: scene.cage.initial_angle, min: -1e3, max: 1e3, nominal: 1.0 },
        );
        self.defect_angles();
        self.turning_parameters();
        for ring in RINGS {
            if self.motion(ring) == Motion::Internal {
                self.ring_parameters(ring);
            }
        }
        self.parameter(
            "solver.tolerance",
            "Relative tolerance of the time integration",
            Q::Parameter(Parameter::Tolerance),
            Unit::One,
            Limited { start: scene.tolerance, min: 1e-12, max: 0.1, nominal: 1e-5 },
        );
        if scene.recorder.is_some() {
            self.push(
                "recorder.folder",
                "Folder for the recording, <instance name>.npy; empty for none",
                Kind::Text { start: String::new() },
                (Causality::Parameter, Variability::Fixed),
                Q::Parameter(Parameter::RecorderFolder),
            );
        }
    }

    /// Where each defect is.
    fn defect_angles(&mut self) {
        for (index, defect) in self.scene.defects.iter().enumerate() {
            let name = match self.scene.defects.len() {
                1 => "defect.angle".to_owned(),
                _ => format!("defect[{}].angle", index + 1),
            };
            self.parameter(
                &name,
                match defect.on {
                    DefectOn::Outer => "Angle of the defect's centre, counter-clockwise from +x",
                    DefectOn::Inner => {
                        "Angle of the defect's centre on the inner ring, counter-clockwise from shaft.initial_angle"
                    }
                    DefectOn::Element { .. } => "Angle of the defect's centre at the start, 0 facing the outer raceway",
                },
                Q::Parameter(Parameter::DefectAngle(index)),
                Unit::Radian,
                Limited { start: defect.angle, min: -1e3, max: 1e3, nominal: 1.0 },
            );
        }
    }

    /// Where rings that bear a defect or turn begin, and how much spin is lost.
    fn turning_parameters(&mut self) {
        let scene = self.scene;
        let mut angle = |name: &str, what: &str, ring, start| {
            let (quantity, unit) = (Q::Parameter(Parameter::RingInitialAngle(ring)), Unit::Radian);
            self.parameter(name, what, quantity, unit, Limited { start, min: -1e3, max: 1e3, nominal: 1.0 });
        };
        if scene.has_defect_of_inner_ring() {
            let what = "Angle of the inner ring at the start, counter-clockwise";
            angle("shaft.initial_angle", what, RingName::Shaft, scene.shaft_initial_angle);
        }
        if scene.housing_speed.is_some() {
            let what = "Angle of the outer ring at the start, counter-clockwise";
            angle("housing.initial_angle", what, RingName::Housing, scene.housing_initial_angle);
        }
        if scene.defects.iter().any(|defect| matches!(defect.on, DefectOn::Element { .. })) {
            self.parameter(
                "element.spin_slip",
                "Lag of the elements' spin behind pure rolling",
                Q::Parameter(Parameter::SpinSlip),
                Unit::One,
                Limited { start: scene.cage.spin_slip, min: -1.0, max: 1.0, nominal: 0.01 },
            );
        }
    }

    fn damping(&mut self) {
        let (damping, unit, what, nominal) = match self.scene.contact.damping {
            Damping::HuntCrossley(chi) => (chi, Unit::SecondPerMetre, "Hunt-Crossley constant chi", 0.5),
            Damping::Proportional(tau) => (tau, Unit::Second, "time constant tau of proportional damping", 1e-6),
        };
        self.parameter(
            "contact.damping",
            &format!("Contact damping: {what}"),
            Q::Parameter(Parameter::ContactDamping),
            unit,
            Limited { start: damping, min: 0.0, max: 1e6, nominal },
        );
    }

    fn ring_parameters(&mut self, ring: RingName) {
        let (name, what, parts) = match ring {
            RingName::Shaft => ("shaft", "inner ring", self.scene.shaft),
            RingName::Housing => ("housing", "outer ring", self.scene.housing),
        };
        self.parameter(
            &format!("{name}.mass"),
            &format!("Mass of the {what} and what moves with it"),
            Q::Parameter(Parameter::RingMass(ring)),
            Unit::Kilogram,
            Limited { start: parts.mass, min: 1e-6, max: 1e9, nominal: 1.0 },
        );
        self.parameter(
            &format!("{name}.damping"),
            &format!("Viscous damping of the {what} to ground"),
            Q::Parameter(Parameter::RingDamping(ring)),
            Unit::NewtonSecondPerMetre,
            Limited { start: parts.damping, min: 0.0, max: 1e12, nominal: 1000.0 },
        );
        self.parameter(
            &format!("{name}.stiffness"),
            &format!("Support stiffness of the {what} to ground"),
            Q::Parameter(Parameter::RingStiffness(ring)),
            Unit::NewtonPerMetre,
            Limited { start: parts.stiffness, min: 0.0, max: 1e15, nominal: 1e7 },
        );
    }
}
