//! What a host that moves a ring finds beside the forces: what to hold, how long to step, and how it repeats a step.
//!
//! These rows stand after all others, so that older ones keep their references.

use super::builder::{Builder, REPEATED_INPUTS, RINGS};
use super::variables::{Causality, Kind, Unit, Variability};
use crate::scene::Motion;
use crate::simulation::interface::quantity::{Parameter, Quantity as Q, RingName};

impl Builder<'_> {
    pub(super) fn coupling(&mut self) {
        let hosted: Vec<RingName> = RINGS.into_iter().filter(|&ring| self.motion(ring) == Motion::Host).collect();
        for &ring in &hosted {
            let text = [
                " of the bearing's contacts to hold on",
                " over a next communication step of the same length; for a host that steps all units in parallel and \
                 holds inputs",
            ];
            self.forces(ring, "next_mean_", text, Q::NextMeanForce);
        }
        if hosted.is_empty() {
            return;
        }
        let kind = Kind::Real { unit: Unit::Second, start: None, min: None, max: None, nominal: 1e-5 };
        let text = "Communication step for errors of about 1 %, if a hosted ring has the mass that is usual; a \
                    hundredth where the host reads force but no mean force, stiffness or derivative";
        self.push("solver.suggested_step", text, kind, (Causality::Local, Variability::Continuous), Q::SuggestedStep);
        self.push(
            "host.repeated_inputs",
            "What inputs are when a step is repeated from the same communication point",
            Kind::Enumeration {
                type_name: "RepeatedInputs",
                items: REPEATED_INPUTS,
                start: self.scene.repeated_inputs.number(),
            },
            (Causality::Parameter, Variability::Fixed),
            Q::Parameter(Parameter::RepeatedInputs),
        );
    }

    /// What the coupling loses: last of all.
    pub(super) fn coupling_error(&mut self) {
        if RINGS.into_iter().all(|ring| self.motion(ring) != Motion::Host) {
            return;
        }
        self.output(
            "host.coupling_error",
            "Error that the coupling has made in the position of hosted rings, by what the host gave until the last \
             step began: rms over rms of their way from the start, over about the last 20 ms",
            Q::CouplingError,
            Unit::One,
            0.01,
        );
        self.output(
            "host.largest_coupling_error",
            "Largest host.coupling_error so far",
            Q::LargestCouplingError,
            Unit::One,
            0.01,
        );
    }
}
