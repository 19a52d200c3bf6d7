//! Random scenes against the oracle.

mod judge;

use crate::case::random;
use crate::draw::{Draw, for_seeds, seeds};
use crate::oracle::Bearing;
use crate::subject::Subject;
use judge::{Verdict, judge};
use std::f64::consts::PI;

#[test]
fn random_scenes_agree_with_the_oracle() {
    let mut failed = Vec::new();
    for seed in seeds(40) {
        let (kind, case) = random(&mut Draw::new(seed));
        if std::env::var("BRINELL_SEED").is_ok() && std::env::var("BRINELL_SCENES").is_err() {
            println!("{}{}{:#?}", case.toml(), case.profile().unwrap_or_default(), case.steps);
        }
        let begun = std::time::Instant::now();
        let verdict = judge(&case);
        let took = begun.elapsed().as_secs_f64();
        let kind = format!("{} / {} / {} / Z {}", kind.defect, kind.motion, kind.speed, case.count);
        match verdict {
            Verdict::Agreed(m) => println!(
                "{seed}: agreed {:.1e} units {:.2} start {:.1e} judged {:.2} tol {:e} {took:.2} s [{kind}]",
                m.error, m.units, m.start, m.judged, case.tolerance
            ),
            Verdict::Refused(where_, error) => println!("{seed}: refused ({where_}) {error} {took:.2} s [{kind}]"),
            Verdict::Undecided(why) => println!("{seed}: undecided {why} {took:.2} s [{kind}]"),
            Verdict::Failed(why) => {
                println!("{seed}: FAILED {why} {took:.2} s [{kind}]");
                failed.push(format!("BRINELL_SEED={seed}: {why} [{kind}]"));
            }
        }
    }
    assert!(failed.is_empty(), "{} failed:\n{}", failed.len(), failed.join("\n"));
}

/// The path that the simulation's elements follow over a scene's defect, at angles all around, is the brute-force envelope.
#[test]
fn random_rigid_paths_are_the_envelope() {
    for_seeds(150, |_, draw| {
        let (_, case) = random(draw);
        let oracle = Bearing::new(&case);
        let Some((envelope, _)) = &oracle.defect else { return Ok(()) };
        let simulation = Subject::new(&case).map_err(|error| error.to_string())?.simulation;
        let Some((near, _)) = &simulation.equations().0.defect else { return Err("no defect".to_owned()) };
        let (knots, rho) = (near.knots(), oracle.rho_0);
        // Around each knot and change, and anywhere.
        let ends = knots.iter().chain(&envelope.changes).flat_map(|at| [at - 1e-9, at + 1e-9]);
        let anywhere = (0..2000).map(|_| draw.between(-PI, PI));
        let [first, last] = [knots[0], knots[knots.len() - 1]];
        let within = (0..2000).map(|i| first + (last - first) * (f64::from(i) + 0.5) / 2000.0);
        for psi in ends.chain(anywhere).chain(within).filter(|psi| (-PI..=PI).contains(psi)) {
            let cell = knots.partition_point(|&knot| knot <= psi);
            let found = if cell == 0 || cell == knots.len() {
                0.0
            } else {
                -near.approach(cell - 1, 0.0, psi, rho).map_err(|error| error.to_string())?.value
            };
            let (feature, centre) = envelope.touched(psi);
            let expected = centre - rho;
            let kept = envelope.path(envelope.feature(psi), psi).0;
            if !((kept - expected).abs() <= 4e-15 * rho) {
                return Err(format!(
                    "the oracle's own path at {psi} is {kept:e} and {expected:e} ({feature:?}) {:?}",
                    envelope.feature(psi)
                ));
            }
            // Roundings of the radii, and the polynomials that the path is kept as.
            let limit = 4e-15 * rho + 3e-13 * oracle.r;
            if !((found - expected).abs() <= limit) {
                let off = found - expected;
                return Err(format!(
                    "path at {psi} is {found:e}, not {expected:e} ({feature:?}): {off:e} off, allowed {limit:e}"
                ));
            }
        }
        Ok(())
    });
}
