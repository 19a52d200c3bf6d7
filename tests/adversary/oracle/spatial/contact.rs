//! One contact: a ball's centre and the circle of one groove's centres of curvature.

use super::surfaces::Over;
use super::vector::{Vector, add, cross, dot, length, subtract, times};
use crate::case::Damping;

/// One groove.
#[derive(Debug, Clone, Copy)]
pub(super) struct Groove {
    /// Whether it is the inner ring's.
    pub(super) inner: bool,
    /// Radius and axial place of the circle of its centres of curvature (m).
    pub(super) circle: f64,
    pub(super) shift: f64,
    /// Distance of the ball's centre from that circle where it just touches (m).
    pub(super) touching: f64,
    /// Hertz's constant (N/m^1.5).
    pub(super) stiffness: f64,
}

/// What damps a contact: along its normal, and across the groove (s/m).
#[derive(Debug, Clone, Copy)]
pub(super) struct Dampers {
    pub(super) normal: Damping,
    pub(super) across: f64,
}

impl Dampers {
    pub(super) const NONE: Self = Self { normal: Damping::HuntCrossley(0.0), across: 0.0 };
}

/// Where a ring is and how it moves.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Pose {
    pub(super) position: Vector,
    pub(super) velocity: Vector,
    /// About x and y.
    pub(super) tilt: [f64; 2],
    pub(super) tilt_rate: [f64; 2],
}

impl Pose {
    /// The ring's axis and how it turns.
    fn axis(&self) -> [Vector; 2] {
        let ([x, y], [vx, vy]) = (self.tilt, self.tilt_rate);
        let long = [y, -x, 1.0];
        let size = length(long);
        let axis = times(1.0 / size, long);
        let rate = times(1.0 / size, [vy, -vx, 0.0]);
        [axis, subtract(rate, times(dot(rate, axis), axis))]
    }
}

/// What a contact is and does.
#[derive(Debug, Clone, Copy, Default)]
pub struct Touch {
    /// Force along the normal (N); and the contact angle (rad).
    pub force: f64,
    pub angle: f64,
    /// How far it is closed (m).
    pub approach: f64,
    /// From the ring's centre to the ball's.
    pub arm: Vector,
    /// All that the ring does to the ball (N), and its moment about the ring's centre (N m).
    pub on_ball: Vector,
    pub moment: Vector,
    /// Outwards in the ring's plane, along its axis, forwards.
    pub(super) frame: [Vector; 3],
    /// Distance from the ring's axis (m).
    pub(super) distance: f64,
    /// Velocity against the ring, which is not turned with it (m/s).
    pub(super) velocity: Vector,
}

/// Where a ball at `place` with a velocity is against a ring.
pub(super) fn seen(pose: &Pose, place: Vector, velocity: Vector) -> Touch {
    let [axis, axis_rate] = pose.axis();
    let arm = subtract(place, pose.position);
    let along = dot(arm, axis);
    let across = subtract(arm, times(along, axis));
    let distance = length(across);
    let outwards = times(1.0 / distance, across);
    // The ring turns about no axis of its own here: only its tilt carries points along.
    let carried = cross(cross(axis, axis_rate), arm);
    let velocity = subtract(subtract(velocity, pose.velocity), carried);
    Touch { arm, frame: [outwards, axis, cross(axis, outwards)], distance, velocity, ..Touch::default() }
}

impl Touch {
    /// Direction of the ball from the ring's centre about z, and how fast that turns.
    pub(super) fn turning(&self) -> [f64; 2] {
        let [outwards, _, forwards] = self.frame;
        let angle = outwards[1].atan2(outwards[0]);
        [angle, dot(self.velocity, forwards) / self.distance]
    }

    /// What the ball does to the ring: forces, and moments about x and y.
    pub(super) fn on_ring(&self) -> [f64; 5] {
        let ([x, y, z], [about_x, about_y, _]) = (self.on_ball, self.moment);
        [x, y, z, about_x, about_y].map(|part| -part)
    }

    /// The direction away from the groove's circle outside, and towards it inside; and that across the groove.
    pub(super) fn normal_and_across(&self) -> [Vector; 2] {
        let ([outwards, axis, _], (sin, cos)) = (self.frame, self.angle.sin_cos());
        [add(times(cos, outwards), times(sin, axis)), add(times(-sin, outwards), times(cos, axis))]
    }

    /// With the groove's force, over a defect or none.
    pub(super) fn pushed(mut self, groove: &Groove, over: Over, dampers: Dampers) -> Self {
        let ([_, axis, forwards], Over { sunk, slope, past }) = (self.frame, over);
        let sign = if groove.inner { -1.0 } else { 1.0 };
        // From the groove's circle to the ball for the outer ring, from the ball to the circle for the inner one.
        let radial = sign * (self.distance - groove.circle);
        let axial = sign * (dot(self.arm, axis) - groove.shift);
        let far = radial.hypot(axial);
        self.angle = axial.atan2(radial);
        self.approach = far - groove.touching - sunk;
        // Beyond 90 degrees the circle is no part of the groove.
        if self.approach <= 0.0 || radial <= 0.0 {
            return self;
        }
        let [normal, sideways] = self.normal_and_across();
        let rate = sign * dot(normal, self.velocity) - slope * past;
        let elastic = groove.stiffness * self.approach * self.approach.sqrt();
        let damper = match dampers.normal {
            Damping::HuntCrossley(chi) => elastic * chi,
            Damping::Proportional(tau) => 1.5 * groove.stiffness * self.approach.sqrt() * tau,
        };
        self.force = (elastic + damper * rate).max(0.0);
        let lean = (slope / self.distance).atan();
        let drag = -dampers.across * self.force * dot(sideways, self.velocity);
        let push = add(times(-sign * lean.cos(), normal), times(lean.sin(), forwards));
        self.on_ball = add(times(self.force, push), times(drag, sideways));
        self.moment = cross(self.arm, self.on_ball);
        self
    }
}
