//! Reads which paths a Rust file names, as far as the layers need it.

/// A module, or an item in one, by its path from the crate's root.
pub(super) type Path = Vec<String>;

/// A file by its module, and its text.
pub(super) type File = (Path, String);

/// One path of a `use`, as it is written, and the name that it has from there on: `*` stands for many.
#[derive(Debug, PartialEq)]
pub(super) struct Use {
    /// The path.
    pub(super) path: Path,
    /// The name.
    pub(super) name: String,
    /// Whether others may take it from there.
    pub(super) is_public: bool,
}

/// The files without those of modules under `#[cfg(test)]`, and each without its own tests.
pub(super) fn without_tests(files: Vec<File>) -> Vec<File> {
    let declared = |(path, text): &File| -> Vec<Path> {
        let after = text.split("#[cfg(test)]\n").skip(1).filter_map(|after| after.lines().next()?.strip_suffix(';'));
        let names = after.filter_map(|line| line.split_once("mod ")).map(|(_, name)| name.to_owned());
        names.map(|name| [&path[..], &[name]].concat()).collect()
    };
    let tests: Vec<Path> = files.iter().flat_map(declared).collect();
    let kept = files.into_iter().filter(|(path, _)| !tests.iter().any(|test| path.starts_with(test)));
    kept.map(|(path, text)| (path, text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default().to_owned()))
        .collect()
}

/// Every path within the crate that a module's text names by `crate::`, `super::` or `self::`, from the crate's root.
pub(super) fn named(module: &Path, text: &str) -> Vec<Path> {
    named_at(module, &without_comments(text)).into_iter().map(|(_, path)| path).collect()
}

/// Every module at the crate's root that a module's text names, alone or in braces, with its line; without a name where
/// it is the root itself. Comments do not count.
pub(super) fn imports(module: &Path, text: &str) -> Vec<(usize, String)> {
    let code = without_comments(text);
    let roots = code.match_indices("crate as ").map(|(at, _)| (at, Path::new()));
    let mut named: Vec<(usize, Path)> = named_at(module, &code).into_iter().chain(roots).collect();
    named.sort_by_key(|(at, _)| *at);
    let line = |at: usize| code[..at].matches('\n').count() + 1;
    let mut found: Vec<_> =
        named.into_iter().map(|(at, path)| (line(at), path.first().cloned().unwrap_or_default())).collect();
    found.dedup();
    found
}

/// What [`named`] finds in code without comments, and where.
fn named_at(module: &Path, code: &str) -> Vec<(usize, Path)> {
    let each = |at: usize| paths(&code[at..]).into_iter().map(move |path| (at, path));
    let mut found: Vec<(usize, Path)> = after("crate::", code).flat_map(each).collect();
    for (keyword, least) in [("super::", 1), ("self::", 0)] {
        for at in after(keyword, code) {
            let (mut up, mut rest) = (least, &code[at..]);
            while let Some(further) = rest.strip_prefix("super::") {
                (up, rest) = (up + 1, further);
            }
            if rest.starts_with("super as ") {
                (up, rest) = (up + 1, "self");
            }
            let module = [&module[..], &inline_modules(&code[..at])].concat();
            if let Some(depth) = module.len().checked_sub(up) {
                found.extend(paths(rest).into_iter().map(|path| (at, [&module[..depth], &path].concat())));
            }
        }
    }
    found
}

/// The modules that are open at the end of a part of a formatted file: those whose brace has not been closed.
fn inline_modules(code: &str) -> Path {
    let mut open: Vec<(usize, String)> = Vec::new();
    for line in code.lines() {
        let rest = line.trim_start();
        let indent = line.len() - rest.len();
        let head = rest.split_once("mod ").filter(|(before, _)| before.is_empty() || before.starts_with("pub"));
        if let Some(name) = head.and_then(|(_, after)| after.strip_suffix(" {")) {
            open.push((indent, name.to_owned()));
        } else if rest == "}" {
            open.retain(|(of, _)| *of != indent);
        }
    }
    open.into_iter().map(|(_, name)| name).collect()
}

/// What a file's own `use` lines bring, those of its functions not counted.
pub(super) fn uses(text: &str) -> Vec<Use> {
    let code = without_comments(text);
    let mut found = Vec::new();
    for at in after("use ", &code) {
        let before = code[..at - "use ".len()].rsplit('\n').next().unwrap_or_default();
        let is_public = before == "pub " || before.starts_with("pub(") && before.ends_with(") ");
        if is_public || before.is_empty() {
            tree(&code[at..], &Path::new(), is_public, &mut found);
        }
    }
    found
}

/// Where what follows a keyword begins: those that stand within a longer word or path do not count.
fn after<'t>(keyword: &'t str, code: &'t str) -> impl Iterator<Item = usize> + 't {
    let within = |c: char| c.is_alphanumeric() || matches!(c, '_' | ':');
    let whole = move |at: &usize| !code[..*at].chars().next_back().is_some_and(within);
    code.match_indices(keyword).map(|(at, _)| at).filter(whole).map(|at| at + keyword.len())
}

/// Every path of what stands after `crate::` and the like: one, or those of a list.
fn paths(text: &str) -> Vec<Path> {
    let mut found = Vec::new();
    tree(text, &Path::new(), false, &mut found);
    found.into_iter().map(|each| each.path).collect()
}

/// Reads one path or a list of paths that go on from `start`. Gives what follows.
fn tree<'t>(text: &'t str, start: &Path, is_public: bool, found: &mut Vec<Use>) -> &'t str {
    let (mut path, mut rest) = (start.clone(), text.trim_start());
    loop {
        if let Some(list) = rest.strip_prefix('{') {
            rest = list.trim_start();
            while !rest.is_empty() && !rest.starts_with('}') {
                rest = tree(rest, &path, is_public, found);
                rest = &rest[rest.find([',', '}']).unwrap_or(rest.len())..];
                rest = rest.trim_start_matches(',').trim_start();
            }
            return rest.strip_prefix('}').unwrap_or_default();
        }
        let name = name_at(rest);
        rest = &rest[name.len()..];
        if name != "self" && !name.is_empty() {
            path.push(name);
        }
        match rest.strip_prefix("::") {
            Some(further) => rest = further,
            None => break,
        }
    }
    let name = match rest.trim_start().strip_prefix("as ") {
        Some(renamed) => name_at(renamed),
        None if rest.starts_with('*') => "*".to_owned(),
        None => path.last().cloned().unwrap_or_default(),
    };
    found.push(Use { path, name, is_public });
    rest
}

fn name_at(text: &str) -> String {
    text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

/// A file's code.
pub(super) fn without_comments(text: &str) -> String {
    text.lines().map(|line| without_comment(line) + "\n").collect()
}

fn without_comment(line: &str) -> String {
    let mut quoted = false;
    let bytes = line.as_bytes();
    for (at, byte) in bytes.iter().enumerate() {
        match byte {
            b'"' if at == 0 || bytes[at - 1] != b'\\' => quoted = !quoted,
            b'/' if !quoted && bytes.get(at + 1) == Some(&b'/') => return line[..at].to_owned(),
            _ => {}
        }
    }
    line.to_owned()
}
