//! The force of an oil film that is pressed out of a gap before surfaces touch.
//!
//! Elements press oil out of a closing gap; an opening one cavitates and pulls at nothing. With g the height of the gap
//! and H the height up to which oil fills it, Reynolds' equation has a closed solution for paraboloids, since the edge
//! of the oil is then a line of equal height:
//! ```text
//! F = c g'/g (1 − g/H)²   while g' closes and g < H;   F = c g'/g without a limit
//! ```
//! (c: [`crate::geometry::film_thickness`]). Where the surfaces are pressed together they are the film's thickness h
//! apart, so that a contact begins at g = h: with the approach Δ, negative before it, g = h − Δ.
//!
//! Under load the contact's own damping stands for what the film does. The squeeze force hands over to it within the
//! approach h, over which the surfaces deform as much as the film is thick:
//! ```text
//! F = c Δ'/h (1 − h/H)² (1 − Δ/h)²   for 0 ≤ Δ < h
//! ```
//! Without that the force would fall by c Δ'/h where a contact begins: 11 N at 10 mm/s.
//!
//! h is never taken to be less than [`ROUGHNESS`]: where nothing rolls there is no film, and surfaces touch with their
//! asperities. Near a defect the gap is that of the contact law's equivalent approach, and c that of the whole raceway.

use crate::numerics::number::Number;

/// Height of asperities (m): gaps are no smaller.
pub(crate) const ROUGHNESS: f64 = 0.02e-6;

/// The film between elements and one raceway.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SqueezeFilm<T = f64> {
    /// c (N s).
    pub coefficient: f64,
    /// h (m), and its reciprocal.
    pub thickness: T,
    per_thickness: T,
    /// 1/H (1/m); 0 where oil fills every gap.
    pub per_layer: f64,
}

impl SqueezeFilm {
    /// A film of squeeze constant c (N s) and thickness (m), with oil up to a height of `layer` (m).
    pub fn new(coefficient: f64, thickness: f64, layer: Option<f64>) -> Self {
        let thickness = thickness.max(ROUGHNESS);
        let per_layer = layer.map_or(0.0, |layer| 1.0 / layer);
        Self { coefficient, thickness, per_thickness: 1.0 / thickness, per_layer }
    }

    /// The same in numbers of another kind; `to` makes them.
    #[inline(always)]
    pub fn to<T: Number>(&self, to: impl Fn(f64) -> T) -> SqueezeFilm<T> {
        let Self { coefficient, per_layer, .. } = *self;
        SqueezeFilm { coefficient, thickness: to(self.thickness), per_thickness: to(self.per_thickness), per_layer }
    }

    /// The same of a thickness that has derivatives; where asperities are higher it has none.
    pub fn of_thickness<T: Number>(&self, thickness: T) -> SqueezeFilm<T> {
        let Self { coefficient, per_layer, .. } = *self;
        let asperities = thickness.all(ROUGHNESS);
        let thickness = asperities.if_less(thickness, thickness, asperities);
        SqueezeFilm { coefficient, thickness, per_thickness: thickness.all(1.0) / thickness, per_layer }
    }
}

impl<T: Number> SqueezeFilm<T> {
    /// Force (N) at approach `delta` (m) and its rate (m/s).
    #[inline(always)]
    pub fn force(&self, delta: T, rate: T) -> T {
        let one = delta.all(1.0);
        let gap = self.thickness + (-delta).or_zero();
        let filled = (one - gap * delta.plain(self.per_layer)).or_zero();
        let unloaded = (one - delta.or_zero() * self.per_thickness).or_zero();
        let share = filled * unloaded;
        // Where nothing moves half of all elements resist, whichever way a ring begins to move.
        rate.or_zero_across() * delta.plain(self.coefficient) / gap * (share * share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::number::Dual;
    use proptest::prelude::*;

    const FILMS: [SqueezeFilm; 3] =
        [film(1.73e-4, 0.155e-6, 0.0), film(1.73e-4, 0.155e-6, 1e6), film(2e-5, ROUGHNESS, 3e5)];

    const fn film(coefficient: f64, thickness: f64, per_layer: f64) -> SqueezeFilm {
        SqueezeFilm { coefficient, thickness, per_thickness: 1.0 / thickness, per_layer }
    }

    fn force(film: &SqueezeFilm, delta: f64, rate: f64) -> f64 {
        film.force(delta, rate)
    }

    #[test]
    fn a_gap_that_closes_evenly_resists_as_the_closed_form_says() {
        // The film's own c by quadrature of the pressure over the gap's filled part, in the radius √(h − ε) of
        // paraboloids: F = 2π√(R_x R_y) ∫ p dh, p = K (1/h² − 1/H²).
        for film in &FILMS {
            for gap in [0.2e-6, 0.5e-6, 2e-6, 2.9e-6] {
                let rate = 0.01;
                let height = if film.per_layer > 0.0 { 1.0 / film.per_layer } else { 1e6 * gap };
                let count = 200_000;
                let (log_low, log_high) = (f64::ln(gap), f64::ln(height));
                // Midpoints, even in the logarithm of h.
                let sum: f64 = (0..count)
                    .map(|i| {
                        let width = (log_high - log_low) / f64::from(count);
                        let h = (log_low + (f64::from(i) + 0.5) * width).exp();
                        let outside = film.per_layer * film.per_layer;
                        (1.0 / (h * h) - outside) * h * width
                    })
                    .sum();
                let expected = if height > gap { film.coefficient * rate * sum } else { 0.0 };
                let found = force(film, film.thickness - gap, rate);
                // Without a limit the sum leaves out what is beyond a million gaps: 1e-6.
                assert!((found - expected).abs() <= 2e-6 * expected, "{film:?} {gap}: {found} {expected}");
            }
        }
    }

    proptest! {
        #[test]
        fn a_film_takes_energy_and_never_gives_any(delta in -5e-6..1e-6f64, rate in -1.0..1.0f64) {
            for film in &FILMS {
                let force = force(film, delta, rate);
                prop_assert!(force >= 0.0 && (rate > 0.0 || force == 0.0));
            }
        }

        #[test]
        fn derivatives_equal_difference_quotients(delta in -5e-6..1e-6f64, rate in 1e-3..1.0f64) {
            for film in &FILMS {
                let (d, v) = (1e-13, 1e-6);
                let ends = [-film.thickness + 0.0, 0.0, film.thickness].map(|end| (delta - end).abs());
                prop_assume!(ends.iter().all(|away| *away > 2.0 * d));
                let dual = Dual::<f64, 3>::variable;
                let of = film.of_thickness(dual(film.thickness, 2));
                let found = of.force(dual(delta, 0), dual(rate, 1));
                let by_approach = (force(film, delta + d, rate) - force(film, delta - d, rate)) / (2.0 * d);
                let by_rate = (force(film, delta, rate + v) - force(film, delta, rate - v)) / (2.0 * v);
                // Second-order quotients over 1e-13 m of lengths from 2e-8 m; their rounding is 1e-16 of 1e-6 m.
                let scale = film.coefficient * rate / (film.thickness * film.thickness);
                prop_assert!((found.value - force(film, delta, rate)).abs() <= 1e-12 * scale * film.thickness);
                prop_assert!((found.by[0] - by_approach).abs() < 1e-5 * scale, "{by_approach} {found:?}");
                prop_assert!((found.by[1] - by_rate).abs() < 1e-6 * scale * film.thickness / rate);
                let thicker = |by: f64| film.of_thickness(film.thickness + by).force(delta, rate);
                let by_thickness = (thicker(d) - thicker(-d)) / (2.0 * d);
                // At the asperities' height a thickness has one side only.
                let one_sided = film.thickness <= ROUGHNESS;
                let miss = (found.by[2] - by_thickness).abs();
                prop_assert!(one_sided || miss < 1e-5 * scale, "{by_thickness} {found:?}");
            }
        }
    }

    #[test]
    fn the_force_goes_over_into_the_contact_without_a_step() {
        for film in &FILMS {
            let at = |delta: f64| force(film, delta, 0.01);
            let whole = at(-1e-15);
            // A femtometre of 20 nm or more.
            assert!((at(1e-15) - whole).abs() < 1e-6 * whole);
            assert!(at(film.thickness) == 0.0 && at(0.999_9 * film.thickness) < 1e-7 * whole);
        }
    }

    #[test]
    fn nan_gives_no_force_that_is_one() {
        for film in &FILMS {
            assert!(force(film, f64::NAN, 0.1).is_nan() && force(film, -1e-7, f64::NAN).is_nan());
        }
    }
}
