//! From `fmuResourceLocation`, or FMI 3.0's `resourcePath`, to a path on this machine.
//!
//! FMI 3.0 passes a plain absolute path, in which nothing is escaped. FMI 2.0 asks for a URI after RFC 3986 with the
//! scheme `file`. Importers send `file:/dir`, `file:///dir`, `file://localhost/dir`, on Windows also `file:///C:/dir`
//! and the ill-formed `file://C:/dir`; some leave characters unescaped. All these name a path without doubt and are
//! accepted; so is a plain absolute path. A `+` is a plus sign: it means a space only in web forms. Escapes that are
//! none stay as they are. Other schemes and, except on Windows, other hosts are refused.

use std::path::PathBuf;

/// Why a resource location is refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub(crate) enum UriError {
    /// Another scheme, or a relative path.
    #[error("resource location \"{0}\": it must be a file URI with an absolute path, as in file:///dir/resources")]
    NotAFile(String),
    /// A file on another machine.
    #[error("resource location \"{uri}\": it names the host \"{host}\"; resources must lie on this machine")]
    OtherHost { uri: String, host: String },
    /// A relative path, or a URI, where FMI 3.0 has a path.
    #[error("resourcePath \"{0}\": it must be an absolute path, as in /dir/resources/")]
    NotAbsolute(String),
    /// An escaped NUL, or bytes that cannot be a path here.
    #[error("resource location \"{0}\": it cannot be a path on this machine")]
    NotAPath(String),
}

/// The path that a resource location names.
pub(crate) fn path(uri: &[u8]) -> Result<PathBuf, UriError> {
    let bytes = local_path(uri, cfg!(windows))?;
    to_path(bytes).ok_or_else(|| UriError::NotAPath(String::from_utf8_lossy(uri).into_owned()))
}

/// The path that FMI 3.0 passes as it is.
pub(crate) fn plain_path(path: &[u8]) -> Result<PathBuf, UriError> {
    let shown = || String::from_utf8_lossy(path).into_owned();
    let found = to_path(path.to_vec()).ok_or_else(|| UriError::NotAPath(shown()))?;
    if found.is_absolute() { Ok(found) } else { Err(UriError::NotAbsolute(shown())) }
}

#[cfg(unix)]
fn to_path(bytes: Vec<u8>) -> Option<PathBuf> {
    use std::os::unix::ffi::OsStringExt;
    Some(std::ffi::OsString::from_vec(bytes).into())
}

#[cfg(not(unix))]
fn to_path(bytes: Vec<u8>) -> Option<PathBuf> {
    String::from_utf8(bytes).ok().map(PathBuf::from)
}

fn local_path(uri: &[u8], windows: bool) -> Result<Vec<u8>, UriError> {
    let shown = || String::from_utf8_lossy(uri).into_owned();
    let absolute = |path: &[u8]| path.starts_with(b"/") || windows && (is_drive(path) || path.starts_with(b"\\"));

    if !(uri.len() >= 5 && uri[..5].eq_ignore_ascii_case(b"file:")) {
        return if absolute(uri) { Ok(uri.to_vec()) } else { Err(UriError::NotAFile(shown())) };
    }
    let rest = &uri[5..];
    let escaped = if let Some(after) = rest.strip_prefix(b"//") {
        let end = after.iter().position(|byte| *byte == b'/').unwrap_or(after.len());
        let host = &after[..end];
        if host.is_empty() || host.eq_ignore_ascii_case(b"localhost") {
            &after[end..]
        } else if windows && is_drive(host) {
            after
        } else if windows {
            rest
        } else {
            return Err(UriError::OtherHost { uri: shown(), host: String::from_utf8_lossy(host).into_owned() });
        }
    } else {
        rest
    };

    let mut path = unescape(escaped);
    if windows && path.starts_with(b"/") && is_drive(&path[1..]) {
        path.remove(0);
    }
    if path.contains(&0) {
        Err(UriError::NotAPath(shown()))
    } else if absolute(&path) {
        Ok(path)
    } else {
        Err(UriError::NotAFile(shown()))
    }
}

fn is_drive(path: &[u8]) -> bool {
    path.len() >= 2 && path[0].is_ascii_alphabetic() && path[1] == b':'
}

fn unescape(escaped: &[u8]) -> Vec<u8> {
    let digit = |byte: &u8| char::from(*byte).to_digit(16);
    let mut bytes = Vec::with_capacity(escaped.len());
    let mut rest = escaped;
    while let Some((&first, after)) = rest.split_first() {
        rest = after;
        let value = match (first, after) {
            (b'%', [high, low, ..]) => digit(high).zip(digit(low)).map(|(high, low)| (high * 16 + low) as u8),
            _ => None,
        };
        bytes.push(value.unwrap_or(first));
        if value.is_some() {
            rest = &after[2..];
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unix(uri: &str) -> Result<String, UriError> {
        local_path(uri.as_bytes(), false).map(|path| String::from_utf8(path).unwrap())
    }

    fn windows(uri: &str) -> Result<String, UriError> {
        local_path(uri.as_bytes(), true).map(|path| String::from_utf8(path).unwrap())
    }

    #[test]
    fn one_two_and_three_slashes_and_localhost_name_the_same_path() {
        for uri in ["file:/a/b", "file:///a/b", "file://localhost/a/b", "FILE://LOCALHOST/a/b", "/a/b"] {
            assert_eq!(unix(uri).unwrap(), "/a/b", "{uri}");
        }
    }

    #[test]
    fn spaces_plus_signs_and_umlauts_arrive_escaped_or_plain() {
        assert_eq!(unix("file:///a%20b+c/%C3%BCber").unwrap(), "/a b+c/über");
        assert_eq!(unix("file:///a b+c/über").unwrap(), "/a b+c/über");
        assert_eq!(unix("file:///100%/a%2").unwrap(), "/100%/a%2");
        assert_eq!(unix("file:///a%2Fb%25").unwrap(), "/a/b%");
    }

    #[test]
    fn drive_letters_are_understood_on_windows() {
        for uri in ["file:///C:/a%20b", "file:/C:/a%20b", "file://C:/a%20b", "file://localhost/C:/a%20b", "C:/a b"] {
            assert_eq!(windows(uri).unwrap(), "C:/a b", "{uri}");
        }
        assert_eq!(windows("file://server/share/a").unwrap(), "//server/share/a");
    }

    #[test]
    #[cfg(unix)]
    fn a_plain_path_is_absolute_and_keeps_every_byte() {
        assert_eq!(plain_path(b"/a%20b/+/").unwrap(), PathBuf::from("/a%20b/+/"));
        for path in [&b"a/b"[..], b"file:///a", b""] {
            assert!(matches!(plain_path(path), Err(UriError::NotAbsolute(_))));
        }
    }

    #[test]
    fn other_schemes_hosts_and_relative_paths_are_refused() {
        for uri in ["", "file", "file:", "file://", "file:a/b", "http://a/b", "a/b", "C:/a"] {
            assert!(matches!(unix(uri), Err(UriError::NotAFile(_))), "{uri}");
        }
        assert!(matches!(unix("file://server/a"), Err(UriError::OtherHost { .. })));
        assert!(matches!(unix("file:///a%00b"), Err(UriError::NotAPath(_))));
    }
}
