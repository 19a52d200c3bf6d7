//! Variables of every element as arrays, for hosts that know arrays: one variable with an entry for each element in
//! place of one for each element.
//!
//! What only a defective element has, its spin angle, is no array.

use super::quantity::Quantity as Q;
use super::variables::Interface;
use crate::simulation::interface::table::Variable;

/// The rows of the variable table that are one array.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ElementArray {
    /// Their references, those of element 1 first, which stands for the array.
    pub rows: Vec<u32>,
}

impl Interface {
    /// The arrays of this scene, in the order of the table.
    pub(in crate::simulation) fn arrays(&self) -> Vec<ElementArray> {
        let rows = || self.table.iter().zip(self.quantities.iter());
        // All rows that are what `first` is of element 1.
        let array_of = |first: &Q| {
            let kind = std::mem::discriminant(first);
            let rows = rows().filter(|(_, quantity)| std::mem::discriminant(*quantity) == kind);
            ElementArray { rows: rows.map(|(row, _)| row.reference).collect() }
        };
        let first = |wanted: &Q| {
            matches!(wanted, Q::ElementAngle(0) | Q::ElementPath(0) | Q::ElementInnerForce(0) | Q::ElementOuterForce(0))
        };
        rows().filter(|(_, quantity)| first(quantity)).map(|(_, quantity)| array_of(quantity)).collect()
    }
}

/// Name and description of an array, from those of its first row: `element[1].path` becomes `element.path`.
pub fn of_all_elements(first: &Variable) -> (String, String) {
    (first.name.replacen("[1]", "", 1), first.description.replacen("element 1", "each element", 1))
}
