//! Where defects and waves are: on which body, how it turns, and which of its parts a contact is over.

use crate::bearing::Bearing;
use crate::case::{Case, Defect, On, Shape};
use crate::envelope::{Envelope, Feature, Pair};
use crate::instant::{Outside, Seat};
use crate::surface::{Rise, Stretches, Surface, Surfaces};
use crate::turning::{HOUSING, SHAFT, SPIN, Turns, quadratic};
use crate::uneven::Waves;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The surface that a contact is over, with its number and the stretch, and P, dP/dψ and the speed past it.
pub struct Over<'a> {
    pub surface: &'a Surface,
    pub which: usize,
    pub psi: f64,
    pub path: f64,
    pub slope: f64,
    pub rate: f64,
}

impl Bearing {
    /// That of a case with its defects.
    pub fn new(case: &Case) -> Self {
        let mut bearing = Self::smooth(case);
        bearing.surfaces = of(&bearing, case).unwrap_or_default();
        bearing
    }

    /// What element `j` may meet on the inner or the outer raceway: the ring's defects, and its own.
    pub fn surfaces(&self, side: usize, j: usize) -> [Option<&Surface>; 2] {
        let own = self.surfaces.own.get(j).and_then(Option::as_ref);
        [self.surfaces.rings[side].as_ref(), own.map(|own| &own[side])]
    }

    /// All that there are.
    pub fn all_surfaces(&self) -> impl Iterator<Item = (usize, &Surface)> {
        let rings = self.surfaces.rings.iter().enumerate().filter_map(|(side, ring)| Some((side, ring.as_ref()?)));
        rings.chain(self.surfaces.own.iter().flatten().flat_map(|own| own.iter().enumerate()))
    }

    fn meets(&self, side: usize) -> bool {
        self.all_surfaces().any(|(of, _)| of == side)
    }

    /// The stretches that the inner contacts are in where `sides[0]`, and the outer ones where `sides[1]`.
    pub fn stretches(&self, outside: &Outside, t: f64, y: &[f64], sides: [bool; 2], into: &mut [Stretches]) {
        let turns: Turns = outside.turns.map(|turn| quadratic(turn, t));
        let motions = self.motions(outside, t, y);
        for side in (0..2).filter(|&side| sides[side] && self.meets(side)) {
            for (j, stretches) in into.iter_mut().enumerate() {
                for (which, surface) in self.surfaces(side, j).into_iter().enumerate() {
                    if let Some(surface) = surface {
                        let direction = self.seat(j, turns[0], &motions, y).turning(side, &turns)[0];
                        stretches[side][which] = surface.envelope.stretch(surface.psi(direction, &turns));
                    }
                }
            }
        }
    }

    /// What a contact is over: of a ring's defect and the element's own the one that lets them come nearer.
    pub fn over(&self, side: usize, j: usize, seat: &Seat, turns: &Turns, stretches: &Stretches) -> Option<Over<'_>> {
        let over = |(which, surface): (usize, Option<&'_ Surface>)| {
            let (surface, feature) = surface.map(|s| (s, s.envelope.feature(stretches[side][which])))?;
            if feature == Feature::Smooth {
                return None;
            }
            let [direction, rate] = seat.turning(side, turns);
            let psi = surface.psi(direction, turns);
            let (path, slope) = surface.envelope.path(feature, psi);
            Some((which, psi, path, slope, rate - turns[surface.frame][1]))
        };
        let surfaces = self.surfaces(side, j);
        let found = surfaces.into_iter().enumerate().filter_map(over);
        let (which, psi, path, slope, rate) = found.reduce(|ring, own| if own.2 > ring.2 { own } else { ring })?;
        Some(Over { surface: surfaces[which]?, which, psi, path, slope, rate })
    }

    /// Whether there is an edge that only a side could meet.
    pub fn leaps(&self) -> bool {
        self.all_surfaces().any(|(_, surface)| surface.envelope.leaps())
    }

    /// Angular speed (rad/s) of contacts past a defect where the rings turn at these speeds.
    pub fn past(&self, on: Option<On>, speeds: [f64; 2]) -> f64 {
        let turn = |which: usize| self.ratios[which][0] * speeds[0] + self.ratios[which][1] * speeds[1];
        let frame = match on {
            Some(On::Inner) => turn(SHAFT),
            Some(On::Element { .. }) => turn(SPIN),
            Some(On::Outer) => turn(HOUSING),
            None => 0.0,
        };
        turn(0) - frame
    }

    /// Characteristic frequencies (Hz) at the speeds of the start: how often elements pass a point of the outer ring
    /// and of the inner one, and how often an element and the cage turn, the element against the cage.
    pub fn frequencies(&self) -> [f64; 4] {
        let of = |on: Option<On>| self.past(on, self.speeds).abs() / TAU;
        let (count, element) = (self.count as f64, On::Element { element: 0, tilt_deg: 0.0 });
        [count * of(Some(On::Outer)), count * of(Some(On::Inner)), of(Some(element)), of(None)]
    }
}

impl Bearing {
    /// The waves under a contact of element `j`; no two bodies of one contact have any.
    pub fn wave(&self, side: usize, j: usize, seat: &Seat, turns: &Turns) -> Rise {
        let of_element = self.waves.elements.get(j).and_then(Option::as_ref).map(|sides| &sides[side]);
        let waves = self.waves.rings[side].as_ref().or(of_element);
        waves.map_or(Rise::default(), |waves| waves.rise(seat.turning(side, turns), turns))
    }

    /// The fastest that a wave goes by while a ring turns so fast against the other (rad/s).
    pub fn ripple(&self, speed: f64) -> f64 {
        let most = |waves: &Waves| waves.all.iter().fold(0.0f64, |most, [n, ..]| most.max(*n));
        let rings = self.waves.rings.iter().flatten().map(most).fold(0.0, f64::max);
        let elements = self.waves.elements.iter().flatten().map(|sides| most(&sides[0])).fold(0.0, f64::max);
        // A ring passes the cage with the other's speed at most, and the elements spin faster.
        speed * (rings + elements * (self.ratios[SPIN][0].abs() + self.ratios[SPIN][1].abs() + 1.0))
    }
}

/// The surfaces of a case; none where a topography has no envelope.
fn of(bearing: &Bearing, case: &Case) -> Option<Surfaces> {
    let (r, r_o) = (bearing.r, bearing.rho_0 + bearing.r);
    let r_i = bearing.rho_0 - bearing.clearance - r;
    let surface = |pair: Pair, frame: usize, from: f64, body: &[&Defect]| {
        let raceway = if matches!(pair, Pair::OuterRing | Pair::ElementOutside) { r_o } else { r_i };
        let own = if frame == SPIN { r } else { raceway };
        let envelope = Envelope::new(&profiles(body, own, r)?, pair, r, raceway);
        Some(Surface { envelope, centre: from + body[0].angle_deg * PI / 180.0, frame })
    };
    let on = |wanted: &dyn Fn(On) -> bool| case.defects.iter().filter(|d| wanted(d.on)).collect::<Vec<&Defect>>();
    let [inner, outer] = [on(&|on| on == On::Inner), on(&|on| on == On::Outer)];
    let mut surfaces = Surfaces::default();
    if !inner.is_empty() {
        surfaces.rings[0] = Some(surface(Pair::InnerRing, SHAFT, 0.0, &inner)?);
    }
    if !outer.is_empty() {
        surfaces.rings[1] = Some(surface(Pair::OuterRing, HOUSING, 0.0, &outer)?);
    }
    for j in 0..bearing.count {
        let own = on(&|on| matches!(on, On::Element { element, .. } if element == j));
        surfaces.own.push(if own.is_empty() {
            None
        } else {
            let outside = bearing.starts[0] + TAU * j as f64 / bearing.count as f64;
            // The side that faces the inner raceway is half a turn on.
            let inside = surface(Pair::ElementInside, SPIN, outside - PI, &own)?;
            Some([inside, surface(Pair::ElementOutside, SPIN, outside, &own)?])
        });
    }
    Some(surfaces)
}

/// Arcs and depths (m) of all defects of a body of radius `own`, in order from the first on around it; none with a
/// topography.
fn profiles(body: &[&Defect], own: f64, r: f64) -> Option<Vec<Vec<(f64, f64)>>> {
    let all: Vec<Vec<(f64, f64)>> = body.iter().map(|defect| points(defect, own, r)).collect::<Option<_>>()?;
    let begins = all[0][0].0;
    let mut shifted: Vec<Vec<(f64, f64)>> = all
        .into_iter()
        .zip(body)
        .map(|(points, defect)| {
            let away = own * (defect.angle_deg - body[0].angle_deg) * PI / 180.0;
            let turns = ((away + points[0].0 - begins) / (TAU * own)).floor();
            points.into_iter().map(|(arc, depth)| (arc + away - turns * TAU * own, depth)).collect()
        })
        .collect();
    shifted.sort_by(|a, b| a[0].0.total_cmp(&b[0].0));
    Some(shifted)
}

/// Smallest distance between two defects of one body (m), negative where they overlap; infinite without.
pub fn closest(bearing: &Bearing, case: &Case) -> f64 {
    let mut closest = f64::INFINITY;
    for (k, one) in case.defects.iter().enumerate() {
        for other in case.defects[..k].iter().filter(|other| other.on.is_body_of(one.on)) {
            let own = match one.on {
                On::Outer => bearing.rho_0 + bearing.r,
                On::Inner => bearing.rho_0 - bearing.clearance - bearing.r,
                On::Element { .. } => bearing.r,
            };
            let halves = [one, other].map(|defect| match points(defect, own, bearing.r) {
                Some(points) => points[points.len() - 1].0,
                None => 0.5 * defect.shape.length(own),
            });
            // From middle to middle both ways around.
            let apart = (own * (one.angle_deg - other.angle_deg) * PI / 180.0).rem_euclid(TAU * own);
            closest = closest.min(apart.min(TAU * own - apart) - halves[0] - halves[1]);
        }
    }
    closest
}

/// Arcs and depths (m) of a defect on a body of radius `own`.
pub(crate) fn points(defect: &Defect, own: f64, r: f64) -> Option<Vec<(f64, f64)>> {
    match &defect.shape {
        Shape::Trace(points) => {
            let middle = 0.5 * (points[0].0 + points[points.len() - 1].0);
            Some(points.iter().map(|&(arc, depth)| ((arc - middle) * 1e-3, depth * 1e-6)).collect())
        }
        Shape::Spall { length, depth_um, slope_deg } => {
            let length = length.on(own);
            let off = match defect.on {
                On::Element { tilt_deg, .. } => 2.0 * r * (tilt_deg * PI / 180.0).sin(),
                _ => 0.0,
            };
            // Of a round pit the track crosses a chord.
            let half = 0.5 * (length * length - off * off).sqrt();
            let (depth, slope) = (depth_um * 1e-6, slope_deg * PI / 180.0);
            let run = if *slope_deg >= 90.0 { 0.0 } else { (depth * (FRAC_PI_2 - slope).tan()).min(half) };
            Some(vec![(-half, 0.0), (run - half, depth), (half - run, depth), (half, 0.0)])
        }
        Shape::Topography(_) => None,
    }
}
