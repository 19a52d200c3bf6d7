//! The page of a run: what it holds, and in a browser what it draws, that it reports no error, that zooming shows the
//! samples themselves. `BRINELL_BROWSER` names a Chromium; without it those that are usual are tried. All tests that
//! open one are called `in_a_browser`, by which `.ci/run` leaves them out where there is none.
#![allow(clippy::unwrap_used)]

use super::run;
use crate::common;
use crate::common::program::done;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

const BROWSERS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];
pub(super) const FLAGS: [&str; 9] = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--hide-scrollbars",
];
/// Time of the page, not of the machine.
const OWN_TIME: &str = "--virtual-time-budget=20000";

/// A Chromium.
pub(super) fn browser() -> String {
    let named = env::var("BRINELL_BROWSER").ok();
    let usual = BROWSERS.iter().map(|name| (*name).to_owned());
    let answers = |name: &String| Command::new(name).arg("--version").output().is_ok_and(|said| said.status.success());
    let found = named.into_iter().chain(usual).find(answers);
    found.unwrap_or_else(|| panic!("no Chromium is installed, or none that answers; BRINELL_BROWSER can name one"))
}

/// What the browser says of a page.
fn opened(browser: &str, folder: &Path, page: &str, more: &[&str]) -> String {
    let profile = tempfile::tempdir_in(folder).unwrap();
    let mut command = Command::new(browser);
    command.args(FLAGS).arg(OWN_TIME).arg(format!("--user-data-dir={}", profile.path().display()));
    done(command.args(more).arg(format!("file://{page}"))).out
}

/// What the browser makes of a page with a script behind it.
fn measured(browser: &str, page: &Path, script: &str, more: &[&str]) -> String {
    let path = page.with_file_name("measured.html");
    fs::write(&path, fs::read_to_string(page).unwrap() + script).unwrap();
    opened(browser, page.parent().unwrap(), &path.display().to_string(), &[more, &["--dump-dom"]].concat())
}

/// What stands in the document between a tag and the next.
fn within<'a>(dom: &'a str, tag: &str) -> &'a str {
    dom.split(tag).nth(1).unwrap_or_else(|| panic!("no {tag}")).split('<').next().unwrap()
}

/// The number of points that the page drew.
fn points(dom: &str) -> usize {
    let body = dom.split("<body").nth(1).unwrap().split('>').next().unwrap().to_owned();
    assert!(body.contains("data-state=\"drawn\""), "{body}");
    assert_eq!(within(dom, "<div id=\"errors\">"), "", "the page's own errors");
    body.split("data-points=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
}

/// A page of a scene.
pub(super) fn page(name: &str, scene: &str, more: &[&str]) -> PathBuf {
    common::python();
    let folder = common::folder(name);
    run(scene, &folder, &[&["--html", "--no-figure", "--columns", "shaft.y"], more].concat());
    folder.join(scene).with_extension("html")
}

/// What a script says of the data in a page.
fn said_of(page: &Path, script: &str) -> String {
    let folder = page.parent().unwrap();
    common::run_text(common::python(), folder, &format!("{DATA}{script}"), [page]).trim().to_owned()
}

/// The same of the motion in a page, beside the run's table.
pub(super) fn beside_the_table(page: &Path, script: &str) -> String {
    said_of(page, &format!("{TABLE}{script}"))
}

const DATA: &str = r#"
import base64
import json
import sys
import numpy as np

text = open(sys.argv[1], encoding="utf-8").read()
data, _ = json.JSONDecoder().raw_decode(text[text.index("const DATA = ") + len("const DATA = "):])
"#;
const TABLE: &str = r#"
motion = data["motion"]
numbers = lambda packed: np.frombuffer(base64.b64decode(packed), "<f4").astype(float)
with open(sys.argv[1].replace(".html", ".csv"), encoding="utf-8") as file:
    names = [cell.rsplit(" [", 1)[0] for cell in file.readline().strip().split(",")]
    table = dict(zip(names, np.loadtxt(file, delimiter=",").T))
"#;

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
#[ignore = "opens a browser"]
fn the_page_in_a_browser_is_drawn_without_an_error_and_zooming_shows_every_sample() {
    let browser = browser();
    let path = page("page-drawn", "6205-spall-5deg", &["--stop", "0.3"]);
    let (folder, name) = (path.parent().unwrap(), path.display().to_string());
    // The sensor's 15 345 samples and nine others: at most 4000 of each are drawn, and all of a millisecond: 51 of the
    // recorder's and 10 of the others.
    let all = points(&opened(&browser, folder, &name, &["--dump-dom"]));
    let zoomed = points(&opened(&browser, folder, &format!("{name}#0.1,0.101"), &["--dump-dom"]));
    assert!(all > 20_000 && all < 30 * 4010, "{all} points");
    assert!(zoomed > 200 && zoomed < 2500, "{zoomed} points in a millisecond");
    let shot = folder.join("page.png");
    opened(&browser, folder, &name, &["--window-size=1250,2400", &format!("--screenshot={}", shot.display())]);
    let said = common::run_text(common::python(), folder, LOOK, [&shot]);
    assert!(said.contains("drawn"), "{said}");
}

#[test]
#[ignore = "opens a browser five times"]
fn a_time_range_asked_for_in_a_browser_is_cut_to_the_run_and_what_is_wrong_with_it_is_said() {
    let browser = browser();
    let path = page("page-asked", "6205-healthy", &["--stop", "0.1"]);
    let (folder, name) = (path.parent().unwrap(), path.display().to_string());
    let look = |asked: &str| {
        let dom = opened(&browser, folder, &format!("{name}{asked}"), &["--dump-dom"]);
        (points(&dom), within(&dom, "<p id=\"asked\">").to_owned())
    };
    let (all, said) = look("");
    assert!(all > 1000 && said.is_empty(), "{all} points, {said}");
    let (inside, said) = look("#0.02,0.04");
    assert!(inside < all / 2 && said.is_empty(), "{inside} points, {said}");
    let (late, said) = look("#0.09,0.7");
    assert!(late > 100 && late < inside, "{late} points");
    assert_eq!(
        said,
        "The address asks for 0.09 to 0.7 s, but the run goes from 0 to 0.1 s. Shown is what there is of it."
    );
    let (beyond, said) = look("#0.5,0.7");
    assert_eq!(beyond, all, "a range without samples shows all");
    assert_eq!(said, "The address asks for 0.5 to 0.7 s, but the run goes from 0 to 0.1 s. All of it is shown.");
    let (wrong, said) = look("#0.04,0.02");
    assert!(wrong == all && said.contains("two times in seconds"), "{said}");
}

#[test]
#[ignore = "opens a browser for each width"]
fn nothing_in_a_browser_lies_under_a_toolbar_in_a_narrow_window() {
    let browser = browser();
    let path = page("page-narrow", "6205-spall-5deg", &["--stop", "0.3"]);
    for width in [500, 700, 1400] {
        let dom = measured(&browser, &path, OVERLAP, &[&format!("--window-size={width},2700")]);
        assert!(points(&dom) > 20_000);
        assert_eq!(within(&dom, "<pre id=\"overlap\">"), "4 toolbars, 3 legends, under toolbars: ", "at {width} px");
    }
}

/// What of the plots the toolbars cover: legends, names of curves, curves. And what legends and names of axes cover.
const OVERLAP: &str = r#"<pre id="overlap"></pre><script>
Promise.all(drawn).then(() => {
  const all = (what) => [...document.querySelectorAll(what)];
  const meet = (a, b) => {
    const [p, q] = [a.getBoundingClientRect(), b.getBoundingClientRect()];
    return p.left < q.right && q.left < p.right && p.top < q.bottom && q.top < p.bottom;
  };
  const [bars, legends] = [all(".modebar-group"), all("g.legend")];
  const plots = ["g.legend", ".annotation", ".bglayer .bg"].flatMap(all);
  const under = plots.filter((one) => bars.some((bar) => meet(bar, one)));
  const covered = all(".xtitle, .xtick, .annotation").filter((one) => legends.some((legend) => meet(legend, one)));
  const count = new Set(bars.map((bar) => bar.parentNode)).size;
  const ticks = all(".xtitle").filter((one) => all(".xtick text").some((tick) => meet(tick, one)));
  const said = [...under, ...covered, ...ticks].map((one) => `${one.getAttribute("class")} ${one.textContent}`);
  const text = `${count} toolbars, ${legends.length} legends, under toolbars: ${said.join("; ")}`;
  document.getElementById("overlap").textContent = text;
});
</script>
"#;

#[test]
fn a_page_of_a_long_run_has_every_sample_of_the_sensor() {
    let path = page("page-long", "6205-healthy", &["--stop", "0.6", "--step", "2e-5"]);
    // 0.6 s at 51.2 kHz, except for the filter's half length at both ends.
    let count: usize = said_of(&path, LONG).parse().unwrap();
    assert!((30_600..30_720).contains(&count), "{count} samples");
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains("the page has the least and the greatest; sensor.acceleration has all"));
}

/// Samples of the sensor; all else has been made shorter.
const LONG: &str = r##"
counts = {s["name"]: len(base64.b64decode(s["values"])) // 4 for p in data["panels"] for s in p["signals"]}
sensor = counts.pop(data["motion"]["sensor"])
assert len(counts) > 10 and max(counts.values()) < 0.9 * sensor, (sensor, counts)
print(sensor)
"##;

#[test]
fn no_two_curves_of_a_panel_look_alike() {
    let path = page("page-colours", "nu205-healthy", &["--stop", "0.06"]);
    // The bearing has 13 rollers.
    assert_eq!(said_of(&path, COLOURS), "most curves 13");
}

/// Colours of one style are told apart where they are 60 of 255 or more from each other, and from the white behind.
const COLOURS: &str = r##"
most = 0
for panel in data["panels"]:
    looks = [(s["dash"], *bytes.fromhex(s["colour"][1:])) for s in panel["signals"]]
    most = max(most, len(looks))
    for i, (dash, *colour) in enumerate(looks):
        assert np.linalg.norm(np.array(colour) - 255) > 150, colour
        for other_dash, *other in looks[:i]:
            assert dash != other_dash or np.linalg.norm(np.array(colour, float) - other) >= 60, (colour, other)
print("most curves", most)
"##;

/// Curves in the colours of the signals, axes and letters: a blank page, or one of letters alone, has none.
const LOOK: &str = r##"
import sys
import numpy as np
from PIL import Image

image = np.asarray(Image.open(sys.argv[1]).convert("RGB")).astype(int)
assert image.shape[:2] == (2400, 1250), image.shape
# Each of the nine elements has a colour of its own. A line of one pixel is mixed with white; the number in its name
# alone has some 30 pixels.
for colour in "0072B2 E69F00 009E73 D55E00 CC79A7 56B4E9 882255 332288 8C8C1A".split():
    count = (np.abs(image - list(bytes.fromhex(colour))).sum(axis=2) < 60).sum()
    assert count > 100, (colour, count)
ink = (image.sum(axis=2) < 600).mean()
assert 0.01 < ink < 0.5, ink
# Every part of the page has something in it.
for part in np.array_split(image[:2200], 10):
    assert (part.sum(axis=2) < 600).mean() > 0.002
print("drawn", ink)
"##;

#[test]
#[ignore = "measures the machine; opens a browser"]
fn the_moving_bearing_in_a_browser_is_drawn_sixty_times_a_second() {
    let browser = browser();
    let path = page("page-sixty", "6205-epps", &["--stop", "0.1"]);
    let dom = measured(&browser, &path, COST, &[]);
    assert!(dom.contains("data-motion=\"drawn\""));
    points(&dom);
    let cost: f64 = within(&dom, "<pre id=\"cost\">").parse().unwrap();
    println!("{cost} ms");
    assert!(cost < 1000.0 / 60.0, "{cost} ms a picture");
}

#[test]
#[ignore = "opens a browser"]
fn the_envelope_of_a_band_that_is_taken_in_a_browser_has_the_programs_own_lines() {
    let browser = browser();
    let profile = common::folder("page-band-speed").join("up.csv");
    fs::write(&profile, RUN_UP).unwrap();
    let speed = format!("--speed-profile={}", profile.display());
    // Without equal angles the run-up's lines are 0.2 to 0.85 of the program's.
    for (name, asked, off) in [("page-band", ["--stop", "0.5"].as_slice(), 0.1), ("page-band-up", &[&speed], 0.15)] {
        let path = page(name, "er16k-tb1", asked);
        let dom = measured(&browser, &path, BAND, &[]);
        assert!(dom.contains("id=\"band-take\""), "{name}: no band to take");
        let lines = within(&dom, "<pre id=\"lines\">");
        let ratios: Vec<f64> = lines.split(' ').map(|ratio| ratio.parse().unwrap()).collect();
        // The band's ends are cut there and sloped in the program.
        assert!(ratios.len() == 5 && ratios.iter().all(|ratio| (ratio - 1.0).abs() < off), "{name}: {lines}");
    }
}

/// In 0.5 s, half of it with a speed that grows.
const RUN_UP: &str = "time_s,speed_hz\n0,15\n0.25,20\n0.5,20\n";

/// Of the band that the page begins with: heights of the first multiples of BPFO over those of the program.
const BAND: &str = r#"<pre id="lines"></pre><script>
Promise.all(drawn).then(() => {
  const spectrum = DATA.spectra.find((one) => one.band), of = [...spectrum.band, spectrum.turning];
  const mine = envelope(DATA.motion.signal, ...of);
  const there = { step: spectrum.step, y: numbers(spectrum.y) };
  const around = ({ step }, f) => [Math.floor((f - 5) / step), Math.ceil((f + 5) / step)];
  const highest = (of, f) => Math.max(...of.y.subarray(...around(of, f)));
  const at = spectrum.marks.find((mark) => mark.name === "BPFO").at.slice(0, 5);
  document.getElementById("lines").textContent = at.map((f) => highest(mine, f) / highest(there, f)).join(" ");
});
</script>
"#;

/// Milliseconds of a picture: the mean of five over the run, the least of 60 such, which a busy machine lets through.
const COST: &str = r#"<pre id="cost"></pre><script>
Promise.all(drawn).then(() => {
  const costs = Array.from({ length: 60 }, () => costOfPicture(5));
  document.getElementById("cost").textContent = Math.min(...costs).toFixed(2);
});
</script>
"#;
