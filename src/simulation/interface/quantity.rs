//! What a variable stands for in the model, apart from its name.

use crate::dynamics::parameters::Frame;

/// One of the two rings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RingName {
    /// The inner ring.
    Shaft,
    /// The outer ring.
    Housing,
}

impl RingName {
    /// Position in lists of both rings, the inner one first.
    pub(in crate::simulation) fn index(self) -> usize {
        match self {
            Self::Shaft => 0,
            Self::Housing => 1,
        }
    }

    /// Its name in names of variables, and in words.
    pub(in crate::simulation) fn names(self) -> [&'static str; 2] {
        match self {
            Self::Shaft => ["shaft", "inner ring"],
            Self::Housing => ["housing", "outer ring"],
        }
    }

    /// The frame of its defects.
    pub(in crate::simulation) fn frame(self) -> Frame {
        match self {
            Self::Shaft => Frame::Shaft,
            Self::Housing => Frame::Housing,
        }
    }
}

/// What a variable stands for in the model. `usize` arguments are the coordinate of a ring (0 is x, 1 is y, 2 is z, 3
/// and 4 the tilt about x and y; what acts along a tilt is a moment) or the element (from 0).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Quantity {
    Speed(RingName),
    RingAngle(RingName),
    ShaftTorque,
    Load(RingName, usize),
    Position(RingName, usize),
    Velocity(RingName, usize),
    Acceleration(RingName, usize),
    Force(RingName, usize),
    MeanForce(RingName, usize),
    /// The force to hold over the next step.
    NextMeanForce(RingName, usize),
    Stiffness(usize, usize),
    SensorAcceleration(usize),
    /// Displacement of the inner ring against the outer along an axis.
    Probe(usize),
    CageAngle,
    CageSpeed,
    CageTorque,
    ElementAngle(usize),
    ElementPath(usize),
    /// Axial position of a ball.
    ElementAxial(usize),
    /// Contact angle of an element on the inner (0) or the outer (1) raceway.
    ContactAngle(usize, usize),
    /// Angle that the contact ellipse leaves to the shoulder.
    ShoulderMargin(usize, usize),
    ElementInnerForce(usize),
    ElementOuterForce(usize),
    ElementSpinAngle(usize),
    Count(Count),
    /// Half of the internal clearance that the host sets.
    RadialClearance,
    SuggestedStep,
    /// Error of the coupling to a host.
    CouplingError,
    LargestCouplingError,
    Parameter(Parameter),
}

/// What a host moves or loads the bearing with. `usize` is the coordinate of the ring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::simulation) enum Input {
    Speed(RingName),
    Load(RingName, usize),
    Position(RingName, usize),
    Velocity(RingName, usize),
    Acceleration(RingName, usize),
}

/// What the solver counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Count {
    Steps,
    RejectedSteps,
    ContactSolves,
    MapLookups,
    TruncatedContacts,
    OffTrackContacts,
}

/// What a host may set before the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Parameter {
    InternalClearance,
    ContactAngle,
    OperatingAngle,
    ContactDamping,
    AcrossDamping,
    ContactLaw,
    CageSlip,
    CageInitialAngle,
    RingInitialAngle(RingName),
    SpinSlip,
    DefectAngle(usize),
    RingMass(RingName),
    RingDamping(RingName),
    RingStiffness(RingName),
    AxialDamping(RingName),
    AxialStiffness(RingName),
    Preload(RingName),
    TransverseInertia,
    PolarInertia,
    TiltDamping,
    TiltStiffness,
    Tolerance,
    RecorderFolder,
    RepeatedInputs,
    SpallLength(usize),
    SpallDepth(usize),
    CageSeed,
    FilmViscosity,
    SensorResonance(usize),
    RecorderRate,
    DiameterSeed,
}

impl Quantity {
    /// The quantity as an input, if it can be one.
    pub(in crate::simulation) fn as_input(self) -> Option<Input> {
        match self {
            Self::Speed(ring) => Some(Input::Speed(ring)),
            Self::Load(ring, axis) => Some(Input::Load(ring, axis)),
            Self::Position(ring, axis) => Some(Input::Position(ring, axis)),
            Self::Velocity(ring, axis) => Some(Input::Velocity(ring, axis)),
            Self::Acceleration(ring, axis) => Some(Input::Acceleration(ring, axis)),
            Self::RingAngle(_)
            | Self::ShaftTorque
            | Self::Force(..)
            | Self::MeanForce(..)
            | Self::NextMeanForce(..)
            | Self::SuggestedStep
            | Self::CouplingError
            | Self::LargestCouplingError
            | Self::Stiffness(..)
            | Self::SensorAcceleration(_)
            | Self::Probe(_)
            | Self::CageAngle
            | Self::CageSpeed
            | Self::CageTorque
            | Self::ElementAngle(_)
            | Self::ElementPath(_)
            | Self::ElementAxial(_)
            | Self::ContactAngle(..)
            | Self::ShoulderMargin(..)
            | Self::ElementInnerForce(_)
            | Self::ElementOuterForce(_)
            | Self::ElementSpinAngle(_)
            | Self::Count(_)
            | Self::RadialClearance
            | Self::Parameter(_) => None,
        }
    }
}

impl Input {
    /// Highest order of the derivatives by time that act, and how the input's description says so.
    ///
    /// What would make a higher polynomial than [`Excitation`](crate::dynamics::parameters::Excitation) has is refused:
    /// the cage's angle is a quadratic, so that the instants at which elements pass knots are roots of one.
    pub(in crate::simulation) fn derivatives(self) -> (i32, &'static str) {
        match self {
            Self::Position(..) => (2, "derivatives of orders 1 and 2 act, in place of velocity and acceleration"),
            Self::Velocity(..) => (2, "derivatives of orders 1 and 2 act, in place of acceleration and its derivative"),
            Self::Load(..) => (2, "derivatives of orders 1 and 2 act"),
            Self::Speed(_) | Self::Acceleration(..) => (1, "derivative of order 1 acts"),
        }
    }
}
