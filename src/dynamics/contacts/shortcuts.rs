//! What was worked out last and makes the next of its kind quicker. It changes no result, except for roundings of law
//! `love`, which those forget who want bits that depend on nothing before.

use crate::contact::near_defect::LoveSolvers;
use crate::dynamics::parameters::{LeadPieces, Model};

/// Shortcuts of contacts that are computed one by one.
#[derive(Debug, Clone, Default)]
pub struct Shortcuts {
    /// Where contacts of law `love` are solved.
    pub(in crate::dynamics) love: LoveSolvers,
    /// Polynomials of an uneven cage.
    pub(crate) leads: LeadPieces,
}

impl Shortcuts {
    /// With all the room that a model needs, which others take when they need it first.
    pub fn of(model: &Model) -> Self {
        // An even cage has no polynomials.
        let count = if model.is_uneven() { model.element_count } else { 0 };
        Self { love: model.love_solvers(), leads: LeadPieces::new(count) }
    }

    /// Forgets what later roundings would depend on.
    pub fn forget(&mut self) {
        self.love.forget();
    }
}
