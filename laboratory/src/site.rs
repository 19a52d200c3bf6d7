//! The command `site`: the documentation as a book, by mdBook. The pages are those of `docs/`, as they are; the first
//! is the README.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use fmu_build::shared::{Project, whole_file};

/// Chapters: a heading, the folder of its pages, and those of them that come first, in this order.
const CHAPTERS: [(&str, &str, &[&str]); 7] = [
    ("First hours", "tutorials", &["catalogue.md", "recording.md", "data-set.md", "rotor.md"]),
    ("How to", "how-to", &["hosting.md", "step.md", "defects.md", "sensors.md", "runs.md", "sweeps.md", "sizing.md"]),
    ("Reference", "reference", &["scenes.md", "keys.md", "symbols.md", "variables.md", "commands.md"]),
    ("Explanation", "explanation", &["model.md", "theory.md", "axial.md", "contact.md"]),
    ("Evidence", "evidence", &["validation.md"]),
    ("Data", "data", &[]),
    ("Behind it", "", &[]),
];
/// Pages above `docs/`, with their names in the book.
const ABOVE: [(&str, &str); 3] =
    [("README.md", "index.md"), ("CHANGELOG.md", "changes.md"), ("ARCHITECTURE.md", "house.md")];
const SETTINGS: &str = "[book]\ntitle = \"Brinell\"\nlanguage = \"en\"\nsrc = \"src\"\n\n\
                        [output.html]\nadditional-js = [\"src/math.js\"]\nno-section-label = true\n";
/// The command: lays out `<folder>/src` and has mdBook write `<folder>/book`.
pub fn command(project: &Project, folder: &Path) -> Result<()> {
    let source = project.source().context("the site is made of Brinell's source, which is not there")?;
    lay_out(source, folder)?;
    let status = Command::new("mdbook").arg("build").arg(folder).status();
    match status {
        Ok(status) if status.success() => println!("{}", folder.join("book/index.html").display()),
        Ok(status) => bail!("mdbook: {status}"),
        Err(_) => bail!("{} is laid out; to make the site of it: cargo install --locked mdbook", folder.display()),
    }
    Ok(())
}

/// Writes settings, contents and pages.
pub fn lay_out(source: &Path, folder: &Path) -> Result<()> {
    let pages = folder.join("src");
    if pages.exists() {
        fs::remove_dir_all(&pages).with_context(|| pages.display().to_string())?;
    }
    copy(&source.join("docs"), &pages)?;
    for page in markdown(&pages)? {
        // Without a heading it is a part that another page holds.
        if title(&fs::read_to_string(&page)?).is_none() {
            fs::remove_file(&page).with_context(|| page.display().to_string())?;
        }
    }
    whole_file::write(&folder.join("book.toml"), SETTINGS)?;
    let read = |name: &str| fs::read_to_string(source.join(name)).with_context(|| name.to_owned());
    for (name, page) in ABOVE {
        // In the repository they lie above the pages.
        whole_file::write(&pages.join(page), read(name)?.replace("docs/", ""))?;
    }
    bring_what_is_linked(source, &pages)?;
    show_data(&pages)?;
    whole_file::write(&pages.join("SUMMARY.md"), contents(&pages)?)?;
    Ok(())
}

/// Files of the repository that pages lead to come along, so that the book is whole.
fn bring_what_is_linked(source: &Path, pages: &Path) -> Result<()> {
    for page in markdown(pages)? {
        let mut text = fs::read_to_string(&page)?;
        let up = "../".repeat(page.strip_prefix(pages)?.components().count() - 1);
        for link in links(&text) {
            // What does not leave the page's folder is beside it.
            let Some(above) = link.strip_prefix(&up) else { continue };
            // A page of `docs/` leads to the repository's files by one more `../`, one of the root without it.
            let file = above.strip_prefix("../").unwrap_or(above);
            let from = source.join(file);
            let known = ABOVE.iter().find(|(name, _)| *name == file).map(|(_, page)| *page);
            if known.is_none() && !pages.join(file).exists() && from.exists() {
                if from.is_dir() { copy(&from, &pages.join(file))? } else { bring(&from, &pages.join(file))? }
            }
            for end in [")", "#"] {
                text = text.replace(&format!("]({link}{end}"), &format!("]({up}{}{end}", known.unwrap_or(file)));
            }
        }
        fs::write(&page, text)?;
    }
    Ok(())
}

/// Tables of `data/` become pages, and links to them lead there.
fn show_data(pages: &Path) -> Result<()> {
    let mut names = Vec::new();
    for entry in fs::read_dir(pages.join("data"))? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let cell = |text: &str| text.replace('|', "\\|");
        let line = |cells: &csv::StringRecord| {
            let cells: Vec<String> = cells.iter().map(cell).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let mut table = csv::Reader::from_path(&path).with_context(|| name.clone())?;
        let head = table.headers()?.clone();
        let mut text = format!("# {name}\n\n[The file]({name})\n\n{}{}|\n", line(&head), "|---".repeat(head.len()));
        for record in table.records() {
            text += &line(&record?);
        }
        fs::write(path.with_extension("md"), text)?;
        names.push(name);
    }
    for page in markdown(pages)?.iter().filter(|page| !page.starts_with(pages.join("data"))) {
        let text = fs::read_to_string(page)?;
        let linked = names.iter().fold(text.clone(), |text, name| {
            text.replace(&format!("data/{name})"), &format!("data/{})", name.replace(".csv", ".md")))
        });
        if linked != text {
            fs::write(page, linked)?;
        }
    }
    Ok(())
}

fn bring(from: &Path, to: &Path) -> Result<()> {
    fs::create_dir_all(to.parent().unwrap_or(to))?;
    fs::copy(from, to).with_context(|| from.display().to_string())?;
    Ok(())
}

/// The book's pages, in folders too.
fn markdown(pages: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(pages)? {
        let path = entry?.path();
        if path.is_dir() {
            found.extend(markdown(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "md") {
            found.push(path);
        }
    }
    Ok(found)
}

/// Where a page leads within the repository, each once, without the position on the other page.
fn links(page: &str) -> BTreeSet<String> {
    let ends = page.split("](").skip(1).filter_map(|part| part.split([')', '#']).next());
    let here = |link: &&str| !link.is_empty() && !link.contains("://") && !link.contains([' ', '\n', '\\']);
    ends.filter(here).map(str::to_owned).collect()
}

fn copy(from: &Path, to: &Path) -> Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from).with_context(|| from.display().to_string())? {
        let path = entry?.path();
        let target = to.join(path.file_name().unwrap_or_default());
        if path.is_dir() {
            copy(&path, &target)?;
        } else {
            fs::copy(&path, &target).with_context(|| path.display().to_string())?;
        }
    }
    Ok(())
}

/// mdBook's list of pages: every page once, by its own heading, each folder a chapter.
fn contents(pages: &Path) -> Result<String> {
    let mut names = names(pages)?;
    let mut text = String::from("# Contents\n\n[Brinell](index.md)\n");
    names.retain(|name| name != "index.md");
    for (heading, folder, first) in CHAPTERS {
        writeln!(text, "\n# {heading}\n")?;
        let folder = if folder.is_empty() { String::new() } else { format!("{folder}/") };
        let (mut chapter, others): (Vec<_>, Vec<_>) = names.into_iter().partition(|name| name.starts_with(&folder));
        let place = |name: &String| first.iter().position(|first| name[folder.len()..] == **first);
        chapter.sort_by_key(|name| place(name).unwrap_or(first.len()));
        for name in &chapter {
            writeln!(text, "- [{}]({name})", title(&fs::read_to_string(pages.join(name))?).unwrap_or(name))?;
        }
        names = others;
    }
    Ok(text)
}

/// Pages below the book's folder, its list of contents aside.
fn names(pages: &Path) -> Result<Vec<String>> {
    let mut names = Vec::new();
    for path in markdown(pages)? {
        names.push(path.strip_prefix(pages)?.to_string_lossy().replace('\\', "/"));
    }
    names.retain(|name| name != "SUMMARY.md");
    names.sort();
    Ok(names)
}

fn title(page: &str) -> Option<&str> {
    page.lines().find_map(|line| line.strip_prefix("# "))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn root() -> &'static Path {
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
    }

    #[test]
    fn every_page_is_in_the_contents_once_and_links_lead_somewhere() {
        let folder = tempfile::tempdir().unwrap();
        lay_out(root(), folder.path()).unwrap();
        let pages = folder.path().join("src");
        assert!(SETTINGS.contains("src/math.js") && pages.join("math.js").is_file());
        let contents = fs::read_to_string(pages.join("SUMMARY.md")).unwrap();
        let names = names(&pages).unwrap();
        assert!(names.iter().any(|name| name.starts_with("decisions/")), "pages in folders are pages");
        for name in names {
            assert_eq!(contents.matches(&format!("]({name})")).count(), 1, "{name} in:\n{contents}");
            assert!(!contents.contains(&format!("[{name}]")), "{name} has no heading");
            for link in links(&fs::read_to_string(pages.join(&name)).unwrap()) {
                let there = pages.join(&name).parent().unwrap().join(&link).canonicalize();
                let inside = there.is_ok_and(|there| there.starts_with(pages.canonicalize().unwrap()));
                assert!(inside, "{name} leads to {link}");
            }
        }
    }
}
