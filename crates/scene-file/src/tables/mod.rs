//! The tables of a scene file, each with the unit in its keys, and what they are in SI units.

mod bearing;
mod cage;
mod defects;
mod diameters;
mod faults;
mod film;
mod one_or_more;
mod profile;
mod rings;
mod short_lists;
mod waviness;

pub(crate) use bearing::BearingTable;
pub(crate) use cage::CageTable;
pub(crate) use defects::DefectTable;
pub(crate) use faults::{Faults, TableFault};
pub(crate) use film::FilmTable;
pub(crate) use rings::{HousingTable, ProbeTable, SensorTable, ShaftTable};

pub(crate) use waviness::WavinessTable;

use brinell::scene::quantity::HOST_MASS;
use brinell::scene::{
    Contact, ContactEdge, ContactLaw, Damping, DegreesOfFreedom, Experiment, Motion, Recorder, RecorderFilter,
    RepeatedInputs, Ring, Scene,
};
use one_or_more::OneOrMore;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use short_lists::{Vector, pair};
use std::f64::consts::TAU;

/// A bearing in its surroundings. Every key carries its unit.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneFile {
    /// Name of the scene and of its FMU: letters, digits, - and _.
    name: String,
    /// One line for the reader.
    #[serde(default)]
    description: String,
    /// Gravity, x and y; a third number is along z.
    #[serde(default = "default_gravity")]
    gravity_m_s2: Vector,
    /// Dimensions and material.
    bearing: BearingTable,
    /// Law and damping of the contacts.
    #[serde(default)]
    contact: ContactTable,
    /// An oil film; without it contacts are dry.
    film: Option<FilmTable>,
    /// Slip, start and irregularity of the cage.
    #[serde(default)]
    cage: CageTable,
    /// A defect; several as `[[defect]]`; none for a healthy bearing.
    #[serde(default)]
    defect: OneOrMore<DefectTable>,
    /// Waves of one order around a body; several as `[[waviness]]`; none for round ones.
    #[serde(default)]
    waviness: OneOrMore<WavinessTable>,
    /// The inner ring.
    shaft: ShaftTable,
    /// The outer ring.
    housing: HousingTable,
    /// An accelerometer on the housing; several as `[[sensor]]`.
    #[serde(default)]
    sensor: OneOrMore<SensorTable>,
    /// A displacement probe between the rings; a table without keys.
    probe: Option<ProbeTable>,
    /// Time integration.
    #[serde(default)]
    solver: SolverTable,
    /// What is known of a host that moves a ring.
    host: Option<HostTable>,
    /// Samples taken inside the step.
    recorder: Option<RecorderTable>,
    /// Default run.
    #[serde(default)]
    experiment: ExperimentTable,
}

impl SceneFile {
    pub(crate) fn into_scene(self) -> Result<Scene, Faults> {
        let mut faults = Faults::default();
        let known = faults.take(self.bearing.freedom());
        let freedom = known.unwrap_or(DegreesOfFreedom::Five);
        let bearing = faults.take(self.bearing.into_bearing(freedom));
        let contact = faults.take(self.contact.into_contact(!self.defect.0.is_empty()));
        let (shaft_speed, shaft_angle) = (self.shaft.speed_hz, self.shaft.initial_angle_deg);
        let (housing_speed, housing_angle) = (self.housing.speed_hz, self.housing.initial_angle_deg);
        let shaft = faults.take(self.shaft.into_ring(freedom));
        let housing = faults.take(self.housing.into_ring(freedom));
        let sensors = faults.take(self.sensor.each("sensor", SensorTable::into_sensor));
        let mass = self.host.as_ref().and_then(|host| host.mass_kg);
        faults.take(mass.map_or(Ok(()), |mass| HOST_MASS.check(mass)).map_err(TableFault::Scene));
        let [shaft, housing] = [shaft, housing].map(|ring| ring.map(|ring| of_host(ring, mass)));
        let repeated_inputs = match self.host.map(|host| host.repeated_inputs) {
            Some(_) if [&shaft, &housing].into_iter().flatten().all(|ring| ring.motion != Motion::Host) => {
                faults.0.push(TableFault::NoHost);
                None
            }
            given => Some(given.unwrap_or_default()),
        };
        let inside = bearing.and_then(|bearing| {
            let defects = faults.take(self.defect.each("defect", |table| table.into_defect(&bearing)));
            let waviness = faults.take(self.waviness.each("waviness", |table| table.into_waves(bearing.element_count)));
            let cage = faults.take(self.cage.into_cage(bearing.element_count));
            Some((bearing, defects?, waviness?, cage?))
        });
        let (
            Some((bearing, defects, waviness, cage)),
            Some(contact),
            Some(shaft),
            Some(housing),
            Some(sensors),
            Some(repeated_inputs),
            Some(_),
        ) = (inside, contact, shaft, housing, sensors, repeated_inputs, known)
        else {
            return Err(faults);
        };
        Ok(Scene {
            name: self.name,
            description: self.description,
            gravity: self.gravity_m_s2.across,
            axial_gravity: self.gravity_m_s2.axial.unwrap_or(0.0),
            bearing,
            contact,
            film: self.film.map(FilmTable::into_film),
            cage,
            defects,
            waviness,
            shaft,
            shaft_speed: shaft_speed * TAU,
            shaft_initial_angle: shaft_angle.to_radians(),
            housing,
            housing_speed: housing_speed.map(|speed| speed * TAU),
            housing_initial_angle: housing_angle.to_radians(),
            sensors,
            probe: self.probe.is_some(),
            tolerance: self.solver.tolerance,
            max_steps: self.solver.max_steps,
            recorder: self.recorder.map(|table| Recorder { rate: table.rate_hz, filter: table.filter }),
            repeated_inputs,
            experiment: Experiment { stop: self.experiment.stop_s, step: self.experiment.step_s },
        })
    }
}

fn default_gravity() -> Vector {
    Vector { across: [0.0, -9.81], axial: None }
}

const DAMPING_CHI_S_M: f64 = 0.5;

/// Law and damping of the contacts.
#[derive(JsonSchema, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactTable {
    /// Law of contacts near defects: "map" with a defect, else "hertz".
    law: Option<ContactLaw>,
    /// Model of damping.
    #[serde(default)]
    damping: DampingModel,
    /// Hunt and Crossley's coefficient.
    #[schemars(extend("default" = DAMPING_CHI_S_M))]
    damping_chi_s_m: Option<f64>,
    /// Damping of a ball's motion across the groove; damping_chi_s_m without it, 0.5 if damping is "proportional".
    across_damping_s_m: Option<f64>,
    /// Force up to which laws "map" and "love" reach; without it four times the static force on the most loaded
    /// element, at least 1000 N and rounded up to 1, 1.25, 1.6, 2, 2.5, 3.15, … kN.
    largest_force_n: Option<f64>,
    /// Cells of laws "map" and "love" along and across the contact at the largest force; [48, 32] without it, of
    /// rollers [48, 16].
    #[serde(default, deserialize_with = "pair")]
    cells: Option<[u32; 2]>,
    /// Error of the map over the largest force that is accepted; without it 1e-3 is tried for, and up to 2e-2 is
    /// tolerated and reported.
    map_accuracy: Option<f64>,
    /// Whether one contact map serves spalls of any length with the same flanks.
    #[serde(default)]
    flank_map: bool,
    /// Time constant of proportional damping; needed there.
    damping_tau_s: Option<f64>,
    /// What laws "map" and "love" take a sharp edge to be: as stiff as the middle of a raceway, "half-space", or as
    /// soft as a "step" of its depth.
    #[serde(default)]
    edge: ContactEdge,
}

/// Model of contact damping.
#[derive(JsonSchema, Serialize, Deserialize, Default, Clone, Copy)]
#[serde(rename_all = "kebab-case")]
enum DampingModel {
    #[default]
    HuntCrossley,
    Proportional,
}

impl ContactTable {
    fn into_contact(self, defect: bool) -> Result<Contact, TableFault> {
        let (chi_key, tau_key) = ("contact.damping_chi_s_m", "contact.damping_tau_s");
        let wrong = |key, value, model, wanted| Err(TableFault::WrongDampingKey { key, value, model, wanted });
        let damping = match (self.damping, self.damping_chi_s_m, self.damping_tau_s) {
            (DampingModel::HuntCrossley, _, Some(tau)) => {
                return wrong(tau_key, tau, "hunt-crossley", chi_key);
            }
            (DampingModel::Proportional, Some(chi), _) => {
                return wrong(chi_key, chi, "proportional", tau_key);
            }
            (DampingModel::HuntCrossley, chi, None) => Damping::HuntCrossley(chi.unwrap_or(DAMPING_CHI_S_M)),
            (DampingModel::Proportional, None, Some(tau)) => Damping::Proportional(tau),
            (DampingModel::Proportional, None, None) => {
                return Err(TableFault::Missing { key: tau_key, why: "contact.damping is \"proportional\"" });
            }
        };
        let default = if defect { ContactLaw::Map } else { ContactLaw::Hertz };
        Ok(Contact {
            law: self.law.unwrap_or(default),
            damping,
            across_damping: self.across_damping_s_m,
            largest_force: self.largest_force_n,
            cells: self.cells,
            map_accuracy: self.map_accuracy,
            flank_map: self.flank_map,
            edge: self.edge,
        })
    }
}

/// Time integration.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct SolverTable {
    /// Relative tolerance.
    tolerance: f64,
    /// Most integration steps in one communication step.
    max_steps: u64,
}

impl Default for SolverTable {
    fn default() -> Self {
        Self { tolerance: 1e-5, max_steps: 10_000_000 }
    }
}

/// What is known of a host that moves a ring.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct HostTable {
    /// Mass that it moves with a ring, for `solver.suggested_step` until its steps have shown it; without it 3.26 kg of
    /// a shaft and 6.64 kg of a housing.
    mass_kg: Option<f64>,
    /// What inputs are when a step is repeated from the same communication point: those of its start, or of its end.
    #[serde(default)]
    repeated_inputs: RepeatedInputs,
}

/// A ring, with the mass that its host moves where it has one.
fn of_host(ring: Ring, mass: Option<f64>) -> Ring {
    match mass {
        Some(mass) if ring.motion == Motion::Host => Ring { mass, ..ring },
        _ => ring,
    }
}

/// Samples taken inside the step.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RecorderTable {
    /// Sampling rate.
    rate_hz: f64,
    /// What is done against aliases.
    #[serde(default)]
    filter: RecorderFilter,
}

/// Default run.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct ExperimentTable {
    /// How long it takes.
    stop_s: f64,
    /// Communication step.
    step_s: f64,
}

impl Default for ExperimentTable {
    fn default() -> Self {
        Self { stop_s: 0.5, step_s: 1e-4 }
    }
}
