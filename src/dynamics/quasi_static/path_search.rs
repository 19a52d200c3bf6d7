//! The search for the path at which an element is in radial balance.

use super::tangent::RadialForce;
use crate::dynamics::contacts::Linearized;
use crate::dynamics::parameters::Model;

/// Longest of Newton's steps (m).
const LONGEST_STEP: f64 = 50e-6;
/// Longest way at once where nothing brackets the balance (m).
const LONGEST_STRIDE: f64 = 1.0;
/// Share of the forces on an element that may be left of its balance: far above rounding, far below what matters.
const RESIDUAL: f64 = 1e-9;
/// Share of an element's distance to which its position is known: some roundings.
const ROUNDING: f64 = 1e-14;

/// Newton's method within the bracket that the signs of the force give, which falls as the path grows; where it would
/// leave that or leap, halving, or as long as there is no bracket walking on to where the element is pushed.
pub(in crate::dynamics) struct PathSearch {
    low: f64,
    high: f64,
    /// Length of the last step of a walk (m); each next one is twice as long.
    stride: f64,
}

impl PathSearch {
    /// A search between these paths (m); `stride`: half the first step of a walk (m).
    pub(in crate::dynamics) fn between(low: f64, high: f64, stride: f64) -> Self {
        Self { low, high, stride }
    }

    /// Where to look after path `u` (m), at which the element is pushed outwards with `force` (N) and Newton's method
    /// goes to `newton` (m); nowhere if nothing is left between the brackets, or none within a metre.
    pub(in crate::dynamics) fn next(&mut self, u: f64, force: f64, newton: f64) -> Option<f64> {
        if force > 0.0 {
            self.low = u
        } else {
            self.high = u
        }
        let Self { low, high, .. } = *self;
        let next = if newton > low && newton < high && (newton - u).abs() < LONGEST_STEP {
            newton
        } else if low.is_finite() && high.is_finite() {
            0.5 * (low + high)
        } else {
            self.stride *= 2.0;
            if force > 0.0 { u + self.stride } else { u - self.stride }
        };
        (next > low && next < high && self.stride <= LONGEST_STRIDE).then_some(next)
    }

    /// The other end of the bracket, seen from one at which the element is pushed outwards with `force` (N), if no path
    /// is left between the two.
    pub(in crate::dynamics) fn neighbour(&self, force: f64) -> Option<f64> {
        let Self { low, high, .. } = *self;
        let middle = 0.5 * (low + high);
        (middle == low || middle == high).then_some(if force > 0.0 { high } else { low })
    }
}

impl Model {
    /// As [`Model::radial_force`], where contacts need not have an answer: an inner contact too deep for its law
    /// pushes outwards, whatever its force. One outside is taken for one that pushes inwards: NaN is not above 0.
    pub(in crate::dynamics) fn radial_push(&self, element: &Linearized) -> RadialForce {
        let RadialForce { force, slope } = self.radial_force(element);
        let too_deep = element.inner.force.x.is_nan() && !element.outer.force.x.is_nan();
        RadialForce { force: if too_deep { f64::INFINITY } else { force }, slope }
    }

    /// Radial force (N) on an element that counts as none where its path resolves its forces.
    pub(in crate::dynamics) fn no_force(&self, element: &Linearized) -> f64 {
        let (j, omega) = (element.at.element, element.at.omega);
        let radius = self.centrifugal_radius(j, element.rho);
        let body = self.mass_of(j) * (self.gravity.norm() + radius * omega * omega);
        RESIDUAL * (body + element.inner.force.norm() + element.outer.force.x.abs())
    }

    /// Radial force (N) that counts as none on an element whose force changes by `slope` (N/m) with its path.
    pub(in crate::dynamics) fn no_force_at(&self, element: &Linearized, slope: f64) -> f64 {
        self.no_force(element) + ROUNDING * element.rho * slope.abs()
    }
}
