//! Grooves, and the tilted rings that they are on, against what they follow from.

use super::*;
use crate::contact::law::Point;
use crate::contact::rolling::RacewaySide;
use crate::dynamics::element::{Aslant, Element, Tilted, View, cross, product};
use crate::numerics::number::Dual;
use crate::scene::{Bearing, Damping};
use proptest::prelude::*;

type Changing = Dual<f64, 1>;

/// An angular contact bearing with 25° (12 balls of 7.938 on 38.5 mm).
fn bearing() -> Bearing {
    let mut bearing = Bearing::steel_balls(12, 7.938e-3, 38.5e-3);
    (bearing.conformity_inner, bearing.conformity_outer) = (0.515, 0.525);
    bearing.set_contact_angle(25f64.to_radians());
    bearing
}

/// R_o − r (m)
fn rolling_radius() -> f64 {
    bearing().outer_raceway_radius() - bearing().element_radius()
}

/// A ball in the direction x, with these u, v and rates, going round at 100 rad/s.
fn ball<T: Number>([u, v]: [T; 2], rate: [T; 2]) -> Element<T, 2> {
    Element { e_r: [u.all(1.0), u.all(0.0)], at: [u, v], rate, rho: u + u.all(rolling_radius()), omega: u.all(100.0) }
}

#[test]
fn a_bearing_just_closed_touches_without_force_at_its_free_contact_angle() {
    for groove in Groove::of(&bearing()) {
        // Its balls' centres are in z = 0 on the pitch circle except for half of (f_i − f_o) D (1 − cos α°).
        let free = 25f64.to_radians();
        let g = match groove.side {
            RacewaySide::Inner => groove.centre_radius - groove.reach * free.cos(),
            RacewaySide::Outer => groove.centre_radius + groove.reach * free.cos(),
        };
        let found = Touch::of(&groove, &Meridian { at: [g - rolling_radius(), 0.0], rate: [0.0; 2] });
        // Rounding of distances of 20 mm.
        assert!(found.approach.abs() < 1e-17, "{:e}", found.approach);
        assert!((groove.angle(found.normal) - free).abs() < 1e-13);
    }
}

proptest! {
    #[test]
    fn a_ring_turned_with_all_around_it_changes_nothing(
        q in prop::array::uniform3(-1e-4..1e-4f64), tilt in prop::array::uniform2(-0.05..0.05f64),
    ) {
        let at = [rolling_radius() + q[0], q[1], q[2]];
        // The ball where it would be, seen by the tilted ring: R q with R ẑ = a. Rodrigues about ẑ × a.
        let length = (tilt[0] * tilt[0] + tilt[1] * tilt[1] + 1.0f64).sqrt();
        let a = [tilt[1] / length, -tilt[0] / length, 1.0 / length];
        let rotated = |v: [f64; 3]| {
            let k = [-a[1], a[0], 0.0];
            let once = cross(k, v);
            let twice = cross(k, once);
            [0, 1, 2].map(|i: usize| v[i] + once[i] + twice[i] / (1.0 + a[2]))
        };
        let seen = |at: [f64; 3], tilt| {
            let offset = [at[0] - rolling_radius(), at[1], at[2]];
            Tilted::new([offset, [0.0; 3]], tilt, [0.0; 2]).see(&ball([0.0; 2], [0.0; 2]))
        };
        for groove in Groove::of(&bearing()) {
            let ((still, upright), (there, tilted)) = (seen(at, [0.0; 2]), seen(rotated(at), tilt));
            let [still, there] = [still, there].map(|at| Touch::of(&groove, &at));
            prop_assert!((there.approach - still.approach).abs() < 2e-17);
            let normal = rotated(upright.in_meridian(still.normal));
            // d, not above 0 on the far side of the circle, where there is no contact.
            let distance = (still.approach + groove.reach).max(0.0);
            for (one, other) in tilted.in_meridian(there.normal).into_iter().zip(normal) {
                // A direction over d is lost to the rounding of 20 mm.
                prop_assert!((one - other).abs() * distance < 1.2e-16);
            }
        }
    }

    #[test]
    fn place_and_direction_change_as_their_rates_say(
        [u, v] in prop::array::uniform2(-3e-5..3e-5f64), rate in prop::array::uniform2(-0.1..0.1f64),
        offset in prop::array::uniform3(-8e-5..8e-5f64), drift in prop::array::uniform3(-0.1..0.1f64),
        tilt in prop::array::uniform2(-0.05..0.05f64), tilting in prop::array::uniform2(-1.0..1.0f64),
    ) {
        let ball = ball([u, v], rate);
        let view = Tilted::new([offset, drift], tilt, tilting);
        let (at, seen) = view.see(&ball);
        let going = |value: f64, rate: f64| Changing { value, by: [rate] };
        let all = |values: [f64; 3], rates: [f64; 3]| [0, 1, 2].map(|i: usize| going(values[i], rates[i]));
        let tilts = [0, 1].map(|i: usize| going(tilt[i], tilting[i]));
        let still = Tilted::new([all(offset, drift), all([0.0; 3], [0.0; 3])], tilts, [going(0.0, 0.0); 2]);
        let moved = Element {
            e_r: [going(1.0, 0.0), going(0.0, ball.omega)],
            at: [going(u, rate[0]), going(v, rate[1])],
            rate: [going(0.0, 0.0); 2],
            rho: going(ball.rho, rate[0]),
            omega: going(0.0, 0.0),
        };
        let (place, direction): (Meridian<Changing, 2>, Aslant<Changing>) = still.see(&moved);
        for (place, rate) in place.at.into_iter().zip(at.rate) {
            // Rounding of 2 m/s.
            prop_assert!((place.by[0] - rate).abs() < 1e-14);
        }
        // The direction is one about z: to second order in the tilt that about the ring's axis. A ring that is tilted
        // about x and turns about y turns about its own axis by their product.
        let [tilt, tilting] = [tilt, tilting].map(|[x, y]: [f64; 2]| x.hypot(y));
        let apart = direction.lead().by[0] + ball.omega - view.turning_of(&ball, &seen);
        prop_assert!(apart.abs() < 1e-12 + tilt * (4.0 * tilt * ball.omega + 1.1 * tilting), "{apart}");
        for groove in Groove::of(&bearing()) {
            let touch = Touch::of(&groove, &at);
            // On the far side of the circle there is no contact.
            if groove.cosine(touch.normal) > 0.0 {
                prop_assert!((Touch::of(&groove, &place).approach.by[0] - touch.closing).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn what_a_contact_takes_from_ring_and_ball_is_what_it_stores(
        [u, v] in prop::array::uniform2(-3e-5..3e-5f64), rate in prop::array::uniform2(-0.1..0.1f64),
        offset in prop::array::uniform3(-8e-5..8e-5f64), going in prop::array::uniform3(-0.1..0.1f64),
        tilt in prop::array::uniform2(-0.05..0.05f64), tilting in prop::array::uniform2(-1.0..1.0f64),
    ) {
        // The outer ring stands.
        let (ball, drift) = (ball([u, v], rate), going.map(|rate| -rate));
        let view = Tilted::new([offset, drift], tilt, tilting);
        let (at, seen) = view.see(&ball);
        let law = DampedLaw::new(Damping::HuntCrossley(0.0), Point, |number| number);
        for groove in &Groove::of(&bearing()) {
            let found = GrooveCircle { groove, law, across_damping: 0.0 }.contact(2.5e10, &at);
            let ([radial, axial], around) = Tilted::on_element(&seen, found.force);
            let taken = radial * rate[0] + axial * rate[1] + around.unwrap_or(0.0) * ball.rho * ball.omega;
            let [x, y, z, m_x, m_y] = Tilted::along_ring(&ball, &seen, found.force);
            // Moments on the ring are about axes at right angles to its own.
            let moment = [m_x, m_y, -(m_x * seen.axis[0] + m_y * seen.axis[1]) / seen.axis[2]];
            let per_square = 1.0 / (1.0 + tilt[0] * tilt[0] + tilt[1] * tilt[1]);
            let turning = [tilting[0], tilting[1], tilt[0] * tilting[1] - tilt[1] * tilting[0]];
            let of_ring = product([x, y, z], going) + product(moment, turning) * per_square;
            // Rounding of 20 mm at 2 m/s, over the groove's 120 µm.
            let largest = found.magnitude * 2.0;
            prop_assert!((taken - of_ring + found.magnitude * found.closing).abs() <= 1e-12 * largest);
        }
    }
}
