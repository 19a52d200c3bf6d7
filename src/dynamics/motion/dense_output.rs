//! Dense output: the motion between two instants at which state and derivative are known.
//!
//! Every position follows the polynomial of degree five that has its value, rate and second derivative at both ends
//! (Hermite); its error is of order h⁶. Velocities are that polynomial's derivative. An element's w is not the rate of
//! its path u: with e_r, e_t turning at the cage speed ω and the outer ring moving at v_o,
//! ```text
//! u' = w − e_r·v_o,   u'' = w' − e_r·v_o' − ω e_t·v_o
//! ```

use crate::dynamics::element::{dot, radial};
use crate::dynamics::parameters::{CageState, Excitation, Layout, LeadPieces, Model};
use crate::numerics::lanes::{Lanes, WIDEST, Wide, blocks, blocks_mut, groups};
use crate::numerics::polynomials::Quintic;

/// What is known at one instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Known<'a> {
    pub(crate) cage: CageState,
    pub(crate) state: &'a [f64],
    pub(crate) derivative: &'a [f64],
}

/// A moment between two instants.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Between<'a> {
    /// Time from the one to the other (s), and share of it that has gone by.
    pub(crate) length: f64,
    pub(crate) share: f64,
    /// The cage at that moment.
    pub(crate) cage: &'a CageState,
}

impl Model {
    /// State at a moment between two instants into `out`; `pieces` are those of an uneven cage.
    #[inline(always)]
    pub(crate) fn dense_output<S: Wide>(
        &self,
        simd: S,
        excitation: &Excitation,
        ends: [Known; 2],
        Between { length, share, cage }: Between,
        pieces: &mut LeadPieces,
        out: &mut [f64],
    ) {
        let layout = &self.layout;
        let basis = Quintic::new(length, share);
        let value = |i: usize| ends.map(|end| end.state[i]);
        let rate = |i: usize| ends.map(|end| end.derivative[i]);
        let rings = [layout.shaft, layout.housing].into_iter().flatten().map(|start| (start, 2));
        for (start, count) in rings.chain(layout.sensor_indices().map(|start| (start, 1))) {
            for i in start..start + count {
                (out[i], out[i + count]) = basis.at(value(i), rate(i), rate(i + count));
            }
        }
        if let Some([v, w_z]) = layout.axial() {
            let slots = [Layout::POSITIONS, Layout::VELOCITIES];
            for start in [layout.shaft, layout.housing].into_iter().flatten() {
                for k in 2..layout.freedom.count() {
                    let (x, rate_of_x) = (start + slots[0][k], start + slots[1][k]);
                    (out[x], out[rate_of_x]) = basis.at(value(x), rate(x), rate(rate_of_x));
                }
            }
            // v' = w_z − ż_o
            let rings =
                ends.map(|end| self.ring_rates_in_space(excitation, end.cage.tau, end.derivative)[1].velocity[2]);
            let velocity = self.rings_in_space(excitation, cage.tau, out, None)[1].velocity[2];
            for j in 0..self.element_count {
                let second = [0, 1].map(|k: usize| ends[k].derivative[w_z + j] - rings[k]);
                let (axial, axial_rate) = basis.at(value(v + j), rate(v + j), second);
                (out[v + j], out[w_z + j]) = (axial, axial_rate + velocity);
            }
        }
        let housing = ends.map(|end| self.housing_state(excitation, end.cage.tau, end.state).velocity);
        let acceleration = ends.map(|end| self.ring_rates(excitation, end.cage.tau, end.derivative)[1].velocity);
        let velocity = self.housing_state(excitation, cage.tau, out).velocity;
        let w = layout.radial_velocity / WIDEST;
        let out = blocks_mut(out);
        for (k, part) in groups::<S>(self.element_count) {
            let [start, end] = ends.map(|end| {
                let (state, derivative) = (blocks(end.state), blocks(end.derivative));
                [&state[k], &derivative[k], &derivative[w + k]].map(|block| Lanes::part(simd, block, part))
            });
            let mut second = [start[2], end[2]];
            for (i, second) in second.iter_mut().enumerate() {
                let (e_r, speed) = self.directions_and_speeds(simd, [k, part], excitation, &ends[i].cage, pieces);
                let e_t = [-e_r[1], e_r[0]];
                *second = *second - dot(simd, acceleration[i], e_r) - speed * dot(simd, housing[i], e_t);
            }
            let (path, path_rate) = basis.at([start[0], end[0]], [start[1], end[1]], second);
            let (e_r, _) = self.directions_and_speeds(simd, [k, part], excitation, cage, pieces);
            path.put(&mut out[k], part);
            (path_rate + dot(simd, velocity, e_r)).put(&mut out[w + k], part);
        }
    }

    /// Radial directions of a part of a block of elements, and their speeds about the outer ring's centre (rad/s).
    #[inline(always)]
    fn directions_and_speeds<S: Wide>(
        &self,
        simd: S,
        [k, part]: [usize; 2],
        excitation: &Excitation,
        cage: &CageState,
        pieces: &mut LeadPieces,
    ) -> ([Lanes<S>; 2], Lanes<S>) {
        if !self.is_uneven() {
            let of = |numbers: &[f64; WIDEST]| Lanes::part(simd, numbers, part);
            return (radial(simd, cage.direction, &self.elements[k], of), Lanes::splat(simd, cage.speed));
        }
        let mut found = [[0.0; WIDEST]; 3];
        for i in part * S::F64_LANES..(part + 1) * S::F64_LANES {
            if k * WIDEST + i < self.element_count {
                let (e_r, speed) = self.direction_and_speed(k * WIDEST + i, excitation, cage, pieces);
                (found[0][i], found[1][i], found[2][i]) = (e_r.x, e_r.y, speed);
            }
        }
        let [x, y, speed] = found.map(|numbers| Lanes::part(simd, &numbers, part));
        ([x, y], speed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::contacts::Forces;
    use crate::dynamics::derivatives::jacobian::tests::{lively, moving};
    use crate::dynamics::parameters::Cells;
    use crate::scene::{Damping, Motion};
    use pulp::Scalar256b;

    /// The state after `time`, by many classical Runge–Kutta steps.
    fn integrated(model: &Model, excitation: &Excitation, state: &[f64], cells: &Cells, time: f64) -> Vec<f64> {
        let (mut y, mut forces, count) = (state.to_vec(), Forces::new(model.element_count), 50);
        let h = time / f64::from(count);
        for step in 0..count {
            let tau = f64::from(step) * h;
            let mut rate = |share: f64, k: &[f64]| {
                let at: Vec<f64> = y.iter().zip(k).map(|(y, k)| y + share * h * k).collect();
                let mut rate = vec![0.0; y.len()];
                model.derivative(excitation, tau + share * h, cells, &at, &mut rate, &mut forces);
                rate
            };
            let a = rate(0.0, &vec![0.0; state.len()]);
            let b = rate(0.5, &a);
            let c = rate(0.5, &b);
            let d = rate(1.0, &c);
            for i in 0..y.len() {
                y[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
            }
        }
        y
    }

    #[test]
    fn dense_output_is_what_many_small_steps_give() {
        // 0.06 rad of an element's vibration: the polynomials' rates miss 1e-10 m/s. Without the terms of a turning e_r
        // or of the outer ring's acceleration they would miss 1e-7.
        let h = 2e-7;
        for motion in [Motion::Internal, Motion::Host] {
            let (model, excitation) = lively([motion; 2], Damping::HuntCrossley(0.3), 0.2);
            let (state, cells) = moving(&model, &excitation, 5);
            let end = integrated(&model, &excitation, &state, &cells, h);
            let mut forces = Forces::new(model.element_count);
            let mut rates = [vec![0.0; state.len()], vec![0.0; state.len()]];
            for ((at, tau), rates) in [(&state, 0.0), (&end, h)].into_iter().zip(&mut rates) {
                model.derivative(&excitation, tau, &cells, at, rates, &mut forces);
            }
            let known = |state, derivative, tau| Known { cage: excitation.cage_at(tau), state, derivative };
            let ends = [known(&state[..], &rates[0][..], 0.0), known(&end, &rates[1], h)];
            for share in [0.3, 0.7] {
                let mut found = vec![0.0; state.len()];
                let cage = excitation.cage_at(share * h);
                let pieces = &mut forces.shortcuts.leads;
                let between = Between { length: h, share, cage: &cage };
                model.dense_output(Scalar256b, &excitation, ends, between, pieces, &mut found);
                let expected = integrated(&model, &excitation, &state, &cells, share * h);
                for i in (0..state.len()).filter(|&i| model.layout.is_used(i)) {
                    let limit = if model.layout.is_position(i) { 1e-16 } else { 2e-9 };
                    let miss = (found[i] - expected[i]).abs();
                    assert!(miss < limit, "{}: {miss:e} at {share}", model.layout.name(i));
                }
            }
        }
    }
}
