//! A ball's contacts with many derivatives. What a contact exerts depends on where the ball is in its ring's meridian
//! plane, and in which direction. It is worked out with derivatives by these few numbers, and the chain rule gives all
//! others.

use super::OnBall;
use super::contacts::{BallMotion, InMeridian, Place, place_of};
use crate::contact::rolling::RacewaySide;
use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::element::{Element, Meridian, Tilted};
use crate::dynamics::parameters::{Model, Space};
use crate::numerics::number::{Dual, Scalar};

/// Derivatives by where a ball is and in which direction.
pub(in crate::dynamics) const STANDING: usize = 3;
/// The same, and by how fast both change.
pub(in crate::dynamics) const MOVING: usize = 6;

impl<N: Scalar, const K: usize> Place<Dual<N, K>> {
    /// What a contact depends on: place and direction, their rates.
    fn numbers(&self) -> [Dual<N, K>; MOVING] {
        let ([x, h], [x_rate, h_rate], [direction, turning]) = (self.at.at, self.at.rate, self.turn);
        [x, h, direction, x_rate, h_rate, turning]
    }

    /// The same place with derivatives by the first `L` of these.
    fn by_itself<const L: usize>(&self) -> Place<Dual<N, L>> {
        let mut numbers = self.numbers().map(|number| Dual::constant(number.value));
        for (k, number) in numbers.iter_mut().enumerate().take(L) {
            number.by[k] = N::from(1.0);
        }
        let [x, h, direction, x_rate, h_rate, turning] = numbers;
        Place { at: Meridian { at: [x, h], rate: [x_rate, h_rate] }, turn: [direction, turning] }
    }
}

impl Model {
    /// What the inner and the outer contact exert on a ball that rings see so, with derivatives by `L` of what they
    /// depend on.
    pub(in crate::dynamics) fn chained_on_ball<N: Scalar, const L: usize, const K: usize>(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        at: &BallMotion<N>,
        (views, ball): (&[Tilted<Dual<N, K>>; 2], &Element<Dual<N, K>, 2>),
        shortcuts: &mut Shortcuts,
    ) -> [OnBall<Dual<N, K>>; 2] {
        let laws = [&self.inner.contact, &self.outer.contact];
        let lifted = at.lifted::<L>();
        [RacewaySide::Inner, RacewaySide::Outer].map(|side| {
            let (law, view, cells) = (laws[side as usize], &views[side as usize], cells[side as usize]);
            let (place, seen) = place_of(side, cells, Dual::constant(at.angle), view, ball);
            let found = self.ball_contact((law, side), space, cells, &lifted, &place.by_itself(), shortcuts);
            let (InMeridian { force: [outwards, along], around, .. }, of) = (found, place.numbers());
            OnBall::of(&seen, [outwards.chained(&of), along.chained(&of)], around.map(|around| around.chained(&of)))
        })
    }
}
