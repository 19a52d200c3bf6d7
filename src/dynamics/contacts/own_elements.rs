//! What an element has by itself: its size, its mass and its contacts.

use crate::contact::law::CompliantContact;
use crate::dynamics::parameters::{Model, OilFilms};
use crate::numerics::lanes::WIDEST;
use crate::numerics::number::Scalar;

impl Model {
    /// Mass (kg) of element `j`.
    #[inline(always)]
    pub fn mass_of(&self, j: usize) -> f64 {
        self.elements[j / WIDEST].mass[j % WIDEST]
    }

    /// 1/mass (1/kg) of element `j`.
    #[inline(always)]
    pub(in crate::dynamics) fn per_mass_of(&self, j: usize) -> f64 {
        self.elements[j / WIDEST].per_mass[j % WIDEST]
    }

    /// Diameter (m) of element `j` beyond the nominal one.
    #[inline(always)]
    pub(in crate::dynamics) fn larger(&self, j: usize) -> f64 {
        self.elements[j / WIDEST].larger[j % WIDEST]
    }

    /// Distance ρ (m) of element `j` where it touches the smooth outer raceway.
    #[inline(always)]
    pub fn centre_radius(&self, j: usize) -> f64 {
        self.outer_centre_radius - 0.5 * self.larger(j)
    }

    /// What separates a raceway from element `j` pressed to the other (m), films included.
    pub(in crate::dynamics) fn clearance_between<T: Scalar>(&self, j: usize, films: Option<&OilFilms<T>>) -> T {
        let clearance = T::from(self.radial_clearance - self.larger(j));
        films.map_or(clearance, |films| clearance - films.together)
    }

    /// Contacts of element `j` with the smooth inner and outer raceway.
    #[inline(always)]
    pub(in crate::dynamics) fn own_contacts(&self, j: usize) -> [&CompliantContact; 2] {
        let nominal = || [&self.inner.contact, &self.outer.contact];
        self.own.get(j).map_or_else(nominal, |own| own.contacts.each_ref())
    }

    /// The same with the damping that contacts of an element in balance are computed without.
    pub(in crate::dynamics) fn own_dampers(&self, j: usize) -> [&CompliantContact; 2] {
        let dampers = self.own.get(j).map_or(self.dampers.as_deref(), |own| own.dampers.as_ref());
        dampers.map_or_else(|| self.own_contacts(j), |dampers| dampers.each_ref())
    }

    /// Sets the compliance (m/N) in series with each outer contact.
    pub fn set_outer_compliance(&mut self, compliance: f64) {
        let own =
            self.own.iter_mut().flat_map(|own| [Some(&mut own.contacts[1]), own.dampers.as_mut().map(|of| &mut of[1])]);
        let of_all = [Some(&mut self.outer.contact), self.dampers.as_mut().map(|dampers| &mut dampers[1])];
        of_all.into_iter().chain(own).flatten().for_each(|contact| contact.compliance = compliance);
    }
}
