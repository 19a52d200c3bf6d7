//! The page of a run in a browser, where there is one: what it draws, that it reports no error, that zooming shows the
//! samples themselves. `BRINELL_BROWSER` names a Chromium; without it those that are usual are tried.
#![allow(clippy::unwrap_used)]

mod common;

use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

const BROWSERS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];
const FLAGS: [&str; 10] = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--hide-scrollbars",
    // Time of the page, not of the machine.
    "--virtual-time-budget=20000",
];

fn browser() -> Option<String> {
    let named = env::var("BRINELL_BROWSER").ok();
    let usual = BROWSERS.iter().map(|name| (*name).to_owned());
    let answers = |name: &String| Command::new(name).arg("--version").output().is_ok_and(|said| said.status.success());
    named.into_iter().chain(usual).find(answers)
}

/// What the browser says of a page.
fn opened(browser: &str, folder: &Path, page: &str, more: &[&str]) -> String {
    let profile = tempfile::tempdir_in(folder).unwrap();
    let output = Command::new(browser)
        .args(FLAGS)
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .args(more)
        .arg(format!("file://{page}"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The number of points that the page drew.
fn points(dom: &str) -> usize {
    let body = dom.split("<body").nth(1).unwrap().split('>').next().unwrap().to_owned();
    assert!(body.contains("data-state=\"drawn\""), "{body}");
    let errors = dom.split("<div id=\"errors\">").nth(1).unwrap().split("</div>").next().unwrap();
    assert_eq!(errors, "", "the page's own errors");
    body.split("data-points=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
}

/// A page of a scene.
fn page(name: &str, scene: &str, more: &[&str]) -> std::path::PathBuf {
    common::python();
    let folder = common::folder(name);
    let output = Command::new(env!("CARGO_BIN_EXE_brinell"))
        .arg("run")
        .arg(common::root().join("scenes").join(scene).with_extension("toml"))
        .args(["--html", "--no-figure", "--columns", "shaft.y", "-o"])
        .arg(&folder)
        .args(more)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder.join(scene).with_extension("html")
}

#[test]
fn the_page_holds_all_it_shows_and_asks_for_nothing() {
    let path = page("page-alone", "6205-spall-5deg", &["--stop", "0.3"]);
    let size = fs::metadata(&path).unwrap().len();
    // Plotly's script has 4.8 MB.
    assert!((4_500_000..8_000_000).contains(&size), "{size} bytes");
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains("default-src 'none'"));
    for title in ["Signals", "Defect 1: outer raceway", "Envelope spectrum", "Order spectrum"] {
        assert!(text.contains(title), "{title}");
    }
    let outside = text.split("<script>").next().unwrap();
    assert!(!outside.contains("src=") && !outside.contains("href="), "{outside}");
}

#[test]
fn a_browser_draws_the_page_without_an_error_and_zooming_shows_every_sample() {
    let Some(browser) = browser() else {
        eprintln!("skipped: no Chromium is installed; BRINELL_BROWSER can name one");
        return;
    };
    let path = page("page-drawn", "6205-spall-5deg", &["--stop", "0.3"]);
    let (folder, name) = (path.parent().unwrap(), path.display().to_string());
    // The sensor's 15 345 samples and nine others: at most 4000 of each are drawn, and all of a millisecond: 51 of the recorder's
    // and 10 of the others.
    let all = points(&opened(&browser, folder, &name, &["--dump-dom"]));
    let zoomed = points(&opened(&browser, folder, &format!("{name}#0.1,0.101"), &["--dump-dom"]));
    assert!(all > 20_000 && all < 30 * 4010, "{all} points");
    assert!(zoomed > 200 && zoomed < 2500, "{zoomed} points in a millisecond");
    let shot = folder.join("page.png");
    opened(&browser, folder, &name, &["--window-size=1250,2400", &format!("--screenshot={}", shot.display())]);
    let script = folder.join("look.py");
    fs::write(&script, LOOK).unwrap();
    let said = common::python().run_file(&script, [&shot]).unwrap_or_else(|error| panic!("{error:#}"));
    assert!(said.contains("drawn"), "{said}");
}

/// Curves in the colours of the signals, axes and letters: a blank page, or one of letters alone, has none.
const LOOK: &str = r##"
import sys
import numpy as np
from PIL import Image

image = np.asarray(Image.open(sys.argv[1]).convert("RGB")).astype(int)
assert image.shape[:2] == (2400, 1250), image.shape
for colour in [(0x00, 0x72, 0xB2), (0xE6, 0x9F, 0x00), (0x00, 0x9E, 0x73)]:
    count = (np.abs(image - colour).sum(axis=2) < 12).sum()
    assert count > 200, (colour, count)
ink = (image.sum(axis=2) < 600).mean()
assert 0.01 < ink < 0.5, ink
# Every part of the page has something in it.
for part in np.array_split(image[:2200], 10):
    assert (part.sum(axis=2) < 600).mean() > 0.002
print("drawn", ink)
"##;
