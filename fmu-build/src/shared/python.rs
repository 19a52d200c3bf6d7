//! Python environments, made once from a pinned list in the cache: this program's own for figures, validation and
//! tests, and others for what needs more. A program that was installed into a Python environment which has the packages
//! takes that one, so that nothing is fetched twice.
//!
//! The scripts are part of this program and are laid beside the environment, so they can import one another.
//! A file lock keeps several processes from making it at once; the stamp that is written last tells whether it
//! is whole and of this program's list.

use std::env;
use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use anyhow::{Context, Result, bail};
use clap::Args;

use super::project::Project;
use super::talk::note;
use super::whole_file;

const REQUIREMENTS: &str = include_str!("../../python/requirements.txt");
const SCRIPTS: &[(&str, &str)] = &[
    ("check.py", include_str!("../../python/check.py")),
    ("contact.py", include_str!("../../python/contact.py")),
    ("demo.py", include_str!("../../python/paper/demo.py")),
    ("events.py", include_str!("../../python/paper/events.py")),
    ("figures.py", include_str!("../../module/brinell/figures.py")),
    ("host.py", include_str!("../../module/brinell/host.py")),
    ("paper.py", include_str!("../../python/paper/paper.py")),
    ("plotting.py", include_str!("../../python/plotting.py")),
    ("run_figure.py", include_str!("../../python/run_figure.py")),
    ("run_motion.js", include_str!("../../python/page/run_motion.js")),
    ("run_motion.py", include_str!("../../python/page/run_motion.py")),
    ("run_page.js", include_str!("../../python/page/run_page.js")),
    ("run_page.py", include_str!("../../python/page/run_page.py")),
    ("run_player.js", include_str!("../../python/page/run_player.js")),
    ("run_section.js", include_str!("../../python/page/run_section.js")),
    ("run_spectra.py", include_str!("../../python/page/run_spectra.py")),
    ("size.py", include_str!("../../python/size.py")),
    ("modes.py", include_str!("../../python/modes.py")),
    ("stiffness.py", include_str!("../../python/stiffness.py")),
];
const INTERPRETER: &str = if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" };
const OLDEST: (u32, u32) = (3, 9);
/// How files of a figure end.
const FIGURES: &[&str] = &[".svg", ".png"];

/// A Python environment that is ready.
#[derive(Debug, Clone)]
pub struct Python {
    interpreter: PathBuf,
    scripts: PathBuf,
    variables: Vec<(&'static str, OsString)>,
}

impl Python {
    /// The environment that this program lies in, if it has what is needed; else makes this program's own, unless it
    /// is there.
    pub fn prepare(project: &Project) -> Result<Self> {
        Self::prepare_with(project, "fmpy, matplotlib, numpy")
    }

    /// The same with what pages are made of.
    pub fn prepare_for_pages(project: &Project) -> Result<Self> {
        Self::prepare_with(project, "fmpy, matplotlib, numpy, plotly")
    }

    fn prepare_with(project: &Project, modules: &str) -> Result<Self> {
        if let Some(interpreter) = around_this_program(modules) {
            let python = Self { interpreter, scripts: project.cache().join("scripts"), variables: Vec::new() };
            python.lay_scripts()?;
            return Ok(python);
        }
        Self::prepare_from(project, "python", REQUIREMENTS)
    }

    /// The interpreter.
    pub fn interpreter(&self) -> &Path {
        &self.interpreter
    }

    /// Makes an environment of the packages in `requirements` under `<name>` in the cache, unless it is there.
    pub fn prepare_from(project: &Project, name: &str, requirements: &str) -> Result<Self> {
        let folder = project.cache().join(name);
        fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
        let lock = File::create(folder.join("lock")).context("lock of the Python environment")?;
        lock.lock().context("lock of the Python environment")?;

        let environment = folder.join("env");
        let python =
            Self { interpreter: environment.join(INTERPRETER), scripts: folder.join("scripts"), variables: Vec::new() };
        let stamp = folder.join("stamp");
        let whole = fs::read_to_string(&stamp).is_ok_and(|made_from| made_from == requirements);
        if !(whole && python.interpreter.is_file()) {
            let system = find_interpreter()?;
            note!("making the Python environment {} (once)", environment.display());
            remove(&stamp, |path| fs::remove_file(path))?;
            remove(&environment, |path| fs::remove_dir_all(path))?;
            remove(&python.bytecode(), |path| fs::remove_dir_all(path))?;
            make(&system, &environment, &python.interpreter, &folder, requirements)?;
            whole_file::write(&stamp, requirements)?;
        }
        python.lay_scripts()?;
        Ok(python)
    }

    /// What is compiled of all that is imported: beside an environment of this program's own, else in its cache.
    pub fn bytecode(&self) -> PathBuf {
        self.scripts.with_file_name("bytecode")
    }

    fn lay_scripts(&self) -> Result<()> {
        fs::create_dir_all(&self.scripts).with_context(|| self.scripts.display().to_string())?;
        SCRIPTS.iter().try_for_each(|&(name, text)| whole_file::write_if_new(&self.scripts.join(name), text).map(drop))
    }

    /// Sets an environment variable for all scripts that run from now on.
    pub fn with_variable(mut self, name: &'static str, value: impl Into<OsString>) -> Self {
        self.variables.push((name, value.into()));
        self
    }

    /// Draws `<stem>.svg` and `.png` behind an answer that is out already, by one of this program's scripts, and gives
    /// its lines: without Python there is no figure, but no failure either.
    ///
    /// # Errors
    /// Of the script.
    pub fn draw<A: AsRef<OsStr>>(
        project: &Project,
        script: &str,
        arguments: impl IntoIterator<Item = A>,
        stems: &[PathBuf],
    ) -> Result<String> {
        match Self::prepare(project) {
            Ok(python) => python.run(script, arguments),
            Err(why) => {
                note!("note: no figure: {why:#}; --no-figure goes without");
                stems.iter().for_each(|stem| whole_file::tell_earlier(&whole_file::earlier(stem, FIGURES)));
                Ok(String::new())
            }
        }
    }

    /// Runs one of this program's scripts and gives its standard output.
    pub fn run<A: AsRef<OsStr>>(&self, script: &str, arguments: impl IntoIterator<Item = A>) -> Result<String> {
        self.run_file(&self.scripts.join(script), arguments)
    }

    /// Runs a script file, which can import this program's scripts, and gives its standard output.
    pub fn run_file<A: AsRef<OsStr>>(&self, script: &Path, arguments: impl IntoIterator<Item = A>) -> Result<String> {
        let about = || self.interpreter.display().to_string();
        let output = self.command(script).args(arguments).output().with_context(about)?;
        if !output.status.success() {
            bail!("{}: {}", script.display(), last_lines(&output));
        }
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    }

    /// Runs one of this program's scripts, whose lines are shown as they come; the end of what it says of a failure is
    /// the error.
    pub fn show<A: AsRef<OsStr>>(&self, script: &str, arguments: impl IntoIterator<Item = A>) -> Result<()> {
        let about = || self.interpreter.display().to_string();
        let mut command = self.command(&self.scripts.join(script));
        let child = command.args(arguments).stdout(Stdio::inherit()).stderr(Stdio::piped()).spawn();
        let output = child.and_then(Child::wait_with_output).with_context(about)?;
        match last_lines(&output) {
            _ if output.status.success() => Ok(()),
            silent if silent.is_empty() => bail!("{script} ended without a word: {}", output.status),
            why => bail!(why),
        }
    }

    fn command(&self, script: &Path) -> Command {
        let mut command = Command::new(&self.interpreter);
        // What a script imports is compiled once for all that follow, and beside nobody's sources.
        command
            .env("PYTHONPATH", &self.scripts)
            .env("PYTHONPYCACHEPREFIX", self.bytecode())
            .env_remove("PYTHONDONTWRITEBYTECODE")
            .env("MPLBACKEND", "Agg")
            .envs(self.variables.iter().map(|(name, value)| (name, value)))
            .arg(script);
        command
    }
}

/// Where results go, and whether they are drawn.
#[derive(Debug, Args)]
pub(crate) struct Drawn {
    /// Folder for what is written [default: the current one]
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// Leave figures out; no Python is needed then
    #[arg(long)]
    pub(crate) no_figure: bool,
}

impl Drawn {
    /// Draws `<stem>.svg` and `.png` by a script, unless figures are left out, and gives its lines.
    ///
    /// # Errors
    /// Of the script.
    pub(crate) fn figure<A: AsRef<OsStr>>(
        &self,
        project: &Project,
        script: &str,
        arguments: impl IntoIterator<Item = A>,
        stems: &[PathBuf],
    ) -> Result<String> {
        if self.no_figure {
            stems.iter().for_each(|stem| whole_file::tell_earlier(&whole_file::earlier(stem, FIGURES)));
            return Ok(String::new());
        }
        Python::draw(project, script, arguments, stems)
    }

    /// The folder; `results` is the one of the command.
    pub(crate) fn folder(&self, project: &Project, results: &str) -> PathBuf {
        self.output.clone().unwrap_or_else(|| project.results(results))
    }
}

/// The interpreter beside this program, where it has these modules. A Windows' Python that is not a virtual
/// environment has its programs in the folder `Scripts` beside the interpreter.
fn around_this_program(modules: &str) -> Option<PathBuf> {
    let program = env::current_exe().ok()?;
    let beside = program.with_file_name(if cfg!(windows) { "python.exe" } else { "python" });
    let above = program.parent()?.with_file_name("python.exe");
    let candidates = if cfg!(windows) { vec![beside, above] } else { vec![beside] };
    candidates.into_iter().find(|interpreter| {
        let tried = || Command::new(interpreter).args(["-c", &format!("import {modules}")]).output();
        interpreter.is_file() && tried().is_ok_and(|output| output.status.success())
    })
}

/// The first interpreter that is new enough.
fn find_interpreter() -> Result<PathBuf> {
    let (major, minor) = OLDEST;
    let chosen = env::var_os("BRINELL_PYTHON").map(PathBuf::from);
    let candidates = chosen.map_or_else(|| vec!["python3".into(), "python".into()], |path| vec![path]);
    let mut refused = Vec::new();
    for candidate in candidates {
        match version(&candidate) {
            Some(version) if version >= OLDEST => return Ok(candidate),
            Some((major, minor)) => refused.push(format!("{} is {major}.{minor}", candidate.display())),
            None => refused.push(format!("{} is not there", candidate.display())),
        }
    }
    bail!(
        "Python {major}.{minor} or newer is needed ({}). Install it, or name one in BRINELL_PYTHON",
        refused.join(", ")
    );
}

fn version(interpreter: &Path) -> Option<(u32, u32)> {
    let script = "import sys; print(sys.version_info[0], sys.version_info[1])";
    let output = Command::new(interpreter).args(["-c", script]).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let (major, minor) = text.trim().split_once(' ')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}

fn make(system: &Path, environment: &Path, interpreter: &Path, folder: &Path, requirements: &str) -> Result<()> {
    let output = Command::new(system).args(["-m", "venv", "--without-pip"]).arg(environment).output()?;
    if !output.status.success() {
        bail!("{} cannot make a virtual environment. It said: {}", system.display(), last_lines(&output));
    }
    let list = folder.join("requirements.txt");
    whole_file::write(&list, requirements)?;
    let pip = pip_for(system, interpreter)?;
    // uv unpacks the same wheels in a tenth of pip's time; where it cannot be had or fails, pip itself says why.
    if install(&pip, &["uv".as_ref()])?.status.success() && uv(interpreter, &list)?.status.success() {
        return Ok(());
    }
    let output = install(&pip, &["-r".as_ref(), list.as_os_str()])?;
    if !output.status.success() {
        bail!(
            "pip could not install the Python packages; is the package index reachable? It said: {}",
            last_lines(&output)
        );
    }
    Ok(())
}

/// The command of a pip for an environment: the system's, if it can serve another interpreter (22.3 of 2022 and newer
/// can); it saves the environment's own, which takes longer to set up than all else.
fn pip_for(system: &Path, interpreter: &Path) -> Result<Vec<OsString>> {
    let systems = [system.as_os_str(), "-m".as_ref(), "pip".as_ref(), "--python".as_ref(), interpreter.as_os_str()];
    if Command::new(system).args(&systems[1..]).arg("--version").output()?.status.success() {
        return Ok(systems.map(OsStr::to_owned).to_vec());
    }
    let output = Command::new(interpreter).args(["-m", "ensurepip"]).output()?;
    if !output.status.success() {
        bail!(
            "{} has no pip for a virtual environment; on Debian or Ubuntu: apt-get install python3-venv. It said: {}",
            system.display(),
            last_lines(&output)
        );
    }
    Ok([interpreter.as_os_str(), "-m".as_ref(), "pip".as_ref()].map(OsStr::to_owned).to_vec())
}

fn install(pip: &[OsString], what: &[&OsStr]) -> Result<Output> {
    let options = ["install", "--quiet", "--disable-pip-version-check", "--only-binary", ":all:"];
    Ok(Command::new(&pip[0]).args(&pip[1..]).args(options).args(what).output()?)
}

fn uv(interpreter: &Path, list: &Path) -> Result<Output> {
    let install = ["-m", "uv", "pip", "install", "--quiet", "--only-binary", ":all:", "--python"];
    // The system's certificates, as pip takes them.
    let mut command = Command::new(interpreter);
    command.args(install).arg(interpreter).arg("-r").arg(list).env("UV_NATIVE_TLS", "1");
    Ok(command.output()?)
}

/// The end of what a program printed, on one line: an FMU logs to the one stream, Python raises on the other.
fn last_lines(output: &Output) -> String {
    let last = |stream: &[u8], count: usize| {
        let text = String::from_utf8_lossy(stream);
        let lines: Vec<_> = text.lines().map(str::trim).filter(|line| !line.is_empty()).map(str::to_owned).collect();
        lines[lines.len().saturating_sub(count)..].to_vec()
    };
    [last(&output.stdout, 2), last(&output.stderr, 5)].concat().join(" | ")
}

fn remove(path: &Path, how: impl FnOnce(&Path) -> std::io::Result<()>) -> Result<()> {
    if path.exists() { how(path).with_context(|| path.display().to_string()) } else { Ok(()) }
}
