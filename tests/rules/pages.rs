//! The pages of `docs/` and those beside them: links lead somewhere, files and names that theory speaks of are there,
//! pages of prose are short, and the list of pages has them all.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::PathBuf;

use brinell_tests::files_below;

/// Lines of a page of prose; pages of evidence are tables and may be longer.
const LONGEST: usize = 150;
/// Pages that hold others' text: what users of earlier versions are told, and links to other projects.
const ABOVE: [&str; 4] = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md"];

fn root() -> PathBuf {
    brinell_tests::root().canonicalize().unwrap()
}

/// The pages in `docs`.
fn documents() -> Vec<PathBuf> {
    let found = files_below(&root().join("docs"), "md");
    assert!(found.len() > 50, "{} pages", found.len());
    found
}

/// All pages, and the page itself without its blocks of code.
fn pages() -> Vec<(PathBuf, String)> {
    let above = ABOVE.iter().map(|name| root().join(name));
    above.chain(documents()).map(|path| (path.clone(), without_code(&fs::read_to_string(path).unwrap()))).collect()
}

fn without_code(text: &str) -> String {
    let mut code = false;
    let mut prose = |line: &&str| {
        let fence = line.trim_start().starts_with("```");
        code ^= fence;
        !code && !fence
    };
    text.lines().filter(|line| prose(line)).map(|line| format!("{line}\n")).collect()
}

/// Targets of a page's links, `path#anchor`.
fn links(text: &str) -> impl Iterator<Item = &str> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    targets.filter(|target| !target.contains("://") && !target.contains([' ', '\n']))
}

/// As hosts of repositories make them of headings.
fn anchors(text: &str) -> Vec<String> {
    let headings = text.lines().filter(|line| line.starts_with('#')).map(|line| line.trim_start_matches('#').trim());
    let anchor = |heading: &str| -> String {
        let kept = heading.chars().filter(|c| c.is_alphanumeric() || "-_ ".contains(*c));
        kept.flat_map(char::to_lowercase).map(|c| if c == ' ' { '-' } else { c }).collect()
    };
    headings.map(anchor).collect()
}

#[test]
fn every_link_of_a_page_leads_to_a_file_and_a_heading() {
    let mut broken = Vec::new();
    for (page, text) in pages() {
        for link in links(&text) {
            let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
            let target = if path.is_empty() { page.clone() } else { page.parent().unwrap().join(path) };
            let there = target.exists()
                && (anchor.is_empty()
                    || anchors(&without_code(&fs::read_to_string(&target).unwrap())).contains(&anchor.to_owned()));
            if !there {
                broken.push(format!("{}: {link}", page.strip_prefix(root()).unwrap().display()));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn files_that_theory_names_are_there_with_what_it_says_is_in_them() {
    let page = root().join("docs/explanation/theory.md");
    let text = fs::read_to_string(&page).unwrap();
    let mut names = 0;
    // [`file.rs`](path): `Name`, `name`; or a full stop
    for part in text.split("[`").skip(1) {
        let Some((path, rest)) = part.split_once("](").and_then(|(_, rest)| rest.split_once(')')) else { continue };
        if !path.ends_with(".rs") {
            continue;
        }
        let source = fs::read_to_string(page.parent().unwrap().join(path)).unwrap_or_else(|e| panic!("{path}: {e}"));
        let Some(listed) = rest.strip_prefix(':') else { continue };
        let listed = listed.split([';', '.']).next().unwrap();
        for name in listed.split('`').skip(1).step_by(2) {
            let defined = ["fn ", "struct ", "enum ", "trait ", "type "].iter().any(|kind| {
                let definition = format!("{kind}{name}");
                let end = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
                source.match_indices(&definition).any(|(at, _)| end(&source[at + definition.len()..]))
            });
            assert!(defined, "theory.md says that {name} is in {path}");
            names += 1;
        }
    }
    assert!(names >= 40, "{names} names");
}

#[test]
fn keys_that_the_page_of_symbols_names_are_keys_of_a_scene() {
    let text = fs::read_to_string(root().join("docs/reference/symbols.md")).unwrap();
    let schema = fs::read_to_string(root().join("scenes/scene.schema.json")).unwrap();
    let mut keys = 0;
    for name in text.split('`').skip(1).step_by(2).filter(|name| !name.contains('[')) {
        let key = name.split('.').next_back().unwrap();
        assert!(schema.contains(&format!("\"{key}\"")), "{name}");
        keys += 1;
    }
    assert!(keys >= 12, "{keys} keys");
}

#[test]
fn no_page_of_prose_has_more_than_150_lines_and_the_readme_80() {
    let mut found = documents();
    // A table that is made of the schema is no prose either.
    let tables = [root().join("docs/evidence"), root().join("docs/reference/keys.md")];
    found.retain(|page| !tables.iter().any(|table| page.starts_with(table)));
    for page in found {
        let lines = fs::read_to_string(&page).unwrap().lines().count();
        assert!(lines <= LONGEST, "{} has {lines} lines", page.display());
    }
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    assert!(readme.lines().count() <= 80 && readme.len() <= 6000, "README.md: {} bytes", readme.len());
}

#[test]
fn the_list_of_pages_has_every_page() {
    let list = fs::read_to_string(root().join("docs/pages.md")).unwrap();
    for page in documents() {
        let name = page.strip_prefix(root().join("docs")).unwrap().to_str().unwrap();
        // A part that another page holds has no heading.
        let part = !fs::read_to_string(&page).unwrap().starts_with("# ");
        assert!(part || name == "pages.md" || list.contains(&format!("]({name})")), "docs/pages.md lacks {name}");
    }
}

#[test]
fn formulas_have_only_what_the_script_that_sets_them_knows() {
    let script = fs::read_to_string(root().join("docs/math.js")).unwrap();
    let mut commands = 0;
    for page in documents() {
        let text = fs::read_to_string(&page).unwrap();
        for formula in text.split("```math\n").skip(1).map(|rest| rest.split("```").next().unwrap()) {
            for rest in formula.split('\\').skip(1) {
                let name: String = rest.chars().take_while(char::is_ascii_alphabetic).collect();
                // A sign behind the backslash is a space or the end of a line.
                let word = |c: char| !c.is_ascii_alphanumeric();
                let known = name.is_empty() || script.split(word).any(|known| known == name);
                assert!(known, "{}: \\{name}", page.display());
                commands += 1;
            }
        }
    }
    assert!(commands > 200, "{commands} commands");
}

#[test]
fn the_scene_of_the_readme_is_one() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let text = readme.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    let scene = brinell_scene_file::from_toml(text).unwrap();
    assert_eq!((text.lines().count(), scene.defects.len(), scene.shaft.load), (12, 1, [0.0, -500.0]));
}

#[test]
fn the_citation_is_of_this_version() {
    let version = format!("version: {}", env!("CARGO_PKG_VERSION"));
    let citation = fs::read_to_string(root().join("CITATION.cff")).unwrap();
    assert!(citation.lines().any(|line| line == version), "no line {version}: {citation}");
}
