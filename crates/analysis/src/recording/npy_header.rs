//! The header of NumPy's `.npy` files: [a Python literal][npy], of which three entries matter.
//!
//! ```text
//! {'descr': '<f8', 'fortran_order': False, 'shape': (204800, 2), }
//! {'descr': [('time', '<f8'), ('element.path', '<f8', (100,)), ], 'fortran_order': False, 'shape': (51201,), }
//! ```
//!
//! [npy]: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html

/// Deepest nesting: what is read needs 3, and a hostile file must not exhaust the stack.
const DEEPEST: usize = 8;

/// What a header says.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Header {
    /// The fields; one without a name in a plain array.
    pub(super) fields: Vec<Field>,
    /// Whether fields have names.
    pub(super) structured: bool,
    /// Whether the first index runs fastest.
    pub(super) fortran: bool,
    /// Number of elements along each dimension.
    pub(crate) shape: Vec<usize>,
}

/// A field of a row.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field {
    pub(super) name: String,
    /// Type of a number.
    pub(super) kind: String,
    /// How many numbers, where it is an array.
    pub(super) count: Option<usize>,
}

impl Field {
    /// Names of its numbers: `element[1].path` and so on of an array `element.path`.
    pub(super) fn names(&self) -> Vec<String> {
        let Some(count) = self.count else { return vec![self.name.clone()] };
        let (first, rest) = self.name.split_at(self.name.find('.').unwrap_or(self.name.len()));
        (1..=count).map(|entry| format!("{first}[{entry}]{rest}")).collect()
    }
}

#[derive(Debug, Clone, PartialEq)]
enum Literal {
    Text(String),
    Word(String),
    List(Vec<Literal>),
    /// Keys and values take turns.
    Dictionary(Vec<Literal>),
}

impl Header {
    /// Reads it.
    ///
    /// # Errors
    /// Text that is no such literal, an entry that is missing, a field that is not a number.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let mut rest = text;
        let Literal::Dictionary(entries) = literal(&mut rest, 0)? else {
            return Err("the header is no Python dictionary".to_owned());
        };
        let entry = |key: &str| {
            let mut pairs = entries.chunks_exact(2);
            let found = pairs.find(|pair| matches!(&pair[0], Literal::Text(name) if name == key));
            found.map(|pair| &pair[1]).ok_or_else(|| format!("no {key} in the header"))
        };
        let (fields, structured) = match entry("descr")? {
            Literal::Text(kind) => (vec![Field { name: String::new(), kind: kind.clone(), count: None }], false),
            Literal::List(fields) => (fields.iter().map(field).collect::<Result<_, _>>()?, true),
            other => return Err(format!("element type {other:?} is not understood")),
        };
        let Literal::List(shape) = entry("shape")? else { return Err("the shape is no tuple".to_owned()) };
        let length = |literal: &Literal| match literal {
            Literal::Word(digits) => digits.parse().map_err(|_| format!("shape {digits} is not a number")),
            other => Err(format!("shape {other:?} is not a number")),
        };
        let fortran = *entry("fortran_order")? == Literal::Word("True".to_owned());
        Ok(Self { fields, structured, fortran, shape: shape.iter().map(length).collect::<Result<_, _>>()? })
    }
}

/// Entries of an array that are read: a hostile file must not exhaust the memory by names.
const MOST_ENTRIES: usize = 1 << 16;

fn field(literal: &Literal) -> Result<Field, String> {
    let entries = |shape: &[Literal]| match shape {
        [Literal::Word(digits)] => digits.parse().ok().filter(|count| (1..=MOST_ENTRIES).contains(count)),
        _ => None,
    };
    match literal {
        Literal::List(parts) => match &parts[..] {
            [Literal::Text(name), Literal::Text(kind)] => {
                Ok(Field { name: name.clone(), kind: kind.clone(), count: None })
            }
            [Literal::Text(name), Literal::Text(kind), Literal::List(shape)] if entries(shape).is_some() => {
                Ok(Field { name: name.clone(), kind: kind.clone(), count: entries(shape) })
            }
            [Literal::Text(name), ..] => {
                Err(format!("field '{name}' is neither a number nor a row of numbers for each sample"))
            }
            _ => Err("a field with a title is not read".to_owned()),
        },
        other => Err(format!("field {other:?} has no name")),
    }
}

/// The literal at the start of `rest`, which is moved on.
fn literal(rest: &mut &str, depth: usize) -> Result<Literal, String> {
    if depth > DEEPEST {
        return Err(format!("the header is nested more than {DEEPEST} deep"));
    }
    *rest = rest.trim_start();
    match rest.chars().next() {
        Some(quote @ ('\'' | '"')) => text(rest, quote),
        Some('(') => items(rest, ')', depth).map(Literal::List),
        Some('[') => items(rest, ']', depth).map(Literal::List),
        Some('{') => items(rest, '}', depth).map(Literal::Dictionary),
        _ => {
            let end = rest.find(|c: char| !c.is_alphanumeric()).unwrap_or(rest.len());
            let (word, after) = rest.split_at(end);
            *rest = after;
            let broken = || format!("the header breaks off before '{}'", after.chars().take(20).collect::<String>());
            if word.is_empty() { Err(broken()) } else { Ok(Literal::Word(word.to_owned())) }
        }
    }
}

fn text(rest: &mut &str, quote: char) -> Result<Literal, String> {
    let mut found = String::new();
    let mut characters = rest.char_indices().skip(1);
    while let Some((at, c)) = characters.next() {
        if c == quote {
            *rest = &rest[at + 1..];
            return Ok(Literal::Text(found));
        }
        // Escapes other than of quotes and of itself do not occur in names of signals.
        let plain = if c == '\\' { characters.next().map(|(_, c)| c) } else { Some(c) };
        found.extend(plain);
    }
    Err(format!("a text in the header does not end: {quote}{found}"))
}

/// What stands up to the bracket `end`, parted by commas or colons.
fn items(rest: &mut &str, end: char, depth: usize) -> Result<Vec<Literal>, String> {
    let mut found = Vec::new();
    *rest = &rest[1..];
    loop {
        *rest = rest.trim_start();
        if let Some(after) = rest.strip_prefix(end) {
            *rest = after;
            return Ok(found);
        }
        found.push(literal(rest, depth + 1)?);
        *rest = rest.trim_start();
        match rest.strip_prefix([',', ':']) {
            Some(after) => *rest = after,
            None if rest.starts_with(end) => {}
            None => return Err(format!("the header has no '{end}' after '{:?}'", found.last())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_and_structured_headers_are_understood() {
        let plain = Header::parse("{'descr': '<f4', 'fortran_order': True, 'shape': (3, 2), }   \n").unwrap();
        let field = |name: &str, kind: &str| Field { name: name.to_owned(), kind: kind.to_owned(), count: None };
        assert_eq!(
            plain,
            Header { fields: vec![field("", "<f4")], structured: false, fortran: true, shape: vec![3, 2] }
        );
        let text = r#"{"shape": (7,), 'descr': [('it\'s [m]', '<f8'), ("b, c", '>i2')], 'fortran_order': False}"#;
        let structured = Header::parse(text).unwrap();
        assert_eq!(structured.fields, [field("it's [m]", "<f8"), field("b, c", ">i2")]);
        assert!(structured.structured && !structured.fortran && structured.shape == [7]);
    }

    #[test]
    fn what_is_no_such_header_is_refused_at_any_length() {
        let text = "{'descr': [('time', '<f8'), ('a', '<f8', (3, 2))], 'fortran_order': False, 'shape': (7,)}";
        for end in 0..text.len() {
            assert!(Header::parse(&text[..end]).is_err(), "{end}");
        }
        assert!(Header::parse(text).is_err_and(|e| e.contains("'a' is neither a number")));
        assert!(Header::parse(&"(".repeat(100_000)).is_err_and(|e| e.contains("nested")));
        assert!(Header::parse("{'descr': '<f8', 'fortran_order': False, 'shape': (-1,)}").is_err());
        assert!(Header::parse("{'descr': '<f8', 'fortran_order': False, 'shape': 5}").is_err());
    }
}
