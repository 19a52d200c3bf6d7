//! A contact near a defect as one potential, written for a ball on the outer raceway.
//!
//! W(u, s) = (2/5) K Δ(u, s)^{5/2} is the elastic energy of an element whose centre stands at radial path u and arc s;
//! K is Hertz's constant of the smooth contact. (A roller has K Δ^{19/9} 9/19.) Δ is the *equivalent approach*: the
//! approach on the smooth raceway that stores the same energy. Both forces derive from it, so that a closed path costs
//! no work:
//!
//! ```text
//! F_n = ∂W/∂u = K Δ^{3/2} ∂Δ/∂u     radial, pushes the element inwards
//! F_t = −∂W/∂s = −K Δ^{3/2} ∂Δ/∂s   on the element along +s, per metre of raceway arc
//! ```

/// Δ with the derivatives by u and s that the forces, and their slopes along the path, need [m, –, 1/m]. Below zero
/// there is no contact; the value then only tells how far off the contact is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EquivalentApproach {
    /// Δ (m).
    pub value: f64,
    /// ∂Δ/∂u.
    pub du: f64,
    /// ∂Δ/∂s.
    pub ds: f64,
    /// ∂²Δ/∂u² (1/m).
    pub duu: f64,
    /// ∂²Δ/∂u∂s (1/m).
    pub dus: f64,
}

impl EquivalentApproach {
    /// Smooth raceway lowered by a constant `depth` (m): Δ = u − depth.
    pub fn flat(u: f64, depth: f64) -> Self {
        Self { value: u - depth, du: 1.0, ..Self::default() }
    }

    /// F_n and F_t (N), where `smooth` gives the force (N) of the smooth contact at an approach (m).
    pub fn forces(&self, smooth: impl Fn(f64) -> f64) -> [f64; 2] {
        let force = smooth(self.value.max(0.0));
        [force * self.du, -force * self.ds]
    }
}

/// Second derivatives of an equivalent approach.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SecondDerivatives {
    /// ∂²Δ/∂u² (1/m).
    pub uu: f64,
    /// ∂²Δ/∂u∂s (1/m).
    pub us: f64,
    /// ∂²Δ/∂s² (1/m).
    pub ss: f64,
}

impl SecondDerivatives {
    /// [Δ_uu, Δ_us, Δ_ss].
    pub fn rows(self) -> [f64; 3] {
        [self.uu, self.us, self.ss]
    }
}
