//! The tables of a scene file, each with the unit in its keys, and what they are in SI units.
//!
//! Keys that may be left out, with what then holds. The values of the support are those of published models of a
//! bearing test rig with five degrees of freedom (attributed to Sawalhi and Randall 2008); the shaft's stiffness is 0,
//! because a shaft that is held to the ground as stiffly as a bearing is stiff would carry the load itself.
//!
//! | key | default |
//! |---|---|
//! | `description` | empty |
//! | `gravity_m_s2` | `[0, -9.81]`; a third number is along z |
//! | `bearing.element` | `"ball"`; or `"cylindrical-roller"`, which needs `roller_length_mm` and has no groove |
//! | `bearing.roller_profile`, `.roller_laminae` | `"log"`, the crown of ISO/TS 16281, or `"straight"`, or a file; 40 |
//! | `bearing.element_diameter_offsets_um`, or `.element_diameter_rms_um`, `.element_diameter_seed` | equal elements |
//! | `bearing.catalogue` | none: dimensions and material are needed; or a name, such as `"6205"` or `"NU205"` |
//! | `bearing.radial_clearance_um` | 5: what separates a raceway from an element pressed to the other, R_o − R_i − 2r |
//! | `bearing.internal_clearance_um` | instead: a catalogue's radial internal clearance (ISO 5753), twice as much |
//! | `bearing.degrees_of_freedom` | 2; or 3, rings move along z as well; or 5, and they tilt. Balls only |
//! | `bearing.contact_angle_deg`, `.axial_clearance_um` | instead of a clearance: free contact angle; axial play |
//! | `bearing.operating_angle_deg` | the free contact angle where given, else that of the start's equilibrium |
//! | `bearing.shoulder_inner_mm`, `.shoulder_outer_mm` | none: nothing is said of shoulders |
//! | `bearing.gyroscopic` | `"none"`; or `"outer"`, `"shared"`, of balls without inertia |
//! | `bearing.outer_compliance_m_n` | 0: rings and seats are rigid |
//! | `bearing.element_inertia` | `"full"`; or `"none"`: elements in radial balance at every instant |
//! | `bearing.density_kg_m3` | from `element_mass_g`, which is then needed |
//! | `bearing.element_mass_g`, `hertz_inner_n_m1_5`, `hertz_outer_n_m1_5` | computed |
//! | `contact.law` | `"map"` with a defect, else `"hertz"` |
//! | `contact.largest_force_n` | four times the static force on the most loaded element, rounded up |
//! | `contact.cells` | `[48, 32]`, rollers `[48, 16]`: along and across the contact at the largest force |
//! | `contact.map_accuracy` | 1e-3 of the largest force; without the key up to 2e-2 is tolerated and reported |
//! | `contact.flank_map` | `false`; `true`: one map for spalls of any length with the same flanks |
//! | `contact.damping` | `"hunt-crossley"`; its `damping_chi_s_m` 0.5 |
//! | `contact.across_damping_s_m` | `damping_chi_s_m`; 0.5 with `"proportional"` |
//! | `cage.slip`, `cage.initial_angle_deg` | 0, −90 |
//! | `cage.spacing_deg`, or `.spacing_rms_deg`; `.jitter_rms_deg`, `.wander` | 0: an even cage that turns evenly |
//! | `cage.irregularity` | none; `"recorded"` instead of the above: 0.6 % and 0.4 % of the spacing, wander 0.3 % |
//! | `cage.seed` | needed where something is random |
//! | `defect` | none; its `on` `"outer"`, `edge_slope_deg` 90; on an element `tilt_deg` 0; several as `[[defect]]` |
//! | `waviness` | none; its `on` `"outer"`; several as `[[waviness]]` |
//! | `shaft.mass_kg`, `.damping_n_s_m`, `.stiffness_n_m` (internal only) | 3.2638, 1376.8, 0 |
//! | `housing.mass_kg`, `.damping_n_s_m`, `.stiffness_n_m` (internal only) | 6.638, 2210.7, 1.51056e7 |
//! | `shaft.load_n`, `housing.load_n` (internal only) | `[0, 0]`; a third number is along z |
//! | `.preload_n`; `.axial_damping_n_s_m`, `.axial_stiffness_n_m` of both | 0; as `damping_n_s_m`, `stiffness_n_m` |
//! | `shaft.load_moment_n_m`, `.tilt_damping_n_m_s`, `.tilt_stiffness_n_m_rad` | `[0, 0]`, 0.5 (assumed), 0 |
//! | `shaft.transverse_inertia_kg_m2`, `.polar_inertia_kg_m2` | 5e-3, 3e-3 (assumed) |
//! | `shaft.initial_angle_deg`, `housing.initial_angle_deg` | 0 |
//! | `housing.speed_hz` | none: the outer ring does not turn |
//! | `sensor` | none; its `direction_deg` 90, or `direction` `[x, y, z]`, `name` empty; several as `[[sensor]]` |
//! | `sensor.mass_kg`, `.stiffness_n_m`, `.damping_n_s_m` | 1, 8.8826e9, 9424.8 |
//! | `sensor.mode` | none; several as `[[sensor.mode]]` below their sensor; its `quadrature_gain` 0, the rest needed |
//! | `sensor.response` | none; a file instead of the modes |
//! | `probe` | none; a table without keys |
//! | `solver.tolerance`, `.max_steps` | 1e-5, 10 000 000 |
//! | `contact.edge` | `"half-space"`: a sharp edge is as stiff as the middle of a raceway; or `"step"` |
//! | `film` | none: dry contacts; its `layer_um` fills every gap |
//! | `host.repeated_inputs` (with a ring of the host only) | `"start"`; or `"end"`: a repeated step is given its end |
//! | `recorder` | none; its `filter` `"linear-phase"`, or `"none"` |
//! | `experiment.stop_s`, `.step_s` | 0.5, 1e-4 |
//!
//! A bearing of the catalogue has its elements, its pitch diameter, conformity 0.52 and steel; keys beside its name
//! win. The largest force is at least 1000 N and rounded up to 1, 1.25, 1.6, 2, 2.5, 3.15, … kN; laws `map` and `love`
//! need it and the cells.

mod bearing;
mod cage;
mod defects;
mod diameters;
mod faults;
mod film;
mod one_or_more;
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

use brinell::scene::{
    Contact, ContactEdge, ContactLaw, Damping, DegreesOfFreedom, Experiment, Motion, Recorder, RecorderFilter,
    RepeatedInputs, Scene,
};
use one_or_more::OneOrMore;
use schemars::JsonSchema;
use serde::Deserialize;
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
    /// How a host that moves a ring repeats steps.
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

/// Law and damping of the contacts.
#[derive(JsonSchema, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactTable {
    /// Law of contacts near defects: "map" with a defect, else "hertz".
    law: Option<ContactLaw>,
    /// Model of damping.
    #[serde(default)]
    damping: DampingModel,
    /// Hunt and Crossley's coefficient; 0.5 without it.
    damping_chi_s_m: Option<f64>,
    /// Damping of a ball's motion across the groove; damping_chi_s_m without it.
    across_damping_s_m: Option<f64>,
    /// Force up to which the contact map reaches.
    largest_force_n: Option<f64>,
    /// Cells along and across the contact at the largest force.
    #[serde(default, deserialize_with = "pair")]
    cells: Option<[u32; 2]>,
    /// Error of the map over the largest force that is accepted.
    map_accuracy: Option<f64>,
    /// Whether one contact map serves spalls of any length with the same flanks.
    #[serde(default)]
    flank_map: bool,
    /// Time constant of proportional damping.
    damping_tau_s: Option<f64>,
    /// What laws "map" and "love" take a sharp edge to be.
    #[serde(default)]
    edge: ContactEdge,
}

/// Model of contact damping.
#[derive(JsonSchema, Deserialize, Default, Clone, Copy)]
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
            (DampingModel::HuntCrossley, chi, None) => Damping::HuntCrossley(chi.unwrap_or(0.5)),
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

/// How a host that moves a ring repeats steps.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct HostTable {
    /// What inputs are when a step is repeated from the same communication point.
    repeated_inputs: RepeatedInputs,
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
