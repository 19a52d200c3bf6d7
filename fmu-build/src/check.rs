//! Tries an FMU as an importer would: unzip, validate, load, initialize, step, save and restore.
//!
//! Works on any FMI 2.0 co-simulation FMU that holds a binary for this platform.

use std::fs::{self, File};
use std::path::Path;

use anyhow::{Context, Result, anyhow, bail, ensure};
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;
use zip::ZipArchive;

use crate::platform::Platform;
use crate::project::Project;
use crate::python::Python;
use crate::slave::{SavedState, Slave};

/// Communication steps that are tried.
const STEPS: u32 = 100;

/// The command: one line for each thing that was tried; the first that fails ends it.
pub fn command(project: &Project, path: &Path) -> Result<()> {
    let about = || path.display().to_string();
    let folder = tempfile::tempdir().context("temporary folder")?;
    let entries = unzip(path, folder.path()).with_context(about)?;
    println!("archive: {entries} files, deflate or store, plain names");
    let text = fs::read_to_string(folder.path().join("modelDescription.xml"))
        .with_context(|| format!("{}: modelDescription.xml", about()))?;
    let description = Description::read(&text).with_context(|| format!("{}: modelDescription.xml", about()))?;
    println!(
        "model description: {}, {} real outputs, {} real inputs",
        description.identifier,
        description.outputs.len(),
        description.inputs
    );
    validate(project, path)?;
    step(folder.path(), &description).with_context(about)
}

/// What a host must know.
#[derive(Debug, Default)]
struct Description {
    guid: String,
    identifier: String,
    state: bool,
    serialized_state: bool,
    tolerance: f64,
    step: f64,
    inputs: usize,
    /// Value reference and name of each real output.
    outputs: Vec<(u32, String)>,
}

impl Description {
    fn read(text: &str) -> Result<Self> {
        let mut description = Self { tolerance: 1e-5, step: 1e-3, ..Self::default() };
        let mut variable = (0, String::new(), String::new());
        let mut reader = Reader::from_str(text);
        loop {
            match reader.read_event()? {
                Event::Eof => break,
                Event::Start(element) | Event::Empty(element) => description.element(&element, &mut variable)?,
                _ => {}
            }
        }
        ensure!(!description.identifier.is_empty(), "no CoSimulation element with a modelIdentifier");
        Ok(description)
    }

    fn element(&mut self, element: &BytesStart<'_>, variable: &mut (u32, String, String)) -> Result<()> {
        match element.name().as_ref() {
            "fmiModelDescription" => {
                let version = attribute(element, "fmiVersion")?.unwrap_or_default();
                ensure!(version == "2.0", "fmiVersion is {version:?}: only 2.0 is tried here");
                self.guid = attribute(element, "guid")?.context("no guid")?;
            }
            "CoSimulation" => {
                self.identifier = attribute(element, "modelIdentifier")?.context("no modelIdentifier")?;
                self.state = flag(element, "canGetAndSetFMUstate")?;
                self.serialized_state = flag(element, "canSerializeFMUstate")?;
            }
            "DefaultExperiment" => {
                if let Some(tolerance) = attribute(element, "tolerance")? {
                    self.tolerance = tolerance.parse()?;
                }
                if let Some(step) = attribute(element, "stepSize")? {
                    self.step = step.parse()?;
                }
            }
            "ScalarVariable" => {
                let reference = attribute(element, "valueReference")?.context("a variable without valueReference")?;
                let name = attribute(element, "name")?.context("a variable without name")?;
                *variable = (reference.parse()?, name, attribute(element, "causality")?.unwrap_or_default());
            }
            "Real" => match variable.2.as_str() {
                "output" => self.outputs.push((variable.0, variable.1.clone())),
                "input" => self.inputs += 1,
                _ => {}
            },
            _ => {}
        }
        Ok(())
    }
}

fn attribute(element: &BytesStart<'_>, name: &str) -> Result<Option<String>> {
    match element.try_get_attribute(name)? {
        Some(attribute) => Ok(Some(attribute.normalized_value(quick_xml::XmlVersion::Implicit1_0)?.into_owned())),
        None => Ok(None),
    }
}

fn flag(element: &BytesStart<'_>, name: &str) -> Result<bool> {
    Ok(matches!(attribute(element, name)?.as_deref(), Some("true" | "1")))
}

fn unzip(path: &Path, folder: &Path) -> Result<usize> {
    let mut archive = ZipArchive::new(File::open(path)?)?;
    for index in 0..archive.len() {
        let entry = archive.by_index(index)?;
        let name = String::from_utf8(entry.name_raw().to_vec()).context("an entry's name is not UTF-8")?;
        ensure!(!name.contains('\\'), "entry {name}: back-slash in the name");
        ensure!(entry.enclosed_name().is_some(), "entry {name}: leaves the folder");
        ensure!(!entry.is_symlink(), "entry {name}: is a link");
        let method = entry.compression();
        let plain = matches!(method, zip::CompressionMethod::Stored | zip::CompressionMethod::Deflated);
        ensure!(plain, "entry {name}: compressed by {method}, only store and deflate are allowed");
    }
    let entries = archive.len();
    archive.extract(folder)?;
    Ok(entries)
}

/// fmpy's validation, when its environment can be made.
fn validate(project: &Project, path: &Path) -> Result<()> {
    let python = match Python::prepare(project) {
        Ok(python) => python,
        Err(error) => {
            println!("fmpy validate_fmu: left out, {error:#}");
            return Ok(());
        }
    };
    python.run("validate.py", [path])?;
    println!("fmpy validate_fmu: nothing found");
    Ok(())
}

fn step(folder: &Path, description: &Description) -> Result<()> {
    let host = Platform::host()?;
    let file = format!("binaries/{}/{}.{}", host.name, description.identifier, host.extension);
    let path = folder.join(&file);
    ensure!(path.is_file(), "{file} is missing: nothing for this platform");
    let mut slave = Slave::new(&path, "check", &description.guid, &folder.join("resources"))?;
    println!("library: {file} loads, has all functions, makes an instance");
    slave.initialize(Some(description.tolerance))?;
    read(&mut slave, description).context("after initialization")?;

    let time = |count: u32| f64::from(count) * description.step;
    for count in 0..STEPS {
        slave.step(time(count), description.step)?;
        read(&mut slave, description).with_context(|| format!("at {} s", time(count + 1)))?;
    }
    println!("doStep: {STEPS} steps of {} s, every output finite", description.step);

    if description.state {
        let state = slave.save()?;
        rewind(&mut slave, description, &state).context("save and restore")?;
        println!("state: restored, {STEPS} steps again, equal bits");
        if description.serialized_state {
            let bytes = slave.to_bytes(&state)?;
            let copy = slave.from_bytes(&bytes)?;
            rewind(&mut slave, description, &copy).context("serialize and deserialize")?;
            slave.free(copy)?;
            println!("serialized state: {} bytes, {STEPS} steps again, equal bits", bytes.len());
        }
        slave.free(state)?;
    } else {
        println!("state: not declared, not tried");
    }
    slave.terminate()?;
    Ok(())
}

/// Steps on from the state twice and compares every bit.
fn rewind(slave: &mut Slave, description: &Description, state: &SavedState) -> Result<()> {
    let mut runs = Vec::new();
    for _ in 0..2 {
        slave.restore(state)?;
        let mut outputs = Vec::new();
        for count in STEPS..2 * STEPS {
            slave.step(f64::from(count) * description.step, description.step)?;
            outputs.extend(read(slave, description)?);
        }
        runs.push(outputs);
    }
    let differs = runs[0].iter().zip(&runs[1]).position(|(a, b)| a.to_bits() != b.to_bits());
    match differs {
        None => Ok(()),
        Some(at) => {
            let (step, output) = (at / description.outputs.len(), at % description.outputs.len());
            Err(anyhow!("{} differs in step {step} after the state", description.outputs[output].1))
        }
    }
}

fn read(slave: &mut Slave, description: &Description) -> Result<Vec<f64>> {
    let references: Vec<u32> = description.outputs.iter().map(|(reference, _)| *reference).collect();
    let values = slave.reals(&references)?;
    for (value, (_, name)) in values.iter().zip(&description.outputs) {
        if !value.is_finite() {
            bail!("output {name} is {value}");
        }
    }
    Ok(values)
}
