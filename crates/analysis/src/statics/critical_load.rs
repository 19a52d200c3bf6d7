//! The load at which elements inside the defect carry again.
//!
//! An element that has gone down to the bottom of a defect carries nothing until the inner ring has come down after it:
//! until its neighbours outside are squeezed by about the depth. Below that load an extended spall takes one or two
//! elements out of the bearing and stiffness is low; above it they carry and it rises steeply. "At the bottom" means
//! that the path of the unloaded element is at least 99 % of its greatest over the defect.
//!
//! The load depends on where the elements stand. *The* critical load belongs to elements placed symmetrically about the
//! middle of the bottom, one in it or two about it, whichever needs less: there all of them begin at once, and there
//! the stiffness is least. Any other cage angle has its own ([`StaticBearing::critical_load_at`]), that of the elements
//! which are deepest then; on its way in or out an element is squeezed by any load at all.
//!
//! A defect of the inner ring has its critical load as well, which belongs to the inner ring's angle besides: largest
//! is that of a spall in the direction of the load.
//!
//! It stands on rigid rings that keep their shape: with 100 µm depth a real ring bends before. A compliance in series
//! with the contacts is the crudest allowance for that.

use super::static_bearing::{StaticBearing, StaticError};
use brinell::contact::law::{Elasticity, ForceLaw};
use brinell::scene::DefectOn;

/// A critical load and where it belongs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CriticalLoad {
    /// Load on the inner ring (N).
    pub load: f64,
    /// Cage angle (rad).
    pub cage_angle: f64,
    /// Number of elements at the greatest depth.
    pub elements: usize,
}

/// Derivatives of the critical load at its cage angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensitivity {
    /// By the depth of the defect, all its depths growing in proportion [N/m of the greatest path].
    pub by_depth: f64,
    /// By the radial clearance (N/m).
    pub by_clearance: f64,
    /// By the compliance in series with each outer contact (N²/m).
    pub by_compliance: f64,
}

/// Where unloaded elements go down deepest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bottom {
    /// Greatest depth to which an unloaded element goes down (m).
    pub path: f64,
    /// Angle of the bottom's middle (rad), counter-clockwise from +x.
    pub middle: f64,
}

/// Share of the greatest path that counts as the bottom.
const BOTTOM: f64 = 0.99;
/// Number of intervals of the defect at whose ends its path is sampled.
const INTERVALS: usize = 500;
/// Approach beyond which the search for a load is given up, in depths.
const ENDLESS: f64 = 1e3;

impl StaticBearing {
    /// Where the path of an unloaded element is deepest.
    ///
    /// # Errors
    /// No defect, or none into which an element sinks.
    pub fn bottom(&self) -> Result<Bottom, StaticError> {
        let of_rings = [DefectOn::Outer, DefectOn::Inner].into_iter().find_map(|on| self.extents(on).next());
        let ([first, last], centre) = of_rings.ok_or(StaticError::NoDefect)?;
        let angle = |i: usize| centre + first + (last - first) * (i as f64 / INTERVALS as f64);
        // Element 1 is at the cage angle.
        let paths: Vec<f64> = (0..=INTERVALS).map(|i| self.sunk(0, angle(i))).collect();
        let path = paths.iter().copied().fold(0.0, f64::max);
        if path <= 0.0 {
            return Err(StaticError::NoDepth { depth_um: path * 1e6 });
        }
        let deep = |&i: &usize| paths[i] >= BOTTOM * path;
        let [first, last] = [(0..=INTERVALS).find(deep), (0..=INTERVALS).rev().find(deep)].map(|i| i.unwrap_or(0));
        let middle = 0.5 * (angle(first) + angle(last));
        if self.sunk(0, middle) >= BOTTOM * path {
            return Ok(Bottom { path, middle });
        }
        // Several deep positions: the deepest.
        let deepest = (0..=INTERVALS).find(|&i| paths[i] == path).unwrap_or(0);
        Ok(Bottom { path, middle: angle(deepest) })
    }

    /// The critical load, with elements symmetrically about the middle of the bottom; `None` where no load brings them
    /// to carry.
    ///
    /// # Errors
    /// A bearing without defect or direction of load; a balance that is not found.
    pub fn critical_load(&self) -> Result<Option<CriticalLoad>, StaticError> {
        let bottom = self.bottom()?;
        let mut least: Option<CriticalLoad> = None;
        for cage_angle in [bottom.middle, bottom.middle - 0.5 * self.spacing()] {
            if !(0..self.element_count()).any(|j| self.sunk(j, cage_angle) >= BOTTOM * bottom.path) {
                continue;
            }
            let found = self.critical_load_at(cage_angle)?;
            if found.is_some_and(|new| least.is_none_or(|old| new.load < old.load)) {
                least = found;
            }
        }
        Ok(least)
    }

    /// The load at which the first of the deepest elements in the defect carries, with element 1 at `cage_angle` (rad);
    /// `None` where no element has gone down, or no load brings it to carry.
    ///
    /// # Errors
    /// A bearing without direction of load; a balance that is not found.
    pub fn critical_load_at(&self, cage_angle: f64) -> Result<Option<CriticalLoad>, StaticError> {
        let paths: Vec<f64> = (0..self.element_count()).map(|j| self.sunk(j, cage_angle)).collect();
        let deepest = paths.iter().copied().fold(0.0, f64::max);
        if deepest <= 0.0 {
            return Ok(None);
        }
        let inside: Vec<usize> = (0..paths.len()).filter(|&j| paths[j] >= BOTTOM * deepest).collect();
        let [x, y] = self.load();
        let length = (x * x + y * y).sqrt();
        let squeeze = |load: f64| -> Result<f64, StaticError> {
            let balance = self.balance(cage_angle, [x / length * load, y / length * load])?;
            Ok(inside.iter().map(|&j| balance.elements[j].inner_approach).fold(f64::NEG_INFINITY, f64::max))
        };
        // That of one contact squeezed by the depth: the scale of loads here. The crown of a roller that is barely
        // inside carries nothing yet.
        let law = self.model.outer.contact.law.clone();
        let scale = match law.elasticity {
            Elasticity::Crowned(_) => ForceLaw { elasticity: Elasticity::Line, ..law }.elastic(deepest),
            Elasticity::Point | Elasticity::Line => law.elastic(deepest),
        };
        let load = crossing(squeeze, scale)?;
        Ok(load.map(|load| CriticalLoad { load, cage_angle, elements: inside.len() }))
    }

    /// How the critical load answers to depth, clearance and compliance, the cage angle held.
    ///
    /// # Errors
    /// Those of [`critical_load`](Self::critical_load).
    pub fn sensitivity(&self, critical: &CriticalLoad) -> Result<Option<Sensitivity>, StaticError> {
        let load = |bearing: &Self| -> Result<f64, StaticError> {
            let found = bearing.critical_load_at(critical.cage_angle)?;
            Ok(found.map_or(f64::NAN, |found| found.load))
        };
        let path = self.bottom()?.path;
        // A hundredth of the depth: differences stand far above the search's 1e-10, errors of second order below 1e-4.
        let step = 0.01 * path;
        let deeper = load(&self.with_depth_times(1.01)?)? - load(&self.with_depth_times(0.99)?)?;
        let clearance = self.model.radial_clearance;
        let looser = load(&self.with_clearance(clearance + step))? - load(&self.with_clearance(clearance - step))?;
        // No compliance below 0: the one-sided quotient of second order.
        let (compliance, soft) = (self.model.outer.contact.compliance, step / critical.load);
        let softer = |times: f64| load(&self.with_outer_compliance(compliance + times * soft));
        let by_compliance = (4.0 * softer(1.0)? - softer(2.0)? - 3.0 * softer(0.0)?) / (2.0 * soft);
        let found = Sensitivity { by_depth: deeper / (2.0 * step), by_clearance: looser / (2.0 * step), by_compliance };
        Ok([found.by_depth, found.by_clearance, found.by_compliance].iter().all(|d| d.is_finite()).then_some(found))
    }
}

/// The load (N) at which an ascending function crosses 0, if it does; 0 where it is positive at a thousandth of
/// `scale`.
///
/// Approaches grow about as load^(2/3), so that is what the Illinois form of the false position runs over.
fn crossing(function: impl Fn(f64) -> Result<f64, StaticError>, scale: f64) -> Result<Option<f64>, StaticError> {
    let load = |x: f64| scale * x * x.sqrt();
    let mut low = (1e-2, function(load(1e-2))?);
    if low.1 >= 0.0 {
        return Ok(Some(0.0));
    }
    let mut high = low;
    while high.1 < 0.0 {
        if high.0 > ENDLESS {
            return Ok(None);
        }
        low = high;
        let x = 3.0 * high.0;
        high = (x, function(load(x))?);
    }
    let mut last_moved_low = None;
    for _ in 0..200 {
        if high.0 - low.0 <= 1e-11 * high.0 || high.1 == 0.0 {
            break;
        }
        let x = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
        // A false position that rounds onto an end moves nothing.
        let x = if x > low.0 && x < high.0 { x } else { 0.5 * (low.0 + high.0) };
        let value = function(load(x))?;
        let moves_low = value < 0.0;
        if moves_low {
            low = (x, value);
            if last_moved_low == Some(true) {
                high.1 *= 0.5;
            }
        } else {
            high = (x, value);
            if last_moved_low == Some(false) {
                low.1 *= 0.5;
            }
        }
        last_moved_low = Some(moves_low);
        if value.abs() < 1e-18 {
            return Ok(Some(load(x)));
        }
    }
    Ok(Some(load(high.0)))
}
