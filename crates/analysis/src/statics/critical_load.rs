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

use super::static_bearing::StaticBearing;
use super::study::StaticError;
use brinell::contact::law::{Elasticity, ForceLaw};
use brinell::dynamics::equilibrium::EquilibriumError;
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

/// Why there is no critical load.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum NoCriticalLoad {
    /// No element is in a defect deep enough to carry nothing.
    #[error("no element has gone down into the defect")]
    NoneInside,
    /// The elements outside leave the elastic range before.
    #[error(
        "under {load:.0} N, where the elements at the bottom of the defect have {gap_um:.1} um to go, others are \
         pressed in by {approach_um:.1} um: at most {limit_um:.1} um, a tenth of an element's radius, are elastic"
    )]
    BeyondElastic { load: f64, gap_um: f64, approach_um: f64, limit_um: f64 },
    /// There is no balance under a load at which the elements would carry, or might.
    #[error("under {load:.0} N: {cause}")]
    NoBalance { load: f64, cause: EquilibriumError },
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
/// Approach of a contact, in radii of an element, up to which a load is sought. There a circle is 5 % deeper than the
/// parabola that Hertz takes for it, and steel has long yielded.
const LARGEST_APPROACH: f64 = 0.1;
/// Factor between a load with a balance and a greater one without, both to the power 2/3, at which the search ends.
const CLOSE: f64 = 1.001;

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

    /// The critical load, with elements symmetrically about the middle of the bottom, or why there is none.
    ///
    /// # Errors
    /// A bearing without defect or direction of load.
    pub fn critical_load(&self) -> Result<Result<CriticalLoad, NoCriticalLoad>, StaticError> {
        let bottom = self.bottom()?;
        let mut least: Result<CriticalLoad, _> = Err(NoCriticalLoad::NoneInside);
        for cage_angle in [bottom.middle, bottom.middle - 0.5 * self.spacing()] {
            if !(0..self.element_count()).any(|j| self.sunk(j, cage_angle) >= BOTTOM * bottom.path) {
                continue;
            }
            let found = self.critical_load_at(cage_angle)?;
            least = match (&least, &found) {
                (Ok(old), Ok(new)) if new.load < old.load => found,
                (Err(_), _) => found,
                (Ok(_), _) => least,
            };
        }
        Ok(least)
    }

    /// The load at which the first of the deepest elements in the defect carries, with element 1 at `cage_angle` (rad),
    /// or why there is none.
    ///
    /// # Errors
    /// A bearing without direction of load.
    pub fn critical_load_at(&self, cage_angle: f64) -> Result<Result<CriticalLoad, NoCriticalLoad>, StaticError> {
        let paths: Vec<f64> = (0..self.element_count()).map(|j| self.sunk(j, cage_angle)).collect();
        let deepest = paths.iter().copied().fold(0.0, f64::max);
        if deepest <= 0.0 {
            return Ok(Err(NoCriticalLoad::NoneInside));
        }
        let inside: Vec<usize> = (0..paths.len()).filter(|&j| paths[j] >= BOTTOM * deepest).collect();
        let [x, y] = self.load();
        let length = (x * x + y * y).sqrt();
        let limit = LARGEST_APPROACH * self.model.element_radius;
        // Greatest approaches of the elements at the bottom and of all.
        let approaches = |load: f64| -> Result<[f64; 2], Ended> {
            let balance = self.balance(cage_angle, [x / length * load, y / length * load])?;
            let greatest = |most: f64, j: usize| balance.elements[j].inner_approach.max(most);
            let all = (0..paths.len()).fold(f64::NEG_INFINITY, greatest);
            Ok([inside.iter().copied().fold(f64::NEG_INFINITY, greatest), all])
        };
        let beyond = |load: f64, [own, all]: [f64; 2]| {
            let [gap_um, approach_um, limit_um] = [(-own).max(0.0), all, limit].map(|length| length * 1e6);
            Ended::Without(NoCriticalLoad::BeyondElastic { load, gap_um, approach_um, limit_um })
        };
        let squeeze = |load: f64| match approaches(load)? {
            [own, all] if own < 0.0 && !(all <= limit) => Err(beyond(load, [own, all])),
            [own, _] => Ok(own),
        };
        // That of one contact squeezed by the depth: the scale of loads here. The crown of a roller that is barely
        // inside carries nothing yet.
        let law = self.model.outer.contact.law.clone();
        let scale = match law.elasticity {
            Elasticity::Crowned(_) => ForceLaw { elasticity: Elasticity::Line, ..law }.elastic(deepest),
            Elasticity::Point | Elasticity::Line => law.elastic(deepest),
        };
        let found = crossing(squeeze, scale).and_then(|load| match load {
            0.0 => Ok(load),
            _ => match approaches(load)? {
                [_, all] if all <= limit => Ok(load),
                there => Err(beyond(load, there)),
            },
        });
        match found {
            Ok(load) => Ok(Ok(CriticalLoad { load, cage_angle, elements: inside.len() })),
            Err(Ended::Without(why)) => Ok(Err(why)),
            Err(Ended::Wrong(error)) => Err(error),
        }
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

/// Why a search for a load has ended without one.
enum Ended {
    /// There is none.
    Without(NoCriticalLoad),
    /// It could not be looked for.
    Wrong(StaticError),
}

impl From<StaticError> for Ended {
    fn from(error: StaticError) -> Self {
        match error {
            StaticError::Equilibrium { load, cause, .. } => {
                Self::Without(NoCriticalLoad::NoBalance { load: libm::hypot(load[0], load[1]), cause })
            }
            error => Self::Wrong(error),
        }
    }
}

/// The load (N) at which an ascending function crosses 0, which has to end where it does not; 0 where it is positive at
/// a thousandth of `scale`.
///
/// Approaches grow about as load^(2/3), so that is what the Illinois form of the false position runs over.
fn crossing(function: impl Fn(f64) -> Result<f64, Ended>, scale: f64) -> Result<f64, Ended> {
    let load = |x: f64| scale * x * x.sqrt();
    let mut low = (1e-2, function(load(1e-2))?);
    if low.1 >= 0.0 {
        return Ok(0.0);
    }
    let mut high = low;
    let mut factor = 3.0f64;
    while high.1 < 0.0 {
        low = high;
        high = loop {
            let x = factor * low.0;
            match function(load(x)) {
                // It may cross 0 before there is no balance any more.
                Err(Ended::Without(NoCriticalLoad::NoBalance { .. })) if factor > CLOSE => factor = factor.sqrt(),
                value => break (x, value?),
            }
        };
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
            return Ok(load(x));
        }
    }
    Ok(load(high.0))
}
