//! One element in radial balance between rings at rest.

use crate::dynamics::contacts::{Linearized, Shortcuts};
use crate::dynamics::parameters::{FramedKinematics, Model, PathMotion, SMOOTH};
use crate::dynamics::quasi_static::{PathSearch, RadialForce};

/// First step of an element's search that its last path does not begin (m).
const FIRST_STRIDE: f64 = 1e-6;

/// An element in radial balance.
pub(super) struct ElementAtRest {
    /// Its path (m).
    pub(super) path: f64,
    /// Its contacts, with the forces of the balance.
    pub(super) element: Linearized,
    /// Where the balance lies between this path and the next number: that of the two at which less force is left.
    pub(super) nearer: Option<f64>,
}

impl Model {
    /// Element `j` in radial balance, looked for from path `guess` on.
    pub(super) fn balanced_element(
        &self,
        j: usize,
        cells: [[u32; 2]; 2],
        guess: f64,
        now: &FramedKinematics,
        shortcuts: &mut Shortcuts,
    ) -> ElementAtRest {
        let at = self.element_motion(j, PathMotion::at_rest(guess), now, shortcuts).searched();
        let touch = match cells[1] {
            [SMOOTH, SMOOTH] => 0.0,
            cells => self.touching_path(j, cells, at.angle, &at.frames, shortcuts),
        };
        let mut element = |u: f64| {
            let element = self.linearized(cells, &at.on_path(u, 0.0), shortcuts);
            (self.radial_push(&element), element)
        };
        let (RadialForce { force: at_touch, .. }, touching) = element(touch);
        if at_touch == 0.0 {
            return ElementAtRest { path: touch, element: touching, nearer: None };
        }
        let (low, high) = if at_touch > 0.0 { (touch, f64::INFINITY) } else { (f64::NEG_INFINITY, touch) };
        let mut u = if guess > low && guess < high { guess } else { touch + FIRST_STRIDE.copysign(at_touch) };
        let mut search = PathSearch::between(low, high, FIRST_STRIDE);
        let mut found = element(u);
        for _ in 0..300 {
            let (RadialForce { force, slope }, there) = found;
            let newton = u - force / slope;
            // A millionth of a millionth of a nanometre: the rounding of micrometre paths.
            if force == 0.0 || ((newton - u).abs() < 1e-21 && force.abs() <= self.no_force(&there)) {
                return ElementAtRest { path: u, element: there, nearer: None };
            }
            let Some(next) = search.next(u, force, newton) else { break };
            u = next;
            found = element(u);
        }
        let (RadialForce { force, slope }, here) = found;
        if force.abs() <= self.no_force(&here) || !force.is_finite() {
            return ElementAtRest { path: u, element: here, nearer: None };
        }
        let beside = search.neighbour(force).map(|path| (path, element(path)));
        match beside {
            Some((path, (other, there))) if force * other.force < 0.0 && other.force.is_finite() => {
                let share = force / (force - other.force);
                let mut between = here;
                between.inner.force += (there.inner.force - here.inner.force) * share;
                between.outer.force += (there.outer.force - here.outer.force) * share;
                let nearer = if force.abs() <= other.force.abs() { u } else { path };
                // Where it pushes its tangent is that of what it does between the two.
                let path = if slope.abs() >= other.slope.abs() { u } else { path };
                ElementAtRest { path, element: between, nearer: Some(nearer) }
            }
            _ => ElementAtRest { path: u, element: here, nearer: None },
        }
    }
}
