//! The smooth raceway's energy on a grid, and its inverse: from the energy of any contact to the equivalent approach.

use libm::pow;

use crate::contact::equivalent::{EquivalentApproach, SecondDerivatives};

/// Energy of the grid and its derivatives, without the factor π E* × cell area.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Energy {
    pub(super) w: f64,
    pub(in crate::contact) u: f64,
    pub(super) s: f64,
}

impl Energy {
    /// Adds a part of another.
    pub(in crate::contact) fn add(&mut self, other: &Self, part: f64) {
        self.w += part * other.w;
        self.u += part * other.u;
        self.s += part * other.s;
    }
}

/// Δ(V(W)) at one W.
struct LocalScale {
    value: f64,
    /// dΔ/dV and d²Δ/dV².
    slope: f64,
    curvature: f64,
    /// dV/dW and d²V/dW².
    per_w: f64,
    second: f64,
}

impl LocalScale {
    /// ∂²Δ/∂x∂y from ∂²W/∂x∂y, ∂W/∂x and ∂W/∂y.
    fn second_derivative(&self, w_xy: f64, w_x: f64, w_y: f64) -> f64 {
        let v_xy = self.per_w * w_xy + self.second * w_x * w_y;
        self.slope * v_xy + self.curvature * (self.per_w * w_x) * (self.per_w * w_y)
    }
}

/// Δ as a function of V = W^p, p = 2/5 of balls and 9/19 of rollers, cubic Hermite between nodes [V, Δ, dΔ/dV].
#[derive(Debug, Clone, Default)]
pub(super) struct SmoothScale {
    nodes: Vec<[f64; 3]>,
    /// p
    power: f64,
}

impl SmoothScale {
    /// From ascending nodes, V being this power of W.
    pub(in crate::contact) fn new(nodes: Vec<[f64; 3]>, power: f64) -> Self {
        Self { nodes, power }
    }

    /// Smallest Δ (m) that the grid resolves.
    pub(super) fn onset(&self) -> f64 {
        self.nodes.first().map_or(0.0, |node| node[1])
    }

    /// Equivalent approach of an energy, without second derivatives.
    pub(super) fn equivalent(&self, e: Energy) -> EquivalentApproach {
        if e.w <= 0.0 {
            return EquivalentApproach::default();
        }
        let scale = self.local(e.w);
        EquivalentApproach {
            value: scale.value,
            du: scale.slope * (scale.per_w * e.u),
            ds: scale.slope * (scale.per_w * e.s),
            ..EquivalentApproach::default()
        }
    }

    /// ∂²Δ/∂u² and ∂²Δ/∂u∂s of an energy with these second derivatives of its own.
    pub(super) fn by_path(&self, e: Energy, [uu, us]: [f64; 2]) -> [f64; 2] {
        if e.w <= 0.0 {
            return [0.0; 2];
        }
        let scale = self.local(e.w);
        [scale.second_derivative(uu, e.u, e.u), scale.second_derivative(us, e.u, e.s)]
    }

    /// Second derivatives of the equivalent approach of an energy, of which `second` are the second derivatives.
    pub(super) fn second_derivatives(&self, e: Energy, second: SecondDerivatives) -> SecondDerivatives {
        let SecondDerivatives { uu, us, ss } = second;
        let [[uu, us], [_, ss]] = self.second(e.w, [e.u, e.s], [[uu, us], [us, ss]]);
        SecondDerivatives { uu, us, ss }
    }

    /// Slopes of the equivalent approach of an energy `w` that has these slopes.
    pub(super) fn slopes<const N: usize>(&self, w: f64, slopes: [f64; N]) -> [f64; N] {
        if w <= 0.0 {
            return [0.0; N];
        }
        let scale = self.local(w);
        slopes.map(|slope| scale.slope * (scale.per_w * slope))
    }

    /// Its second derivatives, of an energy that has these slopes and second derivatives.
    pub(super) fn second<const N: usize>(&self, w: f64, by: [f64; N], second: [[f64; N]; N]) -> [[f64; N]; N] {
        if w <= 0.0 {
            return [[0.0; N]; N];
        }
        let scale = self.local(w);
        std::array::from_fn(|i| std::array::from_fn(|j| scale.second_derivative(second[i][j], by[i], by[j])))
    }

    fn local(&self, w: f64) -> LocalScale {
        let v = pow(w, self.power);
        let per_w = self.power * v / w;
        let [value, slope, curvature] = self.at(v);
        LocalScale { value, slope, curvature, per_w, second: (self.power - 1.0) * per_w / w }
    }

    /// Δ, dΔ/dV, d²Δ/dV².
    fn at(&self, v: f64) -> [f64; 3] {
        let last = self.nodes.len().saturating_sub(1);
        let (Some(start), Some(end)) = (self.nodes.first(), self.nodes.last()) else {
            return [f64::NAN; 3];
        };
        if v <= start[0] {
            return [start[1] * v / start[0], start[1] / start[0], 0.0];
        }
        let (low, high) = (start[0].sqrt(), end[0].sqrt());
        let guess = (last as f64 * (v.sqrt() - low) / (high - low)) as usize;
        let mut k = guess.min(last - 1);
        while k > 0 && v < self.nodes[k][0] {
            k -= 1;
        }
        while k < last - 1 && v >= self.nodes[k + 1][0] {
            k += 1;
        }
        let ([v0, d0, m0], [v1, d1, m1]) = (self.nodes[k], self.nodes[k + 1]);
        let width = v1 - v0;
        let t = (v - v0) / width;
        let secant = (d1 - d0) / width;
        // The cubic of `numerics::hermite` adds its terms in another order: every run over a defect would have other
        // bits.
        let (c2, c3) = (3.0 * secant - 2.0 * m0 - m1, m0 + m1 - 2.0 * secant);
        [
            d0 + width * t * (m0 + t * (c2 + t * c3)),
            m0 + t * (2.0 * c2 + 3.0 * t * c3),
            (2.0 * c2 + 6.0 * t * c3) / width,
        ]
    }
}
