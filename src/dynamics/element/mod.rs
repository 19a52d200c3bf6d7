//! One element, seen from either ring: one text for rings of two, three and five degrees of freedom, in numbers of
//! every kind.
//!
//! An element has `P` coordinates beside its place on the cage: its radial path u, and where it moves along the axis v.
//! A ring's [view](View) says where the element is in the ring's *meridian plane*, through the ring's axis and the
//! element: how far outwards, x, counted from where it touches the smooth outer raceway, and how far along the axis, h.
//! The [raceway](Raceway) turns these `P` numbers and their rates into as many forces, the contact's law included. The
//! view carries them back to the element and to the `C` coordinates of the ring.
//!
//! Along e_r, e_t and the axis, with ρ = R_o − r + u, the outer ring's centre x_o before the inner's x_i and v_o the
//! outer ring's velocity,
//! ```text
//! u' = w − e_r·v_o   w' = F·e_r/m + g·e_r + ω (v_o·e_t + ρ ω)
//! v' = w_z − ż_o     w_z' = F_z/m + g_z
//! q_o = (ρ, 0, v)    q_i = q_o + x_o − x_i    q̇_o = (u', ρ ω, v')    q̇_i = q̇_o + ẋ_o − ẋ_i
//! ```
//! F is the force of both contacts on the element; −F acts on a ring, with the moment −q × F about its centre.

mod directions;
mod raceway;
mod view;

pub(in crate::dynamics) use directions::{dot, radial};
pub(in crate::dynamics) use raceway::{Contact, Filmed, GrooveCircle, Inside, Outside, Raceway, Touch};
pub(in crate::dynamics) use view::{
    Aslant, Concentric, Shifted, Tilted, View, along, cross, dot as product, off_centre, turned_back, views,
};

/// An element, however it is seen.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Element<T, const P: usize> {
    /// Direction e_r from the outer ring's centre, along x and y.
    pub(in crate::dynamics) e_r: [T; 2],
    /// u, and v (m).
    pub(in crate::dynamics) at: [T; P],
    /// u', and v' (m/s).
    pub(in crate::dynamics) rate: [T; P],
    /// ρ (m).
    pub(in crate::dynamics) rho: T,
    /// Its speed about the outer ring's centre (rad/s).
    pub(in crate::dynamics) omega: T,
}

/// Where an element is in a ring's meridian plane: x, and h (m), and how these change (m/s).
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Meridian<T, const P: usize> {
    pub(in crate::dynamics) at: [T; P],
    pub(in crate::dynamics) rate: [T; P],
}
