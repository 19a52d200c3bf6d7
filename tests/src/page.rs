//! Parts of pages that tests write: what stands there between `<!-- name -->` and `<!-- end -->`.

use std::fs;

/// Puts parts, by their names, in place of those on a page of the repository.
pub fn write(page: &str, parts: impl IntoIterator<Item = (&'static str, String)>) {
    let path = crate::root().join(page);
    let mut text = fs::read_to_string(&path).unwrap();
    for (name, part) in parts {
        let mark = format!("<!-- {name} -->\n");
        let (before, rest) = text.split_once(&mark).expect(name);
        let (_, after) = rest.split_once("<!-- end -->").expect(name);
        text = format!("{before}{mark}\n{}\n\n<!-- end -->{after}", part.trim());
    }
    fs::write(path, text).unwrap();
}
