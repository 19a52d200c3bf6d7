//! The parameters in the variable table: what a host may set before the start, with limits.

use super::builder::{Builder, CONTACT_LAWS, Limited, RINGS};
use super::variables::{Causality, Kind, Unit, Variability};
use crate::scene::quantity;
use crate::scene::{Damping, DefectOn, DegreesOfFreedom, Motion, WavyBody};
use crate::simulation::interface::quantity::{Parameter, Quantity as Q, RingName};

impl Builder<'_> {
    pub(super) fn parameters(&mut self) {
        let scene = self.scene;
        self.clearance_and_angles();
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
            Limited::of(&quantity::CAGE_SLIP, scene.cage.slip, 0.01),
        );
        self.parameter(
            "cage.initial_angle",
            "Angle of element 1 at the start, counter-clockwise from +x",
            Q::Parameter(Parameter::CageInitialAngle),
            Unit::Radian,
            Limited::of(&quantity::INITIAL_ANGLE, scene.cage.initial_angle, 1.0),
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
            Limited::of(&quantity::TOLERANCE, scene.tolerance, 1e-5),
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

    /// Clearance or free contact angle, and in space what goes with it.
    fn clearance_and_angles(&mut self) {
        let bearing = &self.scene.bearing;
        match bearing.contact_angle {
            None => self.push(
                "bearing.radial_clearance",
                "Half of bearing.internal_clearance: what separates a raceway from an element on the other",
                Kind::Real { unit: Unit::Metre, start: None, min: None, max: None, nominal: 1e-5 },
                (Causality::Local, Variability::Fixed),
                Q::RadialClearance,
            ),
            Some(start) => self.parameter(
                "bearing.contact_angle",
                "Free contact angle, positive where the bearing takes pushes of the inner ring towards +z",
                Q::Parameter(Parameter::ContactAngle),
                Unit::Radian,
                Limited::of(&quantity::CONTACT_ANGLE, start, 0.1),
            ),
        }
        if self.in_space() {
            self.angle_and_across_damping();
        }
    }

    /// The operating angle, and the damping across the groove.
    fn angle_and_across_damping(&mut self) {
        let (bearing, contact) = (&self.scene.bearing, &self.scene.contact);
        self.parameter(
            "bearing.operating_angle",
            "Contact angle for which the cage's speed, the elements' spin and the tracks are worked out",
            Q::Parameter(Parameter::OperatingAngle),
            Unit::Radian,
            Limited {
                min: 0.0,
                ..Limited::of(&quantity::OPERATING_ANGLE, bearing.given_operating_angle().unwrap_or(0.0), 0.1)
            },
        );
        self.parameter(
            "contact.across_damping",
            "Damping of balls across the grooves, Hunt-Crossley constant",
            Q::Parameter(Parameter::AcrossDamping),
            Unit::SecondPerMetre,
            Limited::of(&quantity::ACROSS_DAMPING, contact.damping_across(), 0.5),
        );
    }

    /// Name of what belongs to a defect, counted from 0.
    pub(super) fn of_defect(&self, index: usize, part: &str) -> String {
        if self.scene.defects.len() > 1 { format!("defect[{}].{part}", index + 1) } else { format!("defect.{part}") }
    }

    /// Where each defect is.
    fn defect_angles(&mut self) {
        for (index, defect) in self.scene.defects.iter().enumerate() {
            self.parameter(
                &self.of_defect(index, "angle"),
                match defect.on {
                    DefectOn::Outer => "Angle of the defect's centre, counter-clockwise from +x",
                    DefectOn::Inner => {
                        "Angle of the defect's centre on the inner ring, counter-clockwise from shaft.initial_angle"
                    }
                    DefectOn::Element { .. } => "Angle of the defect's centre at the start, 0 facing the outer raceway",
                },
                Q::Parameter(Parameter::DefectAngle(index)),
                Unit::Radian,
                Limited::of(&quantity::DEFECT_ANGLE, defect.angle, 1.0),
            );
        }
    }

    /// Where rings that have a defect or turn begin, and how much spin is lost.
    fn turning_parameters(&mut self) {
        let scene = self.scene;
        let mut angle = |name: &str, what: &str, ring, limited| {
            self.parameter(name, what, Q::Parameter(Parameter::RingInitialAngle(ring)), Unit::Radian, limited);
        };
        if scene.marks_inner_ring() {
            let what = "Angle of the inner ring at the start, counter-clockwise";
            let limited = Limited::of(&quantity::SHAFT_INITIAL_ANGLE, scene.shaft_initial_angle, 1.0);
            angle("shaft.initial_angle", what, RingName::Shaft, limited);
        }
        if scene.housing_speed.is_some() {
            let what = "Angle of the outer ring at the start, counter-clockwise";
            let limited = Limited::of(&quantity::HOUSING_INITIAL_ANGLE, scene.housing_initial_angle, 1.0);
            angle("housing.initial_angle", what, RingName::Housing, limited);
        }
        let spins = scene.defects.iter().any(|defect| matches!(defect.on, DefectOn::Element { .. }))
            || scene.waviness.iter().any(|waves| matches!(waves.on, WavyBody::Element(_)));
        if spins {
            self.parameter(
                "element.spin_slip",
                "Lag of the elements' spin behind pure rolling",
                Q::Parameter(Parameter::SpinSlip),
                Unit::One,
                Limited::of(&quantity::SPIN_SLIP, scene.cage.spin_slip, 0.01),
            );
        }
    }

    fn damping(&mut self) {
        let (limited, unit, what) = match self.scene.contact.damping {
            Damping::HuntCrossley(chi) => {
                (Limited::of(&quantity::DAMPING_CHI, chi, 0.5), Unit::SecondPerMetre, "Hunt-Crossley constant chi")
            }
            Damping::Proportional(tau) => (
                Limited::of(&quantity::DAMPING_TAU, tau, 1e-6),
                Unit::Second,
                "time constant tau of proportional damping",
            ),
        };
        self.parameter(
            "contact.damping",
            &format!("Contact damping: {what}"),
            Q::Parameter(Parameter::ContactDamping),
            unit,
            limited,
        );
    }

    fn ring_parameters(&mut self, ring: RingName) {
        let ([name, what], parts) = (ring.names(), self.ring(ring));
        let axial = parts.axial;
        let limits = match ring {
            RingName::Shaft => &quantity::SHAFT,
            RingName::Housing => &quantity::HOUSING,
        };
        let all = [
            (
                "mass",
                ["Mass of the ", what, " and what moves with it"],
                Parameter::RingMass(ring),
                Unit::Kilogram,
                Limited::of(&limits.mass, parts.mass, 1.0),
            ),
            (
                "damping",
                ["Viscous damping of the ", what, " to ground"],
                Parameter::RingDamping(ring),
                Unit::NewtonSecondPerMetre,
                Limited::of(&limits.damping, parts.damping, 1000.0),
            ),
            (
                "stiffness",
                ["Support stiffness of the ", what, " to ground"],
                Parameter::RingStiffness(ring),
                Unit::NewtonPerMetre,
                Limited::of(&limits.stiffness, parts.stiffness, 1e7),
            ),
            (
                "axial_damping",
                ["Viscous damping along z of the ", what, ""],
                Parameter::AxialDamping(ring),
                Unit::NewtonSecondPerMetre,
                Limited::of(&limits.axial_damping, axial.damping, 1000.0),
            ),
            (
                "axial_stiffness",
                ["Support stiffness along z of the ", what, ""],
                Parameter::AxialStiffness(ring),
                Unit::NewtonPerMetre,
                Limited::of(&limits.axial_stiffness, axial.stiffness, 1e7),
            ),
            (
                "preload",
                ["Force of a preload spring, in the sense of the contact angle of the ", what, ""],
                Parameter::Preload(ring),
                Unit::Newton,
                Limited::of(&limits.preload, axial.preload, 100.0),
            ),
        ];
        for (key, text, parameter, unit, limited) in all.into_iter().take(if self.in_space() { 6 } else { 3 }) {
            self.parameter(&[name, ".", key].concat(), &text.concat(), Q::Parameter(parameter), unit, limited);
        }
        if ring == RingName::Shaft && self.scene.bearing.degrees_of_freedom == DegreesOfFreedom::Five {
            self.tilt_parameters();
        }
    }

    /// What tilts and holds the inner ring.
    fn tilt_parameters(&mut self) {
        let of = self.scene.shaft.tilt;
        for (key, text, parameter, unit, limited) in [
            (
                "transverse_inertia",
                "Moment of inertia about x or y",
                Parameter::TransverseInertia,
                Unit::KilogramSquareMetre,
                Limited::of(&quantity::TRANSVERSE_INERTIA, of.transverse_inertia, 1e-3),
            ),
            (
                "polar_inertia",
                "Moment of inertia about z",
                Parameter::PolarInertia,
                Unit::KilogramSquareMetre,
                Limited::of(&quantity::POLAR_INERTIA, of.polar_inertia, 1e-3),
            ),
            (
                "tilt_damping",
                "Viscous damping of the tilt",
                Parameter::TiltDamping,
                Unit::NewtonMetreSecondPerRadian,
                Limited::of(&quantity::TILT_DAMPING, of.damping, 1.0),
            ),
            (
                "tilt_stiffness",
                "Support stiffness of the tilt",
                Parameter::TiltStiffness,
                Unit::NewtonMetrePerRadian,
                Limited::of(&quantity::TILT_STIFFNESS, of.stiffness, 1e4),
            ),
        ] {
            let text = [text, " of the inner ring and what moves with it"].concat();
            self.parameter(&["shaft.", key].concat(), &text, Q::Parameter(parameter), unit, limited);
        }
    }
}
