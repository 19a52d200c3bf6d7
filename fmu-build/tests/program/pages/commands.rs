//! Every command that README and the pages of `docs/how-to` and `docs/reference` show is typed here, in an empty folder
//! for each page, with the files that its text says a user has: README's always, those of the pages at night; but their
//! words must always be known to the program.
//!
//! A command whose comment begins with `# minutes` or `# hours` is left to the tests at night or to those who write
//! pages; what needs the repository or an environment of its own is typed by the tests of [`ELSEWHERE`].
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]
#![allow(clippy::unwrap_used)]

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::Mutex;

use clap::Parser;
use fmu_build::cli::Arguments;

use super::hours::typed;
use crate::common;

/// How a command begins, and the test that types it, as `file: name`; or why none does.
const ELSEWHERE: [(&str, &str); 12] = [
    ("cargo fmu demo", "tests/program/pages/commands.rs: the_demo_is_what_the_readme_shows"),
    ("cargo fmu build scenes/6205-epps.toml --platforms all", "tests/platforms.rs: all_platforms"),
    ("cargo lab site", "../laboratory/src/site.rs: every_page_is_in_the_contents_once_and_links_lead_somewhere"),
    ("cargo test --workspace", "is this"),
    ("cargo fmu run 6205-spall-5deg-machine", "as `brinell run`, minutes"),
    (
        "python own_host.py mine.fmu",
        "tests/examples/main.rs: the_host_of_forty_lines_on_its_page_runs_with_a_new_hosted_scene",
    ),
    ("python examples/", "tests/examples/main.rs: every_command_of_the_guide_is_run_here"),
    ("python3 -m venv", "tests/examples/main.rs: every_command_of_the_guide_is_run_here"),
    (". target/examples-env", "tests/examples/main.rs: every_command_of_the_guide_is_run_here"),
    ("pip install -r examples", "tests/examples/main.rs: every_command_of_the_guide_is_run_here"),
    (".ci/platforms", "tests/platforms.rs: all_platforms"),
    ("sbatch ", "tests/program/sweep/mod.rs: parts_of_a_sweep_made_anywhere_join_to_the_bits_of_one_run"),
];
/// What the pages' text says that a user has: a sweep, a speed, a recording.
const SWEEP: &str = "scene = \"er16k-tb1\"\nruns = 18\nstop_s = 0.06\n[set]\ncontact.law = \"hertz\"\n";
const SPEED: &str = "time_s,speed_hz\n0,10\n0.1,20\n0.2,20\n";

/// Lines of the blocks ```` ```sh ```` of a page, continued lines joined.
fn commands(page: &Path) -> Vec<String> {
    let text = fs::read_to_string(page).unwrap().replace("\\\n", " ");
    let blocks = text.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    blocks.flat_map(|block| block.lines().map(str::to_owned).collect::<Vec<_>>()).collect()
}

/// A command and its comment.
fn parts(line: &str) -> (&str, &str) {
    line.split_once(" #").map_or((line.trim(), ""), |(command, comment)| (command.trim(), comment.trim()))
}

fn takes_long(comment: &str) -> bool {
    comment.starts_with("minutes") || comment.starts_with("hours")
}

/// What a user of this page has before: a sweep, a speed over time, recordings.
fn prepare(page: &str, folder: &Path) {
    fs::write(folder.join("design.toml"), SWEEP).unwrap();
    fs::write(folder.join("up.csv"), SPEED).unwrap();
    if page.ends_with("sizing.md") || page.ends_with("commands.md") {
        let made = "brinell run 6205-spall-5deg --stop 1 --step 0.01 --wav --wav-rate 51200 --no-figure \
                    && mv 6205-spall-5deg.wav recording.wav && rm -f 6205-spall-5deg*";
        assert!(typed(made, folder).status.success());
        let script = "import os, sys\nimport numpy as np\nfrom scipy.io import savemat, wavfile\n\
                      os.chdir(sys.argv[1])\nrate, x = wavfile.read('recording.wav')\nnp.save('recording.npy', x)\n\
                      savemat('recording.mat', {'X130_DE_time': x})\n";
        common::run_text(common::python(), &common::folder("recordings-made"), script, [folder]);
    }
}

/// Whether a command reports on a shipped scene, which it does from any page alike, and another page has it already.
fn is_said_elsewhere(command: &str) -> bool {
    static SAID: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    let reports = ["brinell contact ", "brinell modes ", "brinell stiffness "].iter().any(|r| command.starts_with(r));
    reports && !command.contains(".toml") && !SAID.lock().unwrap().insert(command.to_owned())
}

/// Types the commands of pages, those that take long or the others.
fn type_all(pages: &[&str], long: bool) {
    for page in pages {
        let path = common::root().join(page);
        let folder = common::folder(&format!("typed-{}", page.replace('/', "-")));
        prepare(page, &folder);
        for line in commands(&path) {
            let (command, comment) = parts(&line);
            if !command.starts_with("brinell ") || takes_long(comment) != long || is_said_elsewhere(command) {
                continue;
            }
            let output = typed(command, &folder);
            let said = String::from_utf8_lossy(&output.stdout);
            assert!(output.status.success(), "{page}: {command}\n{said}");
            // The recording is one of the outer raceway's spall, at 10 Hz and this rate.
            if command.starts_with("brinell size recording.") && command.contains("--rate 51200") {
                let sized = !said.contains("\"length_deg\": null") && said.contains("\"length_deg\": ");
                assert!(said.contains("\"fault\": \"outer\"") && sized, "{page}: {command}\n{said}");
            }
        }
    }
}

/// The words of a command of the program, as a shell hands them over.
fn words(command: &str) -> Vec<String> {
    let alone = command.split(['>', '|', '&']).next().unwrap();
    let script = format!("brinell() {{ printf '%s\\n' brinell \"$@\"; }}; {alone}");
    let shell = Command::new("sh").args(["-c", &script]).output().unwrap();
    String::from_utf8(shell.stdout).unwrap().lines().map(str::to_owned).collect()
}

fn pages() -> Vec<String> {
    let mut pages = vec!["README.md".to_owned()];
    for shelf in ["how-to", "reference", "explanation"] {
        let folder = common::root().join("docs").join(shelf);
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        pages.extend(entries.map(|name| format!("docs/{shelf}/{name}")));
    }
    pages.sort();
    pages
}

#[test]
fn every_command_of_a_page_is_typed_by_a_test_or_says_why_not() {
    let mut count = 0;
    for page in pages() {
        for line in commands(&common::root().join(&page)) {
            let (command, comment) = parts(&line);
            let elsewhere = ELSEWHERE.iter().find(|(begins, _)| command.starts_with(begins));
            let here = command.starts_with("brinell ");
            assert!(command.is_empty() || here || takes_long(comment) || elsewhere.is_some(), "{page}: {command}");
            if here {
                let known = Arguments::try_parse_from(words(command));
                known.unwrap_or_else(|error| panic!("{page}: {command}\n{error}"));
                count += 1;
            }
        }
    }
    assert!(count >= 30, "{count} commands of the program");
    for (_, by) in ELSEWHERE {
        if let Some((file, test)) = by.split_once(".rs: ") {
            let source = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("{file}.rs"));
            let text = fs::read_to_string(&source).unwrap_or_else(|error| panic!("{}: {error}", source.display()));
            assert!(text.contains(test), "no {test} in {file}.rs");
        }
    }
}

#[test]
fn commands_of_the_readme_run_in_an_empty_folder() {
    type_all(&["README.md"], false);
}

#[test]
#[ignore = "a minute"]
fn commands_of_the_reference_run_in_an_empty_folder() {
    type_all(&["docs/reference/commands.md", "docs/reference/fmi3.md"], false);
}

#[test]
#[ignore = "minutes"]
fn commands_of_how_to_pages_run_in_an_empty_folder() {
    let pages = pages();
    type_all(&pages.iter().map(String::as_str).filter(|page| page.contains("/how-to/")).collect::<Vec<_>>(), false);
}

#[test]
#[ignore = "minutes"]
fn commands_that_take_minutes_run_in_an_empty_folder() {
    type_all(&pages().iter().map(String::as_str).collect::<Vec<_>>(), true);
}

#[test]
#[ignore = "drives the FMU for half a minute; `commands_that_take_minutes` types it, too"]
fn the_demo_is_what_the_readme_shows() {
    let folder = common::folder("typed-demo");
    let output = typed("brinell demo", &folder);
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && said.contains("demo.png"), "{said}");
    // By the paper's numbers; there is no 2, as no element gets free.
    let events = fs::read_to_string(folder.join("brinell-demo/events.csv")).unwrap();
    let numbered = events.lines().skip(1).map(|line| line.split(',').take(2).collect::<Vec<_>>().join(" "));
    let numbered: Vec<String> = numbered.filter(|words| !words.ends_with(' ')).collect();
    assert_eq!(numbered, ["entry 1", "reload 3", "exit 4"], "{events}");
}
