//! HDF5, as MATLAB's version 7.3 writes it: datasets of numbers by their path, called by a text `Name` beside them.
//! MATLAB stores text as numbers; an attribute says that it is text.

use hdf5_reader::group::Group;
use hdf5_reader::{Dataset, Datatype, Hdf5File, OpenOptions};

use super::array::{self, Contents, Kind, Number};

/// Most bytes of a dataset.
const LARGEST: usize = 1 << 30;
/// Deepest nesting of groups: they may form a circle.
const DEEPEST: usize = 16;
/// Where MATLAB keeps what cells refer to.
const REFERENCES: &str = "#refs#";

/// Whether bytes are HDF5, behind MATLAB's header of 512 bytes.
pub(super) fn is(bytes: &[u8]) -> bool {
    bytes.get(512..520) == Some(b"\x89HDF\r\n\x1a\n")
}

/// What the file holds.
pub(super) fn contents(bytes: &[u8]) -> Result<Contents, String> {
    let options = OpenOptions::default().with_max_read_bytes(LARGEST).with_max_chunk_bytes(LARGEST);
    let file = Hdf5File::from_vec_with_options(bytes.to_vec(), options).map_err(|why| why.to_string())?;
    let root = file.root_group().map_err(|why| why.to_string())?;
    let mut contents = Contents::default();
    add(&root, "", 0, &mut contents)?;
    Ok(contents)
}

fn add(group: &Group, path: &str, depth: usize, contents: &mut Contents) -> Result<(), String> {
    let (groups, datasets) = group.members().map_err(|why| why.to_string())?;
    let named = |name: &str| if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
    let first = contents.names.len();
    let mut called = None;
    for dataset in datasets {
        let name = named(dataset.name());
        let channels = channels(&dataset).map_err(|why| format!("{name}: {why}"))?;
        match channels {
            Some(channels) => contents.add(&name, channels),
            None if dataset.name().eq_ignore_ascii_case("name") => called = text(&dataset),
            None => {}
        }
    }
    for group in groups.iter().filter(|group| group.name() != REFERENCES && depth < DEEPEST) {
        add(group, &named(group.name()), depth + 1, contents)?;
    }
    if let Some(name) = called {
        contents.call(first, path, &name);
    }
    Ok(())
}

/// Whether MATLAB means text.
fn is_text(dataset: &Dataset) -> bool {
    dataset.attribute("MATLAB_class").and_then(|class| class.read_string()).is_ok_and(|class| class == "char")
}

/// The text in characters of two bytes; none in anything else.
fn text(dataset: &Dataset) -> Option<String> {
    let bytes = dataset.read_native_bytes().ok().filter(|_| is_text(dataset))?;
    let units: Vec<u16> = bytes.chunks_exact(2).map(|two| u16::from_ne_bytes([two[0], two[1]])).collect();
    let text = String::from_utf16_lossy(&units).trim().to_owned();
    (!text.is_empty() && dataset.num_elements().is_ok_and(|count| count as usize == units.len())).then_some(text)
}

/// Numbers; none in text and other types, nor in nothing.
fn channels(dataset: &Dataset) -> Result<Option<Vec<Vec<f64>>>, String> {
    let (kind, size) = match dataset.dtype() {
        Datatype::FloatingPoint { size, .. } => (Kind::Float, *size),
        Datatype::FixedPoint { size, signed: true, .. } => (Kind::Signed, *size),
        Datatype::FixedPoint { size, .. } => (Kind::Unsigned, *size),
        _ => return Ok(None),
    };
    if dataset.num_elements().map_err(|why| why.to_string())? == 0 || is_text(dataset) {
        return Ok(None);
    }
    let number = Number::new(kind, usize::from(size), cfg!(target_endian = "big"), &format!("{:?}", dataset.dtype()))?;
    let bytes = dataset.read_native_bytes().map_err(|why| why.to_string())?;
    let shape: Vec<usize> = dataset.shape().iter().map(|&n| n as usize).collect();
    let shape = if shape.is_empty() { vec![1] } else { shape };
    array::channels(&number.values(&bytes), &shape, false).map(Some)
}
