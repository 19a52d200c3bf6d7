//! Which continuous states and inputs the derivative of a continuous state depends on, and which inputs and parameters
//! both depend on at the start.
//!
//! An element's motion follows its own states, both rings and the cage, and no other element; a ring follows all
//! elements, a sensor its housing alone.

use super::part::{Derivative, Part};
use super::states::Place;
use super::variables::ExchangeRole;
use crate::scene::{Motion, Scene};
use crate::simulation::Simulation;
use crate::simulation::interface::table::{Causality, Dependencies};
use crate::simulation::interface::{Input, Parameter, Quantity as Q, RingName, starts_from, turns};

use Derivative::{Position, Rate};

const RINGS: [RingName; 2] = [RingName::Shaft, RingName::Housing];

/// What a derivative may depend on, a ring's motion as a state or an input all the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Known {
    Part(Part),
    Speed(RingName),
    Load(usize, usize),
    Cage,
    Frame,
    Mode(usize),
}

impl Known {
    fn of_input(input: Input) -> Option<Self> {
        match input {
            Input::Speed(ring) => Some(Self::Speed(ring)),
            Input::Load(ring, axis) => Some(Self::Load(ring.index(), axis)),
            Input::Position(ring, axis) => Some(Self::Part(Part::Ring(ring.index(), axis, Position))),
            Input::Velocity(ring, axis) => Some(Self::Part(Part::Ring(ring.index(), axis, Rate))),
            Input::Acceleration(..) => None,
        }
    }
}

impl Simulation {
    /// What continuous states and their derivatives depend on, in the order of their references.
    pub fn exchange_dependencies(&self) -> Vec<Dependencies> {
        let places: Vec<Place> = self.places().collect();
        let (scene, first) = (&self.setup.scene, self.interface.table.len() as u32 + 1);
        let rows = || self.interface.table.iter().zip(&*self.interface.quantities);
        let inputs = rows().filter(|(row, _)| row.causality == Causality::Input);
        let inputs = inputs.filter_map(|(row, of)| Some((row.reference, Known::of_input(of.as_input()?)?)));
        let states = (first..).zip(&places).filter_map(|(reference, &place)| Some((reference, self.known(place)?)));
        let knowns: Vec<(u32, Known)> = inputs.chain(states).collect();
        let initial = |depends: &dyn Fn(Q) -> bool| {
            let known = |row: Causality| matches!(row, Causality::Input | Causality::Parameter);
            let listed = rows().filter(|(row, of)| known(row.causality) && depends(**of));
            listed.map(|(row, _)| row.reference).collect::<Vec<_>>()
        };
        let of = |role: ExchangeRole, output: u32| match role {
            ExchangeRole::State(number) => {
                let initial =
                    initial(&|known| state_starts_from(self.known(places[number]), places[number], known, scene));
                Dependencies { output, direct: Vec::new(), initial }
            }
            ExchangeRole::Derivative(number) => {
                let place = places[number];
                let direct = knowns.iter().filter(|(_, known)| self.follows(place, *known));
                let direct = direct.map(|(reference, _)| *reference).collect();
                Dependencies {
                    output,
                    direct,
                    initial: initial(&|known| rate_starts_from(self.known(place), place, known, scene)),
                }
            }
            ExchangeRole::Indicator(_) => Dependencies { output, direct: Vec::new(), initial: Vec::new() },
        };
        let count = places.len();
        let roles = (0..count).map(ExchangeRole::State).chain((0..count).map(ExchangeRole::Derivative));
        roles.zip(first..).map(|(role, reference)| of(role, reference)).collect()
    }

    /// A state as what others depend on.
    fn known(&self, place: Place) -> Option<Known> {
        match place {
            Place::Slot(i) => Part::of(&self.run.model.layout, i).map(Known::Part),
            Place::Mode(i) => Some(Known::Mode(i)),
            Place::Cage => Some(Known::Cage),
            Place::Frame(_) => Some(Known::Frame),
        }
    }

    /// Whether the derivative of a state depends on this.
    fn follows(&self, place: Place, known: Known) -> bool {
        let scene = &self.setup.scene;
        let marked = !scene.defects.is_empty() || !scene.waviness.is_empty();
        let of_ring = |known: Known| matches!(known, Known::Part(Part::Ring(..)) | Known::Speed(_) | Known::Cage);
        let of_housing = |known: Known| matches!(known, Known::Part(Part::Ring(1, ..)));
        // What every contact sees.
        let seen = of_ring(known) || (known == Known::Frame && marked);
        let part = match place {
            Place::Cage => return matches!(known, Known::Speed(_)),
            Place::Frame(i) => {
                return RINGS.iter().enumerate().any(|(k, &ring)| known == Known::Speed(ring) && (i == k || i == 2));
            }
            Place::Mode(i) => {
                let own = matches!(known, Known::Mode(of) if of / 2 == i / 2);
                return own || of_housing(known) || matches!(known, Known::Part(Part::Sensor(..)));
            }
            Place::Slot(i) => Part::of(&self.run.model.layout, i),
        };
        match part {
            Some(Part::Ring(ring, axis, Position)) => known == Known::Part(Part::Ring(ring, axis, Rate)),
            Some(Part::Ring(ring, axis, Rate)) => {
                let elements = matches!(known, Known::Part(Part::Radial(..) | Part::Axial(..)));
                let sensors = ring == 1 && matches!(known, Known::Part(Part::Sensor(..)));
                seen || elements || sensors || known == Known::Load(ring, axis)
            }
            Some(Part::Radial(j, Position)) => match known {
                Known::Part(Part::Ring(1, axis, Rate)) => axis < 2,
                _ => known == Known::Cage || known == Known::Part(Part::Radial(j, Rate)),
            },
            Some(Part::Axial(j, Position)) => {
                [Part::Axial(j, Rate), Part::Ring(1, 2, Rate)].map(Known::Part).contains(&known)
            }
            Some(Part::Radial(j, Rate) | Part::Axial(j, Rate)) => {
                let own = |of| matches!(of, Known::Part(Part::Radial(k, _) | Part::Axial(k, _)) if k == j);
                seen || own(known)
            }
            Some(Part::Sensor(k, Position)) => known == Known::Part(Part::Sensor(k, Rate)),
            Some(Part::Sensor(k, Rate)) => {
                of_housing(known) || matches!(known, Known::Part(Part::Sensor(of, _)) if of == k)
            }
            None => false,
        }
    }
}

/// Whether a state depends on an input or a parameter at the start.
fn state_starts_from(known: Option<Known>, place: Place, of: Q, scene: &Scene) -> bool {
    let Some(Known::Part(part)) = known else {
        return match place {
            Place::Cage => of == Q::Parameter(Parameter::CageInitialAngle),
            Place::Frame(i) if i < 2 => of == Q::Parameter(Parameter::RingInitialAngle(RINGS[i])),
            _ => false,
        };
    };
    match part {
        Part::Ring(ring, axis, Position) => starts_from(Q::Position(RINGS[ring], axis), of, scene),
        Part::Radial(j, Position) => starts_from(Q::ElementPath(j), of, scene),
        Part::Axial(j, Position) => starts_from(Q::ElementAxial(j), of, scene),
        // At rest on the housing.
        Part::Sensor(_, Position) if scene.housing.motion == Motion::Internal => {
            starts_from(Q::Position(RingName::Housing, 0), of, scene)
        }
        Part::Sensor(k, of_sensor) => {
            let along = scene.sensors[k].unit_in_space();
            (0..3).any(|axis| along[axis] != 0.0 && is_motion(of, axis, of_sensor))
        }
        // The outer ring of a host takes all elements along.
        Part::Radial(j, Rate) => {
            let moves = (0..2).any(|axis| is_motion(of, axis, Rate));
            moves || (scene.housing.motion == Motion::Host && starts_from(Q::ElementAngle(j), of, scene))
        }
        Part::Axial(_, Rate) => is_motion(of, 2, Rate),
        Part::Ring(.., Rate) => false,
    }
}

/// Whether a known is that of the outer ring's motion along an axis.
fn is_motion(known: Q, axis: usize, of: Derivative) -> bool {
    known
        == match of {
            Position => Q::Position(RingName::Housing, axis),
            Rate => Q::Velocity(RingName::Housing, axis),
        }
}

/// Whether the derivative of a state depends on an input or a parameter at the start: rings and elements are at rest
/// whatever it is, but for what an outer ring that the host moves adds to the turning of elements.
fn rate_starts_from(part: Option<Known>, place: Place, known: Q, scene: &Scene) -> bool {
    match place {
        Place::Cage => turns(known, scene),
        Place::Frame(2) => turns(known, scene) || known == Q::Parameter(Parameter::SpinSlip),
        Place::Frame(i) => known == Q::Speed(RINGS[i]),
        Place::Slot(_) | Place::Mode(_) => {
            let around = matches!(part, Some(Known::Part(Part::Radial(_, Rate))));
            let moves = (0..2).any(|axis| is_motion(known, axis, Rate));
            let moved = scene.housing.motion == Motion::Host;
            around && moved && (moves || turns(known, scene) || starts_from(Q::ElementAngle(0), known, scene))
        }
    }
}
