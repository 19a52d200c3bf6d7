//! What a value reference of FMI 3.0 stands for: one row of the variable table, an array of rows, or the time.
//!
//! A scalar has its row's reference, as in FMI 2.0; an array has that of its first row, and the references of its other
//! rows are unknown; the time comes after the last row.

use super::failure::Failure;
use brinell::simulation::Simulation;
use brinell::simulation::interface::table::Causality;
use brinell::simulation::interface::{ElementArray, of_all_elements};

/// What a reference stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Nothing: a row of an array that is not its first.
    Hidden,
    /// A row.
    Scalar,
    /// The array of this number.
    Array(u8),
}

/// Where a row is in its variable.
pub(crate) struct RowAddress {
    /// Reference of the variable.
    pub(crate) reference: u32,
    /// Element, counted from 1; 0 in a scalar.
    pub(crate) element: usize,
}

/// How many values a call gives or wants.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ValueCount {
    /// What the interface calls the number.
    pub(crate) name: &'static str,
    /// The number.
    pub(crate) given: usize,
}

/// What the references of one model stand for.
#[derive(Debug)]
pub(crate) struct Addressing {
    kinds: Vec<Kind>,
    arrays: Vec<ElementArray>,
    /// Number of variables behind the time: those of model exchange.
    exchanged: usize,
    scalars: bool,
}

/// Which variables the FMU lists beyond, or in place of, those of the table.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Listing {
    /// Those of model exchange as well.
    pub(crate) exchange: bool,
    /// No arrays, and counters as Int64.
    pub(crate) scalars: bool,
}

impl Addressing {
    /// That of a model.
    pub(crate) fn of(simulation: &Simulation, Listing { exchange, scalars }: Listing) -> Self {
        let arrays = if scalars { Vec::new() } else { simulation.arrays() };
        let mut kinds = vec![Kind::Scalar; simulation.table().len()];
        for (number, array) in (0..).zip(&arrays) {
            for &row in &array.rows {
                kinds[row as usize] = Kind::Hidden;
            }
            if let Some(&first) = array.rows.first() {
                kinds[first as usize] = Kind::Array(number);
            }
        }
        let states = simulation.continuous_state_count();
        let exchanged = if exchange { 2 * states + simulation.event_indicator_count() } else { 0 };
        Self { kinds, arrays, exchanged, scalars }
    }

    /// Whether counters are Int64, as enumerations are.
    pub(crate) fn counts_signed(&self) -> bool {
        self.scalars
    }

    /// Whether a reference is the time's.
    #[inline]
    pub(crate) fn is_time(&self, reference: u32) -> bool {
        reference as usize == self.kinds.len()
    }

    /// Whether a reference is that of a variable of model exchange.
    #[inline]
    pub(crate) fn is_exchanged(&self, reference: u32) -> bool {
        let behind = (reference as usize).checked_sub(self.kinds.len() + 1);
        behind.is_some_and(|number| number < self.exchanged)
    }

    /// Whether all are scalars of the table.
    #[inline]
    pub(crate) fn are_scalars(&self, references: &[u32]) -> bool {
        references.iter().all(|&reference| self.kinds.get(reference as usize) == Some(&Kind::Scalar))
    }

    /// The rows behind a reference; none behind the time and what model exchange adds.
    ///
    /// # Errors
    /// A reference of nothing.
    pub(crate) fn rows<'a>(&'a self, reference: &'a u32) -> Result<&'a [u32], Failure> {
        match self.kinds.get(*reference as usize) {
            Some(Kind::Scalar) => Ok(std::slice::from_ref(reference)),
            Some(Kind::Array(number)) => Ok(&self.arrays[usize::from(*number)].rows),
            None if self.is_time(*reference) || self.is_exchanged(*reference) => Ok(&[]),
            _ => Err(Failure::UnknownReference(*reference)),
        }
    }

    /// Number of values behind a reference.
    fn count(&self, reference: &u32) -> Result<usize, Failure> {
        Ok(self.rows(reference)?.len().max(1))
    }

    /// Refuses a number of values that is not that behind the references.
    pub(crate) fn check_count(&self, references: &[u32], count: ValueCount) -> Result<(), Failure> {
        let ValueCount { name, given } = count;
        let mut needed = 0;
        for reference in references {
            needed += self.count(reference)?;
        }
        if needed == given { Ok(()) } else { Err(Failure::ValueCount { name, given, needed }) }
    }

    /// Name of what is behind a reference.
    pub(crate) fn name(&self, simulation: &Simulation, reference: u32) -> String {
        let row = simulation.table().get(reference as usize);
        match (row, self.kinds.get(reference as usize)) {
            (Some(row), Some(Kind::Array(_))) => of_all_elements(row).0,
            (Some(row), _) => row.name.clone(),
            (None, _) if self.is_exchanged(reference) => simulation.exchange_name(reference).unwrap_or_default(),
            (None, _) => "time".to_owned(),
        }
    }

    /// Where a row is in its variable.
    pub(crate) fn address_of(&self, row: u32) -> RowAddress {
        for array in &self.arrays {
            if let Some(index) = array.rows.iter().position(|&one| one == row) {
                return RowAddress { reference: array.rows[0], element: index + 1 };
            }
        }
        RowAddress { reference: row, element: 0 }
    }

    /// Whether an intermediate update can touch a variable: inputs and outputs. modelDescription.xml names those that
    /// change within a step; the mean force, which does not, may be read as well, for fmusim asks for every output that
    /// it records.
    pub(crate) fn is_intermediate(&self, simulation: &Simulation, reference: u32) -> bool {
        self.rows(&reference).is_ok_and(|rows| {
            let rows = rows.iter().filter_map(|&row| simulation.table().get(row as usize));
            let mut any = false;
            let all =
                rows.inspect(|_| any = true).all(|row| matches!(row.causality, Causality::Input | Causality::Output));
            any && all
        })
    }

    /// Whether a reference is that of an input.
    pub(crate) fn is_input(simulation: &Simulation, reference: u32) -> bool {
        simulation.table().get(reference as usize).is_some_and(|row| row.causality == Causality::Input)
    }
}
