//! HDF5, as MATLAB's version 7.3 writes it: datasets of numbers by their path. Whatever has fewer than two numbers is
//! left out, and so is text, which MATLAB stores as numbers.

use hdf5_reader::group::Group;
use hdf5_reader::{Dataset, Datatype, Hdf5File, OpenOptions};

use super::array::{self, Columns, Kind, Number};

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

/// The file's channels.
pub(super) fn columns(bytes: &[u8]) -> Result<Columns, String> {
    let options = OpenOptions::default().with_max_read_bytes(LARGEST).with_max_chunk_bytes(LARGEST);
    let file = Hdf5File::from_vec_with_options(bytes.to_vec(), options).map_err(|why| why.to_string())?;
    let root = file.root_group().map_err(|why| why.to_string())?;
    let mut columns = (Vec::new(), Vec::new());
    add(&root, "", 0, &mut columns)?;
    Ok(columns)
}

fn add(group: &Group, path: &str, depth: usize, columns: &mut Columns) -> Result<(), String> {
    let (groups, datasets) = group.members().map_err(|why| why.to_string())?;
    let named = |name: &str| if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
    for dataset in datasets {
        let name = named(dataset.name());
        let channels = channels(&dataset).map_err(|why| format!("{name}: {why}"))?;
        columns.0.extend(array::names(&name, channels.len()));
        columns.1.extend(channels);
    }
    for group in groups.iter().filter(|group| group.name() != REFERENCES && depth < DEEPEST) {
        add(group, &named(group.name()), depth + 1, columns)?;
    }
    Ok(())
}

fn channels(dataset: &Dataset) -> Result<Vec<Vec<f64>>, String> {
    let (kind, size) = match dataset.dtype() {
        Datatype::FloatingPoint { size, .. } => (Kind::Float, *size),
        Datatype::FixedPoint { size, signed: true, .. } => (Kind::Signed, *size),
        Datatype::FixedPoint { size, .. } => (Kind::Unsigned, *size),
        _ => return Ok(Vec::new()),
    };
    let class = dataset.attribute("MATLAB_class").and_then(|class| class.read_string());
    let few = dataset.num_elements().map_err(|why| why.to_string())? < 2;
    if few || class.is_ok_and(|class| class == "char") {
        return Ok(Vec::new());
    }
    let number = Number::new(kind, usize::from(size), cfg!(target_endian = "big"), &format!("{:?}", dataset.dtype()))?;
    let bytes = dataset.read_native_bytes().map_err(|why| why.to_string())?;
    let shape: Vec<usize> = dataset.shape().iter().map(|&n| n as usize).collect();
    array::channels(&number.values(&bytes), &shape, false)
}
