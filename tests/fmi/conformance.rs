//! `fmi2-conformance.md` and `fmi3-conformance.md` in `docs/evidence`: each rule has a test, or a measurement.
//! A test that fails fails the suite that this belongs to.
#![allow(clippy::unwrap_used)]

use std::fs;

/// What is wrong with the evidence of a rule.
fn fault(shown: &str, result: &str) -> Option<String> {
    if shown.is_empty() || result.is_empty() {
        return Some("neither test nor measurement".to_owned());
    }
    shown.split("<br>").find_map(|one| {
        if one.starts_with('`') {
            // A command, whose figure is the result.
            return (result == "passes").then(|| format!("{one} without a figure"));
        }
        let link = one.strip_prefix("[`").and_then(|rest| rest.strip_suffix(')')?.split_once("`](../../"));
        let Some((name, file)) = link else { return Some(format!("{one} is no link to a test")) };
        let text = fs::read_to_string(brinell_tests::root().join(file)).unwrap_or_default();
        (!text.contains(&format!("fn {name}("))).then(|| format!("no test {name} in {file}"))
    })
}

#[test]
fn every_rule_of_the_standard_has_a_test_or_a_measurement() {
    for (page, fewest) in [("fmi2-conformance.md", 60), ("fmi3-conformance.md", 30)] {
        let text = fs::read_to_string(brinell_tests::root().join("docs/evidence").join(page)).unwrap();
        let rows = text.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| rule "));
        let mut rules = 0;
        for row in rows {
            let cells: Vec<&str> = row.trim_matches('|').split(" | ").map(str::trim).collect();
            let [rule, shown, result] = cells[..] else { panic!("{page}: three cells in: {row}") };
            let fault = fault(shown, result);
            assert!(fault.is_none(), "{page}: {rule} {}", fault.unwrap());
            rules += 1;
        }
        assert!(rules >= fewest, "{page}: {rules} rules");
    }
}
