//! Play and Sound on the page of a run, pressed as a user presses them: a Chromium does what it is told over two pipes,
//! in the devtools protocol. Its clock is the machine's, so that pictures are counted as they come.
#![cfg(unix)]
#![allow(clippy::unwrap_used)]

use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::Duration;

use serde_json::{Value, json};
use tempfile::TempDir;

use super::page::{FLAGS, browser, page};

/// A page in a browser of its own.
struct Tab {
    browser: Child,
    to: File,
    from: BufReader<File>,
    session: String,
    asked: u64,
    /// Its profile, and the two pipes.
    _folder: TempDir,
}

impl Tab {
    /// Opens a page and waits until all of it is drawn.
    fn open(browser: &str, page: &Path) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let pipes = ["to", "from"].map(|name| folder.path().join(name));
        assert!(Command::new("mkfifo").args(&pipes).status().unwrap().success());
        // Commands are read from descriptor 3, answers go to 4. One that hangs is ended, and the test with it.
        let browser = Command::new("timeout")
            .args(["120", "sh", "-c", "exec \"$@\" 3<to 4>from", "sh", browser])
            .args(FLAGS)
            .args(["--remote-debugging-pipe", "--mute-audio", "--window-size=1250,1000"])
            .arg(format!("--user-data-dir={}", folder.path().join("profile").display()))
            .current_dir(&folder)
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let to = File::options().write(true).open(&pipes[0]).unwrap();
        let from = BufReader::new(File::open(&pipes[1]).unwrap());
        let mut tab = Self { browser, to, from, session: String::new(), asked: 0, _folder: folder };
        let target = tab.ask("Target.createTarget", json!({ "url": format!("file://{}", page.display()) }));
        let attach = json!({ "targetId": target["targetId"], "flatten": true });
        tab.session = tab.ask("Target.attachToTarget", attach)["sessionId"].as_str().unwrap().to_owned();
        while tab.said("document.body ? document.body.dataset.state : null") != "drawn" {
            thread::sleep(Duration::from_millis(100));
        }
        assert_eq!(tab.said("document.getElementById('errors').textContent"), "", "the page's own errors");
        tab
    }

    /// What the browser answers to a command: JSON, and a zero byte behind it.
    fn ask(&mut self, method: &str, of: Value) -> Value {
        self.asked += 1;
        let mut command = json!({ "id": self.asked, "method": method, "params": of });
        if !self.session.is_empty() {
            command["sessionId"] = json!(self.session);
        }
        self.to.write_all(format!("{command}\0").as_bytes()).unwrap();
        loop {
            let mut answer = Vec::new();
            assert!(self.from.read_until(0, &mut answer).unwrap() > 0, "the browser ended before {method}");
            let mut answer: Value = serde_json::from_slice(answer.strip_suffix(b"\0").unwrap()).unwrap();
            // Others tell what happens.
            if answer["id"] == self.asked {
                assert!(answer.get("error").is_none(), "{method}: {answer}");
                return answer["result"].take();
            }
        }
    }

    /// What an expression is on the page, or will be.
    fn said(&mut self, expression: &str) -> Value {
        let of = json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let mut result = self.ask("Runtime.evaluate", of);
        assert!(result.get("exceptionDetails").is_none(), "{expression}: {result}");
        result["result"]["value"].take()
    }

    /// Presses the mouse on the middle of a button.
    fn press(&mut self, button: &str) {
        let place = format!("document.getElementById('{button}').getBoundingClientRect()");
        let x = self.said(&format!("{place}.left + {place}.width / 2"));
        let y = self.said(&format!("{place}.top + {place}.height / 2"));
        for kind in ["mousePressed", "mouseReleased"] {
            let of = json!({ "type": kind, "x": x, "y": y, "button": "left", "clickCount": 1 });
            self.ask("Input.dispatchMouseEvent", of);
        }
    }
}

impl Drop for Tab {
    fn drop(&mut self) {
        // A browser that does not end by itself is ended by `timeout`.
        let _ = self.to.write_all(b"{\"id\": 0, \"method\": \"Browser.close\"}\0");
        let _ = self.browser.wait();
    }
}

/// Counts pictures, and what is made to sound.
const WATCH: &str = "{
  window.pictures = 0;
  const { drawBearing } = Motion, { start } = AudioBufferSourceNode.prototype;
  Motion.drawBearing = (...of) => { pictures += 1; return drawBearing(...of); };
  window.sounds = [];
  window.AudioContext = class extends AudioContext {
    createBuffer(channels, length, rate) {
      const buffer = super.createBuffer(channels, length, rate);
      sounds.push({ channels, length, rate, buffer, context: this });
      return buffer;
    }
  };
  AudioBufferSourceNode.prototype.start = function (...of) {
    const sound = sounds.find((sound) => sound.buffer === this.buffer);
    Object.assign(sound, { started: true, faster: this.playbackRate.value });
    return start.apply(this, of);
  };
}";
/// Where slider, clock and picture are.
const STATE: &str = "({
  slider: Number(document.getElementById('motion-time').value), said: document.getElementById('motion-said').value,
  button: document.getElementById('motion-play').textContent,
  picture: document.getElementById('motion-bearing').toDataURL(),
})";
/// How many pictures are drawn in a second and a half, and how long that was (s).
const COUNT: &str = "new Promise((done) => {
  const [begin, before] = [performance.now(), pictures];
  setTimeout(() => done([pictures - before, (performance.now() - begin) / 1000]), 1500);
})";
/// What sounds by now, and its largest value.
const SOUND: &str = "new Promise((done) => setTimeout(done, 200)).then(() => sounds.map(
  ({ channels, length, rate, started, faster, buffer, context }) => ({
    channels, length, rate, started, faster, state: context.state,
    largest: buffer.getChannelData(0).reduce((most, v) => Math.max(most, Math.abs(v)), 0),
  })))";

#[test]
#[ignore = "opens a browser"]
fn play_in_a_browser_moves_the_bearing_and_pause_holds_it_and_sound_is_the_sensors_signal() {
    let mut tab = Tab::open(&browser(), &page("page-played", "6205-spall-5deg", &["--stop", "0.3"]));
    tab.said(WATCH);
    let before = tab.said(STATE);
    assert_eq!((&before["button"], tab.said(COUNT)[0].as_u64()), (&json!("Play"), Some(0)), "nobody has pressed it");
    tab.press("motion-play");
    let counted = tab.said(COUNT);
    let (pictures, seconds) = (counted[0].as_u64().unwrap(), counted[1].as_f64().unwrap());
    println!("{:.0} pictures a second: {pictures} in {seconds:.2} s", pictures as f64 / seconds);
    let after = tab.said(STATE);
    assert!(pictures > 1 && after["button"] == "Pause", "{pictures} pictures, {}", after["button"]);
    for what in ["slider", "said", "picture"] {
        assert_ne!(after[what], before[what], "{what} stays while it plays");
    }
    tab.press("motion-play");
    let held = tab.said(STATE);
    assert_eq!((&held["button"], tab.said(COUNT)[0].as_u64()), (&json!("Play"), Some(0)), "a pause");
    assert_eq!(tab.said(STATE), held, "a pause");

    tab.press("motion-sound");
    let sounds = tab.said(SOUND);
    let [sound] = &sounds.as_array().unwrap()[..] else { panic!("{sounds}") };
    // 0.3 s at 51.2 kHz, except for the recorder's filter's half length at both ends.
    let length = sound["length"].as_u64().unwrap();
    assert!((15_300..15_361).contains(&length), "{sound}");
    assert_eq!((&sound["channels"], &sound["rate"]), (&json!(1), &json!(51_200)), "{sound}");
    assert!(sound["started"] == true && sound["state"] == "running", "{sound}");
    // Single precision.
    assert!((sound["largest"].as_f64().unwrap() - 0.8).abs() < 1e-6, "{sound}");
    assert!((sound["faster"].as_f64().unwrap() - 1.0).abs() < 1e-6, "{sound}");
}

/// What stands beside the enlarged ball when the slider is at a twentieth and so on of the run.
const ENLARGED: &str = "(() => {
  const { fillText } = CanvasRenderingContext2D.prototype, slider = document.getElementById('motion-time');
  let said = [];
  CanvasRenderingContext2D.prototype.fillText = function (text, ...of) {
    if (this.canvas.id === 'motion-zoom' && String(text).includes('raceway')) said.push(text);
    return fillText.call(this, text, ...of);
  };
  for (let k = 1; k < 40; k++) {
    slider.value = String(k / 40);
    slider.dispatchEvent(new Event('input'));
  }
  return said;
})()";

#[test]
#[ignore = "opens a browser"]
fn where_no_ball_is_at_the_defect_the_page_in_a_browser_says_how_far_the_nearest_is() {
    let mut tab = Tab::open(&browser(), &page("page-enlarged", "6205-spall-5deg", &["--stop", "0.1"]));
    let said = tab.said(ENLARGED);
    let said: Vec<&str> = said.as_array().unwrap().iter().map(|text| text.as_str().unwrap()).collect();
    assert_eq!(said.len(), 39, "{said:?}");
    let (far, near): (Vec<&str>, Vec<&str>) = said.iter().partition(|text| text.starts_with("nearest element"));
    assert!(near.iter().all(|text| text.contains(" N, outer raceway")) && !near.is_empty(), "{near:?}");
    for side in [" mm before it, outer raceway", " mm past it, outer raceway"] {
        assert!(far.iter().any(|text| text.contains(side)), "{side}: {far:?}");
    }
    assert!(far.iter().all(|text| !text.contains(" N,")), "a force elsewhere is not one at the defect: {far:?}");
}

#[test]
#[ignore = "opens a browser"]
fn sound_in_a_browser_of_a_run_whose_sensor_stays_as_it_is_says_so() {
    let mut tab = Tab::open(&browser(), &page("page-silent", "6205-hosted", &["--stop", "0.02"]));
    tab.said(WATCH);
    let button = tab.said("document.getElementById('motion-sound').textContent");
    assert_eq!(button, "No sound: housing.ay stays as it is");
    tab.press("motion-sound");
    assert_eq!(tab.said(SOUND), json!([]));
}
