//! The two methods beside each other.

use crate::row::Row;
use crate::scenes::{BALLS, lighter};
use crate::support::Named;
use brinell::scene::Scene;
use brinell::simulation::Method;

/// Runs a scene that the oracle does not have as it is, and by the implicit method alone at a tolerance 100 times
/// tighter.
pub fn agree(what: &'static str, scene: Scene, step: f64, count: usize, limit: f64) -> Row {
    const NAMES: [&str; 4] = ["shaft.force.y", "housing.force.y", "element[1].force.outer", "element[2].force.inner"];
    let run = |bearing: &mut Named| bearing.course(NAMES, step, count).concat();
    let mut tight = scene.clone();
    tight.tolerance *= 1e-2;
    let mut bearing = Named::started(scene);
    let found = run(&mut bearing);
    let mut check = Named::started(tight);
    check.0.set_method(Method::Rodas);
    let expected = run(&mut check);
    let pairs = || found.iter().zip(&expected);
    let (got, largest) = pairs().fold((0.0f64, 0.0f64), |m, (a, b)| if b.abs() > m.1.abs() { (*a, *b) } else { m });
    let worst = pairs().fold(0.0f64, |m, (a, b)| m.max((a - b).abs())) / largest.abs();
    assert!(worst <= limit, "{what}: forces differ by {worst:e} of {largest:e} N");
    let expected = format!("Rodas5P alone at a tolerance of 1e-7: {largest:.6e} N");
    Row::new(what, expected, format!("{got:.6e} N"), &bearing).within(worst, limit)
}

#[test]
fn a_saved_state_continues_with_the_same_bits_while_the_methods_take_turns() {
    let [mut bearing, mut other] = [(); 2].map(|()| Named::started(lighter(BALLS.spalled(), 0.01)));
    let names = ["shaft.y", "housing.ay", "element[1].path", "element[1].force.outer"];
    let (mut turns, mut last) = (0, bearing.0.step_counts());
    for _ in 0..100 {
        bearing.goes_on_alike(&mut other, names, 7.7e-5, 2);
        let now = bearing.0.step_counts();
        let (all, implicit) = (now.all - last.all, now.implicit - last.implicit);
        turns += usize::from(implicit > 0 && implicit < all);
        last = now;
    }
    assert!(turns > 10, "both methods stepped in {turns} of 100 rounds only");
}

#[test]
fn mean_forces_of_both_methods_agree() {
    let mean = |method: Method| {
        let mut bearing = Named::started(BALLS.hosted());
        bearing.0.set_method(method);
        bearing.set("shaft.y", -1e-5);
        bearing.run(1e-3, 1);
        let means = bearing.all(["shaft.mean_force.x", "shaft.mean_force.y", "housing.mean_force.y"]);
        (means, bearing.get("shaft.force.y"))
    };
    let ((explicit, end), (implicit, _)) = (mean(Method::DormandPrince), mean(Method::Rodas));
    for (a, b) in explicit.iter().zip(implicit) {
        // The tolerance is 1e-5 of an approach.
        assert!((a - b).abs() < 1e-4 * end.abs(), "{a} {b}");
    }
    assert!((explicit[1] - end).abs() > 1e-3 * end.abs(), "a steady force would show nothing: {} {end}", explicit[1]);
}
