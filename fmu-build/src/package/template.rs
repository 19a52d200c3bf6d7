//! Files of an FMU and pages, made from templates.

use anyhow::Result;
use minijinja::syntax::SyntaxConfig;
use minijinja::{Environment, Output, State, Value};
use quick_xml::escape::escape;

/// A template, filled. By the ending of its name values are escaped as text of HTML, as attributes of XML, or, of
/// Markdown and TOML, left as they are.
///
/// # Errors
/// Of the template.
pub fn render(name: &str, template: &str, values: Value) -> Result<String> {
    let mut page = Environment::new();
    page.set_syntax(SyntaxConfig::builder().trim_blocks(true).lstrip_blocks(true).keep_trailing_newline(true).build()?);
    page.set_formatter(escaped);
    Ok(page.render_named_str(name, template, values)?)
}

/// Values as text, unless they are marked as HTML or XML themselves.
fn escaped(out: &mut Output<'_>, state: &mut State<'_, '_>, value: &Value) -> Result<(), minijinja::Error> {
    let text = value.to_string();
    let escaped = || escape(text.as_str());
    Ok(match state.name().rsplit_once('.') {
        _ if value.is_safe() => out.write_str(&text),
        Some((_, "md" | "toml")) => out.write_str(&text),
        // A reader of XML takes line ends and tabs of an attribute for spaces.
        Some((_, "xml")) => out.write_str(&escaped().replace('\n', "&#10;").replace('\t', "&#9;")),
        _ => out.write_str(&escaped()),
    }?)
}
