//! What must be equal in every bit: a second run, another start time, another order of inputs, a parameter set by the
//! host instead of the scene, a state that was saved and put back.

use super::{Trajectory, scene, trajectory};
use crate::case::{Case, Length, On, Shape};
use crate::draw::{Draw, for_compared};
use crate::subject::Subject;

/// Says whether there was anything to compare.
fn equal(case: &Case, other: Trajectory) -> Result<bool, String> {
    let base = trajectory(case, |_| {});
    let bits = |trajectory: &Trajectory| -> Vec<Vec<u64>> {
        trajectory.samples.iter().map(|sample| sample.iter().map(|value| value.to_bits()).collect()).collect()
    };
    if base.failed != other.failed {
        return Err(format!("{:?} and {:?}", base.failed, other.failed));
    }
    if bits(&base) != bits(&other) {
        let differs = base.samples.iter().zip(&other.samples).position(|(a, b)| a != b);
        let names = crate::oracle::signals::signals(case);
        let first = differs.and_then(|at| {
            let (a, b) = (&base.samples[at], &other.samples[at]);
            let i = a.iter().zip(b).position(|(a, b)| a != b)?;
            Some(format!("{} is {:e} and {:e}", names[i].0, a[i], b[i]))
        });
        return Err(format!("other bits from sample {differs:?} on: {first:?}"));
    }
    Ok(!base.samples.is_empty())
}

#[test]
fn a_second_run_has_the_same_bits() {
    for_compared(6, |_, draw| {
        let case = scene(draw, true);
        equal(&case, trajectory(&case, |_| {}))
    });
}

#[test]
fn the_start_time_changes_no_bit() {
    for_compared(6, |_, draw| {
        let case = scene(draw, true);
        let start = draw.log(1e-3, 1e9) * draw.sign();
        equal(&case, trajectory(&case, |subject| subject.begin = start))
    });
}

#[test]
fn the_order_of_inputs_changes_no_bit() {
    for_compared(6, |seed, draw| {
        let case = scene(draw, true);
        equal(&case, trajectory(&case, |subject| subject.shuffle = Some(Draw::new(!seed))))
    });
}

#[test]
fn the_order_of_defects_changes_no_bit() {
    for_compared(30, |_, draw| {
        let case = scene(draw, true);
        let mut turned = case.clone();
        turned.defects.reverse();
        // The spin of an element is counted from the first of its defects.
        let elements = case.defects.iter().filter(|defect| matches!(defect.on, On::Element { .. })).count();
        if case.defects.len() < 2 || elements != case.defective_elements().len() {
            return Ok(false);
        }
        // An error says the numbers of defects.
        let mut found = trajectory(&turned, |_| {});
        if let (Some(_), Some(failed)) = (&found.failed, trajectory(&case, |_| {}).failed) {
            found.failed = Some(failed);
        }
        equal(&case, found)
    });
}

#[test]
fn saving_and_restoring_changes_no_bit() {
    for_compared(6, |_, draw| {
        let case = scene(draw, true);
        equal(&case, trajectory(&case, |subject| subject.rollback = true))
    });
}

#[test]
fn a_parameter_set_by_the_host_is_that_of_the_scene() {
    for_compared(10, |_, draw| {
        let mut case = scene(draw, true);
        // A length in degrees becomes one in metres with the clearance of the scene, which is to be another one.
        let diameter = case.diameter_mm;
        for defect in &mut case.defects {
            if let Shape::Spall { length: length @ Length::Degrees(_), .. } = &mut defect.shape {
                *length = Length::Millimetres(0.5 * diameter);
            }
        }
        let mut given = Subject::new(&case).map_err(|error| error.to_string())?;
        // The same in all but the parameters, of which the host then sets those of the first.
        let mut other = case.clone();
        other.clearance_um *= draw.between(0.5, 1.0);
        other.cage_deg += draw.between(-90.0, 90.0);
        other.slip = draw.unit();
        other.tolerance = 1e-3;
        for ring in &mut other.rings {
            // No less than a scene may have.
            ring.mass *= draw.between(if ring.mass > 2e-6 { 0.5 } else { 1.0 }, 2.0);
            ring.damping = ring.damping * draw.between(0.5, 2.0) + draw.unit();
            ring.stiffness = ring.stiffness * draw.between(0.5, 2.0) + 1.0;
        }
        // All by the same, so that none come to overlap.
        let away = draw.between(-90.0, 90.0);
        other.defects.iter_mut().for_each(|defect| defect.angle_deg += away);
        other.rings_deg[0] += draw.between(-90.0, 90.0);
        if other.housing_hz.is_some() {
            other.rings_deg[1] += draw.between(-90.0, 90.0);
        }
        other.spin_slip = 0.0;
        match &mut other.damping {
            crate::case::Damping::HuntCrossley(chi) => *chi = 0.5 * *chi + 0.1,
            crate::case::Damping::Proportional(tau) => *tau = 0.5 * *tau + 1e-6,
        }
        let parameters = given.parameters();
        let found = trajectory_of(&other, &case, |subject| subject.set_parameters(&parameters));
        equal(&case, found)
    });
}

/// The scene of one case under the inputs of another.
fn trajectory_of(scene: &Case, inputs: &Case, prepare: impl Fn(&mut Subject)) -> Trajectory {
    let case = Case { steps: inputs.steps.clone(), ..scene.clone() };
    trajectory(&case, |subject| {
        prepare(subject);
    })
}
