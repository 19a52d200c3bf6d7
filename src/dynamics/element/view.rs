//! How a ring sees an element: from its own centre, from a centre that is shifted, along an axis that is tilted.
//!
//! With q from the ring's centre to the element's, along e_r, e_t and the bearing's axis z, the ring's axis a = ẑ
//! unless it is tilted by φ, a = (φ_y, −φ_x, 1)/|…|, and w = q_t² + (q_z − h)(q_z + h):
//! ```text
//! h = q·a    g = √(q_r² + w)    x = g − (R_o − r) = u + p + w/(g + q_r)    p = q_r − ρ
//! ḣ = q̇·a + q·ȧ                 ẋ = (q·q̇ − h ḣ)/g
//! F = A q + B a    A = F_g/g    B = F_h − A h        moment about the ring's centre q × F = B q × a
//! ```
//! for a force F_g away from the ring's axis and F_h along it. x is summed from small numbers: of distances of 20 mm
//! nothing is lost.

use super::{Element, Meridian};
use crate::numerics::number::Number;

/// How a ring of `C` coordinates, x and y, or x, y, z and its tilts, sees elements of `P`.
pub(in crate::dynamics) trait View<T: Number, const P: usize, const C: usize>: Copy {
    /// What is known of an element once it is seen.
    type Seen: Copy;

    /// An element in the ring's meridian plane.
    fn see(&self, element: &Element<T, P>) -> (Meridian<T, P>, Self::Seen);

    /// Parts along e_r, and the axis, of a force (N) that has these parts away from the ring's axis, and along it; and
    /// its part along e_t, where there is one.
    fn on_element(seen: &Self::Seen, force: [T; P]) -> ([T; P], Option<T>);

    /// The same force along the ring's coordinates, and its moments about the ring's centre (N, N m): the opposite acts
    /// on the ring.
    fn along_ring(element: &Element<T, P>, seen: &Self::Seen, force: [T; P]) -> [T; C];
}

/// The ring that elements' paths count from: it sees them straight outwards.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Concentric;

/// A ring whose centre the outer ring's is this far before (m), and goes away from (m/s). With `SERIES`, of rings
/// nearly concentric, g − q_r and the direction of q are series in q_t/q_r.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Shifted<T, const D: usize, const SERIES: bool> {
    pub(in crate::dynamics) offset: [T; D],
    pub(in crate::dynamics) drift: [T; D],
}

/// An element as a shifted ring sees it.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Beside<T> {
    /// q along e_r and e_t (m).
    q: [T; 2],
    /// Its direction there.
    n: [T; 2],
    /// q_z (m), where there is one.
    height: Option<T>,
}

/// The same of a ring that is tilted.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Tilted<T> {
    offset: [T; 3],
    drift: [T; 3],
    /// a and ȧ along x, y and z.
    axis: [T; 3],
    turning: [T; 3],
}

/// An element as a tilted ring sees it.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Aslant<T> {
    /// q and a along e_r, e_t and z.
    q: [T; 3],
    axis: [T; 3],
    /// h (m) and 1/g.
    height: T,
    per_distance: T,
}

/// |q| − q_r (m), the direction of q and |q| (m), of q along e_r and e_t. `series`: series in t/q_r
/// ([`Model::nearly_concentric`](crate::dynamics::parameters::Model)).
#[inline(always)]
pub(in crate::dynamics) fn off_centre<T: Number>([q_r, t]: [T; 2], series: bool) -> (T, [T; 2], T) {
    if series {
        let slope = t / q_r;
        let (x, number) = (slope * slope, |number| t.all(number));
        let n_r = number(1.0) - x * (number(0.5) - x * t.plain(0.375));
        let longer = t * slope * (number(0.5) - x * (number(0.125) - x * t.plain(0.0625)));
        (longer, [n_r, slope * n_r], q_r + longer)
    } else {
        let square = t * t;
        let distance = (q_r * q_r + square).sqrt();
        (square / (distance + q_r), [q_r / distance, t / distance], distance)
    }
}

/// v along e_r and the direction counter-clockwise of it.
#[inline(always)]
fn along<T: Number>([e_x, e_y]: [T; 2], x: T, y: T) -> [T; 2] {
    [x * e_x + y * e_y, y * e_x - x * e_y]
}

/// Parts along x and y of parts along e_r and e_t.
#[inline(always)]
fn turned_back<T: Number>([e_x, e_y]: [T; 2], r: T, t: T) -> [T; 2] {
    [r * e_x - t * e_y, r * e_y + t * e_x]
}

/// A force along a ring's coordinates; `others` are its part along z, and its moments along e_r and e_t.
#[inline(always)]
fn by_coordinates<T: Number, const C: usize>(e_r: [T; 2], force: [T; 2], others: impl FnOnce() -> [T; 3]) -> [T; C] {
    let [x, y] = turned_back(e_r, force[0], force[1]);
    let mut found = [x; C];
    found[1] = y;
    if C > 2 {
        let [f_z, m_r, m_t] = others();
        let [m_x, m_y] = turned_back(e_r, m_r, m_t);
        (found[2], found[3], found[4]) = (f_z, m_x, m_y);
    }
    found
}

impl<T: Number, const P: usize, const C: usize> View<T, P, C> for Concentric {
    type Seen = ();

    #[inline(always)]
    fn see(&self, element: &Element<T, P>) -> (Meridian<T, P>, ()) {
        (Meridian { at: element.at, rate: element.rate }, ())
    }

    #[inline(always)]
    fn on_element((): &(), force: [T; P]) -> ([T; P], Option<T>) {
        (force, None)
    }

    #[inline(always)]
    fn along_ring(element: &Element<T, P>, (): &(), force: [T; P]) -> [T; C] {
        let ([e_x, e_y], outwards) = (element.e_r, force[0]);
        let mut found = [outwards * e_x; C];
        found[1] = outwards * e_y;
        if C > 2 {
            let moment = element.at[P - 1] * outwards - element.rho * force[P - 1];
            (found[2], found[3], found[4]) = (force[P - 1], -(moment * e_y), moment * e_x);
        }
        found
    }
}

impl<T: Number, const P: usize, const C: usize, const D: usize, const SERIES: bool> View<T, P, C>
    for Shifted<T, D, SERIES>
{
    type Seen = Beside<T>;

    #[inline(always)]
    fn see(&self, element: &Element<T, P>) -> (Meridian<T, P>, Beside<T>) {
        let ([p, t], drift) =
            (along(element.e_r, self.offset[0], self.offset[1]), along(element.e_r, self.drift[0], self.drift[1]));
        let q_r = element.rho + p;
        let (longer, n, _) = off_centre([q_r, t], SERIES);
        let (mut at, mut rate) = (element.at, element.rate);
        at[0] = at[0] + p + longer;
        rate[0] = n[0] * (drift[0] + rate[0]) + n[1] * (drift[1] + element.rho * element.omega);
        let mut height = None;
        for k in 1..P {
            at[k] = at[k] + self.offset[k + 1];
            rate[k] = rate[k] + self.drift[k + 1];
            height = Some(at[k]);
        }
        (Meridian { at, rate }, Beside { q: [q_r, t], n, height })
    }

    #[inline(always)]
    fn on_element(seen: &Beside<T>, force: [T; P]) -> ([T; P], Option<T>) {
        let mut parts = force;
        parts[0] = force[0] * seen.n[0];
        (parts, Some(force[0] * seen.n[1]))
    }

    #[inline(always)]
    fn along_ring(element: &Element<T, P>, seen: &Beside<T>, force: [T; P]) -> [T; C] {
        let [f_r, f_t] = seen.n.map(|n| force[0] * n);
        by_coordinates(element.e_r, [f_r, f_t], || {
            let (f_z, [q_r, q_t]) = (force[P - 1], seen.q);
            let q_z = seen.height.unwrap_or(q_r);
            [f_z, q_t * f_z - q_z * f_t, q_z * f_r - q_r * f_z]
        })
    }
}

impl<T: Number> Tilted<T> {
    /// Of a ring whose centre the outer ring's is `offset` (m) before, and goes away from at `drift` (m/s), tilted
    /// (rad) about x and y, and tilting (rad/s).
    #[inline(always)]
    pub(in crate::dynamics) fn new(
        [offset, drift]: [[T; 3]; 2],
        [about_x, about_y]: [T; 2],
        [rate_x, rate_y]: [T; 2],
    ) -> Self {
        let per_square = about_x.all(1.0) / (about_x * about_x + about_y * about_y + about_x.plain(1.0));
        let per_length = per_square.sqrt();
        let axis = [about_y * per_length, -about_x * per_length, per_length];
        let shrinking = (about_x * rate_x + about_y * rate_y) * per_square;
        let turning = [
            rate_y * per_length - axis[0] * shrinking,
            -rate_x * per_length - axis[1] * shrinking,
            -(axis[2] * shrinking),
        ];
        Self { offset, drift, axis, turning }
    }
}

/// a·b
#[inline(always)]
fn dot<T: Number>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl<T: Number> View<T, 2, 5> for Tilted<T> {
    type Seen = Aslant<T>;

    #[inline(always)]
    fn see(&self, element: &Element<T, 2>) -> (Meridian<T, 2>, Aslant<T>) {
        let here = |[x, y, z]: [T; 3]| {
            let [r, t] = along(element.e_r, x, y);
            [r, t, z]
        };
        let ([p, q_t, z], [drift_r, drift_t, drift_z]) = (here(self.offset), here(self.drift));
        let (axis, turning) = (here(self.axis), here(self.turning));
        let ([u, v], [u_rate, v_rate]) = (element.at, element.rate);
        let q = [element.rho + p, q_t, v + z];
        let rate = [drift_r + u_rate, drift_t + element.rho * element.omega, v_rate + drift_z];
        let (height, rising) = (dot(q, axis), dot(rate, axis) + dot(q, turning));
        let beside = q_t * q_t + (q[2] - height) * (q[2] + height);
        let distance = (q[0] * q[0] + beside).sqrt();
        let outwards = u + p + beside / (distance + q[0]);
        let per_distance = distance.all(1.0) / distance;
        let going = (dot(q, rate) - height * rising) * per_distance;
        (Meridian { at: [outwards, height], rate: [going, rising] }, Aslant { q, axis, height, per_distance })
    }

    #[inline(always)]
    fn on_element(seen: &Aslant<T>, force: [T; 2]) -> ([T; 2], Option<T>) {
        let [r, t, z] = seen.along(force).0;
        ([r, z], Some(t))
    }

    #[inline(always)]
    fn along_ring(element: &Element<T, 2>, seen: &Aslant<T>, force: [T; 2]) -> [T; 5] {
        let ([f_r, f_t, f_z], along) = seen.along(force);
        let ([q_r, q_t, q_z], [a_r, a_t, a_z]) = (seen.q, seen.axis);
        by_coordinates(element.e_r, [f_r, f_t], || {
            [f_z, along * (a_z * q_t - a_t * q_z), along * (a_r * q_z - a_z * q_r)]
        })
    }
}

impl<T: Number> Aslant<T> {
    /// A force along e_r, e_t and z, and B.
    #[inline(always)]
    fn along(&self, [outwards, along]: [T; 2]) -> ([T; 3], T) {
        let by_q = outwards * self.per_distance;
        let by_axis = along - by_q * self.height;
        let part = |i: usize| by_q * self.q[i] + by_axis * self.axis[i];
        ([part(0), part(1), part(2)], by_axis)
    }
}
