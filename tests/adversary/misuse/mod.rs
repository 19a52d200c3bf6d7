//! Misuse of the C interface: random walks over all 34 functions and all states, several instances at once, from
//! several threads.
//!
//! Arguments are good, or wrong in every way that the standard lets a callee notice: state, count, null, misaligned and
//! overlapping arrays, references and types, values, times, handles that are freed, invented or another's, bytes that
//! are cut, flipped or another model's, folders that are shared, full or none. After each call:
//!
//! - the status is one that a model of the standard allows, which knows nothing of Brinell's code;
//! - an error has one line in the log that begins with the function, what is switched off is silent;
//! - no number that is not finite is given under OK;
//! - a twin that takes only the calls which succeeded gives equal bits, in variables, states and recordings;
//! - so does a new instance that takes only the calls which were not taken back, in variables;
//! - after an error reading, restoring, resetting and freeing go on, and a reset gives a usable instance.
//!
//! A walk is a function of its seed, or of a fuzzer's bytes (`tests/fuzz`).

mod chance;
mod disk;
mod life;
mod stage;
mod standard;
mod states;
mod steps;
mod tally;
mod values;
mod walker;
#[cfg(test)]
mod walks;

pub(crate) use chance::Chance;
use stage::{Folders, FullDisk, Stage, stages};
use walker::{SHARERS, State, Strangers, Walker};

/// A call: who makes it, with what luck, whether with good arguments, and what others have.
type Call = fn(&mut Walker, &mut Chance, bool, &Strangers);

/// Each function of the standard, the states in which it may be called, and a call of it. The letters are those of
/// [`State`], written down from the standard's table (FMI 2.0.x, section 4.2.4, co-simulation) and from nothing of
/// Brinell; S is *start and end*: no instance.
///
/// States that cannot occur here have no letter: *step in progress* and *step canceled* need a step in the background,
/// *step failed* a step that is discarded, *fatal* condemns other instances.
const TABLE: [(&str, &str, Call); 34] = [
    ("fmi2GetTypesPlatform", "SIZCTE", life::platform),
    ("fmi2GetVersion", "SIZCTE", life::version),
    ("fmi2SetDebugLogging", "IZCTE", life::debug_logging),
    ("fmi2Instantiate", "S", life::instantiate),
    ("fmi2FreeInstance", "IZCTE", life::free),
    ("fmi2SetupExperiment", "I", life::setup),
    ("fmi2EnterInitializationMode", "I", life::enter),
    ("fmi2ExitInitializationMode", "Z", life::exit),
    ("fmi2Terminate", "C", life::terminate),
    ("fmi2Reset", "IZCTE", life::reset),
    ("fmi2GetReal", "ZCTE", values::get_real),
    ("fmi2GetInteger", "ZCTE", values::get_integer),
    ("fmi2GetBoolean", "ZCTE", values::get_boolean),
    ("fmi2GetString", "ZCTE", values::get_string),
    ("fmi2SetReal", "IZC", values::set_real),
    ("fmi2SetInteger", "IZC", values::set_integer),
    ("fmi2SetBoolean", "IZC", values::set_boolean),
    ("fmi2SetString", "IZC", values::set_string),
    ("fmi2GetFMUstate", "IZCTE", states::get_state),
    ("fmi2SetFMUstate", "IZCTE", states::set_state),
    ("fmi2FreeFMUstate", "IZCTE", states::free_state),
    ("fmi2SerializedFMUstateSize", "IZCTE", states::state_size),
    ("fmi2SerializeFMUstate", "IZCTE", states::serialize),
    ("fmi2DeSerializeFMUstate", "IZCTE", states::deserialize),
    ("fmi2GetDirectionalDerivative", "ZCTE", steps::directional),
    ("fmi2SetRealInputDerivatives", "IZC", steps::input_derivatives),
    ("fmi2GetRealOutputDerivatives", "CTE", steps::output_derivatives),
    ("fmi2DoStep", "C", steps::do_step),
    ("fmi2CancelStep", "", life::cancel),
    ("fmi2GetStatus", "CT", steps::status),
    ("fmi2GetRealStatus", "CT", steps::real_status),
    ("fmi2GetIntegerStatus", "CT", steps::integer_status),
    ("fmi2GetBooleanStatus", "CT", steps::boolean_status),
    ("fmi2GetStringStatus", "CT", steps::string_status),
];

/// What a host that knows the standard would do next.
fn sensible(w: &Walker, chance: &mut Chance, patience: usize) -> Call {
    let calls: &[Call] = match w.model.state {
        State::Instantiated if w.model.clock.is_none() => {
            &[life::setup, life::setup, values::set_real, values::set_string]
        }
        State::Instantiated => &[life::enter, life::enter, values::set_real, values::set_string],
        State::Initialization => &[life::exit, life::exit, values::set_real, values::get_real, values::set_string],
        State::StepComplete if chance.one_in(patience.max(8)) => &[life::terminate, states::set_state],
        State::StepComplete if !chance.one_in(3) => &[steps::do_step],
        State::StepComplete => &[values::set_real, values::get_real, steps::input_derivatives, states::get_state],
        State::Terminated => {
            &[life::reset, states::set_state, values::get_real, steps::real_status, steps::output_derivatives]
        }
        State::Error => &[life::reset, states::set_state],
    };
    *chance.pick(calls)
}

/// How seldom in a round a call is none that a host would make: often, or so seldom that runs become long.
const PATIENCE: [usize; 2] = [3, 60];

/// One call of one instance, which is any of all once in `patience` calls. One that it has freed is replaced, and goes
/// on with the other's counts.
fn call(w: &mut Walker, chance: &mut Chance, patience: usize, others: &Strangers) {
    if chance.one_in(patience) {
        let (.., call) = TABLE[chance.below(TABLE.len())];
        call(w, chance, false, others);
    } else {
        let (call, kind) = (sensible(w, chance, patience), !chance.one_in(3 * patience));
        call(w, chance, kind, others);
    }
    if w.gone {
        let next = Walker::new(w.stage, w.folders, w.number + 1000, w.seed, chance);
        let before = std::mem::replace(w, next).tally;
        w.tally.add(&before);
    } else if chance.one_in(12) {
        w.compare();
    }
}

/// After everything: a reset gives an instance that steps like a new one.
fn finish(w: &mut Walker, chance: &mut Chance) {
    let nobody = Strangers::default();
    life::reset(w, chance, true, &nobody);
    for call in [life::setup, life::enter, life::exit, steps::do_step] {
        call(w, chance, true, &nobody);
    }
    w.require(w.model.state == State::StepComplete, || "after a reset no step could be taken".to_owned());
    w.compare();
    w.compare_with_the_straight_way();
    life::free(w, chance, true, &nobody);
}

/// A walk of two instances of one scene as these bytes have it, for a fuzzer.
pub(crate) fn walk_of_bytes(data: &[u8]) {
    // Without the contact map, which takes long where code is instrumented.
    thread_local!(static STAGES: Vec<Stage> = stages(|_| None));
    STAGES.with(|stages| walk_of_two(stages, Chance::of_bytes(0, data)));
}

/// As long as there are bytes.
fn walk_of_two(stages: &[Stage], mut chance: Chance) {
    let (stage, folders) = (chance.pick(stages), Folders::new(0, FullDisk::None));
    let mut walkers = [SHARERS, SHARERS + 1].map(|number| Walker::new(stage, &folders, number, 0, &mut chance));
    let mut others = Strangers::default();
    while chance.has_bytes() {
        let index = chance.below(walkers.len());
        // What one has saved the other may be given.
        let (one, other) = (index, 1 - index);
        others.blobs = states::publish(&walkers[other], &mut chance).into_iter().collect();
        others.states = walkers[other].saved.iter().map(|saved| saved.handle.addr()).collect();
        call(&mut walkers[one], &mut chance, PATIENCE[0], &others);
    }
    walkers.iter_mut().for_each(|walker| finish(walker, &mut chance));
}
