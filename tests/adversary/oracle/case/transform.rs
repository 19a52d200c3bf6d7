//! The same scene seen from elsewhere: turned, mirrored, made of other lengths, forces and times, its steps cut.

use super::{Case, Damping, Grooves, Host, Length, Motion, On, Shape, Step, Topography};
use crate::turning::quadratic;

/// Factors of length, force and time.
#[derive(Debug, Clone, Copy)]
pub struct Factors {
    pub length: f64,
    pub force: f64,
    pub time: f64,
}

impl Case {
    /// With every vector mapped by an orthogonal map.
    fn moved(&self, vector: impl Fn([f64; 2]) -> [f64; 2]) -> Self {
        let mut case = self.clone();
        case.gravity = vector(case.gravity);
        for ring in &mut case.rings {
            ring.load = vector(ring.load);
        }
        for host in case.steps.iter_mut().filter_map(|step| step.host.as_mut()) {
            for ring in &mut host.rings {
                for order in 0..3 {
                    let [x, y] = vector([ring[0][order], ring[1][order]]);
                    (ring[0][order], ring[1][order]) = (x, y);
                }
            }
        }
        case
    }

    /// Turned about the origin, counter-clockwise. Defects turn with the angle at which their ring begins; on an outer
    /// ring at rest by their own, and on an element with the element.
    pub fn turned(&self, degrees: f64) -> Self {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let mut case = self.moved(|[x, y]| [cos * x - sin * y, sin * x + cos * y]);
        case.cage_deg += degrees;
        case.rings_deg[0] += degrees;
        if case.housing_hz.is_some() {
            case.rings_deg[1] += degrees;
        } else {
            case.defects.iter_mut().filter(|defect| defect.on == On::Outer).for_each(|d| d.angle_deg += degrees);
            case.waves.iter_mut().filter(|wave| wave.on == On::Outer).for_each(|wave| wave.crest_deg += degrees);
        }
        case
    }

    /// Left and right exchanged. Element j takes the place of element −j.
    pub fn mirrored(&self) -> Self {
        let mut case = self.moved(|[x, y]| [-x, y]);
        (case.speed_hz, case.housing_hz) = (-case.speed_hz, case.housing_hz.map(|speed| -speed));
        for host in case.steps.iter_mut().filter_map(|step| step.host.as_mut()) {
            host.speeds = host.speeds.map(|speed| speed.map(|speed| -speed));
        }
        (case.cage_deg, case.rings_deg) = (180.0 - case.cage_deg, case.rings_deg.map(|angle| -angle));
        let count = case.count;
        case.put_elements(|j| (count - j) % count);
        let mirror = |on: On, degrees: f64| if matches!(on, On::Element { .. }) { -degrees } else { 180.0 - degrees };
        case.waves.iter_mut().for_each(|wave| wave.crest_deg = mirror(wave.on, wave.crest_deg));
        for defect in &mut case.defects {
            defect.angle_deg = mirror(defect.on, defect.angle_deg);
            match &mut defect.shape {
                Shape::Trace(points) => {
                    points.reverse();
                    for point in points {
                        point.0 = -point.0;
                    }
                }
                Shape::Topography(topography) => topography.mirror(),
                Shape::Spall { .. } => {}
            }
        }
        case
    }

    /// Puts each element, with its size, defects and waves, in the place of another.
    pub fn put_elements(&mut self, place: impl Fn(usize) -> usize) {
        let before = self.larger_um.clone();
        before.into_iter().enumerate().for_each(|(j, larger)| self.larger_um[place(j)] = larger);
        let of_defects = self.defects.iter_mut().map(|defect| &mut defect.on);
        for on in of_defects.chain(self.waves.iter_mut().map(|wave| &mut wave.on)) {
            if let On::Element { element, .. } = on {
                *element = place(*element);
            }
        }
    }

    /// With all lengths, forces and times multiplied. Rollers stay similar by forces that grow as areas, and oil does
    /// not, as asperities have their height.
    pub fn scaled(&self, by: Factors) -> Self {
        let Factors { length, force, time } = by;
        let mass = force * time * time / length;
        let mut case = self.clone();
        case.gravity = case.gravity.map(|g| g * length / (time * time));
        case.diameter_mm *= length;
        case.larger_um.iter_mut().for_each(|larger| *larger *= length);
        case.waves.iter_mut().for_each(|wave| wave.amplitude_um *= length);
        case.pitch_mm *= length;
        if let Grooves::Equal(diameter) = &mut case.grooves {
            *diameter *= length;
        }
        case.clearance_um *= length;
        case.modulus_gpa *= force / (length * length);
        case.element = case.element.map(|[modulus, ratio]| [modulus * force / (length * length), ratio]);
        case.density = case.density.map(|density| density * mass / (length * length * length));
        case.mass_g = case.mass_g.map(|m| m * mass);
        case.hertz = case.hertz.map(|k| k.map(|k| k * force / (length * length.sqrt())));
        case.compliance *= length / force;
        match &mut case.damping {
            Damping::HuntCrossley(chi) => *chi *= time / length,
            Damping::Proportional(tau) => *tau *= time,
        }
        case.defects.iter_mut().for_each(|defect| defect.shape.scale(length));
        for ring in &mut case.rings {
            ring.load = ring.load.map(|load| load * force);
            (ring.mass, ring.stiffness) = (ring.mass * mass, ring.stiffness * force / length);
            ring.damping *= force * time / length;
        }
        case.speed_hz /= time;
        case.housing_hz = case.housing_hz.map(|speed| speed / time);
        case.sensor = case.sensor.map(|[m, k, c]| [m * mass, k * force / length, c * force * time / length]);
        if let Some(roller) = &mut case.roller {
            roller.length_mm *= length;
        }
        case.modes.iter_mut().for_each(|mode| mode.frequency_hz /= time);
        for step in &mut case.steps {
            step.length *= time;
        }
        case.scale_hosts(by);
        case
    }

    fn scale_hosts(&mut self, Factors { length, force, time }: Factors) {
        for host in self.steps.iter_mut().filter_map(|step| step.host.as_mut()) {
            host.speeds = host.speeds.map(|speed| [speed[0] / time, speed[1] / (time * time)]);
            for which in 0..2 {
                let internal = self.rings[which].motion == Motion::Internal;
                let unit = if internal { force } else { length };
                for axis in &mut host.rings[which] {
                    *axis = [axis[0] * unit, axis[1] * unit / time, axis[2] * unit / (time * time)];
                }
            }
        }
    }

    /// Each communication step cut in two at a share of its length; what the host says is said on at the cut.
    pub fn cut(&self, shares: impl Fn(usize) -> f64) -> Self {
        let mut case = self.clone();
        case.steps.clear();
        for (i, step) in self.steps.iter().enumerate() {
            let first = shares(i) * step.length;
            case.steps.push(Step { length: first, ..*step });
            // A host that said nothing has nothing to go on with: all stays as it was left.
            let host = step.host.map(|host| host.later(first));
            case.steps.push(Step { length: step.length - first, host });
        }
        case
    }
}

impl Host {
    /// What it comes to after a time.
    pub fn later(&self, time: f64) -> Self {
        Self {
            speeds: self.speeds.map(|[speed, slope]| [speed + time * slope, slope]),
            rings: self.rings.map(|ring| ring.map(|c| quadratic(c, time))),
        }
    }
}

impl Topography {
    /// With arcs from the other end.
    fn mirror(&mut self) {
        let width = self.axials.len();
        self.arcs = self.arcs.iter().rev().map(|arc| -arc).collect();
        self.depths = self.depths.chunks(width).rev().flatten().copied().collect();
    }
}

impl Shape {
    fn scale(&mut self, length: f64) {
        match self {
            Self::Trace(points) => {
                for (arc, depth) in points {
                    (*arc, *depth) = (*arc * length, *depth * length);
                }
            }
            Self::Spall { length: long, depth_um, .. } => {
                *depth_um *= length;
                if let Length::Millimetres(long) = long {
                    *long *= length;
                }
            }
            Self::Topography(topography) => {
                let lengths = [&mut topography.arcs, &mut topography.axials, &mut topography.depths];
                lengths.into_iter().flatten().for_each(|value| *value *= length);
            }
        }
    }
}
