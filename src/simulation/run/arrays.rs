//! Variables of every element as arrays, for hosts that know arrays: one variable with an entry for each element in
//! place of one for each element.
//!
//! What only a defective element has, its spin angle, is no array.

use crate::simulation::Simulation;
use crate::simulation::interface::Quantity as Q;
use crate::simulation::interface::table::Variable;

/// The rows of the variable table that are one array.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ElementArray {
    /// Their references, those of element 1 first, which stands for the array.
    pub rows: Vec<u32>,
}

impl Simulation {
    /// The arrays of this scene, in the order of the table.
    pub fn arrays(&self) -> Vec<ElementArray> {
        let first = |wanted: &Q| {
            matches!(
                wanted,
                Q::ElementAngle(0)
                    | Q::ElementPath(0)
                    | Q::ElementAxial(0)
                    | Q::ElementInnerForce(0)
                    | Q::ElementOuterForce(0)
                    | Q::ContactAngle(0, _)
                    | Q::ShoulderMargin(0, _)
            )
        };
        self.quantities.iter().filter(|quantity| first(quantity)).map(|&quantity| self.array_of(quantity)).collect()
    }

    /// All rows that are what `first` is of element 1.
    fn array_of(&self, first: Q) -> ElementArray {
        // On one of the two raceways.
        let side = |quantity: Q| match quantity {
            Q::ContactAngle(_, side) | Q::ShoulderMargin(_, side) => side,
            _ => 0,
        };
        let kind = |quantity: Q| (std::mem::discriminant(&quantity), side(quantity));
        let rows = self.table.iter().zip(self.quantities.iter());
        let rows = rows.filter(|(_, quantity)| kind(**quantity) == kind(first)).map(|(row, _)| row.reference);
        ElementArray { rows: rows.collect() }
    }
}

/// Name and description of an array, from those of its first row: `element[1].path` becomes `element.path`.
pub fn of_all_elements(first: &Variable) -> (String, String) {
    (first.name.replacen("[1]", "", 1), first.description.replacen("element 1", "each element", 1))
}
