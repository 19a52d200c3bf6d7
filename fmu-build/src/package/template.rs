//! Files of an FMU and pages, made from the templates of `fmu-build/assets`.

use anyhow::Result;
use minijinja::syntax::SyntaxConfig;
use minijinja::{Environment, Output, State, Value};
use quick_xml::escape::escape;

/// A template, filled. Values are escaped as text; in a template of XML, whose name ends so, as attributes.
///
/// # Errors
/// Of the template.
pub(crate) fn render(name: &str, template: &str, values: Value) -> Result<String> {
    let mut page = Environment::new();
    page.set_syntax(SyntaxConfig::builder().trim_blocks(true).lstrip_blocks(true).keep_trailing_newline(true).build()?);
    page.set_formatter(escaped);
    Ok(page.render_named_str(name, template, values)?)
}

/// Values as text, unless they are marked as HTML or XML themselves.
fn escaped(out: &mut Output<'_>, state: &mut State<'_, '_>, value: &Value) -> Result<(), minijinja::Error> {
    let text = value.to_string();
    let escaped = || escape(text.as_str());
    Ok(match (value.is_safe(), state.name().ends_with(".xml")) {
        (true, _) => out.write_str(&text),
        (false, false) => out.write_str(&escaped()),
        // A reader of XML takes line ends and tabs of an attribute for spaces.
        (false, true) => out.write_str(&escaped().replace('\n', "&#10;").replace('\t', "&#9;")),
    }?)
}
