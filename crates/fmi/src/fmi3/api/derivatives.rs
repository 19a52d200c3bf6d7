//! The exported functions that give derivatives. Those of inputs by time, which FMI 2.0 takes, FMI 3.0 has given up for
//! intermediate updates.

#![allow(non_snake_case)]

use super::functions;
use super::types::{Instance, Status, ValueReference};
use super::values::{expand, may_read};
use crate::arguments::{array, array_mut, disjoint};
use crate::both_versions::variables::{Array, product};
use crate::instance::{Failure, ValueCount, finite};
use crate::{boundary, instance};
use brinell::simulation::{Simulation, SimulationError};

/// What the model computes of rows of unknowns and knowns and a seed.
type Computed = fn(&mut Simulation, &[u32], &[u32], &[f64], &mut [f64]) -> Result<(), SimulationError>;

/// Computes a product of variables' elements. `adjoint` says which of unknowns and knowns the seed belongs to.
fn of_elements(
    instance: &mut instance::Instance,
    [unknowns, knowns]: [&[ValueReference]; 2],
    (seed, sensitivity): (&[f64], &mut [f64]),
    adjoint: bool,
) -> Result<(), Failure> {
    let of_seed = ValueCount { name: "nSeed", given: seed.len() };
    let of_sensitivity = ValueCount { name: "nSensitivity", given: sensitivity.len() };
    let (of_unknowns, of_knowns) = if adjoint { (of_seed, of_sensitivity) } else { (of_sensitivity, of_seed) };
    with_rows(instance, |instance, rows| {
        expand(instance, unknowns, of_unknowns, rows)?;
        let count = rows.len();
        expand(instance, knowns, of_knowns, rows)?;
        let (unknowns, knowns) = rows.split_at(count);
        let (compute, of): (Computed, _) = if adjoint {
            (Simulation::adjoint_derivative, knowns)
        } else {
            (Simulation::directional_derivative, unknowns)
        };
        compute(&mut instance.simulation, unknowns, knowns, seed, sensitivity)?;
        finite(&instance.simulation, of, sensitivity)
    })
}

/// Lends the instance's room for rows, empty.
fn with_rows<R>(
    instance: &mut instance::Instance,
    body: impl FnOnce(&mut instance::Instance, &mut Vec<u32>) -> R,
) -> R {
    let mut rows = std::mem::take(&mut instance.rows);
    rows.clear();
    let result = body(instance, &mut rows);
    instance.rows = rows;
    result
}

/// Products with J, which holds the partial derivatives of the unknowns by the knowns: name, row of the table of modes,
/// whether the seed belongs to the unknowns.
macro_rules! products {
    ($($(#[$meaning:meta])* $name:ident $row:ident $adjoint:literal;)*) => {$(
        $(#[$meaning])*
        ///
        /// # Safety
        /// Pointers are null or point to as many elements as said.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            instance: Instance,
            unknowns: *const ValueReference,
            nUnknowns: usize,
            knowns: *const ValueReference,
            nKnowns: usize,
            seed: *const f64,
            nSeed: usize,
            sensitivity: *mut f64,
            nSensitivity: usize,
        ) -> Status {
            let unknowns = Array { name: "unknowns", pointer: unknowns, count: nUnknowns };
            let knowns = Array { name: "knowns", pointer: knowns, count: nKnowns };
            let seed = Array { name: "seed", pointer: seed, count: nSeed };
            let values = Array { name: "sensitivity", pointer: sensitivity, count: nSensitivity };
            // SAFETY: this function's contract.
            unsafe {
                product(instance, &functions::$row, [unknowns, knowns], seed, values, |instance, of, seed, values| {
                    of_elements(instance, of, (seed, values), $adjoint)
                })
            }
        }
    )*};
}

products! {
    /// `fmi3GetDirectionalDerivative`: J·`seed`.
    fmi3GetDirectionalDerivative GET_DIRECTIONAL_DERIVATIVE false;
    /// `fmi3GetAdjointDerivative`: `seed`ᵀ·J.
    fmi3GetAdjointDerivative GET_ADJOINT_DERIVATIVE true;
}

/// `fmi3GetOutputDerivatives`: derivatives of outputs by time where the instance is. An order holds for all elements of
/// its variable.
///
/// # Safety
/// Pointers are null or point to as many elements as said, `orders` to `nValueReferences`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetOutputDerivatives(
    instance: Instance,
    valueReferences: *const ValueReference,
    nValueReferences: usize,
    orders: *const i32,
    values: *mut f64,
    nValues: usize,
) -> Status {
    boundary::call(instance, &functions::GET_OUTPUT_DERIVATIVES, |instance| {
        disjoint(valueReferences, nValueReferences, values, nValues)?;
        disjoint(orders, nValueReferences, values, nValues)?;
        // SAFETY: this function's contract; null, misaligned and overlapping arrays are refused.
        let (references, orders, values) = unsafe {
            (
                array("valueReferences", valueReferences, nValueReferences)?,
                array("orders", orders, nValueReferences)?,
                array_mut("values", values, nValues)?,
            )
        };
        may_read(instance, references)?;
        with_rows(instance, |instance, rows| {
            expand(instance, references, ValueCount { name: "nValues", given: values.len() }, rows)?;
            let of_rows = orders_of_rows(instance, references, orders)?;
            instance.simulation.output_derivatives(rows, &of_rows, values)?;
            finite(&instance.simulation, rows, values)
        })
    })
}

fn orders_of_rows(instance: &instance::Instance, references: &[u32], orders: &[i32]) -> Result<Vec<i32>, Failure> {
    let mut of_rows = Vec::new();
    for (reference, &order) in references.iter().zip(orders) {
        let count = super::values::addressing(instance)?.rows(reference)?.len();
        of_rows.extend(std::iter::repeat_n(order, count));
    }
    Ok(of_rows)
}
