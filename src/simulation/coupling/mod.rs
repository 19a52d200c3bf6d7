//! How far off the coupling to a host is: measured from what the host gives, whatever its mass, spring and wiring.
//!
//! A host moves a ring of mass m by the bearing's force, as it is wired, and by what else it has:
//! ```text
//! m x'' = U(t) + R(t)
//! ```
//! U is the force that its wiring gives it over a communication step of length h, R all the rest (loads, springs,
//! dampers), which is continuous. The bearing knows the force F that it does give on the way on which it moves the
//! ring. What the coupling loses is r = U − F; the place of the ring is off by δ,
//! ```text
//! m δ'' + c δ' + (k + K) δ = r
//! ```
//! with the tangent stiffness K of the bearing, and k, c those of R: [`error`](self::error). All of it follows from
//! places and velocities that the host gives at two communication points ([`way`]), and what the bearing knows:
//! [`host`].
//!
//! *Per step*, with F' and F'' of the force and an acceleration that the host gives one step late:
//!
//! | wiring | U over the step n, n + 1 | mean of r over the step |
//! |---|---|---|
//! | parallel, `force` held | F(n) | −h F'/2 |
//! | parallel, `mean_force` held | mean over n − 1, n | −h F' |
//! | parallel, `next_mean_force` held | mean − h² F''/12 | of third order |
//! | sequential, `force` held | F(n + 1) | +h F'/2 |
//! | sequential or iterated, `mean_force` held | mean | 0 |
//! | sequential, `force` interpolated | F(n) … F(n + 1) | +h² F''/12 |
//! | parallel, `force` with its derivative | F(n) + F' t | −h² F''/6 |
//!
//! Three more terms are the same for all. A force that is held moves the ring by F' h³/12m further than the force that
//! grows by F': as if h² F''/12 were pushed too much. The bearing's own way is apart from the host's by what the
//! acceleration was late: K times the mean gap, of third order. And the *gap* itself, at the end of the step, is
//! h³ F'/2m for wirings of first order and of second alike: at 1 µs `force` held in parallel and `mean_force` in
//! sequence, 1400 times apart in error, have the same gap. So the gap alone cannot tell them apart; r can.
//!
//! *A held force on a linear spring, without R,* is closed: x, v after a step are x + v h − K x h²/2m, v − K x h/m,
//! and the amplitude grows by √(1 + (ωh)²/2) a step, as exp(ω² h t/4). The tests compare with it.
//!
//! Rotations are left out: tilts and moments, and what a host does to them.

mod error;
mod host;
mod step;
mod way;

use error::Error;
use host::{Host, Lost};
use way::Way;

pub(in crate::simulation) use step::{Body, Step, Triple};

/// What has been learned of a host, part of the state.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Coupling {
    /// The last step, which the next one's start completes.
    last: Step,
    hosts: [Host; 2],
    error: Error,
    /// Steps in a row in which a ring had another place without any velocity.
    without_velocity: f64,
    /// Length of the last jump to another place (m); 0 for none.
    jump: f64,
}

/// Steps without velocities from which on the host is taken to give none.
const IN_A_ROW: f64 = 3.0;
/// Share of the force from which on a way that no velocity explains is a jump.
const JUMP: f64 = 0.05;

impl Coupling {
    /// Error of the place of hosted rings, rms over rms of their way from the start, as it is now and at most so far.
    pub fn errors(&self) -> [f64; 2] {
        [self.error.now, self.error.largest]
    }

    /// Mass (kg) that the host moves, once it is known.
    pub fn mass(&self, ring: usize) -> Option<f64> {
        Some(self.hosts[ring].mass).filter(|mass| *mass > 0.0)
    }

    /// Whether the host gives places without velocities.
    pub fn lacks_velocity(&self) -> bool {
        self.without_velocity >= IN_A_ROW
    }

    /// Which force the host gives a ring over a step, as its motion shows.
    pub fn force(&self, ring: usize) -> &'static str {
        self.hosts[ring].force()
    }

    /// Whether the force that the host takes is off by what its change in a step is, not by how that changes; `None`
    /// while it is not known.
    pub(in crate::simulation) fn is_of_first_order(&self) -> Option<bool> {
        self.hosts.iter().filter(|host| host.shows_its_force()).map(Host::is_of_first_order).reduce(|a, b| a || b)
    }

    /// Length (m) of the last jump of a ring to another place.
    pub fn jump(&self) -> Option<f64> {
        Some(self.jump).filter(|jump| *jump > 0.0)
    }

    /// Force (N) on both rings where the last step has brought them.
    pub(in crate::simulation) fn forces(&self) -> Option<[Triple; 2]> {
        Some(self.last.end).filter(|_| self.last.length > 0.0)
    }

    /// Notes a step. Its start completes the one before.
    pub(in crate::simulation) fn note(&mut self, step: Step, bodies: [Body; 2]) {
        let ends = step.motion.map(|[place, velocity, ..]| [place, velocity]);
        if self.last.length > 0.0 {
            self.complete(ends, bodies);
        } else if self.error.is_fresh() {
            self.error.begin(ends.map(|[place, _]| place));
        }
        self.last = step;
    }

    /// Forgets the last step, where the host has moved a ring inside it.
    pub(in crate::simulation) fn interrupt(&mut self) {
        self.last.length = 0.0;
        self.hosts.iter_mut().for_each(Host::interrupt);
    }

    fn complete(&mut self, ends: [[Triple; 2]; 2], bodies: [Body; 2]) {
        let step = self.last;
        let ways = [0, 1].map(|ring| {
            let [place, velocity, ..] = step.motion[ring];
            Way::new([place, velocity], ends[ring], step.length)
        });
        if let Some(share) = self.flaw(&step, &ways, bodies) {
            self.error.note(share);
            self.hosts.iter_mut().for_each(Host::interrupt);
            return;
        }
        let mut lost = [Lost::default(); 2];
        for ring in [0, 1].into_iter().filter(|&ring| bodies[ring].is_hosted) {
            lost[ring] = self.hosts[ring].complete(&step, ring, &ways[ring]);
        }
        let known = |ring: usize| !bodies[ring].is_hosted || self.hosts[ring].mass > 0.0;
        if known(0) && known(1) {
            let learned =
                [0, 1].map(|ring| if bodies[ring].is_hosted { self.hosts[ring].body() } else { bodies[ring] });
            self.error.go_on(&step, lost, learned);
            self.error.compare(&step, ends.map(|[place, _]| place), bodies.map(|body| body.is_hosted));
        }
    }

    /// Which share of the force a way is worth that no velocity explains, where there is one to be named.
    fn flaw(&mut self, step: &Step, ways: &[Way; 2], bodies: [Body; 2]) -> Option<f64> {
        let hosted = || [0, 1].into_iter().filter(|&ring| bodies[ring].is_hosted);
        let force = hosted().map(|ring| step.mean[ring].norm().max(step.end[ring].norm())).fold(0.0, f64::max);
        let share = |way: &Triple| if force > 0.0 { (step.stiffness * way).norm() / force } else { 0.0 };
        if let Some(ring) = hosted().find(|&ring| ways[ring].lacks_velocity) {
            self.without_velocity += 1.0;
            return Some(share(&ways[ring].unexplained));
        }
        self.without_velocity = 0.0;
        let jumped = hosted().find(|&ring| ways[ring].is_jump() && share(&ways[ring].unexplained) > JUMP)?;
        self.jump = ways[jumped].unexplained.norm();
        Some(share(&ways[jumped].unexplained))
    }

    /// All its numbers.
    pub(in crate::simulation) fn numbers(&mut self) -> impl Iterator<Item = &mut f64> {
        let Self { last, hosts, error, without_velocity, jump } = self;
        let hosts = hosts.iter_mut().flat_map(Host::numbers);
        let rest = [without_velocity, jump];
        last.numbers().chain(hosts).chain(error.numbers()).chain(rest)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use nalgebra::Matrix3;

    const MASS: f64 = 3.0;
    const SPRING: f64 = 6e7;
    const STEP: f64 = 2e-6;
    /// Steps in 5 ms, a quarter of what errors are remembered for.
    const STEPS: usize = 2500;

    /// What a mass on a linear spring tells, under the force of the step's start or under its mean, each held: its
    /// mass, the error, and that of the recursion against cos ωt, both as shares of the way.
    fn mass_on_a_spring(takes_mean: bool) -> (f64, [f64; 2]) {
        let along = |x: f64| Triple::new(x, 0.0, 0.0);
        let bodies = [Body { is_hosted: true, ..Body::default() }, Body::default()];
        let rate = (SPRING / MASS).sqrt();
        let (mut x, mut v, mut late) = (1e-5, 0.0, -SPRING * 1e-5);
        let (mut coupling, mut start) = (Coupling::default(), late);
        let (mut off, mut way) = (0.0, 0.0);
        for count in 1..=STEPS {
            let a = late / MASS;
            let mean = -SPRING * (x + 0.5 * STEP * (v + STEP * a / 3.0));
            let end = -SPRING * (x + STEP * (v + 0.5 * STEP * a));
            let pair = |of: f64| [along(of), Triple::zeros()];
            let step = Step {
                length: STEP,
                motion: [[along(x), along(v), along(a), Triple::zeros()], [Triple::zeros(); 4]],
                start: pair(start),
                mean: pair(mean),
                end: pair(end),
                stiffness: Matrix3::from_diagonal(&along(SPRING)),
                ..Step::default()
            };
            coupling.note(step, bodies);
            late = if takes_mean { mean } else { start };
            (x, v) = (x + STEP * (v + 0.5 * STEP * late / MASS), v + STEP * late / MASS);
            start = end;
            let exact = 1e-5 * (rate * STEP * count as f64).cos();
            off += (x - exact).powi(2);
            way += (x - 1e-5).powi(2);
        }
        let error = (off / way).sqrt();
        (coupling.mass(0).unwrap(), [coupling.errors()[0], error / (1.0 + error)])
    }

    #[test]
    fn a_held_force_makes_a_mass_on_a_spring_swing_further_as_its_closed_form_says_and_is_told_so() {
        // Amplitudes grow as √(1 + (ωh)²/2)ⁿ: exp(ω² h t/4) at the end, 5.1 % of it, and two thirds of that in rms of
        // the growth over 5 ms. What is forgotten in that time is an eighth of it, and the first six steps are not
        // counted.
        let (mass, [told, error]) = mass_on_a_spring(false);
        assert!((mass / MASS - 1.0).abs() < 1e-4, "{mass} kg");
        let growth = (SPRING / MASS * STEP * STEP * STEPS as f64 / 4.0).exp_m1();
        // Of a way that swings about its start: rms √1.5 of the amplitude.
        let closed = growth / 3.0_f64.sqrt() / 2.0_f64.sqrt() / 1.5_f64.sqrt();
        assert!((error / closed - 1.0).abs() < 0.1, "{error} instead of {closed}");
        assert!((told / error - 1.0).abs() < 0.2, "{told} instead of {error}");
    }

    #[test]
    fn a_mean_in_sequence_is_told_to_be_a_thousand_times_better_with_the_same_gap() {
        let (mass, [told, error]) = mass_on_a_spring(true);
        assert!((mass / MASS - 1.0).abs() < 1e-4, "{mass} kg");
        assert!((told / error - 1.0).abs() < 0.2, "{told} instead of {error}");
        assert!(told < 1e-3 * mass_on_a_spring(false).1[0] * 3.0, "{told}");
    }

    #[test]
    fn positions_without_velocities_and_jumps_are_told_apart() {
        let step = |x: f64, v: f64| {
            let along = |x: f64| Triple::new(0.0, x, 0.0);
            let motion = [[along(x), along(v), Triple::zeros(), Triple::zeros()], [Triple::zeros(); 4]];
            let force = [along(-500.0), along(500.0)];
            let stiffness = Matrix3::from_diagonal_element(5e7);
            Step { length: 1e-5, motion, start: force, mean: force, end: force, stiffness, ..Step::default() }
        };
        let bodies = [Body { is_hosted: true, ..Body::default() }, Body::default()];
        let noted = |steps: &[(f64, f64)]| {
            let mut coupling = Coupling::default();
            steps.iter().for_each(|&(x, v)| coupling.note(step(x, v), bodies));
            coupling
        };
        let still = noted(&[(1e-5, 0.0), (1.1e-5, 0.0), (1.2e-5, 0.0), (1.3e-5, 0.0)]);
        assert!(still.lacks_velocity() && still.jump().is_none());
        // K Δx = 50 N of 500 N in each step, of both together.
        assert!((still.errors()[0] - 0.1 / 1.1).abs() < 1e-9, "{:?}", still.errors());
        let jumped = noted(&[(0.0, 0.0), (1e-5, 1e-3), (1.001e-5, 1e-3)]);
        assert!(!jumped.lacks_velocity() && (jumped.jump().unwrap() - 0.9995e-5).abs() < 1e-7);
        let swung = noted(&[(1e-5, 0.0), (1.05e-5, 0.1), (1.2e-5, 0.2)]);
        assert!(!swung.lacks_velocity() && swung.jump().is_none());
    }
}
