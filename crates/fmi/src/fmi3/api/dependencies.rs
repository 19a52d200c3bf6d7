//! The exported functions that tell what a variable depends on, element by element.
//!
//! Outputs depend before the end of initialization on inputs and parameters, at communication points on inputs. So do
//! the variables of model exchange, whose derivatives then depend on states as well. What they depend on are scalars,
//! whose element index is 0: all of the variable.

#![allow(non_snake_case)]

use super::functions;
use super::types::{DEPENDENT, DependencyKind, Instance, Status, ValueReference};
use super::values::addressing;
use crate::arguments::{store, store_all};
use crate::instance::{Failure, Mode};
use crate::{boundary, instance};

/// What one element of the dependent variable depends on.
struct Dependency {
    element: usize,
    /// Reference of the independent variable.
    independent: ValueReference,
}

fn dependencies(instance: &instance::Instance, reference: ValueReference) -> Result<Vec<Dependency>, Failure> {
    let addressing = addressing(instance)?;
    let rows = addressing.rows(&reference)?;
    let initial = matches!(instance.mode, Mode::Instantiated | Mode::Initialization);
    let is_exchanged = addressing.is_exchanged(reference);
    let rows = if is_exchanged { std::slice::from_ref(&reference) } else { rows };
    let all =
        if is_exchanged { instance.simulation.exchange_dependencies() } else { instance.simulation.dependencies() };
    let of_row = |row: &u32| {
        let element = addressing.address_of(*row).element;
        let found = all.iter().find(|of| of.output == *row);
        let known = found.map_or(&[][..], |of| if initial { &of.initial } else { &of.direct });
        let on = move |&known: &u32| Dependency { element, independent: addressing.address_of(known).reference };
        known.iter().map(on).collect::<Vec<_>>()
    };
    Ok(rows.iter().flat_map(of_row).collect())
}

/// `fmi3GetNumberOfVariableDependencies`.
///
/// # Safety
/// `nDependencies` is null or points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfVariableDependencies(
    instance: Instance,
    valueReference: ValueReference,
    nDependencies: *mut usize,
) -> Status {
    boundary::call(instance, &functions::NUMBER_OF_DEPENDENCIES, |instance| {
        let count = dependencies(instance, valueReference)?.len();
        // SAFETY: this function's contract; null and misaligned pointers are refused.
        unsafe { store("nDependencies", nDependencies, count) }
    })
}

/// `fmi3GetVariableDependencies`.
///
/// # Safety
/// The arrays are null, or have `nDependencies` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetVariableDependencies(
    instance: Instance,
    dependent: ValueReference,
    elementIndicesOfDependent: *mut usize,
    independents: *mut ValueReference,
    elementIndicesOfIndependents: *mut usize,
    dependencyKinds: *mut DependencyKind,
    nDependencies: usize,
) -> Status {
    boundary::call(instance, &functions::DEPENDENCIES, |instance| {
        let found = dependencies(instance, dependent)?;
        if found.len() != nDependencies {
            let (name, given, needed) = ("nDependencies", nDependencies, found.len());
            return Err(Failure::DependencyCount { name, given, needed });
        }
        let (elements, references): (Vec<_>, Vec<_>) = found.iter().map(|of| (of.element, of.independent)).unzip();
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        unsafe {
            store_all("elementIndicesOfDependent", elementIndicesOfDependent, &elements)?;
            store_all("independents", independents, &references)?;
            store_all("elementIndicesOfIndependents", elementIndicesOfIndependents, &vec![0; nDependencies])?;
            store_all("dependencyKinds", dependencyKinds, &vec![DEPENDENT; nDependencies])
        }
    })
}
