//! Second derivatives of law `love`: one or two more solutions with the factor of the last contact.
//!
//! On the pressed cells K p = g, with g = u − h(x − s) and W = ½ Σ p g. While their set stays as it is,
//!
//! ```text
//! W_uu = 1ᵀ K⁻¹ 1    W_us = g_sᵀ K⁻¹ 1    W_ss = g_sᵀ K⁻¹ g_s + Σ p g_ss,    g_s = h′, g_ss = −h″
//! ```
//!
//! with ½ in place of 1 in a row that lies on the middle of mirrored halves, in g, g_s and g_ss alike. A surface that
//! varies across the raceway adds the element's place there, y, as a third variable: the slope ∂W/∂y = Σ p g_y is for
//! the asking with the last contact, and the second derivatives go on in the same way (g_sy = 0).

use super::love_contact::{Layer, LoveContact};
use super::raceway_grid::RacewayGrid;
use super::row_pairs::PressedCell;
use super::smooth_scale::Energy;
use crate::contact::equivalent::{EquivalentApproach, SecondDerivatives};
use crate::contact::error::ContactError;

impl LoveContact {
    /// As [`LoveContact::solve`], with the second derivatives along the path, which cost two triangular solutions more.
    ///
    /// # Errors
    /// As [`LoveContact::solve`].
    pub(in crate::contact) fn solve_along_path(&mut self, u: f64, s: f64) -> Result<EquivalentApproach, ContactError> {
        let found = self.solve(u, s)?;
        Ok(self.along_path(u, s, found))
    }

    /// As [`LoveContact::continued`], with the second derivatives along the path.
    pub(in crate::contact) fn continued_along_path(
        &mut self,
        u: f64,
        s: f64,
    ) -> Result<EquivalentApproach, ContactError> {
        let found = self.continued(u, s)?;
        Ok(self.along_path(u, s, found))
    }

    /// What was found last with its second derivatives along the path, which are 0 where it was continued.
    fn along_path(&mut self, u: f64, s: f64, found: EquivalentApproach) -> EquivalentApproach {
        if u <= self.first_touch(s) || found.value < self.smooth.onset() {
            return found;
        }
        let [duu, dus] = self.by_path();
        EquivalentApproach { duu, dus, ..found }
    }

    /// Second derivatives where [`LoveContact::solve`] has value and slopes, exact for the pressed cells of that
    /// contact: they step where a cell joins or leaves these and at the nodes of the smooth raceway's energy.
    ///
    /// Below the smallest contact, from whose path u₀ Δ is continued, ∂²Δ/∂u² = 0 and ∂²Δ/∂u∂s is that of Δ and of
    /// ∂Δ/∂u. What `solve` has as ∂Δ/∂s lacks (u − u₀) ∂²Δ/∂u∂s there, and ∂²Δ/∂s² lacks (u − u₀) ∂³Δ/∂u∂s². At u₀
    /// the slopes themselves step by some per cent, and rounding decides which of them is continued.
    ///
    /// # Errors
    /// As [`LoveContact::solve`].
    pub fn second_derivatives(&mut self, u: f64, s: f64) -> Result<SecondDerivatives, ContactError> {
        let touch = self.first_touch(s);
        if self.is_far(u, touch) {
            return Ok(SecondDerivatives::default());
        }
        if u > touch && self.equivalent(u, s)?.value >= self.smooth.onset() {
            return Ok(self.of_last_contact(s));
        }
        let (_, found) = self.at_onset(s, touch)?;
        let SecondDerivatives { uu, us, ss } = self.of_last_contact(s);
        // Along the onset du₀/ds = −Δ_s/Δ_u; Δ = Δ(u₀) + Δ_u(u₀, s) (u − u₀).
        let turn = -found.ds / found.du;
        Ok(SecondDerivatives { uu: 0.0, us: us + uu * turn, ss: ss - uu * turn * turn })
    }

    /// As [`LoveContact::solve`], of an element at `place` (m) across the raceway, with ∂Δ/∂place; 0 of a profile.
    ///
    /// # Errors
    /// As [`LoveContact::solve`].
    pub fn solve_across(&mut self, u: f64, s: f64, place: f64) -> Result<(EquivalentApproach, f64), ContactError> {
        if self.grid().mirrored() {
            return Ok((self.solve(u, s)?, 0.0));
        }
        self.move_across(place)?;
        let found = self.solve(u, s)?;
        let is_far = self.is_far(u, self.first_touch(s));
        Ok((found, if is_far { 0.0 } else { self.slopes_of_last(s)[2] }))
    }

    /// Second derivatives of the same by path, arc and place across, as exact as
    /// [those by path and arc](LoveContact::second_derivatives).
    ///
    /// # Errors
    /// As [`LoveContact::solve`].
    pub fn second_derivatives_across(&mut self, u: f64, s: f64, place: f64) -> Result<[[f64; 3]; 3], ContactError> {
        self.move_across(place)?;
        let touch = self.first_touch(s);
        if self.is_far(u, touch) {
            return Ok([[0.0; 3]; 3]);
        }
        if u > touch && self.equivalent(u, s)?.value >= self.smooth.onset() {
            return Ok(self.second_of_last(s));
        }
        self.at_onset(s, touch)?;
        let ([by_path, by_arc, by_place], mut second) = (self.slopes_of_last(s), self.second_of_last(s));
        let (uu, turns) = (second[0][0], [1.0, -by_arc / by_path, -by_place / by_path]);
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let way = if i == 0 || j == 0 { 1.0 } else { -1.0 };
            second[i][j] += way * uu * turns[i] * turns[j];
        }
        second[0][0] = 0.0;
        Ok(second)
    }

    /// Puts the element at another place across the raceway (m), over a grid that is wide enough.
    fn move_across(&mut self, place: f64) -> Result<(), ContactError> {
        let largest = self.largest_approach();
        self.layers.iter_mut().try_for_each(|layer| layer.move_across(place, largest))
    }

    /// Slopes of Δ by path, arc and place across of the contact that was solved last, at arc `s` (m).
    fn slopes_of_last(&self, s: f64) -> [f64; 3] {
        let (w, slopes) = self.mean_of_last(s);
        self.smooth.slopes(w, slopes)
    }

    /// The same of the energy, and the energy.
    fn mean_of_last(&self, s: f64) -> (f64, [f64; 3]) {
        let (part, mut w, mut slopes) = (1.0 / self.layers.len() as f64, 0.0, [0.0; 3]);
        for layer in &self.layers {
            w += part * layer.energy.w;
            for PressedCell { row, column, pressure, .. } in layer.solver.cells() {
                let by = layer.grid.slopes(row, column, s);
                (0..3).for_each(|i| slopes[i] += part * pressure * by[i]);
            }
        }
        (w, slopes)
    }

    /// Second derivatives of Δ by path, arc and place across of the contact that was solved last, at arc `s` (m).
    fn second_of_last(&mut self, s: f64) -> [[f64; 3]; 3] {
        let ((w, slopes), part) = (self.mean_of_last(s), 1.0 / self.layers.len() as f64);
        let mut second = [[0.0; 3]; 3];
        for layer in &mut self.layers {
            let of = layer.second_across(s);
            (0..9).for_each(|k| second[k / 3][k % 3] += part * of[k / 3][k % 3]);
        }
        self.smooth.second(w, slopes, second)
    }

    /// Second derivatives along the path of the contact that was solved last.
    fn by_path(&mut self) -> [f64; 2] {
        let (mut energy, mut second) = (Energy::default(), [0.0; 2]);
        let part = 1.0 / self.layers.len() as f64;
        for layer in &mut self.layers {
            energy.add(&layer.energy, part);
            let of = layer.by_path();
            second = [0, 1].map(|i| second[i] + part * of[i]);
        }
        self.smooth.by_path(energy, second)
    }

    /// Of the contact that was solved last, at arc `s` (m).
    fn of_last_contact(&mut self, s: f64) -> SecondDerivatives {
        let (mut energy, mut sum) = (Energy::default(), SecondDerivatives::default());
        let part = 1.0 / self.layers.len() as f64;
        for layer in &mut self.layers {
            energy.add(&layer.energy, part);
            let SecondDerivatives { uu, us, ss } = layer.second_derivatives(s);
            sum = SecondDerivatives { uu: sum.uu + part * uu, us: sum.us + part * us, ss: sum.ss + part * ss };
        }
        self.smooth.second_derivatives(energy, sum)
    }
}

impl Layer {
    /// W_uu and W_us of the last contact (see `second_derivatives`).
    fn by_path(&mut self) -> [f64; 2] {
        self.apply_inverse(|_, _, _| 1.0);
        let mut second = [0.0; 2];
        for PressedCell { row, column, unknown, .. } in self.solver.cells() {
            let by_u = self.grid.share(row) * self.unit[unknown];
            second[0] += by_u;
            second[1] += by_u * self.slopes[(column - self.first) as usize];
        }
        second
    }

    /// Of the energy of the last contact, without the factor π E* × cell area.
    fn second_derivatives(&mut self, s: f64) -> SecondDerivatives {
        let mut of = SecondDerivatives::default();
        self.apply_inverse(|_, _, _| 1.0);
        for PressedCell { row, column, unknown, .. } in self.solver.cells() {
            let by_u = self.grid.share(row) * self.unit[unknown];
            of.uu += by_u;
            of.us += by_u * self.grid.gap_derivatives(column, s)[0];
        }
        self.apply_inverse(|grid, _, column| grid.gap_derivatives(column, s)[0]);
        for PressedCell { row, column, unknown, pressure } in self.solver.cells() {
            let [slope, second] = self.grid.gap_derivatives(column, s);
            of.ss += self.grid.share(row) * (slope * self.unit[unknown] - pressure * second);
        }
        of
    }

    /// The same by path, arc and place across, of a grid that is not mirrored.
    fn second_across(&mut self, s: f64) -> [[f64; 3]; 3] {
        let mut of = [[0.0; 3]; 3];
        for i in 0..3 {
            self.apply_inverse(|grid, row, column| grid.slopes(row, column, s)[i]);
            for PressedCell { row, column, unknown, .. } in self.solver.cells() {
                let by = self.grid.slopes(row, column, s);
                (0..3).for_each(|j| of[i][j] += by[j] * self.unit[unknown]);
            }
        }
        for PressedCell { row, column, pressure, .. } in self.solver.cells() {
            of[1][1] -= pressure * self.grid.gap_derivatives(column, s)[1];
            of[2][2] -= pressure * self.grid.across_derivatives(row)[1];
        }
        of
    }

    /// K⁻¹ on the pressed cells of the last contact, applied to a function of row and column.
    fn apply_inverse(&mut self, value: impl Fn(&RacewayGrid, usize, i32) -> f64) {
        self.solver.right_hand_side(&mut self.unit);
        for PressedCell { row, column, unknown, .. } in self.solver.cells() {
            self.unit[unknown] = self.grid.share(row) * value(&self.grid, row, column);
        }
        self.solver.apply_inverse(&mut self.unit);
    }
}

impl RacewayGrid {
    /// First and second derivative (–, 1/m) of the gap in a column by t = x − s, the element at arc `s` (m).
    fn gap_derivatives(&self, column: i32, s: f64) -> [f64; 2] {
        let t = self.centre(column) - s;
        [self.element.along(t)[1], self.element.along_second(t)]
    }

    /// The same of a row by the distance from the element's middle.
    fn across_derivatives(&self, row: usize) -> [f64; 2] {
        self.element.across_derivatives(self.row_offset(row))
    }

    /// Derivatives of a cell's interference by path, arc and place across the raceway.
    fn slopes(&self, row: usize, column: i32, s: f64) -> [f64; 3] {
        [1.0, self.gap_derivatives(column, s)[0], self.across_derivatives(row)[0]]
    }
}
