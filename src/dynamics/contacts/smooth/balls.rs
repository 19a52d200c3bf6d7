//! Smooth contacts of balls between rings that move in space.

use super::{OnRings, Smooth};
use crate::contact::law::{DampedLaw, Point};
use crate::dynamics::contacts::Record;
use crate::dynamics::element::{Concentric, GrooveCircle, Shifted, Tilted, View};
use crate::dynamics::parameters::{COORDINATES, ElementBlock, Model, RingInSpace, Space, Stage};
use crate::numerics::lanes::{Kernel, Lanes, Wide};

/// Balls between these rings at one instant.
struct Balls<'a, const RECORD: bool> {
    model: &'a Model,
    space: &'a Space,
    rings: &'a [RingInSpace; 2],
    stage: &'a Stage<'a>,
    derivative: &'a mut [f64],
    kept: (&'a [ElementBlock], &'a mut Record),
}

impl Model {
    /// Smooth contacts of all balls in space, as [`smooth_contacts`](Self::smooth_contacts) in the plane.
    #[inline(always)]
    pub(in crate::dynamics) fn smooth_balls<S: Wide, const RECORD: bool>(
        &self,
        simd: S,
        space: &Space,
        rings: &[RingInSpace; 2],
        stage: &Stage,
        derivative: &mut [f64],
        kept: (&[ElementBlock], &mut Record),
    ) -> OnRings<COORDINATES> {
        let balls = Balls::<RECORD> { model: self, space, rings, stage, derivative, kept };
        if !space.tilts {
            let [offset, drift] = balls.apart(simd);
            return balls.seen(simd, (Shifted::<_, 3, false> { offset, drift }, Concentric));
        }
        let outer = &rings[1];
        if [outer.position, outer.velocity].iter().any(|of| of[3..] != [0.0; 2]) {
            // A function of its own: only hosts tilt outer rings.
            return simd.outlined(balls);
        }
        let inner = tilted(simd, &rings[0], balls.apart(simd));
        balls.seen(simd, (inner, Concentric))
    }
}

impl<const RECORD: bool> Balls<'_, RECORD> {
    /// How far the outer ring's centre is before the inner one's (m), and how fast it goes away (m/s).
    #[inline(always)]
    fn apart<S: Wide>(&self, simd: S) -> [[Lanes<S>; 3]; 2] {
        let [inner, outer] = self.rings;
        let apart = |of: fn(&RingInSpace) -> &[f64; COORDINATES]| {
            [0, 1, 2].map(|k: usize| Lanes::splat(simd, of(outer)[k] - of(inner)[k]))
        };
        [apart(|ring| &ring.position), apart(|ring| &ring.velocity)]
    }

    /// What acts on the rings that see the balls so.
    #[inline(always)]
    fn seen<S: Wide, VI, VO>(self, simd: S, views: (VI, VO)) -> OnRings<COORDINATES>
    where
        VI: View<Lanes<S>, 2, COORDINATES>,
        VO: View<Lanes<S>, 2, COORDINATES>,
    {
        let Self { model, space, rings, stage, derivative, kept } = self;
        let number = |number: f64| Lanes::splat(simd, number);
        let law = DampedLaw::new(model.inner.contact.law.damping, Point, number);
        let groove = |side: usize| GrooveCircle {
            groove: &space.grooves[side],
            law,
            across_damping: number(space.across_damping),
        };
        let [x, y, z, ..] = rings[1].velocity;
        let smooth = Smooth {
            model,
            simd,
            cage: stage.cage,
            carrier: [x, y, z],
            axial_gravity: space.gravity,
            ahead: stage.ahead,
            law,
            views,
            raceways: (groove(0), groove(1)),
        };
        smooth.all::<2, COORDINATES, RECORD, true>(stage.state, derivative, kept.0, kept.1)
    }
}

impl<const RECORD: bool> Kernel for Balls<'_, RECORD> {
    type Output = OnRings<COORDINATES>;

    /// Between rings that both tilt.
    #[inline(always)]
    fn run<S: Wide>(self, simd: S) -> OnRings<COORDINATES> {
        let none = [[Lanes::splat(simd, 0.0); 3]; 2];
        let views = (tilted(simd, &self.rings[0], self.apart(simd)), tilted(simd, &self.rings[1], none));
        self.seen(simd, views)
    }
}

/// A ring as all lanes have it.
#[inline(always)]
fn tilted<S: Wide>(simd: S, ring: &RingInSpace, apart: [[Lanes<S>; 3]; 2]) -> Tilted<Lanes<S>> {
    let pair = |of: &[f64; COORDINATES]| [of[3], of[4]].map(|tilt| Lanes::splat(simd, tilt));
    Tilted::new(apart, pair(&ring.position), pair(&ring.velocity))
}
