//! Derivatives of outputs: by inputs, and by time.
//!
//! *By inputs at a communication point* a derivative is what a host sees when it sets an input and reads an output
//! without a step between: states stay, and only what feeds through directly moves. *In initialization mode* the output
//! is that of the static equilibrium, which moves with the input; rings at rest stay at rest. Cage angles follow no
//! input in either case.
//!
//! *By parameters*, in initialization mode only, a derivative is a difference of two starts: parameters shape the model
//! itself, down to radii and contact laws.
//!
//! *By time* an output changes with the states' derivatives, the cage angle and the inputs, which go on as they would
//! in the next step: prescribed rings by their velocity and acceleration, loads and speed by the derivatives set for
//! them.
//!
//! All follow from the first-order change of [`crate::dynamics::derivatives::variation`]. Means over the last step and
//! counts of the solver change with nothing until the next step.

mod by_parameter;

use crate::dynamics::derivatives::Going;
use crate::dynamics::parameters::{Excitation, Frame, Kinematics, RingInSpace};
use crate::dynamics::quasi_static::in_plane;
use crate::numerics::plane::Vector;
use crate::simulation::interface::{Change, Input, Quantity, RingName, as_many, dependencies, value_access};
use crate::simulation::run::{Present, UpToDate};
use crate::simulation::{Simulation, SimulationError, VariableError};

/// Fills values of unknowns from knowns and a seed of theirs, in this order.
pub(in crate::simulation) type Product =
    fn(&mut Simulation, &[u32], &[u32], &[f64], &mut [f64]) -> Result<(), SimulationError>;

impl Simulation {
    /// Derivatives by time of real outputs at the present time; of order 1.
    ///
    /// # Errors
    /// Before `initialize`; another order; a variable that is no real output.
    pub fn output_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &mut [f64],
    ) -> Result<(), SimulationError> {
        as_many(references.len(), orders.len())?;
        as_many(references.len(), values.len())?;
        for (&reference, &order) in references.iter().zip(orders) {
            let variable = self.interface.unknown(reference)?;
            if order != 1 {
                let name = variable.name.clone();
                return Err(VariableError::OutputDerivative { name, order }.into());
            }
        }
        if !self.run.state.started {
            return Err(SimulationError::NotInitialized);
        }
        self.refresh()?;
        let acceleration = self.present.outputs(&self.run).acceleration(RingName::Housing);
        let excitation = self.excitation(true);
        if excitation != self.present.excitation || self.run.model.solves_grids() {
            self.present.evaluate(&self.run, excitation);
            self.invalidate(UpToDate::State);
        }
        self.along_time(&excitation);
        self.finish_change(references, acceleration, self.excitation(false));
        for (value, &reference) in values.iter_mut().zip(references) {
            let quantity = self.interface.quantities[reference as usize];
            *value = self.changed(quantity);
            if let Quantity::Force(ring, axis) = quantity {
                self.note_rate(ring, axis, *value);
            }
        }
        Ok(())
    }

    /// The change of `unknowns`, real outputs, for a change `seed` of `knowns`, real inputs or before `initialize` real
    /// parameters, to first order. The continuous states of `exchange` and their derivatives are
    /// unknowns as well; the states are knowns once the run has started.
    /// ```
    /// use brinell::scene::{Bearing, Scene};
    /// use brinell::simulation::Simulation;
    ///
    /// let bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3);
    /// let scene = Scene::builder(bearing).shaft_speed(157.1).shaft_load([0.0, -1500.0]).build()?;
    /// let mut simulation = Simulation::new(scene, None)?;
    /// simulation.initialize(0.0)?;
    /// // What the load does to the ring's acceleration at once: 1/m.
    /// let (load, acceleration) = (simulation.reference("shaft.load.y")?, simulation.reference("shaft.ay")?);
    /// let mut change = [0.0];
    /// simulation.directional_derivative(&[acceleration], &[load], &[1.0], &mut change)?;
    /// assert!((change[0] * simulation.get("shaft.mass")? - 1.0).abs() < 1e-12);
    /// # Ok::<(), brinell::Error>(())
    /// ```
    ///
    /// # Errors
    /// Variables of another kind; before `initialize` also an equilibrium that does not exist or has no derivative.
    pub fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        values: &mut [f64],
    ) -> Result<(), SimulationError> {
        as_many(knowns.len(), seed.len())?;
        as_many(unknowns.len(), values.len())?;
        for &reference in unknowns {
            self.check_unknown(reference)?;
        }
        let acceleration = self.along_knowns(knowns, seed)?;
        if !self.run.state.started {
            let progress = &self.run.state.progress;
            let Present { excitation, evaluation, .. } = &mut *self.present;
            let found = self.run.model.vary_equilibrium(
                excitation,
                &progress.cells,
                &progress.state,
                &self.change.loads,
                &mut self.change.variation,
                &mut evaluation.forces.shortcuts,
            );
            found.ok_or(SimulationError::NoDerivative)?;
        }
        self.finish_change(unknowns, acceleration, self.present.excitation);
        for (value, &reference) in values.iter_mut().zip(unknowns) {
            *value = match self.interface.quantities.get(reference as usize) {
                Some(&quantity) => self.changed(quantity),
                None => self.exchanged_change(reference),
            };
        }
        for (&known, &weight) in knowns.iter().zip(seed) {
            if let Some(&Quantity::Parameter(parameter)) = self.interface.quantities.get(known as usize)
                && dependencies::balances(parameter)
            {
                self.along_parameter(unknowns, (known, parameter), weight, values)?;
            }
        }
        Ok(())
    }

    /// What a change of each of `knowns`, real inputs, adds to the sum of `unknowns`, real outputs, weighted by `seed`:
    /// the seed's product with the Jacobian from the left. As many directional derivatives are computed as there are
    /// knowns.
    ///
    /// # Errors
    /// As [`directional_derivative`](Self::directional_derivative).
    pub fn adjoint_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        values: &mut [f64],
    ) -> Result<(), SimulationError> {
        as_many(unknowns.len(), seed.len())?;
        as_many(knowns.len(), values.len())?;
        for (&reference, &weight) in unknowns.iter().zip(seed) {
            self.check_unknown(reference)?;
            if !weight.is_finite() {
                return Err(self.no_weight(reference, weight).into());
            }
        }
        self.left_product(Self::directional_derivative, [unknowns, knowns], seed, values)
    }

    /// The product of `seed` from the left with the Jacobian of which `product` gives products from the right, by a
    /// column each.
    pub(in crate::simulation) fn left_product(
        &mut self,
        product: Product,
        [unknowns, knowns]: [&[u32]; 2],
        seed: &[f64],
        values: &mut [f64],
    ) -> Result<(), SimulationError> {
        let mut column = vec![0.0; unknowns.len()];
        for (value, known) in values.iter_mut().zip(knowns) {
            product(self, unknowns, std::slice::from_ref(known), &[1.0], &mut column)?;
            *value = column.iter().zip(seed).map(|(derivative, weight)| weight * derivative).sum();
        }
        Ok(())
    }

    /// Starts the change with that of the inputs among the knowns, everything else as it is. Gives the outer ring's
    /// acceleration (m/s²).
    pub(in crate::simulation) fn along_knowns(
        &mut self,
        knowns: &[u32],
        seed: &[f64],
    ) -> Result<Vector, SimulationError> {
        for (&reference, &value) in knowns.iter().zip(seed) {
            self.check_known(reference)?;
            if !value.is_finite() {
                return Err(self.no_weight(reference, value).into());
            }
        }
        self.refresh()?;
        self.present.evaluation.forces.shortcuts.forget();
        self.along_inputs(knowns, seed);
        Ok(self.present.outputs(&self.run).acceleration(RingName::Housing))
    }

    /// Refuses what is no real output, nor a continuous state or the derivative of one.
    fn check_unknown(&self, reference: u32) -> Result<(), VariableError> {
        match self.interface.table.get(reference as usize) {
            Some(_) => self.interface.unknown(reference).map(|_| ()),
            None => self.check_exchanged_unknown(reference),
        }
    }

    /// Refuses what is no real input: before the start no parameter either, after it no continuous state.
    fn check_known(&self, reference: u32) -> Result<(), VariableError> {
        let Some(variable) = self.interface.table.get(reference as usize) else {
            return self.check_exchanged_known(reference);
        };
        let class = self.interface.classes(&[reference]).unwrap_or(0);
        if class != value_access::INPUT && (self.run.state.started || class != value_access::PARAMETER) {
            return Err(VariableError::NotAKnown { name: variable.name.clone() });
        }
        Ok(())
    }

    fn no_weight(&self, reference: u32, value: f64) -> VariableError {
        let name = self.interface.table.get(reference as usize).map(|variable| variable.name.clone());
        let name = name.or_else(|| self.exchange_name(reference)).unwrap_or_default();
        VariableError::OutOfRange { name, value, min: f64::MIN, max: f64::MAX }
    }

    fn along_inputs(&mut self, knowns: &[u32], seed: &[f64]) {
        self.change.clear();
        for (&reference, &value) in knowns.iter().zip(seed) {
            let Some(quantity) = self.interface.quantities.get(reference as usize) else {
                self.along_exchanged(reference, value);
                continue;
            };
            let (Some(input), change) = (quantity.as_input(), &mut self.change) else { continue };
            match input {
                Input::Speed(ring) => {
                    let (ratios, i) = (&self.run.model.ratios, ring.index());
                    change.variation.cage_speed += ratios.cage[i] * value;
                    change.variation.frames[ring.frame() as usize][1] += value;
                    change.variation.frames[Frame::Spin as usize][1] += ratios.spin[i] * value;
                    change.variation.film_speed += if ring == RingName::Shaft { value } else { -value };
                }
                Input::Load(name, axis) => change.loads[name.index()][axis] += value,
                Input::Position(name, axis) => change.variation.rings[name.index()].position[axis] += value,
                Input::Velocity(name, axis) => change.variation.rings[name.index()].velocity[axis] += value,
                Input::Acceleration(name, axis) => change.accelerations[name.index()][axis] += value,
            }
        }
    }

    /// The change per second of state and inputs.
    fn along_time(&mut self, excitation: &Excitation) {
        let (change, derivative) = (&mut self.change, &self.present.evaluation.derivative);
        change.clear();
        let layout = &self.run.model.layout;
        let z = layout.element_count;
        let variation = &mut change.variation;
        (variation.cage_angle, variation.cage_speed) = (excitation.cage.0[1], excitation.cage.0[2]);
        variation.frames = excitation.frame_rates(0.0);
        variation.film_speed = excitation.relative_speed.rate_at(0.0);
        variation.path.copy_from_slice(&derivative[..z]);
        variation.radial_velocity.copy_from_slice(&derivative[layout.radial_velocity..][..z]);
        let model = &self.run.model;
        variation.rings = match model.space {
            Some(_) => model.ring_rates_in_space(excitation, 0.0, derivative),
            None => model.ring_rates(excitation, 0.0, derivative).map(RingInSpace::from),
        };
        for (sensor, i) in change.sensors.iter_mut().zip(layout.sensor_indices()) {
            *sensor = [derivative[i], derivative[i + 1]];
        }
        for (k, i) in layout.sensor_indices().enumerate() {
            change.by_sensor_modes[k] =
                self.run.model.sensor_modes.rate(k, derivative[i + 1], &self.run.state.progress.sensor_modes);
        }
        // Those of internal rings follow from the forces' change.
        change.accelerations = excitation.motion.map(|ring| ring.map(|motion| motion.0[3]));
        change.loads = excitation.load.map(|ring| ring.map(|load| load.rate_at(0.0)));
        let Some([v, w_z]) = layout.axial() else { return };
        change.variation.axial.copy_from_slice(&derivative[v..][..z]);
        change.variation.axial_velocity.copy_from_slice(&derivative[w_z..][..z]);
    }

    /// From the change of state and inputs to that of forces, accelerations and, if it is asked for, stiffness. The
    /// outer ring's `acceleration` is the present one (m/s²), `excitation` is without derivatives of inputs.
    pub(in crate::simulation) fn finish_change(
        &mut self,
        unknowns: &[u32],
        acceleration: Vector,
        excitation: Excitation,
    ) {
        self.note_wiring(value_access::SECOND);
        let forces_now = &mut self.present.evaluation.forces;
        let progress = &self.run.state.progress;
        let (cells, state) = (&progress.cells, &progress.state);
        let change = &mut *self.change;
        let Change { variation, forces, .. } = &mut *change;
        self.run.model.vary(&excitation, cells, state, acceleration, (variation, forces), &mut forces_now.shortcuts);

        // At the start nothing accelerates, whatever the inputs are.
        if self.run.state.started && self.run.model.space.is_some() {
            let rings = self.run.model.rings_in_space(&excitation, 0.0, state, None);
            change.accelerate_in_space(&self.run.model, &excitation, &rings);
        } else if self.run.state.started {
            let (variation, forces) = (&change.variation, &change.forces);
            let cage = excitation.cage_at(0.0);
            let [shaft, housing] = variation.in_plane();
            let moved = Kinematics { cage, shaft, housing };
            let [mut x, mut v] = moved.bodies();
            for (k, &[of_x, of_v]) in change.sensors.iter().enumerate() {
                (x[4 + k], v[4 + k]) = (of_x, of_v);
            }
            let acting = in_plane(&forces.rings) + in_plane(&change.loads);
            let accelerations = self.run.model.supports.accelerations(&x, &v, &acting);
            for (i, acceleration) in accelerations.iter().enumerate().take(4) {
                // What the host prescribes has been set before.
                change.accelerations[i / 2][i % 2] += acceleration;
            }
            change.sensor_accelerations.copy_from_slice(&accelerations.as_slice()[4..]);
        }
        let by_acceleration = change.forces.torque_by_acceleration;
        let [x, y, ..] = change.accelerations[1];
        change.cage_torque = change.forces.cage_torque + by_acceleration.dot(&Vector::new(x, y));
        let quantities = &self.interface.quantities;
        let wanted = |&of: &u32| matches!(quantities.get(of as usize), Some(Quantity::Stiffness(..)));
        if unknowns.iter().any(wanted) {
            // Balances follow inputs at once, states do not.
            let mut settled = Vec::new();
            let state = if self.run.model.elements_in_balance() {
                settled.extend_from_slice(state);
                forces_now.settle(&self.run.model, &mut settled);
                &settled[..]
            } else {
                state
            };
            let (model, by, shortcuts) = (&self.run.model, &change.variation, &mut forces_now.shortcuts);
            change.stiffness = match model.vary_stiffness_in_space(&excitation, (cells, state), by, shortcuts) {
                Some(stiffness) => stiffness,
                None => {
                    let plane = model.vary_stiffness(&excitation, cells, state, by, shortcuts);
                    let part = |row, column| if row < 2 && column < 2 { plane[(row, column)] } else { 0.0 };
                    std::array::from_fn(|row| std::array::from_fn(|column| part(row, column)))
                }
            };
        }
    }

    /// Change of the cage's own angle and speed.
    fn cage_change(&self) -> [f64; 2] {
        let (lead, cage) = (self.run.model.cage_lead(self.run.state.cage), self.excitation(false).cage_at(0.0));
        let Going { turn, speed, .. } = Going::of(lead, &cage, &self.change.variation);
        [turn, speed]
    }

    /// Change of the angle of element `j`.
    fn element_turn(&self, j: usize) -> f64 {
        Going::turned(self.run.model.lead(j, self.run.state.cage), &self.change.variation)
    }

    /// What the change makes of one output.
    pub(in crate::simulation) fn changed(&self, quantity: Quantity) -> f64 {
        let Change { variation, forces, .. } = &*self.change;
        match quantity {
            Quantity::Position(name, axis) => variation.rings[name.index()].position[axis],
            Quantity::Velocity(name, axis) => variation.rings[name.index()].velocity[axis],
            Quantity::Acceleration(name, axis) => self.change.accelerations[name.index()][axis],
            Quantity::Force(name, axis) => forces.rings[name.index()][axis],
            // Before the first step the mean is the force itself.
            Quantity::MeanForce(name, axis) | Quantity::NextMeanForce(name, axis) if !self.run.state.started => {
                forces.rings[name.index()][axis]
            }
            Quantity::Stiffness(row, column) => -self.change.stiffness[row][column],
            Quantity::SensorAcceleration(k) => {
                self.run.model.sensor_modes.direct(k) * self.change.sensor_accelerations[k]
                    + self.change.by_sensor_modes[k]
            }
            Quantity::Probe(axis) => variation.rings[0].position[axis] - variation.rings[1].position[axis],
            Quantity::CageAngle => self.cage_change()[0],
            Quantity::ElementAngle(j) => self.element_turn(j),
            Quantity::CageSpeed => self.cage_change()[1],
            Quantity::CageTorque => self.change.cage_torque,
            Quantity::ShaftTorque => forces.shaft_torque,
            Quantity::RingAngle(name) => variation.frames[name.frame() as usize][0],
            // The spin angle is that of the defect against the element's own direction.
            Quantity::ElementSpinAngle(j) => variation.frames[Frame::Spin as usize][0] - self.element_turn(j),
            Quantity::ElementPath(j) => variation.path[j],
            Quantity::ElementAxial(j) => variation.axial[j],
            Quantity::ContactAngle(j, side) => forces.contact_angles[side][j],
            Quantity::ShoulderMargin(j, side) => {
                self.change.of_shoulder(&self.run.model, &self.present.evaluation.forces, j, side)
            }
            Quantity::ElementInnerForce(j) => forces.inner[j],
            Quantity::ElementOuterForce(j) => forces.outer[j],
            Quantity::MeanForce(..) | Quantity::NextMeanForce(..) | Quantity::Count(_) => 0.0,
            Quantity::SuggestedStep | Quantity::CouplingError | Quantity::LargestCouplingError => 0.0,
            Quantity::Speed(_) | Quantity::Load(..) | Quantity::RadialClearance | Quantity::Parameter(_) => 0.0,
        }
    }
}
