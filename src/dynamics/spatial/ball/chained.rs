//! A ball's contacts with many derivatives. What a contact exerts depends on how the ball is seen from its ring. It
//! is worked out with derivatives by these few numbers, and the chain rule gives all others.

use super::contacts::BallMotion;
use super::{Ball, OnBall, Seen};
use crate::contact::groove::{Axis, Spatial};
use crate::contact::rolling::RacewaySide;
use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::parameters::{Model, Space};
use crate::numerics::number::{Dual, Scalar};

/// Derivatives by where a ball is and where its ring's axis points.
pub(in crate::dynamics) const STANDING: usize = 6;
/// The same, and by how fast both move.
pub(in crate::dynamics) const MOVING: usize = 12;

impl<N: Scalar, const K: usize> Seen<Dual<N, K>> {
    /// What a contact depends on: place, axis, their rates.
    fn numbers(&self) -> [Dual<N, K>; MOVING] {
        let (q, a, rate, turning) = (self.q, self.axis.direction, self.rate, self.axis.turning);
        let [[q_r, q_t, q_z], [a_r, a_t, a_z]] = [q, a];
        let [[v_r, v_t, v_z], [t_r, t_t, t_z]] = [rate, turning];
        [q_r, q_t, q_z, a_r, a_t, a_z, v_r, v_t, v_z, t_r, t_t, t_z]
    }

    /// The same ball with derivatives by the first `L` of these.
    fn by_itself<const L: usize>(&self) -> Seen<Dual<N, L>> {
        let number = |of: &Dual<N, K>, m: usize| {
            let mut found = Dual::constant(of.value);
            if m < L {
                found.by[m] = N::from(1.0);
            }
            found
        };
        let three = |[a, b, c]: &Spatial<Dual<N, K>>, m: usize| [number(a, m), number(b, m + 1), number(c, m + 2)];
        let axis = Axis { direction: three(&self.axis.direction, 3), turning: three(&self.axis.turning, 9) };
        Seen { q: three(&self.q, 0), rate: three(&self.rate, 6), axis }
    }
}

impl Model {
    /// What the inner and the outer contact exert on a ball that moves as it is seen, with derivatives by `L` of what
    /// they depend on.
    pub(in crate::dynamics) fn chained_on_ball<N: Scalar, const L: usize, const K: usize>(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        at: &BallMotion<N>,
        ball: &Ball<Dual<N, K>>,
        shortcuts: &mut Shortcuts,
    ) -> [OnBall<Dual<N, K>>; 2] {
        let laws = [&self.inner.contact, &self.outer.contact];
        let lifted = at.lifted::<L>();
        let mut of = |side: RacewaySide, seen: &Seen<Dual<N, K>>| {
            let (law, cells) = (laws[side as usize], cells[side as usize]);
            let found = self.ball_contact((law, side), space, cells, &lifted, &seen.by_itself(), shortcuts);
            let numbers = seen.numbers();
            let chained =
                |[a, b, c]: &Spatial<Dual<N, L>>| [a.chained(&numbers), b.chained(&numbers), c.chained(&numbers)];
            OnBall { force: chained(&found.on_ball.force), moment: chained(&found.on_ball.moment) }
        };
        [of(RacewaySide::Inner, &ball.seen.0), of(RacewaySide::Outer, &ball.seen.1)]
    }
}
