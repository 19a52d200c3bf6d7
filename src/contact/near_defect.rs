//! The contact of an element near a defect, whatever the contact law and whichever surface has the defect.
//!
//! Each law gives an *equivalent approach* Δ(u, ψ): the force law of the smooth contact applied to Δ gives the normal
//! force, and a direction says how it acts on the element. On the smooth raceway Δ = u and the direction is radial.
//! Here u is the approach of the element to the smooth raceway, on which side ever, and ψ the direction in which the
//! two bodies touch, seen in the frame of the one that has the defect, from the defect's centre. The surface around
//! the defect is cut at knots into cells inside which Δ is smooth.

use std::sync::Arc;

use super::across::{ByPlace, STEP, Slices, of_map, of_three};
use super::equivalent::{EquivalentApproach, SecondDerivatives};
use super::error::ContactError;
use crate::contact::love::LoveContact;
use crate::contact::map::{ContactMap, Unmapped};
use crate::contact::rolled_path::RigidPath;
use crate::numerics::number::Scalar;

/// Equivalent approach of one element to a raceway, and the direction of the contact force on the element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approach<T = f64> {
    /// Δ (m); negative when there is a gap.
    pub value: T,
    /// ∂Δ/∂u
    pub by_path: T,
    /// ∂Δ/∂ψ (m/rad)
    pub by_angle: T,
    /// Part of the direction away from the raceway: inwards from the outer one, outwards from the inner one.
    pub radial: T,
    /// Tangential part of the direction, counter-clockwise.
    pub tangential: T,
}

impl<T: Scalar> Approach<T> {
    /// That of the smooth raceway at approach `u` (m).
    #[inline(always)]
    pub fn smooth(u: T) -> Self {
        let [zero, one] = [0.0, 1.0].map(T::from);
        Self { value: u, by_path: one, by_angle: zero, radial: one, tangential: zero }
    }

    /// NaN: an integration that meets it takes the step back.
    pub fn unsolved() -> Self {
        let nan = T::from(f64::NAN);
        Self { value: nan, radial: nan, tangential: nan, ..Self::smooth(nan) }
    }

    /// The same over a wave of this `slope` (m/rad), for an element at this `distance` (m) from the ring's centre.
    #[inline(always)]
    pub fn over_wave(self, slope: T, distance: T) -> Self {
        let along = self.by_path * slope;
        let (by_angle, tangential) = (self.by_angle + along, self.tangential - along / distance);
        Self { by_angle, tangential, ..self }
    }

    /// From a potential's [Δ, Δ_u, Δ_s]: forces are its gradient. Per turning angle s = B ψ, B the radius of the body
    /// that has the defect, and the tangential force acts at the lever, the element's `distance` from the ring's
    /// centre.
    #[inline(always)]
    fn of([value, du, ds]: [T; 3], bearer_radius: f64, distance: T) -> Self {
        let share = T::from(bearer_radius) / distance;
        let by_angle = ds * T::Plain::from(bearer_radius);
        Self { value, by_path: du, by_angle, radial: du, tangential: -ds * share }
    }
}

/// A surface near its defect under one contact law.
#[derive(Debug, Clone)]
pub enum NearDefect {
    /// The earlier model: a rigid element's path.
    Hertz(RigidPath),
    /// Love's half-space, looked up.
    Map(NearMap),
    /// Love's half-space, solved.
    Love(Box<NearLove>),
}

/// A contact map on its surface.
#[derive(Debug, Clone)]
pub struct NearMap {
    map: Arc<ContactMap>,
    bearer_radius: f64,
    knots: Vec<f64>,
    /// Maps across the groove, of a surface that varies there.
    slices: Option<Box<Slices>>,
}

impl NearMap {
    /// A map for a defect on a body of this radius (m).
    pub fn new(map: Arc<ContactMap>, bearer_radius: f64) -> Self {
        let knots = map.knots().iter().map(|arc| arc / bearer_radius).collect();
        Self { map, bearer_radius, knots, slices: None }
    }

    /// The same with maps across the groove, which meet at the same arcs.
    pub fn with_slices(self, slices: Slices) -> Self {
        Self { slices: Some(Box::new(slices)), ..self }
    }
}

/// A grid on its surface, solved where that is neither smooth nor flat.
#[derive(Debug, Clone)]
pub struct NearLove {
    /// As it was prepared; contacts are solved in copies of it.
    contact: Arc<LoveContact>,
    bearer_radius: f64,
    knots: Vec<f64>,
    /// Depth of each cell that is flat.
    flats: Vec<Option<f64>>,
    /// Place across the groove (m) from which the grid's rows count, of a surface that varies there.
    track: Option<f64>,
}

impl NearLove {
    /// A grid for a defect on a body of this radius (m).
    pub fn new(Unmapped { contact, knots, flats }: Unmapped, bearer_radius: f64) -> Self {
        let knots = knots.into_iter().map(|arc| arc / bearer_radius).collect();
        Self { contact: Arc::new(contact), bearer_radius, knots, flats, track: None }
    }

    /// The same of a surface that varies across the groove; the rows count from the place `track` (m) there.
    pub fn across(self, track: f64) -> Self {
        Self { track: Some(track), ..self }
    }

    /// Δ with its derivatives by path, arc and place across (m) from where rows count.
    #[inline(never)]
    fn solve_across<T: Scalar>(
        &self,
        cell: usize,
        at: [T; 3],
        curved: bool,
        solvers: &mut LoveSolvers,
    ) -> Result<ByPlace<T>, ContactError> {
        let [u, s, place] = at.map(T::value);
        if let Some(depth) = self.flats[cell] {
            let [zero, one] = [0.0, 1.0].map(T::from);
            return Ok([at[0] - T::from(depth), one, zero, zero]);
        }
        let (found, by_place) = solvers.of(self).solve_across(u, s, place)?;
        let second = &mut |[u, s, place]: [f64; 3]| {
            let mut second = solvers.of(self).second_derivatives_across(u, s, place)?;
            if !curved {
                second[1][1] = 0.0;
            }
            Ok(second)
        };
        of_three(at, [found.value, found.du, found.ds, by_place], second)
    }

    /// A function of its own, so that nothing of it is in the way of other laws.
    #[inline(never)]
    fn solve(
        &self,
        cell: usize,
        [u, s]: [f64; 2],
        along_path: bool,
        solvers: &mut LoveSolvers,
    ) -> Result<EquivalentApproach, ContactError> {
        match self.flats[cell] {
            Some(depth) => Ok(EquivalentApproach::flat(u, depth)),
            None if along_path => solvers.of(self).solve_along_path(u, s),
            None => solvers.of(self).solve(u, s),
        }
    }

    #[inline(never)]
    fn second_derivatives(
        &self,
        cell: usize,
        [u, s]: [f64; 2],
        solvers: &mut LoveSolvers,
    ) -> Result<SecondDerivatives, ContactError> {
        match self.flats[cell] {
            Some(_) => Ok(SecondDerivatives::default()),
            None => solvers.of(self).second_derivatives(u, s),
        }
    }
}

/// Where contacts of law `love` are solved, one place for each defect; none under another law. In each the last contact
/// is where the solution of the next one starts, and nothing else.
#[derive(Debug, Clone, Default)]
pub struct LoveSolvers(Vec<LoveSolver>);

/// Where the contacts near one defect are solved.
#[derive(Debug, Clone)]
struct LoveSolver {
    /// The defect's grid as it was prepared.
    prepared: Arc<LoveContact>,
    contact: LoveContact,
}

impl LoveSolvers {
    /// Those of these surfaces, with the room that their contacts need.
    pub fn new<'a>(surfaces: impl IntoIterator<Item = &'a NearDefect>) -> Self {
        let mut solvers = Self::default();
        for surface in surfaces {
            if let NearDefect::Love(near) = surface {
                solvers.of(near);
            }
        }
        solvers
    }

    /// That of a surface, made if there is none yet.
    fn of(&mut self, near: &NearLove) -> &mut LoveContact {
        let known = self.0.iter().position(|solver| Arc::ptr_eq(&solver.prepared, &near.contact));
        let at = known.unwrap_or(self.0.len());
        if known.is_none() {
            self.0.push(LoveSolver { prepared: near.contact.clone(), contact: near.contact.copy() });
        }
        &mut self.0[at].contact
    }

    /// Forgets what was solved before, so that the next answers do not depend on it even in their rounding.
    pub fn forget(&mut self) {
        for solver in &mut self.0 {
            solver.contact.forget();
        }
    }
}

impl NearDefect {
    /// Ascending angles (rad) from the defect's centre at which the approach is not smooth. Cell `i` lies between knots
    /// `i` and `i + 1`; outside the first and last the raceway is smooth.
    pub fn knots(&self) -> &[f64] {
        match self {
            Self::Hertz(path) => path.knots(),
            Self::Map(near) => &near.knots,
            Self::Love(near) => &near.knots,
        }
    }

    /// Approach in `cell` at the approach `u` (m) to the smooth raceway and at `angle` (rad) from the defect's centre,
    /// which may lie slightly beyond the cell's ends, of an element at this `distance` (m) from the ring's centre.
    /// With derivatives, those of the slopes along the surface are left out if it is not to be taken as `curved`.
    /// Law `love` is solved in `solvers`.
    ///
    /// # Errors
    /// Where the law was not prepared for so large an approach, or the grid cannot be solved.
    #[inline(always)]
    pub fn approach<T: Scalar>(
        &self,
        cell: usize,
        u: T,
        angle: T,
        distance: T,
        curved: bool,
        solvers: &mut LoveSolvers,
    ) -> Result<Approach<T>, ContactError> {
        match self {
            Self::Map(near) => {
                let at = [u, angle * T::Plain::from(near.bearer_radius)];
                Ok(Approach::of(of_map(&near.map, cell, at, curved)?, near.bearer_radius, distance))
            }
            Self::Love(near) => {
                let at = [u, angle * T::Plain::from(near.bearer_radius)];
                let found = near.solve(cell, at.map(T::value), !curved, solvers)?;
                let second = &mut |at: [f64; 2]| match curved {
                    true => near.second_derivatives(cell, at, solvers).map(SecondDerivatives::rows),
                    false => Ok([found.duu, found.dus, 0.0]),
                };
                let approach = T::surface(at, [found.value, found.du, found.ds], STEP, second)?;
                Ok(Approach::of(approach, near.bearer_radius, distance))
            }
            Self::Hertz(path) => {
                let point = path.at(cell, angle.value());
                let zero = T::from(0.0);
                let along = |angle: f64| if curved { path.second_derivative(cell, angle) } else { 0.0 };
                let second = &mut |[angle, _]: [f64; 2]| Ok([along(angle), 0.0, 0.0]);
                let first = [point.path, point.slope, 0.0];
                let [path, slope, _] = T::surface([angle, zero], first, STEP / distance.value(), second)?;
                let tan = slope / distance;
                let radial = T::from(1.0) / (T::from(1.0) + tan * tan).sqrt();
                Ok(Approach {
                    value: u - path,
                    by_path: T::from(1.0),
                    by_angle: -slope,
                    radial,
                    tangential: tan * radial,
                })
            }
        }
    }

    /// Whether the approach depends on the place across the groove: [`Self::approach_across`] is to be asked then.
    #[inline]
    pub fn varies_across(&self) -> bool {
        match self {
            Self::Hertz(_) => false,
            Self::Map(near) => near.slices.is_some(),
            Self::Love(near) => near.track.is_some(),
        }
    }

    /// First and last place across the groove (m) for which a surface that varies there is prepared.
    pub fn prepared_across(&self) -> Option<[f64; 2]> {
        match self {
            Self::Map(NearMap { slices: Some(slices), .. }) => Some(slices.ends()),
            _ => None,
        }
    }

    /// As [`Self::approach`] at the place `across` (m) the groove, with ∂Δ/∂across.
    ///
    /// # Errors
    /// As there.
    #[inline(never)]
    pub fn approach_across<T: Scalar>(
        &self,
        cell: usize,
        [u, across]: [T; 2],
        (angle, distance): (T, T),
        curved: bool,
        solvers: &mut LoveSolvers,
    ) -> Result<(Approach<T>, T), ContactError> {
        let arc = |radius: f64| angle * T::Plain::from(radius);
        let ([value, du, ds, by_across], radius) = match self {
            Self::Map(near @ NearMap { slices: Some(slices), .. }) => {
                (slices.approach(cell, [u, arc(near.bearer_radius), across], curved)?, near.bearer_radius)
            }
            Self::Love(near) if near.track.is_some() => {
                let place = across - T::Plain::from(near.track.unwrap_or_default());
                (near.solve_across(cell, [u, arc(near.bearer_radius), place], curved, solvers)?, near.bearer_radius)
            }
            _ => return Ok((self.approach(cell, u, angle, distance, curved, solvers)?, T::from(0.0))),
        };
        Ok((Approach::of([value, du, ds], radius, distance), by_across))
    }

    /// Whether contacts are solved on a grid inside the step.
    pub fn solves_grids(&self) -> bool {
        matches!(self, Self::Love(_))
    }
}
