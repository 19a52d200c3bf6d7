//! Derivatives of outputs: by time, and by inputs. Not provided yet; the model description says so.

use super::{Simulation, SimulationError};

impl Simulation {
    /// Derivatives of real outputs by time at the present time.
    pub fn output_derivatives(
        &mut self,
        _references: &[u32],
        _orders: &[i32],
        _values: &mut [f64],
    ) -> Result<(), SimulationError> {
        Err(SimulationError::NotProvided("derivatives of outputs by time"))
    }

    /// The change of `unknowns` for a change `seed` of `knowns`, to first order.
    pub fn directional_derivative(
        &mut self,
        _unknowns: &[u32],
        _knowns: &[u32],
        _seed: &[f64],
        _values: &mut [f64],
    ) -> Result<(), SimulationError> {
        Err(SimulationError::NotProvided("directional derivatives"))
    }
}
