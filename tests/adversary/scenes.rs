//! Random scenes against the oracle.

mod judge;

use crate::case::random;
use crate::draw::{Draw, seeds};
use judge::{Verdict, judge};

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
