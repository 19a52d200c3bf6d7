//! How a ring sees an element: from its own centre, from a centre that is shifted, along an axis that is tilted.
//!
//! With q from the ring's centre to the element's, along e_r, e_t and the bearing's axis z, the ring's axis a = ẑ
//! unless it is tilted by φ, a = (φ_y, −φ_x, 1)/|…|, and w = q_t² + (q_z − h)(q_z + h):
//! ```text
//! h = q·a    g = √(q_r² + w)    x = g − (R_o − r) = u + p + w/(g + q_r)    p = q_r − ρ
//! ḣ = q̇·a + q·ȧ                 ẋ = (q·q̇ − h ḣ)/g
//! F = A q + B a    A = F_g/g    B = F_h − A h        moment about the ring's centre q × F = B q × a
//! ```
//! for a force F_g away from the ring's axis and F_h along it. Around the axis, along t_φ = a × q/g, the element goes
//! with φ̇ = t_φ·(q̇ − h ȧ)/g. x is summed from small numbers: of distances of 20 mm nothing is lost.

use super::{Element, Meridian};
use crate::dynamics::parameters::{COORDINATES, RingInSpace};
use crate::numerics::number::{Number, Scalar};

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
    /// q (m) and a along e_r, e_t and z.
    pub(in crate::dynamics) q: [T; 3],
    pub(in crate::dynamics) axis: [T; 3],
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
pub(in crate::dynamics) fn along<T: Number>([e_x, e_y]: [T; 2], x: T, y: T) -> [T; 2] {
    [x * e_x + y * e_y, y * e_x - x * e_y]
}

/// Parts along x and y of parts along e_r and e_t.
#[inline(always)]
pub(in crate::dynamics) fn turned_back<T: Number>([e_x, e_y]: [T; 2], r: T, t: T) -> [T; 2] {
    [r * e_x - t * e_y, r * e_y + t * e_x]
}

/// A force along a ring's coordinates; of rings with more than x and y `others` are its part along z, and its moments
/// along e_r and e_t.
#[inline(always)]
fn by_coordinates<T: Number, const C: usize>(e_r: [T; 2], force: [T; 2], [f_z, m_r, m_t]: [T; 3]) -> [T; C] {
    let [x, y] = turned_back(e_r, force[0], force[1]);
    let mut found = [x; C];
    found[1] = y;
    if C > 2 {
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
        let (f_z, [q_r, q_t]) = (force[P - 1], seen.q);
        let q_z = seen.height.unwrap_or(q_r);
        by_coordinates(element.e_r, [f_r, f_t], [f_z, q_t * f_z - q_z * f_t, q_z * f_r - q_r * f_z])
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
pub(in crate::dynamics) fn dot<T: Number>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b
#[inline(always)]
pub(in crate::dynamics) fn cross<T: Number>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

impl<T: Number> View<T, 2, 5> for Tilted<T> {
    type Seen = Aslant<T>;

    #[inline(always)]
    fn see(&self, element: &Element<T, 2>) -> (Meridian<T, 2>, Aslant<T>) {
        let ([u, v], here) = (element.at, |of| here(element.e_r, of));
        let ([p, q_t, z], axis) = (here(self.offset), here(self.axis));
        let (rate, turning) = self.going(element);
        let q = [element.rho + p, q_t, v + z];
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
        let moments = [along * (a_z * q_t - a_t * q_z), along * (a_r * q_z - a_z * q_r)];
        by_coordinates(element.e_r, [f_r, f_t], [f_z, moments[0], moments[1]])
    }
}

/// How the inner and the outer ring see what is between them.
#[inline(always)]
pub(in crate::dynamics) fn views<T: Number>([inner, outer]: &[RingInSpace<T>; 2]) -> [Tilted<T>; 2] {
    let apart = |of: fn(&RingInSpace<T>) -> &[T; COORDINATES]| [0, 1, 2].map(|k: usize| of(outer)[k] - of(inner)[k]);
    let none = [inner.position[0].all(0.0); 3];
    let view = |apart, ring: &RingInSpace<T>| {
        let pair = |of: &[T; COORDINATES]| [of[3], of[4]];
        Tilted::new(apart, pair(&ring.position), pair(&ring.velocity))
    };
    [view([apart(|ring| &ring.position), apart(|ring| &ring.velocity)], inner), view([none; 2], outer)]
}

/// A vector along e_r, e_t and z.
#[inline(always)]
fn here<T: Number>(e_r: [T; 2], [x, y, z]: [T; 3]) -> [T; 3] {
    let [r, t] = along(e_r, x, y);
    [r, t, z]
}

impl<T: Number> Tilted<T> {
    /// q̇ (m/s) and ȧ (1/s) along e_r, e_t and z.
    #[inline(always)]
    fn going(&self, element: &Element<T, 2>) -> ([T; 3], [T; 3]) {
        let ([r, t, z], [u_rate, v_rate]) = (here(element.e_r, self.drift), element.rate);
        ([r + u_rate, t + element.rho * element.omega, v_rate + z], here(element.e_r, self.turning))
    }

    /// Rate φ̇ (rad/s) at which an element goes around the ring, t_φ·(q̇ − h ȧ)/g.
    #[inline(always)]
    pub(in crate::dynamics) fn turning_of(&self, element: &Element<T, 2>, seen: &Aslant<T>) -> T {
        let (rate, turning) = self.going(element);
        let rate = [0, 1, 2].map(|i: usize| rate[i] - seen.height * turning[i]);
        dot(seen.around(), rate) * seen.per_distance
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

    /// What has these parts away from the ring's axis and along it, along e_r, e_t and z.
    #[inline(always)]
    pub(in crate::dynamics) fn in_meridian(&self, parts: [T; 2]) -> [T; 3] {
        self.along(parts).0
    }

    /// Direction t_φ = a × q/g around the ring.
    #[inline(always)]
    pub(in crate::dynamics) fn around(&self) -> [T; 3] {
        cross(self.axis, self.q).map(|part| part * self.per_distance)
    }
}

impl<T: Scalar> Aslant<T> {
    /// φ − θ (rad): what its direction from the ring's axis is ahead of e_r.
    #[inline(always)]
    pub(in crate::dynamics) fn lead(&self) -> T {
        let [r, t] = [0, 1].map(|i: usize| self.q[i] - self.height * self.axis[i]);
        T::angle_of([r, t])
    }
}
