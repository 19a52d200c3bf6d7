//! The libraries of other machines, on this one: Windows' under Wine, Linux's for ARM under QEMU. Each is driven
//! through the golden runs by a small host of its kind, and every output must have the bits in `tests/golden`.
//!
//! `.ci/platforms` installs what these tests need and runs them.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used)]

mod common;
#[path = "common/machines.rs"]
mod machines;
#[path = "../../tests/golden/runs.rs"]
mod runs;

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use brinell::scene::Motion;
use brinell::simulation::interface::table::{Causality, Kind, Variable};
use fmu_build::package::{Choice, Library, Model};
use fmu_build::platforms::Platform;
use fmu_build::shared::Project;
use runs::{AS_SHIPPED, BY_PATH, STEP, STEPS, ring_motion, scene_of};

/// A kind of machine, on which a library and a host run.
struct Machine {
    folder: PathBuf,
    host: PathBuf,
    library: PathBuf,
    kind: As,
}

/// What stands for the machine.
#[derive(Clone, Copy, PartialEq)]
enum As {
    Own,
    Wine,
    Qemu,
}

impl Machine {
    fn new(platform: &str, kind: As) -> Self {
        let platform = Platform::named(platform).unwrap();
        let folder = common::folder(&format!("machine-{}", platform.name));
        let choice = Choice { file: None, platforms: vec![platform.name.to_owned()] };
        let library = folder.join(platform.file());
        fs::write(&library, &Library::obtain(&Project::find(), &choice).unwrap().binaries()[0].bytes).unwrap();
        let host = folder.join(if kind == As::Wine { "host.exe" } else { "host" });
        let built = machines::compiled(platform.targets[0], &["--bin", "host"]);
        fs::copy(built.join(host.file_name().unwrap()), &host).unwrap();
        if kind == As::Wine {
            machines::bring_what_wine_lacks(&folder);
        }
        Self { folder, host, library, kind }
    }

    /// A path of this machine as that one names it: Wine shows the whole file system as drive Z.
    fn path(&self, path: &Path) -> String {
        if self.kind == As::Wine { machines::on_windows(path) } else { path.to_str().unwrap().to_owned() }
    }

    /// Lets the host do a job and gives the lines that it prints.
    fn run(&self, job: &str) -> Result<Vec<String>, String> {
        let file = self.folder.join("job.txt");
        fs::write(&file, job).unwrap();
        let mut command = match self.kind {
            As::Own => Command::new(&self.host),
            As::Wine => machines::wine(&self.host),
            As::Qemu => machines::qemu(&self.host),
        };
        let output = command.arg(self.path(&file)).output().unwrap_or_else(|e| panic!("{command:?}: {e}"));
        let text = String::from_utf8_lossy(&output.stdout).replace('\r', "");
        if output.status.success() {
            return Ok(text.lines().map(str::to_owned).collect());
        }
        Err(format!("{}{text}", String::from_utf8_lossy(&output.stderr)))
    }

    /// Every golden run; the first line of each that differs.
    fn golden_runs(&self) {
        let mut differ = Vec::new();
        for name in common::names().into_iter().chain(BY_PATH.map(|name| name.to_owned() + AS_SHIPPED)) {
            let case = Case::golden(&name);
            let folder = self.folder.join(&name);
            common::lay(&case.model, &folder);
            let job = format!("library {}\nuri {}\n{}", self.path(&self.library), uri(&self.path(&folder)), case.job);
            let found = self.run(&job).unwrap_or_else(|why| panic!("{name}: {why}"));
            assert_eq!(found.len(), case.wanted.len(), "{name}");
            for ((output, wanted), found) in case.wanted.iter().zip(&found) {
                if wanted != found {
                    differ.push(format!("{name}: {output}"));
                }
            }
        }
        assert!(differ.is_empty(), "other bits than linux64's in {differ:#?}");
    }
}

/// A scene with what a golden run asks of it.
struct Case {
    model: Model,
    /// All lines of a job but the library and the location.
    job: String,
    /// Outputs by name, with the checksum in the golden file.
    wanted: Vec<(String, String)>,
}

impl Case {
    fn golden(name: &str) -> Self {
        let file = common::root().join("tests/golden").join(format!("{name}.csv"));
        let text = fs::read_to_string(&file).unwrap();
        let mut lines = text.lines().filter(|line| !line.starts_with('#')).map(|line| line.split(','));
        let wanted: Vec<_> =
            lines.next().unwrap().map(str::to_owned).zip(lines.next().unwrap().map(str::to_owned)).collect();
        let model = golden_model(name);
        let table = model.simulation.table();
        let reference = |name: &str| table.iter().find(|v| v.name == name).map(|v| v.reference).unwrap();
        let outputs: Vec<_> = wanted.iter().map(|(name, _)| reference(name).to_string()).collect();
        assert!(outputs.len() >= table.iter().filter(|v| is_real_output(v)).count() / 2, "{name}: few are compared");
        let rings = [("shaft", &model.scene.shaft), ("housing", &model.scene.housing)];
        let hosted: Vec<_> = rings.into_iter().filter(|(_, ring)| ring.motion == Motion::Host).collect();
        let of_rings =
            |t: f64| hosted.iter().flat_map(move |(ring, _)| ring_motion(ring, t).map(|(p, v)| (*ring, p, v)));
        let mut job = format!("guid {}\nstep {STEP}\noutputs {}\ninputs", model.guid(), outputs.join(" "));
        for (ring, part, _) in of_rings(0.0) {
            write!(job, " {}", reference(&format!("{ring}.{part}"))).unwrap();
        }
        for step in 0..STEPS {
            job += "\nrow";
            for (_, _, value) in of_rings(step as f64 * STEP) {
                write!(job, " {:x}", value.to_bits()).unwrap();
            }
        }
        Self { model, job, wanted }
    }
}

fn is_real_output(variable: &Variable) -> bool {
    variable.causality == Causality::Output && matches!(variable.kind, Kind::Real { .. })
}

/// The shipped scene, under law `hertz` where that golden run is.
fn golden_model(name: &str) -> Model {
    if !BY_PATH.contains(&name) {
        return common::model(scene_of(name));
    }
    let text = common::scene_text(name);
    assert_eq!(text.matches("law = \"map\"").count(), 1, "{name}");
    let file = common::folder("by-path").join(format!("{name}.toml"));
    fs::write(&file, text.replace("law = \"map\"", "law = \"hertz\"")).unwrap();
    Model::read(&file).unwrap()
}

/// A path as a URI with everything escaped that may be.
fn uri(path: &str) -> String {
    let path = path.replace('\\', "/");
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"/:-._~".contains(&byte);
    let escaped: String =
        path.bytes().map(|b| if plain(b) { char::from(b).to_string() } else { format!("%{b:02X}") }).collect();
    if path.starts_with('/') { format!("file://{escaped}") } else { format!("file:///{escaped}") }
}

/// Apart, so that the nightly run can leave them to `.ci/platforms`.
mod all_platforms {
    use super::*;

    #[test]
    #[ignore = "compiles the library for this machine"]
    fn linux64_gives_the_golden_bits() {
        Machine::new("linux64", As::Own).golden_runs();
    }

    #[test]
    #[ignore = "compiles the library for Windows and needs Wine"]
    fn win64_gives_the_golden_bits_under_wine() {
        Machine::new("win64", As::Wine).golden_runs();
    }

    #[test]
    #[ignore = "compiles the library for ARM and needs QEMU"]
    fn aarch64_linux_gives_the_golden_bits_under_qemu() {
        Machine::new("aarch64-linux", As::Qemu).golden_runs();
    }

    #[test]
    #[ignore = "compiles the library for Windows and needs Wine"]
    fn on_windows_a_scene_is_found_behind_every_uri_in_odd_and_long_folders_and_the_library_unloads() {
        let mut machine = Machine::new("win64", As::Wine);
        let case = Case::golden("6205-epps");
        let odd = machine.folder.join("Wälzlager & Käfig 50 % + mehr");
        // Beyond the 260 characters that Windows took before its version 10.
        let long = (0..6)
            .fold(machine.folder.clone(), |folder, _| folder.join("a folder with fifty characters in its name, äöü"));
        fs::create_dir_all(&odd).unwrap();
        fs::rename(&machine.library, odd.join("Wälzlager.dll")).unwrap();
        machine.library = odd.join("Wälzlager.dll");
        for folder in [&odd, &long] {
            common::lay(&case.model, folder);
            let windows = machine.path(folder);
            let slashes = windows.replace('\\', "/");
            let escaped = uri(&windows);
            let after = escaped.strip_prefix("file:///").unwrap().to_owned();
            let forms = [
                escaped.clone(),
                format!("file:/{after}"),
                format!("file://{after}"),
                format!("file://localhost/{after}"),
                format!("FILE:///{after}"),
                format!("file:///{}", slashes.replace('%', "%25")),
                format!("{escaped}/"),
                windows,
            ];
            for form in forms {
                let job = format!("library {}\nuri {form}\ntimes 3\n{}", machine.path(&machine.library), case.job);
                let found = machine.run(&job).unwrap_or_else(|why| panic!("{form}: {why}"));
                let wanted: Vec<_> = case.wanted.iter().map(|(_, sum)| sum.clone()).collect();
                assert!(found == wanted, "{form}: other bits");
            }
        }
        assert!(machine.path(&long).len() > 300);
        let job = format!("library {}\nuri file:///Z:/nowhere\n{}", machine.path(&machine.library), case.job);
        let said = machine.run(&job).unwrap_err();
        assert!(said.contains("Z:/nowhere\\\\scene.toml") || said.contains("Z:/nowhere\\scene.toml"), "{said}");
    }
}
