//! How scalars and arrays are read and set: all of a call's variables or none.

use crate::instance::{Addressing, Failure, Instance, Mode, ValueCount, finite, values};
use brinell::simulation::VariableError;
use brinell::simulation::interface::table::Kind;

/// What references stand for, of an instance that was made by FMI 3.0.
pub(super) fn addressing(instance: &Instance) -> Result<&Addressing, Failure> {
    instance.addressing.as_ref().ok_or(ANOTHER_VERSION)
}

const ANOTHER_VERSION: Failure = Failure::NotProvided("was instantiated under another version of FMI");

/// Refuses to read, in an intermediate update, what the host has not asked for.
#[inline]
pub(super) fn may_read(instance: &Instance, references: &[u32]) -> Result<(), Failure> {
    if instance.mode == Mode::IntermediateUpdate { within_update(instance, references, "read") } else { Ok(()) }
}

/// Refuses to set, in an intermediate update, what the host has not asked for, and what is no input.
#[inline]
pub(super) fn may_set(instance: &Instance, references: &[u32]) -> Result<(), Failure> {
    if instance.mode != Mode::IntermediateUpdate {
        return Ok(());
    }
    within_update(instance, references, "set")?;
    let may_set = instance.updates.as_ref().is_some_and(|updates| updates.may_set);
    let refused = |reference: &&u32| !may_set || !Addressing::is_input(&instance.simulation, **reference);
    match references.iter().find(refused) {
        None => Ok(()),
        Some(&reference) => {
            let why = if may_set { "it is no input" } else { "intermediateVariableSetRequested is false" };
            let name = addressing(instance)?.name(&instance.simulation, reference);
            Err(Failure::NotIntermediate { name, what: "set", why })
        }
    }
}

fn within_update(instance: &Instance, references: &[u32], what: &'static str) -> Result<(), Failure> {
    let addressing = addressing(instance)?;
    let is_required = |reference| instance.updates.as_ref().is_some_and(|updates| updates.has(reference));
    for &reference in references {
        addressing.rows(&reference)?;
        if !is_required(reference) {
            let name = addressing.name(&instance.simulation, reference);
            return Err(Failure::NotIntermediate { name, what, why: "it is not among requiredIntermediateVariables" });
        }
    }
    Ok(())
}

/// Reads reals.
#[inline]
pub(super) fn read(instance: &mut Instance, references: &[u32], values: &mut [f64]) -> Result<(), Failure> {
    let Instance { addressing: Some(addressing), simulation, clock, .. } = instance else {
        return Err(ANOTHER_VERSION);
    };
    if references.len() == values.len() && addressing.are_scalars(references) {
        simulation.reals(references, values)?;
        return finite(simulation, references, values);
    }
    addressing.check_count(references, ValueCount { name: "nValues", given: values.len() })?;
    let mut rest = values;
    for reference in references {
        let rows = addressing.rows(reference)?;
        let (of_this, later) = rest.split_at_mut(rows.len().max(1));
        if addressing.is_exchanged(*reference) {
            of_this.fill(values::value(simulation, *reference)?);
        } else if rows.is_empty() {
            of_this.fill(clock.map_or(simulation.time(), |clock| clock.time));
        } else {
            simulation.reals(rows, of_this)?;
            finite(simulation, rows, of_this)?;
        }
        rest = later;
    }
    Ok(())
}

/// Sets reals: inputs and parameters, which are all scalars.
#[inline]
pub(super) fn set(instance: &mut Instance, references: &[u32], values: &[f64]) -> Result<(), Failure> {
    check_scalars(instance, references, values.len())?;
    Ok(instance.simulation.set_reals(references, values)?)
}

/// Refuses unknown references, a wrong number of values, and then what cannot be set because it is an array or the
/// time.
#[inline]
pub(super) fn check_scalars(instance: &Instance, references: &[u32], count: usize) -> Result<(), Failure> {
    let addressing = addressing(instance)?;
    if references.len() == count && addressing.are_scalars(references) {
        return Ok(());
    }
    addressing.check_count(references, ValueCount { name: "nValues", given: count })?;
    match references.iter().find(|&&reference| !addressing.are_scalars(&[reference])) {
        None => Ok(()),
        Some(&reference) => {
            let name = addressing.name(&instance.simulation, reference);
            Err(VariableError::NotSettable { name, why: "it is computed" }.into())
        }
    }
}

/// Refuses scalars whose type is another one than `wanted`.
pub(super) fn check_kind(
    instance: &Instance,
    references: &[u32],
    wanted: &'static str,
    is_wanted: fn(&Kind) -> bool,
) -> Result<(), Failure> {
    for &reference in references {
        if !instance.simulation.table().get(reference as usize).is_some_and(|row| is_wanted(&row.kind)) {
            return Err(wrong_type(instance, reference, wanted)?);
        }
    }
    Ok(())
}

/// The failure that says why a variable is not what a call takes it for.
pub(super) fn wrong_type(instance: &Instance, reference: u32, wanted: &'static str) -> Result<Failure, Failure> {
    let addressing = addressing(instance)?;
    addressing.rows(&reference)?;
    let name = addressing.name(&instance.simulation, reference);
    Ok(VariableError::WrongType { name, reference, wanted }.into())
}

/// The rows behind references, put into `rows`: of reals that are not the time.
pub(super) fn expand(
    instance: &Instance,
    references: &[u32],
    count: ValueCount,
    rows: &mut Vec<u32>,
) -> Result<(), Failure> {
    let addressing = addressing(instance)?;
    addressing.check_count(references, count)?;
    for reference in references {
        if addressing.is_time(*reference) {
            return Err(VariableError::NotAnUnknown { name: "time".to_owned() }.into());
        }
        if addressing.is_exchanged(*reference) {
            rows.push(*reference);
        }
        rows.extend_from_slice(addressing.rows(reference)?);
    }
    Ok(())
}
