//! Does what a job file says with the library of an FMU, and prints a checksum of each output.
//!
//! A job is lines of a word and what belongs to it: `library`, `uri`, `guid`, `times` (how often the library is loaded,
//! run and unloaded), `step` (s), `outputs` and `inputs` (value references), and for each step one `row` of input
//! values, as the hexadecimal bits of floating-point numbers. The first row is also set before initialization.

use std::error::Error;
use std::fs;
use std::path::Path;

use host::Instance;

/// What is to be done.
#[derive(Default)]
struct Job {
    library: String,
    uri: String,
    guid: String,
    times: usize,
    step: f64,
    outputs: Vec<u32>,
    inputs: Vec<u32>,
    rows: Vec<Vec<f64>>,
}

impl Job {
    fn read(text: &str) -> Result<Self, Box<dyn Error>> {
        let mut job = Self { times: 1, ..Self::default() };
        let bits = |word: &str| u64::from_str_radix(word, 16).map(f64::from_bits);
        let references = |words: &str| words.split_whitespace().map(str::parse).collect::<Result<Vec<u32>, _>>();
        for line in text.lines() {
            let (what, rest) = line.split_once(' ').unwrap_or((line, ""));
            match what {
                "library" => job.library = rest.to_owned(),
                "uri" => job.uri = rest.to_owned(),
                "guid" => job.guid = rest.to_owned(),
                "times" => job.times = rest.parse()?,
                "step" => job.step = rest.parse()?,
                "outputs" => job.outputs = references(rest)?,
                "inputs" => job.inputs = references(rest)?,
                "row" => job.rows.push(rest.split_whitespace().map(bits).collect::<Result<_, _>>()?),
                other => return Err(format!("a job knows no {other:?}").into()),
            }
        }
        Ok(job)
    }

    /// Runs once and gives the outputs at every communication point.
    fn run(&self) -> Result<Vec<Vec<f64>>, Box<dyn Error>> {
        let mut instance = Instance::with_uri(Path::new(&self.library), "host", &self.guid, &self.uri)?;
        if let Some(row) = self.rows.first().filter(|row| !row.is_empty()) {
            instance.set_reals(&self.inputs, row)?;
        }
        if cfg!(windows) && fs::remove_file(&self.library).is_ok() {
            return Err("a library that is loaded could be removed: nothing is seen of whether it is unloaded".into());
        }
        instance.initialize(None)?;
        let mut points = vec![instance.reals(&self.outputs)?];
        for (index, row) in self.rows.iter().enumerate() {
            if !row.is_empty() {
                instance.set_reals(&self.inputs, row)?;
            }
            instance.step(index as f64 * self.step, self.step)?;
            points.push(instance.reals(&self.outputs)?);
        }
        instance.terminate()?;
        Ok(points)
    }
}

/// FNV-1a with 64 bits, of numbers from the lowest byte on. Written here again: the host shares no code with what it
/// drives.
fn checksum(numbers: impl Iterator<Item = f64>) -> u64 {
    let bytes = numbers.flat_map(|number| number.to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |sum: u64, byte| (sum ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

/// Takes the file away, which Windows refuses as long as the library is loaded, and puts it back.
fn unloaded(library: &Path) -> Result<(), Box<dyn Error>> {
    let aside = library.with_extension("aside");
    fs::copy(library, &aside)?;
    fs::remove_file(library).map_err(|error| format!("still loaded: {error}"))?;
    fs::rename(&aside, library)?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("which job?")?;
    let job = Job::read(&fs::read_to_string(file)?)?;
    let mut first: Option<Vec<u64>> = None;
    for _ in 0..job.times {
        let points = job.run()?;
        let sums = (0..job.outputs.len()).map(|output| checksum(points.iter().map(|row| row[output]))).collect();
        if first.get_or_insert_with(|| Vec::clone(&sums)) != &sums {
            return Err("another run gave other bits".into());
        }
        unloaded(Path::new(&job.library))?;
    }
    for sum in first.unwrap_or_default() {
        println!("{sum:016x}");
    }
    Ok(())
}
