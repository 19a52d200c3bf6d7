//! What is kept of each contact.

use crate::dynamics::parameters::{Model, Space};
use crate::numerics::lanes::row::Row;
use crate::numerics::lanes::{WIDEST, blocks_mut};

/// Lists of a [`Record`], in the order of [`Record::smooth_contacts`].
pub(super) type Lists<'a> = [&'a mut [[f64; WIDEST]]; 12];

/// What is kept of each contact, for whoever wants to know more than the sums. Its lists are made once.
#[derive(Debug, Clone, Default)]
pub struct Record {
    /// Force of the inner contact Q_i of each element (N).
    pub inner: Row,
    /// Direction of q of each element, its radial part.
    pub normal_radial: Row,
    /// Direction of q of each element, its tangential part.
    pub normal_tangential: Row,
    /// Force of the outer contact of each element (N).
    pub outer: Row,
    /// Outer contact force on each element, inwards (N).
    pub outer_radial: Row,
    /// Outer contact force on each element, counter-clockwise (N).
    pub outer_tangential: Row,
    /// Approach of the inner contact (m): negative when there is a gap.
    pub inner_approach: Row,
    /// Equivalent approach of the outer contact (m).
    pub outer_approach: Row,
    /// How clearly the inner contact pushes ([`crate::contact::law::ForceLaw::pushing`]) (m).
    pub inner_pushing: Row,
    /// How clearly the outer contact pushes (m).
    pub outer_pushing: Row,
    /// u' of each element (m/s).
    pub path_rate: Row,
    /// Path u (m) and absolute radial velocity w (m/s) of each element that is in balance at every instant; empty for
    /// others, whose state has them.
    pub balanced: [Row; 2],
    /// In space: parts of the direction of the inner contact's force away from the inner ring's axis and along it, then
    /// of the outer contact's from the outer ring's; empty in the plane.
    pub meridians: [Row; 4],
}

impl Record {
    /// Path (m) of each element in `state`, of which these are the contacts: where it is, or where it is in balance.
    /// There may be more slots than elements.
    #[inline]
    pub fn paths<'a>(&'a self, model: &Model, state: &'a [f64]) -> &'a [f64] {
        if model.elements_in_balance() { &self.balanced[0] } else { state }
    }

    /// Axial position (m) of each ball in space; its slots are as those of the [paths](Self::paths).
    pub fn axial_positions<'a>(&'a self, model: &Model, state: &'a [f64]) -> &'a [f64] {
        let start = model.layout.axial().map_or(0, |[v, _]| v);
        &self.paths(model, state)[start..]
    }

    /// Contact angle (rad) of element `j` on the inner (0) or the outer (1) raceway; 0 of a contact without force.
    pub fn contact_angle(&self, space: &Space, j: usize, side: usize) -> f64 {
        if [&self.inner, &self.outer][side][j] > 0.0 {
            space.grooves[side].angle([0, 1].map(|part: usize| self.meridians[2 * side + part][j]))
        } else {
            0.0
        }
    }

    /// θ_s − |α| − a/r_g (rad): the angle from the end of a contact's ellipse to the shoulder; negative where the
    /// shoulder cuts the ellipse. Of a contact without force the angle to the groove's bottom.
    pub fn shoulder_margin(&self, space: &Space, j: usize, side: usize) -> f64 {
        let force = [&self.inner, &self.outer][side][j];
        space.shoulder_margin(side, self.contact_angle(space, j, side), force)
    }

    /// The lists that smooth contacts of elements of `P` coordinates are kept in, looked up once for all elements.
    #[inline(always)]
    pub(super) fn smooth_contacts<const P: usize>(&mut self) -> Lists<'_> {
        let [inner_across, inner_along, outer_across, outer_along] = &mut self.meridians;
        let [a, b, c, d] = if P == 1 {
            [&mut self.normal_radial, &mut self.normal_tangential, &mut self.outer_radial, outer_along]
        } else {
            [inner_across, inner_along, outer_across, outer_along]
        };
        [
            blocks_mut(&mut self.inner),
            blocks_mut(&mut self.outer),
            blocks_mut(&mut self.outer_tangential),
            blocks_mut(&mut self.inner_approach),
            blocks_mut(&mut self.outer_approach),
            blocks_mut(&mut self.inner_pushing),
            blocks_mut(&mut self.outer_pushing),
            blocks_mut(&mut self.path_rate),
            blocks_mut(a),
            blocks_mut(b),
            blocks_mut(c),
            blocks_mut(d),
        ]
    }

    /// Room for `slots` elements.
    pub(in crate::dynamics) fn new(slots: usize) -> Self {
        let zeros = || Row::zeros(slots);
        Self {
            inner: zeros(),
            normal_radial: zeros(),
            normal_tangential: zeros(),
            outer: zeros(),
            outer_radial: zeros(),
            outer_tangential: zeros(),
            inner_approach: zeros(),
            outer_approach: zeros(),
            inner_pushing: zeros(),
            outer_pushing: zeros(),
            path_rate: zeros(),
            balanced: [Row::zeros(0), Row::zeros(0)],
            meridians: [(); 4].map(|()| Row::zeros(0)),
        }
    }
}
