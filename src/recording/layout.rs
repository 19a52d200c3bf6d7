//! How signals stand in a row of a NumPy file.
//!
//! `numpy.load` refuses headers of more than 10 000 characters unless it is allowed to, and a field for each signal
//! of some 70 elements makes one. Where that is so, what all elements have is an array, as under FMI 3.0:
//! `element.path` has an entry for each element, the first for `element[1].path`.

/// Longest header that `numpy.load` reads by itself (characters): its `max_header_size`.
const LONGEST: usize = 10_000;

/// Order of the numbers of a row, and their names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Layout {
    /// As the header has them.
    fields: String,
    /// Indices of the names in the order in which their numbers stand.
    order: Vec<usize>,
}

/// A field: its name, and the indices of the names that it stands for.
struct Field {
    name: String,
    of: Vec<usize>,
}

impl Layout {
    /// A field for each of these names, in their order.
    pub fn flat(names: &[String]) -> Self {
        Self::of_fields(names.iter().enumerate().map(|(index, name)| Field { name: name.clone(), of: vec![index] }))
    }

    /// The same, with arrays over the elements where `numpy.load` would refuse it.
    pub fn of(names: &[String]) -> Self {
        let flat = Self::flat(names);
        if flat.text(u64::MAX).len() <= LONGEST {
            return flat;
        }
        let mut fields: Vec<Field> = Vec::new();
        for (index, name) in names.iter().enumerate() {
            let whole = || Field { name: name.clone(), of: vec![index] };
            let Some((number, array)) = of_element(name) else {
                fields.push(whole());
                continue;
            };
            match fields.iter_mut().find(|field| field.name == array) {
                // An array without gaps, or it would not be known which element an entry is of.
                Some(field) if field.of.len() + 1 == number => field.of.push(index),
                None if number == 1 => fields.push(Field { name: array, of: vec![index] }),
                _ => fields.push(whole()),
            }
        }
        Self::of_fields(fields.into_iter())
    }

    fn of_fields(all: impl Iterator<Item = Field>) -> Self {
        let mut layout = Self { fields: String::new(), order: Vec::new() };
        for Field { name, of } in all {
            let shape = if name.starts_with(ARRAY) { format!(", ({},)", of.len()) } else { String::new() };
            layout.fields += &format!("('{name}', '<f8'{shape}), ");
            layout.order.extend(of);
        }
        layout
    }

    /// Indices of the names in the order in which their numbers stand in a row.
    pub fn order(&self) -> &[usize] {
        &self.order
    }

    /// The header of a file of so many rows; its length does not depend on them.
    pub fn header(&self, rows: u64) -> Vec<u8> {
        let text = self.text(rows);
        let mut bytes = MAGIC.to_vec();
        bytes.extend((text.len() as u32).to_le_bytes());
        bytes.extend(text.as_bytes());
        bytes
    }

    fn text(&self, rows: u64) -> String {
        let shape = format!("({rows},)");
        let mut text = format!("{{'descr': [{}], 'fortran_order': False, 'shape': {shape:<24}}}", self.fields.as_str());
        // With magic, version and length a multiple of 64, ending in a new line.
        let before = MAGIC.len() + size_of::<u32>();
        let length = (before + text.len() + 1).next_multiple_of(64) - before;
        text.extend(std::iter::repeat_n(' ', length - 1 - text.len()));
        text.push('\n');
        text
    }
}

/// How names of arrays over the elements begin.
const ARRAY: &str = "element.";
/// NumPy's, with version 2.0 of the format.
const MAGIC: &[u8] = b"\x93NUMPY\x02\x00";

/// Number of an element and name of the array, of a name as `element[3].path`.
fn of_element(name: &str) -> Option<(usize, String)> {
    let (number, rest) = name.strip_prefix("element[")?.split_once("].")?;
    Some((number.parse().ok()?, [ARRAY, rest].concat()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(elements: usize) -> Vec<String> {
        let parts = ["angle", "path", "force.inner", "force.outer"];
        let mut names = vec!["time".to_owned(), "shaft.x".to_owned()];
        for j in 1..=elements {
            names.extend(parts.map(|part| format!("element[{j}].{part}")));
            if j == 3 {
                names.push("element[3].spin_angle".to_owned());
            }
        }
        names
    }

    #[test]
    fn few_elements_have_a_field_for_each_signal_and_many_have_arrays_in_a_header_that_numpy_loads() {
        for elements in [9, 69, 70, 100, 1000] {
            let (names, layout) = (names(elements), Layout::of(&names(elements)));
            let header = layout.header(5);
            assert_eq!((header.len() % 64, layout.header(u64::MAX).len()), (0, header.len()), "{elements}");
            assert!(header.len() <= 12 + LONGEST, "{elements}: {}", header.len());
            let text = String::from_utf8_lossy(&header[12..]).into_owned();
            assert!(
                text.contains("('shaft.x', '<f8'), ") && text.contains("'element[3].spin_angle', '<f8'), "),
                "{text}"
            );
            let mut sorted = layout.order().to_vec();
            sorted.sort_unstable();
            assert!(sorted.iter().enumerate().all(|(at, &index)| at == index), "{elements}: each name once");
            if Layout::flat(&names) == layout {
                assert!(elements < 100 && text.contains("('element[2].path', '<f8'), "), "{elements}");
            } else {
                assert!(elements > 60 && text.contains(&format!("('element.path', '<f8', ({elements},)), ")), "{text}");
                let second = layout.order()[2 + elements..][..elements].iter().map(|&index| names[index].clone());
                assert!(second.eq((1..=elements).map(|j| format!("element[{j}].path"))));
            }
        }
    }

    #[test]
    fn elements_with_a_gap_between_them_are_no_array() {
        let mut names = names(100);
        names.retain(|name| name != "element[50].path");
        let text = String::from_utf8_lossy(&Layout::of(&names).header(1)).into_owned();
        assert!(text.contains("('element.angle', '<f8', (100,))") && text.contains("('element[51].path', '<f8'), "));
        assert!(text.contains("('element.path', '<f8', (49,))"));
    }
}
