//! Waves around a body, as an element feels them.
//!
//! A body whose radius is B + Σ w_n cos n(ψ − ψ_n) comes so much closer to the other one that the approach of a
//! smooth contact grows by the wave's height, η = +w on the inner raceway and on an element, η = −w on the outer
//! raceway, which is hollow:
//! ```text
//! δ = u + η(ψ),   ∂δ/∂ψ = η',   tangential force −Q η'/ρ, ρ the distance of the element from the ring's centre
//! ```
//! Both forces are the gradient of one energy. Waves are far longer than the contact and far flatter than the gap, so
//! that a rigid element follows them.

use crate::numerics::number::Scalar;
use crate::numerics::sin_cos;
use crate::scene::{Scene, WavyBody};
use std::convert::Infallible;

/// Step (rad) over the order of the differences that stand for third derivatives of a height.
const STEP: f64 = 1e-5;

/// All waves of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Waves {
    waves: Vec<Wave>,
    step: f64,
}

/// Waves of one order.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Wave {
    order: f64,
    /// Greatest η (m); negative where the surface gives way at `crest`.
    height: f64,
    /// Angle of a crest (rad).
    crest: f64,
}

impl Waves {
    /// Those of a body, whose angle 0 is at `zero` (rad) in the frame in which they are asked for; `None` where there
    /// are none.
    pub fn of(scene: &Scene, body: WavyBody, zero: f64) -> Option<Self> {
        let towards = if body == WavyBody::Outer { -1.0 } else { 1.0 };
        let of_body = scene.waviness.iter().filter(|waves| waves.on == body);
        let waves: Vec<Wave> = of_body
            .map(|of| Wave { order: f64::from(of.order), height: towards * of.amplitude, crest: of.crest + zero })
            .collect();
        let finest = waves.iter().fold(1.0f64, |most, wave| most.max(wave.order));
        (!waves.is_empty()).then_some(Self { waves, step: STEP / finest })
    }

    /// Height η (m), and its first and second derivative by the angle (m/rad, m/rad²), at a direction (rad).
    fn at(&self, direction: f64) -> [f64; 3] {
        self.waves.iter().fold([0.0; 3], |[value, first, second], &Wave { order, height, crest }| {
            let (sin, cos) = sin_cos(order * (direction - crest));
            let (along, across) = (height * cos, height * sin);
            [value + along, first - order * across, second - order * order * along]
        })
    }

    /// Height η (m) and its derivative (m/rad) at a direction (rad), with derivatives of both.
    pub fn height<T: Scalar>(&self, direction: T) -> [T; 2] {
        let [value, first, _] = self.at(direction.value());
        let second = &mut |[angle, _]: [f64; 2]| Ok::<_, Infallible>([self.at(angle)[2], 0.0, 0.0]);
        match T::surface([direction, T::from(0.0)], [value, first, 0.0], self.step, second) {
            Ok([height, slope, _]) => [height, slope],
            Err(never) => match never {},
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::number::Dual;

    #[test]
    fn heights_have_their_own_derivatives() {
        let wave = |order, height, crest| Wave { order, height, crest };
        let waves = Waves { waves: vec![wave(9.0, -1e-6, 0.3), wave(2.0, 3e-6, -1.0)], step: STEP / 9.0 };
        let height = |angle: f64| -1e-6 * (9.0 * (angle - 0.3)).cos() + 3e-6 * (2.0 * (angle + 1.0)).cos();
        for k in 0..50 {
            let angle = 0.13 * f64::from(k) - 3.0;
            let [found, slope] = waves.height(Dual::<Dual<f64, 1>, 1>::variable(Dual::variable(angle, 0), 0));
            assert!((found.value.value - height(angle)).abs() < 1e-20);
            let difference = |h: f64| (height(angle + h) - height(angle - h)) / (2.0 * h);
            assert!((slope.value.value - difference(1e-4)).abs() < 1e-10);
            assert_eq!(found.by[0].value, slope.value.value);
            // −n² and n⁴ of each order.
            let curvature = |power: i32| {
                -1e-6 * 9f64.powi(power) * (9.0 * (angle - 0.3)).cos()
                    + 3e-6 * 2f64.powi(power) * (2.0 * (angle + 1.0)).cos()
            };
            assert!((slope.by[0].value + curvature(2)).abs() < 1e-16);
            let third = 3e-6 * 8.0 * (2.0 * (angle + 1.0)).sin() - 1e-6 * 729.0 * (9.0 * (angle - 0.3)).sin();
            assert!((slope.by[0].by[0] - third).abs() < 1e-11, "{} {third}", slope.by[0].by[0]);
        }
    }
}
