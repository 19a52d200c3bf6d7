//! Numbers as files store them: their bytes, and the shape of an array of them.

/// Names, empty where there are none, and columns.
pub(crate) type Columns = (Vec<String>, Vec<Vec<f64>>);

/// What a file holds.
#[derive(Debug, Clone, PartialEq, Default)]
pub(in crate::recording) struct Contents {
    /// Names of the columns; empty where there are none.
    pub(in crate::recording) names: Vec<String>,
    pub(in crate::recording) columns: Vec<Vec<f64>>,
    /// Single numbers by their names.
    pub(in crate::recording) numbers: Vec<(String, f64)>,
    /// Sampling rate (Hz), where the format has a place for it.
    pub(in crate::recording) rate: Option<f64>,
}

impl From<Columns> for Contents {
    fn from((names, columns): Columns) -> Self {
        Self { names, columns, ..Self::default() }
    }
}

impl Contents {
    /// Adds an array, or what is a number by itself.
    pub(super) fn add(&mut self, name: &str, channels: Vec<Vec<f64>>) {
        match &channels[..] {
            [one] if one.len() == 1 => self.numbers.push((name.to_owned(), one[0])),
            _ => {
                self.names.extend(names(name, channels.len()));
                self.columns.extend(channels);
            }
        }
    }

    /// Gives the columns from `first` on, which lie at `path`, the name that the file has for them beside them: a name
    /// and in brackets the path.
    pub(super) fn call(&mut self, first: usize, path: &str, name: &str) {
        let single = self.names.len() == first + 1;
        for own in self.names[first..].iter_mut().filter(|own| !own.ends_with(')')) {
            let part = own.strip_prefix(path).filter(|_| !single).unwrap_or_default();
            *own = format!("{name}{part} ({own})");
        }
    }
}

/// What arrays are made of, for messages.
const READ: &str = "floats of 4 or 8 bytes and integers of 1 to 8 are read";

/// How a number is stored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Number {
    kind: Kind,
    size: usize,
    big_endian: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Float,
    Signed,
    Unsigned,
}

impl Number {
    /// A number of `size` bytes; `what` names it in the message.
    ///
    /// # Errors
    /// A size that is not read.
    pub(super) fn new(kind: Kind, size: usize, big_endian: bool, what: &str) -> Result<Self, String> {
        let sizes: &[usize] = if kind == Kind::Float { &[4, 8] } else { &[1, 2, 4, 8] };
        if sizes.contains(&size) {
            Ok(Self { kind, size, big_endian })
        } else {
            Err(format!("element type {what}: {READ}"))
        }
    }

    /// NumPy's word for it: byte order, letter, bytes.
    ///
    /// # Errors
    /// Another type.
    pub(super) fn of_numpy(text: &str) -> Result<Self, String> {
        let refuse = || format!("element type {text}: {READ}");
        let (order, rest) = text.split_at_checked(1).ok_or_else(refuse)?;
        let (letter, size) = rest.split_at_checked(1).ok_or_else(refuse)?;
        let size = size.parse().map_err(|_| refuse())?;
        let kind = match letter {
            "f" => Kind::Float,
            "i" => Kind::Signed,
            "u" => Kind::Unsigned,
            _ => return Err(refuse()),
        };
        if !(matches!(order, "<" | ">") || (order == "|" && size == 1)) {
            return Err(refuse());
        }
        Self::new(kind, size, order == ">", text)
    }

    pub(super) fn size(self) -> usize {
        self.size
    }

    /// The numbers in bytes of them.
    pub(super) fn values(self, bytes: &[u8]) -> Vec<f64> {
        bytes.chunks_exact(self.size).map(|bytes| self.value(bytes)).collect()
    }

    /// The number in its bytes.
    pub(super) fn value(self, bytes: &[u8]) -> f64 {
        let mut little = [0; 8];
        for (i, to) in little.iter_mut().take(self.size).enumerate() {
            *to = bytes[if self.big_endian { self.size - 1 - i } else { i }];
        }
        let bits = u64::from_le_bytes(little);
        // The sign's bit is shifted to the top and back.
        let unused = 64 - 8 * self.size as u32;
        match (self.kind, self.size) {
            (Kind::Float, 4) => f64::from(f32::from_bits(bits as u32)),
            (Kind::Float, _) => f64::from_bits(bits),
            (Kind::Signed, _) => ((bits << unused) as i64 >> unused) as f64,
            (Kind::Unsigned, _) => bits as f64,
        }
    }
}

/// Channels of an array of one or two dimensions, the shorter of which counts them; `first_fastest` says which index
/// runs fastest.
///
/// # Errors
/// More dimensions, or another number of values.
pub(super) fn channels(values: &[f64], shape: &[usize], first_fastest: bool) -> Result<Vec<Vec<f64>>, String> {
    let (samples, count, samples_first) = match *shape {
        [samples] => (samples, 1, true),
        [samples, count] if count <= samples => (samples, count, true),
        [count, samples] => (samples, count, false),
        _ => return Err(format!("{} dimensions: 1 or 2 are read", shape.len())),
    };
    if samples.checked_mul(count) != Some(values.len()) {
        return Err(format!("{} numbers, the shape {shape:?} needs another number", values.len()));
    }
    if samples_first == first_fastest {
        return Ok(values.chunks(samples.max(1)).map(<[f64]>::to_vec).collect());
    }
    Ok(deinterleaved(values, count))
}

/// Channels of samples that take turns.
pub(super) fn deinterleaved(samples: &[f64], channels: usize) -> Vec<Vec<f64>> {
    (0..channels.max(1)).map(|k| samples.iter().skip(k).step_by(channels.max(1)).copied().collect()).collect()
}

/// Names of the columns of one variable.
pub(super) fn names(variable: &str, count: usize) -> Vec<String> {
    if count == 1 {
        return vec![variable.to_owned()];
    }
    (1..=count).map(|column| format!("{variable}[{column}]")).collect()
}
