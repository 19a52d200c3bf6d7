//! Smooth contacts of elements in the plane: of balls and rollers, with films.

use super::{Kept, OnRings, Smooth};
use crate::contact::law::{DampedLaw, Elastic, Line, Point};
use crate::dynamics::element::{Concentric, Filmed, Inside, Outside, Shifted};
use crate::dynamics::parameters::{Kinematics, Model, Stage};
use crate::numerics::lanes::{Kernel, Lanes, Wide, handed_on};
use crate::numerics::plane::Vector;

impl Model {
    /// Smooth contacts of all elements in the plane: their part of the derivative, and, if `RECORD`, each of them.
    /// Gives their force on the inner ring and on the outer. If `GENERAL`, each element has a speed and a size of its
    /// own and contacts may have films.
    #[inline(always)]
    pub(in crate::dynamics) fn smooth_contacts<S: Wide, const RECORD: bool, const GENERAL: bool>(
        &self,
        simd: S,
        now: &Kinematics,
        stage: &Stage,
        derivative: &mut [f64],
        kept: Kept,
    ) -> OnRings<2> {
        // A function of its own, so that nothing of it is in the way of balls.
        if let Some(line) = self.inner.contact.law.elasticity.line() {
            let now = &handed_on(now);
            return simd.outlined(Rollers::<RECORD, GENERAL> { model: self, line, now, stage, derivative, kept });
        }
        self.in_plane::<S, Point, RECORD, GENERAL>(simd, Point, now, stage, derivative, kept)
    }

    /// The same for contacts of one elasticity.
    #[inline(always)]
    fn in_plane<S: Wide, E: Elastic, const RECORD: bool, const GENERAL: bool>(
        &self,
        simd: S,
        elastic: E,
        now: &Kinematics,
        stage: &Stage,
        derivative: &mut [f64],
        kept: Kept,
    ) -> OnRings<2> {
        if self.nearly_concentric(now.offset()) {
            self.between_shifted::<S, E, RECORD, GENERAL, true>(simd, elastic, now, stage, derivative, kept)
        } else {
            self.between_shifted::<S, E, RECORD, GENERAL, false>(simd, elastic, now, stage, derivative, kept)
        }
    }

    /// The same between rings that are nearly concentric, or not.
    #[inline(always)]
    fn between_shifted<S: Wide, E: Elastic, const RECORD: bool, const GENERAL: bool, const SERIES: bool>(
        &self,
        simd: S,
        elastic: E,
        now: &Kinematics,
        stage: &Stage,
        derivative: &mut [f64],
        (elements, films, contacts): Kept,
    ) -> OnRings<2> {
        let number = |number: f64| Lanes::splat(simd, number);
        let pair = |vector: Vector| [number(vector.x), number(vector.y)];
        let law = DampedLaw::new(self.inner.contact.law.damping, elastic, number);
        let clearance = if GENERAL { self.clearance(films) } else { self.radial_clearance };
        let view = Shifted::<_, 2, SERIES> { offset: pair(now.offset()), drift: pair(now.drift()) };
        let (cage, velocity) = (&now.cage, now.housing.velocity);
        let views = (view, Concentric);
        let carrier = [velocity.x, velocity.y, 0.0];
        if GENERAL {
            let film = |side: usize| films.map(|films| films.squeeze[side].to(number));
            let laws = [Filmed { law, film: film(0) }, Filmed { law, film: film(1) }];
            let raceways = (Inside { clearance: number(clearance), law: laws[0] }, Outside { law: laws[1] });
            let smooth = Smooth {
                model: self,
                simd,
                cage,
                carrier,
                axial_gravity: 0.0,
                ahead: stage.ahead,
                law,
                views,
                raceways,
            };
            return smooth.all::<1, 2, RECORD, GENERAL>(stage.state, derivative, elements, contacts);
        }
        let raceways = (Inside { clearance: number(clearance), law }, Outside { law });
        let smooth =
            Smooth { model: self, simd, cage, carrier, axial_gravity: 0.0, ahead: stage.ahead, law, views, raceways };
        smooth.all::<1, 2, RECORD, GENERAL>(stage.state, derivative, elements, contacts)
    }
}

/// The smooth contacts of rollers.
struct Rollers<'a, const RECORD: bool, const GENERAL: bool> {
    model: &'a Model,
    line: Line<'a>,
    now: &'a Kinematics,
    stage: &'a Stage<'a>,
    derivative: &'a mut [f64],
    kept: Kept<'a>,
}

impl<const RECORD: bool, const GENERAL: bool> Kernel for Rollers<'_, RECORD, GENERAL> {
    type Output = OnRings<2>;

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) -> OnRings<2> {
        let Self { model, line, now, stage, derivative, kept } = self;
        model.in_plane::<S, Line, RECORD, GENERAL>(simd, line, now, stage, derivative, kept)
    }
}
