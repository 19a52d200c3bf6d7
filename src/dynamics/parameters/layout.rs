//! The layout of the state vector.
//!
//! The state is `[u_1…u_Z, w_1…w_Z, shaft x y vx vy, housing x y vx vy, sensor s vs …]`; a ring that is not internal
//! and absent sensors take no slot. The lists of u and w are filled up with zeros to a multiple of eight slots, the
//! rings' part to a multiple of four, so that they are treated several at a time. u is the roller path (ρ − (R_o − r),
//! ρ the distance of the element's centre from the *outer ring's* centre), w the radial component of the element's
//! absolute velocity.
//!
//! In space the two lists of the elements are `[u… v…]` and `[w… w_z…]`, with the axial position v and velocity w_z,
//! and a ring has eight slots more, `z, tilt about x, about y, –` and their rates. Where there is the plane, it is laid
//! out the same.

use crate::numerics::lanes::{Partition, QUAD, padded};
use crate::scene::{DegreesOfFreedom, ElementInertia, Motion, Scene};

/// Where a state is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    /// Number of elements Z; `u` starts at 0.
    pub element_count: usize,
    /// In how many directions rings move.
    pub freedom: DegreesOfFreedom,
    /// Start of `w`.
    pub radial_velocity: usize,
    /// Start of the inner ring's x, y, vx, vy.
    pub shaft: Option<usize>,
    /// Start of the outer ring's.
    pub housing: Option<usize>,
    /// Start of the first sensor's displacement and velocity along its direction; the next one's are [`QUAD`] on.
    pub sensors: usize,
    /// Number of sensors.
    pub sensor_count: usize,
    /// Whether elements are in balance at every instant: u and w are then no states, but where a search for the balance
    /// begins.
    pub elements_in_balance: bool,
    /// Number of states.
    pub len: usize,
}

impl Layout {
    /// Of a scene.
    pub(in crate::dynamics) fn new(scene: &Scene) -> Self {
        let freedom = scene.bearing.degrees_of_freedom;
        let in_space = freedom != DegreesOfFreedom::Two;
        let radial_velocity = padded(scene.bearing.element_count) * if in_space { 2 } else { 1 };
        let ring = if in_space { 3 * QUAD } else { QUAD };
        let mut len = 2 * radial_velocity;
        let mut take = |wanted: bool, count: usize| {
            wanted.then(|| {
                len += count;
                len - count
            })
        };
        let shaft = take(scene.shaft.motion == Motion::Internal, ring);
        let housing = take(scene.housing.motion == Motion::Internal, ring);
        let sensor_count = scene.sensors.len();
        let sensors = take(true, 0).unwrap_or_default();
        len = sensors + QUAD * sensor_count;
        let element_count = scene.bearing.element_count;
        Self {
            element_count,
            freedom,
            radial_velocity,
            shaft,
            housing,
            sensors,
            sensor_count,
            elements_in_balance: scene.bearing.element_inertia == ElementInertia::None,
            len: len.next_multiple_of(QUAD),
        }
    }

    /// Slots of a ring's x, y, z and tilts about x and y, from its start on.
    pub const POSITIONS: [usize; 5] = [0, 1, 4, 5, 6];
    /// Those of their rates.
    pub const VELOCITIES: [usize; 5] = [2, 3, 8, 9, 10];

    /// Start of `v`, the elements' axial positions, and of `w_z`; `None` in the plane.
    #[inline(always)]
    pub fn axial(&self) -> Option<[usize; 2]> {
        let half = self.radial_velocity / 2;
        (self.freedom != DegreesOfFreedom::Two).then_some([half, self.radial_velocity + half])
    }

    /// Starts of both rings' slots, with the number of their coordinates: the tilt of the outer ring is held.
    fn rings(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let count = self.freedom.count();
        let rings = [self.shaft.map(|start| (start, count)), self.housing.map(|start| (start, count.min(3)))];
        rings.into_iter().flatten()
    }

    /// Whether slot `i` is a coordinate beyond the plane of a ring (0), or its rate (1).
    fn is_beyond(&self, i: usize, kind: usize) -> bool {
        let slots = [Self::POSITIONS, Self::VELOCITIES][kind];
        self.rings().any(|(start, count)| (2..count).any(|k| start + slots[k] == i))
    }

    /// Whether state `i` is a position; otherwise it is a velocity.
    #[inline]
    pub fn is_position(&self, i: usize) -> bool {
        let within = |start: Option<usize>, count: usize| start.is_some_and(|s| i >= s && i < s + count);
        i < self.radial_velocity
            || within(self.shaft, 2)
            || within(self.housing, 2)
            || self.is_beyond(i, 0)
            || self.sensor_indices().any(|start| i == start)
    }

    /// Index of the displacement of each sensor; its velocity is the next.
    pub fn sensor_indices(&self) -> impl Iterator<Item = usize> + use<> {
        let layout = *self;
        (0..self.sensor_count).map(move |k| layout.sensor_index(k))
    }

    /// Index of the displacement of sensor `k`.
    #[inline]
    pub fn sensor_index(&self, k: usize) -> usize {
        self.sensors + k * QUAD
    }

    /// The lists that the state is made up of.
    pub fn partition(&self) -> Partition {
        Partition {
            count: if self.axial().is_some() { self.radial_velocity } else { self.element_count },
            rest: self.len - 2 * self.radial_velocity,
        }
    }

    /// Whether slot `i` is a state's, not one that only fills a list up.
    pub fn is_used(&self, i: usize) -> bool {
        let within = |start: usize, count: usize| i >= start && i < start + count;
        within(0, self.element_count)
            || within(self.radial_velocity, self.element_count)
            || self.axial().is_some_and(|starts| starts.iter().any(|&start| within(start, self.element_count)))
            || self.is_beyond(i, 0)
            || self.is_beyond(i, 1)
            || [self.shaft, self.housing].into_iter().flatten().any(|start| within(start, 4))
            || self.sensor_indices().any(|start| within(start, 2))
    }

    /// Whether slot `i` is a state's that is integrated: an element in balance has none.
    pub fn is_integrated(&self, i: usize) -> bool {
        self.is_used(i) && !(self.elements_in_balance && i < 2 * self.radial_velocity)
    }

    /// Number of states that are integrated.
    pub fn count(&self) -> usize {
        (0..self.len).filter(|&i| self.is_integrated(i)).count()
    }

    /// Name of state `i` for messages.
    pub fn name(&self, i: usize) -> String {
        let w = self.radial_velocity;
        if let Some([v, w_z]) = self.axial() {
            for (start, end, what) in [(v, w, "axial position"), (w_z, 2 * w, "axial velocity")] {
                if i >= start && i < end {
                    return format!("the {what} of element {}", i - start + 1);
                }
            }
        }
        if i < w {
            return format!("the path of element {}", i + 1);
        }
        if i < 2 * w {
            return format!("the radial velocity of element {}", i - w + 1);
        }
        let parts = ["x", "y", "vx", "vy", "z", "tilt.x", "tilt.y", "", "vz", "tilt.vx", "tilt.vy", ""];
        for (start, name) in [(self.shaft, "shaft"), (self.housing, "housing")] {
            let k = start.and_then(|start| i.checked_sub(start)).filter(|&k| k < parts.len());
            if let Some(k) = k.filter(|&k| k < 4 || self.is_beyond(i, 0) || self.is_beyond(i, 1)) {
                return format!("{name}.{}", parts[k]);
            }
        }
        "the sensor's motion".to_owned()
    }
}
