//! The card beside a sweep's table, and the parts of a data set.

use super::*;

/// Rows of a table of the card under a heading, without its head.
fn listed(card: &str, heading: &str) -> Vec<Vec<String>> {
    let section = card.split(&format!("## {heading}\n")).nth(1).unwrap_or_else(|| panic!("no {heading} in {card}"));
    let lines = section.split("\n## ").next().unwrap().lines().filter(|line| line.starts_with("| "));
    let cells = |line: &str| line.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect();
    lines.map(cells).skip(1).filter(|cells: &Vec<String>| cells[0] != "---").collect()
}

#[test]
fn a_card_says_what_the_table_holds_and_how_it_was_made() {
    let folder = common::folder("sweep-card");
    let text = QUICK
        .replace("seed = 3", "seed = 3\nsplit = [0.5, 0.0, 0.5]\nsplit_by = \"defect.length_mm\"")
        .replace("[random]", "solver.max_steps = [1000000, 3]\n[random]");
    let (path, out) = (file(&folder, &text), folder.join("out"));
    sweep(&path, &out, &["--signals", "wav"]);
    let card = fs::read_to_string(out.join("README.md")).unwrap();
    assert!(card.contains("a row for each of 24 runs of 24, of which 12 failed"), "{card}");
    assert!(card.contains("`run-0000000.wav` is that of run 0"), "{card}");
    assert!(card.contains("`brinell sweep sweep.toml -o FOLDER --signals wav`"), "{card}");
    assert!(card.contains(&format!("```toml\n{}\n```\n", text.trim_end())), "{card}");
    // What the machine has is in none of it.
    assert!(!card.contains(&*folder.to_string_lossy()), "{card}");
    // Each column of the table, once and in its order.
    let columns = listed(&card, "Columns");
    let names: Vec<String> = columns.iter().map(|cells| cells[0].trim_matches('`').to_owned()).collect();
    assert_eq!(names, table(&out).0);
    assert!(columns.iter().all(|cells| cells.len() == 3 && cells[2].len() > 5), "{card}");
    let load = columns.iter().find(|cells| cells[0] == "`shaft.load_n`").unwrap();
    assert_eq!(load[1..], ["N", "input: load along that of the scene"]);
    // Counts as the table has them.
    let [types, errors, splits] = ["fault_type", "error", "split"].map(|name| words(&out, name));
    for cells in listed(&card, "Runs of each class") {
        let is_of = |run: &usize| types[*run] == cells[0];
        let count = |is: &dyn Fn(usize) -> bool| (0..24).filter(is_of).filter(|run| is(*run)).count().to_string();
        let mut expected = vec![cells[0].clone(), count(&|_| true), count(&|run| errors[run] != "null")];
        for part in ["train", "validation", "test"] {
            expected.push(count(&|run| errors[run] == "null" && splits[run] == part));
        }
        assert_eq!(cells, expected);
        assert_eq!(cells[1..3], ["8", "4"], "three classes of eight runs");
    }
}

#[test]
fn runs_of_one_length_are_in_one_part_of_the_data_set() {
    let folder = common::folder("sweep-split");
    let text = QUICK.replace("seed = 3", "seed = 3\nsplit = [0.5, 0.25, 0.25]\nsplit_by = [\"defect.length_mm\"]");
    let (path, out) = (file(&folder, &text.replace("[1, 2]", "[0.8, 1.2, 1.6, 2]")), folder.join("out"));
    sweep(&path, &out, &[]);
    let pairs = column(&out, "defect.length_mm").into_iter().map(|length| length.to_string()).zip(words(&out, "split"));
    // Healthy runs have none.
    let mut pairs: Vec<_> = pairs.filter(|(length, _)| length != "null").collect();
    pairs.sort();
    pairs.dedup();
    assert_eq!(pairs.len(), 4, "a length in two parts: {pairs:?}");
    let count = |part: &str| pairs.iter().filter(|(_, of)| of == part).count();
    assert_eq!(["train", "validation", "test"].map(count), [2, 1, 1]);
}

#[test]
fn a_file_of_the_cards_name_that_somebody_has_written_stays() {
    let folder = common::folder("sweep-own-card");
    let (path, out) = (file(&folder, &QUICK.replace("runs = 24", "runs = 1")), folder.join("out"));
    fs::create_dir(&out).unwrap();
    fs::write(out.join("README.md"), "# Mine\n").unwrap();
    assert!(sweep(&path, &out, &[]).contains("README.md is not a sweep's and stays as it is"));
    assert_eq!(fs::read_to_string(out.join("README.md")).unwrap(), "# Mine\n");
    fs::remove_file(out.join("README.md")).unwrap();
    sweep(&path, &out, &[]);
    assert!(fs::read_to_string(out.join("README.md")).unwrap().contains("each of 1 runs of 1, of which 0 failed"));
}
