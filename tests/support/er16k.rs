//! Contacts of an ER16K's ball, test bearing 1's.
#![allow(dead_code, unreachable_pub)] // each test program uses a part of this

use brinell::contact::element_on_raceway::{Across, ElementOnRaceway};
use brinell::contact::rolling::RacewaySide;

pub const OUTER: ElementOnRaceway = ElementOnRaceway {
    element_radius: 3.97e-3,
    raceway_radius: 23.6325e-3,
    across: Across::Groove(4.095e-3),
    raceway: RacewaySide::Outer,
};

pub const INNER: ElementOnRaceway =
    ElementOnRaceway { raceway_radius: 15.6875e-3, raceway: RacewaySide::Inner, ..OUTER };
