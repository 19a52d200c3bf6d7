//! Files of MATLAB, version 5, element by element: <https://www.mathworks.com/help/pdf_doc/matlab/matfile_format.pdf>.

/// An element: type and data, filled up to 8 bytes.
fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let fill = vec![0; data.len().next_multiple_of(8) - data.len()];
    [&kind.to_le_bytes(), &(data.len() as u32).to_le_bytes(), data, &fill].concat()
}

fn words(numbers: &[u32]) -> Vec<u8> {
    numbers.iter().flat_map(|n| n.to_le_bytes()).collect()
}

/// An array of a class (2: structure): head and what follows it.
pub(super) fn array(class: u32, shape: [u32; 2], name: &str, rest: &[u8]) -> Vec<u8> {
    let head = [element(6, &words(&[class, 0])), element(5, &words(&shape)), element(1, name.as_bytes())].concat();
    element(14, &[&head, rest].concat())
}

pub(super) fn doubles(shape: [u32; 2], name: &str, values: &[f64]) -> Vec<u8> {
    let bytes: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
    array(6, shape, name, &element(9, &bytes))
}

/// An array of characters without a name.
pub(super) fn text(text: &str) -> Vec<u8> {
    array(4, [1, text.len() as u32], "", &element(16, text.as_bytes()))
}

/// Names of a structure's fields.
pub(super) fn fields(names: &[&str]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for name in names {
        bytes.extend(name.as_bytes());
        bytes.resize(bytes.len().next_multiple_of(8), 0);
    }
    [words(&[4 << 16 | 5, 8]), element(1, &bytes)].concat()
}

/// A file of these arrays.
pub(super) fn file(arrays: &[Vec<u8>]) -> Vec<u8> {
    let mut head = [b' '; 124];
    head[..10].copy_from_slice(b"MATLAB 5.0");
    [&head[..], b"\0\x01IM", &arrays.concat()].concat()
}
