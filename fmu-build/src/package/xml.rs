//! XML as FMUs hold it: a declaration, elements with attributes, two spaces of indentation.

use std::io;

use quick_xml::events::{BytesDecl, BytesStart, Event};
use quick_xml::writer::Writer;

/// Attributes of one element, in the order written.
pub(crate) type Attributes = Vec<(&'static str, String)>;

/// The shortest text that reads back to the same number; `xs:double` takes Rust's form.
pub(crate) fn number(value: f64) -> String {
    format!("{value:?}")
}

/// A thin layer over the XML writer: elements with owned attributes, indented by two spaces.
pub(crate) struct Xml(Writer<Vec<u8>>);

impl Xml {
    /// A document.
    pub(crate) fn new() -> io::Result<Self> {
        let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
        writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        Ok(Self(writer))
    }

    /// An element with content.
    pub(crate) fn element(
        &mut self,
        name: &str,
        attributes: Attributes,
        content: impl FnOnce(&mut Self) -> io::Result<()>,
    ) -> io::Result<()> {
        let start = start(name, &attributes);
        self.0.write_event(Event::Start(start.borrow()))?;
        content(self)?;
        self.0.write_event(Event::End(start.to_end()))
    }

    /// An element without content.
    pub(crate) fn empty(&mut self, name: &str, attributes: Attributes) -> io::Result<()> {
        self.0.write_event(Event::Empty(start(name, &attributes)))
    }

    /// The document's text.
    pub(crate) fn finish(self) -> io::Result<String> {
        let mut bytes = self.0.into_inner();
        bytes.push(b'\n');
        String::from_utf8(bytes).map_err(io::Error::other)
    }
}

fn start<'a>(name: &'a str, attributes: &'a Attributes) -> BytesStart<'a> {
    let mut start = BytesStart::new(name);
    start.extend_attributes(attributes.iter().map(|(key, value)| (*key, value.as_str())));
    start
}
