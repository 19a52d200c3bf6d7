//! Where a raceway is level, so that the contact is the smooth one's: before the defect, after it, and on flat floors.

use crate::surface::Surface;

use super::raceway_grid::ElementOnRaceway;

/// Distance [m] along the raceway within which the element comes lower than `depth` [m]; a little more than the circles'.
pub(super) fn reach(element: ElementOnRaceway, depth: f64) -> f64 {
    (2.0 * depth.max(0.0) / element.curvatures()[0]).sqrt()
}

/// Stretches of constant depth: first and last arc, depth [m].
pub(super) fn flats(surface: &Surface) -> Vec<(f64, f64, f64)> {
    let (from, to) = surface.extent();
    let mut flats = vec![(f64::NEG_INFINITY, from, 0.0)];
    if let Surface::Profile(profile) = surface {
        for pair in profile.points().windows(2) {
            let ((s0, d0), (s1, d1)) = (pair[0], pair[1]);
            if d0 == d1 && s1 > s0 {
                flats.push((s0, s1, d0));
            }
        }
    }
    flats.push((to, f64::INFINITY, 0.0));
    flats
}

/// Smallest depth [m], of the highest rim; 0 without one.
pub(super) fn shallowest(surface: &Surface) -> f64 {
    let depths: Box<dyn Iterator<Item = f64>> = match surface {
        Surface::Profile(profile) => Box::new(profile.points().iter().map(|&(_, depth)| depth)),
        Surface::Topography(topography) => Box::new(topography.grid().2.iter().copied()),
    };
    depths.fold(0.0, f64::min)
}
