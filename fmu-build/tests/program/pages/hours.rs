//! The pages `docs/tutorials/*.md` are transcripts: what a new user types and what comes back. Their commands are run
//! here, in an empty folder each, and must say what the page says; `write_the_hours` writes the pages anew.
//!
//! In a block ```` ```console ```` each line that begins with `$ ` is a command, and what follows is what it said. A
//! block ```` ```python NAME ```` is a file that the user writes before. The last line counts lines and seconds.
//!
//! Four hundred runs are typed as eighty by the tests, as the page says. What differs then stands in blocks ````
//! ```console counts ````: there words are compared, not numbers.
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]
#![allow(clippy::unwrap_used)]

use crate::common;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};
use std::{env, fs};

const PAGES: [&str; 4] = ["catalogue.md", "recording.md", "data-set.md", "rotor.md"];
const COUNTED: &str = "*Typed: ";
/// What is written of a long sweep where the page is only compared.
const FEWER: [&str; 2] = ["runs = 400\n", "runs = 80\n"];
const WHERE: &str = "on two cores that others used as well.*";

/// A folder of a user's, with the repository's examples in it.
fn user(page: &str) -> std::path::PathBuf {
    // Made once for all users of this machine, with a word that belongs to no transcript.
    common::python();
    let folder = common::folder(page);
    std::os::unix::fs::symlink(common::root().join("examples"), folder.join("examples")).unwrap();
    folder
}

/// Runs a command in a folder, with this build's program.
pub(super) fn typed(command: &str, folder: &Path) -> std::process::Output {
    let program = Path::new(env!("CARGO_BIN_EXE_brinell"));
    // A page that runs no example needs not their half gigabyte.
    let python = if command.contains("python") { common::examples_python() } else { common::python() };
    let folders = [program.parent().unwrap(), python.interpreter().parent().unwrap()].map(Path::to_path_buf);
    let path = env::join_paths(folders.into_iter().chain(env::split_paths(&env::var_os("PATH").unwrap()))).unwrap();
    let modules = [common::root().join("examples"), Path::new(env!("CARGO_MANIFEST_DIR")).join("module")];
    // Around a redirection of its own.
    let whole = if command.starts_with("python ") { command.to_owned() } else { format!("{{ {command}; }} 2>&1") };
    let mut shell = Command::new("sh");
    shell.current_dir(folder).args(["-c", &whole]).env("PATH", path);
    shell.env("PYTHONPATH", env::join_paths(modules).unwrap()).env("PYTHONPYCACHEPREFIX", python.bytecode());
    shell
        .env_remove("PYTHONDONTWRITEBYTECODE")
        .env("MPLBACKEND", "Agg")
        .env("BRINELL_FMU", program)
        .env("BRINELL_PROGRAM", program);
    if let Some(library) = common::built_with_the_tests() {
        shell.env("BRINELL_LIBRARY", library);
    }
    shell.output().unwrap()
}

/// What a command says. Python's packages warn about what the machine lacks: their warnings are left out, ours are not.
fn said(command: &str, folder: &Path) -> String {
    let output = typed(command, folder);
    // What the program refuses is part of a transcript; a script that fails is not.
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() || command.starts_with("brinell "), "{command}: {errors}");
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(!text.contains(common::root().to_str().unwrap()), "{command} names a folder of this machine: {text}");
    text.lines().filter(|line| !of_the_machine(line)).map(|line| timeless(line) + "\n").collect()
}

/// Which libraries are packed, and for which systems.
fn of_the_machine(line: &str) -> bool {
    line.starts_with("linux64: ") && line.contains(" KiB")
}

/// A sweep's JSON without the seconds that it took and the bytes of its compressed files.
fn timeless(line: &str) -> String {
    ["\"seconds\": ", "\"bytes\": "].iter().fold(line.to_owned(), |line, key| match line.split_once(key) {
        Some((before, after)) => {
            format!("{before}{key}…{}", after.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.'))
        }
        None => line,
    })
}

/// The page as it comes out now, with all runs or with fewer.
fn anew(page: &str, all: bool) -> String {
    let folder = user(page);
    let text = fs::read_to_string(common::root().join("docs/tutorials").join(page)).unwrap();
    let (mut out, mut lines) = (String::new(), text.lines().peekable());
    let (mut commands, mut written, mut waited, before) = (0, 0, Duration::ZERO, core_seconds());
    while let Some(line) = lines.next() {
        if line.starts_with(COUNTED) {
            let seconds = waited.as_secs_f64().ceil();
            out += &format!("{COUNTED}{commands} commands and {written} lines of a file. ");
            let core = (core_seconds() - before).ceil();
            out += &format!("Waited: {seconds} s, {core} s of a core, {WHERE}\n");
            continue;
        }
        out += &format!("{line}\n");
        let block = line.strip_prefix("```").unwrap_or_default();
        let mut held = String::new();
        if block.starts_with("console") {
            for line in lines.by_ref().take_while(|line| *line != "```") {
                let Some(command) = line.strip_prefix("$ ") else { continue };
                let begin = Instant::now();
                held += &format!("{line}\n{}", said(command, &folder));
                waited += begin.elapsed();
                commands += 1;
            }
        } else if let Some((_, name)) = block.split_once(' ') {
            held = lines.by_ref().take_while(|line| *line != "```").map(|line| format!("{line}\n")).collect();
            written += held.lines().filter(|line| !line.trim().is_empty()).count();
            let file = if all { held.clone() } else { held.replace(FEWER[0], FEWER[1]) };
            fs::write(folder.join(name), file).unwrap();
        } else {
            continue;
        }
        out += &format!("{held}```\n");
    }
    out
}

/// What the commands have taken so far of a core (s): a busy machine makes one wait longer, but not this.
fn core_seconds() -> f64 {
    let text = fs::read_to_string("/proc/self/stat").unwrap();
    // After the program's name, which may hold blanks: user and system time of children that have ended, in 1/100 s.
    let fields: Vec<&str> = text.rsplit(") ").next().unwrap().split(' ').collect();
    fields[13..15].iter().map(|ticks| ticks.parse::<f64>().unwrap() / 100.0).sum()
}

/// Without the seconds, and without the numbers that count runs.
fn compared(text: &str) -> String {
    let mut counts = false;
    let without = |line: &str| {
        if line.starts_with("```") {
            counts = line == "```console counts";
        }
        let line = line.split(" Waited: ").next().unwrap();
        match counts && !line.starts_with("$ ") {
            true => numberless(line) + "\n",
            false => format!("{line}\n"),
        }
    };
    text.lines().map(without).collect()
}

/// Words alone, one blank between two.
fn numberless(line: &str) -> String {
    let is_word = |word: &&str| word.trim_matches(['"', ',', '{', '}', ';']).parse::<f64>().is_err();
    line.split_whitespace().filter(is_word).collect::<Vec<_>>().join(" ")
}

/// Gives the page as it came out.
fn is_what_happens(page: &str) -> String {
    let there = fs::read_to_string(common::root().join("docs/tutorials").join(page)).unwrap();
    assert!(there.contains(COUNTED), "{page} counts no lines");
    let anew = anew(page, false);
    let (there, found) = (compared(&there), compared(&anew));
    for (number, (there, found)) in there.lines().zip(found.lines()).enumerate() {
        assert_eq!(found, there, "docs/tutorials/{page}, line {}", number + 1);
    }
    assert_eq!(found.lines().count(), there.lines().count(), "docs/tutorials/{page}");
    anew
}

#[test]
fn an_hour_with_a_catalogue_is_what_happens() {
    is_what_happens("catalogue.md");
}

#[test]
#[ignore = "sizes six recordings, two minutes of a core; `size` has tests of its own"]
fn an_hour_with_a_recording_is_what_happens() {
    is_what_happens("recording.md");
}

#[test]
#[ignore = "runs eighty signals; the examples' tests have a labelled sweep as well"]
fn an_hour_with_a_data_set_is_what_happens() {
    if common::has_ross() {
        let page = is_what_happens("data-set.md");
        assert!(page.contains("80 runs, 80 of them made now, 0 failed"), "{page}");
        // What guesses is right of one run in four, of 80 within 5 % of that; this is three times as far off.
        let right = page.split("\nright: ").nth(1).unwrap().split(' ').next().unwrap();
        assert!(right.parse::<f64>().unwrap() > 40.0, "{page}");
    }
}

#[test]
#[ignore = "needs the environment of the examples, half a gigabyte"]
fn an_hour_with_a_rotor_is_what_happens() {
    if common::has_ross() {
        is_what_happens("rotor.md");
    }
}

/// All, or the one that the environment's `BRINELL_PAGE` names.
#[test]
#[ignore = "writes docs/tutorials/*.md"]
fn write_the_hours() {
    let one = env::var("BRINELL_PAGE").ok();
    for page in PAGES.into_iter().filter(|page| one.as_ref().is_none_or(|one| one == page)) {
        fs::write(common::root().join("docs/tutorials").join(page), anew(page, true)).unwrap();
    }
}
