//! What a slot of the state vector is of.

use crate::dynamics::parameters::Layout;

/// What a slot of the state vector is of, elements, rings and sensors counted from 0; of two, position and rate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// Radial path of an element, and its absolute radial velocity.
    Radial(usize, Derivative),
    /// Axial position of an element, and its velocity.
    Axial(usize, Derivative),
    /// Coordinate of the inner (0) or of the outer (1) ring.
    Ring(usize, usize, Derivative),
    /// A sensor along its direction.
    Sensor(usize, Derivative),
}

/// Which of a position and its rate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Derivative {
    Position,
    Rate,
}

use Derivative::{Position, Rate};

impl Part {
    /// That of slot `i`; `None` of one that only fills a list up.
    pub(super) fn of(layout: &Layout, i: usize) -> Option<Self> {
        let (count, within) = (layout.element_count, |start: usize| i.checked_sub(start));
        let element = |start: usize| within(start).filter(|&j| j < count);
        if let Some(j) = element(0) {
            return Some(Self::Radial(j, Position));
        }
        if let Some(j) = element(layout.radial_velocity) {
            return Some(Self::Radial(j, Rate));
        }
        if let Some([v, w_z]) = layout.axial() {
            let axial = element(v).map(|j| (j, Position)).or(element(w_z).map(|j| (j, Rate)));
            if let Some((j, of)) = axial {
                return Some(Self::Axial(j, of));
            }
        }
        for (ring, start) in [layout.shaft, layout.housing].into_iter().enumerate() {
            let Some(k) = start.and_then(within) else { continue };
            for (slots, of) in [(Layout::POSITIONS, Position), (Layout::VELOCITIES, Rate)] {
                if let Some(axis) = slots[..layout.freedom.count()].iter().position(|&slot| slot == k) {
                    return Some(Self::Ring(ring, axis, of));
                }
            }
        }
        let sensor = |k: usize| within(layout.sensor_index(k)).filter(|&part| part < 2);
        let found = (0..layout.sensor_count).find_map(|k| sensor(k).map(|part| (k, part)));
        found.map(|(k, part)| Self::Sensor(k, [Position, Rate][part]))
    }
}
