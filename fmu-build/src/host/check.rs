//! Tries an FMU as an importer would: unzip, validate, load, initialize, step, save and restore.
//!
//! Works on any co-simulation FMU of FMI 2.0 or 3.0 that holds a binary for this platform.

use std::fs::{self, File};
use std::path::Path;

use anyhow::{Context, Result, anyhow, bail, ensure};
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;
use zip::ZipArchive;

use super::fmi2::{SavedState, Slave, SlaveError};
use super::fmi3::{Slave3, Stepped};
use crate::platforms::Platform;
use crate::shared::Version;
use crate::shared::{Project, Python};

/// Communication steps that are tried.
const STEPS: u32 = 100;

/// The command: one line for each thing that was tried; the first that fails ends it.
pub fn command(project: &Project, path: &Path) -> Result<()> {
    let about = || path.display().to_string();
    let folder = crate::shared::whole_file::folder_in(&std::env::temp_dir()).context("temporary folder")?;
    let entries = unzip(path, folder.path()).with_context(about)?;
    println!("archive: {entries} files, deflate or store, plain names");
    let text = fs::read_to_string(folder.path().join("modelDescription.xml"))
        .with_context(|| format!("{}: modelDescription.xml", about()))?;
    let description = Description::read(&text).with_context(|| format!("{}: modelDescription.xml", about()))?;
    println!(
        "model description: FMI {}, {}, {} real outputs, {} real inputs",
        description.version.number(),
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
    version: Version,
    /// GUID, or instantiation token.
    guid: String,
    identifier: String,
    state: bool,
    serialized_state: bool,
    tolerance: f64,
    step: f64,
    inputs: usize,
    outputs: Vec<Output>,
}

/// A real output.
#[derive(Debug)]
struct Output {
    reference: u32,
    name: String,
    /// Number of its values.
    count: usize,
}

/// A variable under way.
#[derive(Debug, Default)]
struct Started {
    reference: u32,
    name: String,
    causality: String,
}

impl Description {
    fn read(text: &str) -> Result<Self> {
        let mut description = Self { tolerance: 1e-5, step: 1e-3, ..Self::default() };
        let mut variable = Started::default();
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

    fn element(&mut self, element: &BytesStart<'_>, variable: &mut Started) -> Result<()> {
        match element.name().as_ref() {
            "fmiModelDescription" => {
                let version = attribute(element, "fmiVersion")?.unwrap_or_default();
                let identity = match version.as_str() {
                    "2.0" => "guid",
                    later if later == "3.0" || later.starts_with("3.0.") => {
                        self.version = Version::Fmi3;
                        "instantiationToken"
                    }
                    _ => bail!("fmiVersion is {version:?}: only 2.0 and 3.0 are tried here"),
                };
                self.guid = attribute(element, identity)?.with_context(|| format!("no {identity}"))?;
            }
            "CoSimulation" => {
                self.identifier = attribute(element, "modelIdentifier")?.context("no modelIdentifier")?;
                let spelling = |old: &'static str, new| if self.version == Version::Fmi2 { old } else { new };
                // A solver of fixed steps goes no shorter way; the experiment, which comes later, may say another.
                if let Some(step) = attribute(element, "fixedInternalStepSize")? {
                    self.step = step.parse()?;
                }
                self.state = flag(element, spelling("canGetAndSetFMUstate", "canGetAndSetFMUState"))?;
                self.serialized_state = flag(element, spelling("canSerializeFMUstate", "canSerializeFMUState"))?;
            }
            "DefaultExperiment" => {
                if let Some(tolerance) = attribute(element, "tolerance")? {
                    self.tolerance = tolerance.parse()?;
                }
                if let Some(step) = attribute(element, "stepSize")? {
                    self.step = step.parse()?;
                }
            }
            "ScalarVariable" => *variable = started(element)?,
            "Real" if self.version == Version::Fmi2 => self.real(variable),
            "Float64" if attribute(element, "valueReference")?.is_some() => {
                *variable = started(element)?;
                self.real(variable);
            }
            // Another type's dimensions belong to no output kept here.
            "Dimension" => {
                let size = attribute(element, "start")?.context("a dimension that is no plain number")?;
                if let Some(output) = self.outputs.last_mut().filter(|output| output.reference == variable.reference) {
                    output.count *= size.parse::<usize>()?;
                }
            }
            _ if attribute(element, "valueReference")?.is_some() => *variable = Started::default(),
            _ => {}
        }
        Ok(())
    }

    /// The name of the variable behind each value.
    fn names(&self) -> impl Iterator<Item = &str> {
        self.outputs.iter().flat_map(|output| std::iter::repeat_n(output.name.as_str(), output.count))
    }

    fn real(&mut self, Started { reference, name, causality }: &Started) {
        match causality.as_str() {
            "output" => self.outputs.push(Output { reference: *reference, name: name.clone(), count: 1 }),
            "input" => self.inputs += 1,
            _ => {}
        }
    }
}

fn started(element: &BytesStart<'_>) -> Result<Started> {
    let reference = attribute(element, "valueReference")?.context("a variable without valueReference")?;
    let name = attribute(element, "name")?.context("a variable without name")?;
    Ok(Started { reference: reference.parse()?, name, causality: attribute(element, "causality")?.unwrap_or_default() })
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
    let own = match description.version {
        Version::Fmi2 => host.name.to_owned(),
        Version::Fmi3 => host.fmi3_of_this_machine(),
    };
    let file = format!("binaries/{own}/{}.{}", description.identifier, host.extension);
    let path = folder.join(&file);
    ensure!(path.is_file(), "{file} is missing: nothing for this platform");
    let mut slave = Unit::new(description, &path, &folder.join("resources"))?;
    println!("library: {file} loads, has all functions, makes an instance");
    slave.initialize(description.tolerance)?;
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
            let bytes = slave.serialize(&state)?;
            let copy = slave.deserialize(&bytes)?;
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

/// An instance of either version.
enum Unit {
    Two(Slave),
    Three(Slave3),
}

/// What both can do.
macro_rules! either {
    ($unit:expr, $slave:ident => $call:expr) => {
        match $unit {
            Unit::Two($slave) => $call,
            Unit::Three($slave) => $call,
        }
    };
}

impl Unit {
    fn new(description: &Description, library: &Path, resources: &Path) -> Result<Self, SlaveError> {
        let identity = &description.guid;
        Ok(match description.version {
            Version::Fmi2 => Self::Two(Slave::new(library, "check", identity, resources)?),
            Version::Fmi3 => Self::Three(Slave3::new(library, "check", identity, resources)?),
        })
    }

    fn initialize(&mut self, tolerance: f64) -> Result<(), SlaveError> {
        match self {
            Self::Two(slave) => slave.initialize(Some(tolerance)),
            Self::Three(slave) => slave.initialize(tolerance),
        }
    }

    fn step(&mut self, from: f64, step: f64) -> Result<()> {
        match self {
            Self::Two(slave) => Ok(slave.step(from, step)?),
            Self::Three(slave) => {
                let Stepped { time, terminate } = slave.step(from, step)?;
                ensure!(!terminate, "fmi3DoStep at {from} s: the FMU wants the run to end at {time} s");
                // A solver of fixed steps may miss the end by some of them; an early return was not allowed.
                ensure!(
                    (time - from - step).abs() <= 0.5 * step,
                    "fmi3DoStep at {from} s by {step} s reached {time} s"
                );
                Ok(())
            }
        }
    }

    /// Values of all real outputs.
    fn reals(&mut self, description: &Description) -> Result<Vec<f64>, SlaveError> {
        let references: Vec<u32> = description.outputs.iter().map(|output| output.reference).collect();
        match self {
            Self::Two(slave) => slave.reals(&references),
            Self::Three(slave) => slave.reals(&references, description.names().count()),
        }
    }

    fn save(&mut self) -> Result<SavedState, SlaveError> {
        either!(self, slave => slave.save())
    }

    fn restore(&mut self, state: &SavedState) -> Result<(), SlaveError> {
        either!(self, slave => slave.restore(state))
    }

    fn free(&mut self, state: SavedState) -> Result<(), SlaveError> {
        either!(self, slave => slave.free(state))
    }

    fn serialize(&mut self, state: &SavedState) -> Result<Vec<u8>, SlaveError> {
        either!(self, slave => slave.to_bytes(state))
    }

    fn deserialize(&mut self, bytes: &[u8]) -> Result<SavedState, SlaveError> {
        either!(self, slave => slave.from_bytes(bytes))
    }

    fn terminate(&mut self) -> Result<(), SlaveError> {
        either!(self, slave => slave.terminate())
    }
}

/// Steps on from the state twice and compares every bit.
fn rewind(slave: &mut Unit, description: &Description, state: &SavedState) -> Result<()> {
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
            let names: Vec<&str> = description.names().collect();
            let (step, output) = (at / names.len(), at % names.len());
            Err(anyhow!("{} differs in step {step} after the state", names[output]))
        }
    }
}

fn read(slave: &mut Unit, description: &Description) -> Result<Vec<f64>> {
    let values = slave.reals(description)?;
    for (value, name) in values.iter().zip(description.names()) {
        if !value.is_finite() {
            bail!("output {name} is {value}");
        }
    }
    Ok(values)
}
