//! Zig as a linker: it holds the symbol lists of every glibc, of Windows and of macOS, so that a library is linked for
//! old systems and for others wherever it is compiled. It comes from the Python package index.
//!
//! Rust's own linker call takes the C library of the machine that compiles, and an FMU made on a new Linux does not
//! load on an older one. Linked through zig it runs with glibc 2.17 (2012), without `libgcc_s`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};

use super::platform::Target;
use crate::shared::{Project, Python, whole_file};

/// The oldest glibc that a library linked by zig runs with: the oldest that Rust supports.
pub const OLDEST_GLIBC: (u32, u32) = (2, 17);

/// The package, exact, so that equal source gives equal bytes.
const REQUIREMENTS: &str = "ziglang==0.15.1\n";

/// Puts the date in the header of `$out` to zero: the four bytes 8 after the offset that stands at 60.
const UNDATED: &str = "\
    at=$(od -An -tu4 -j60 -N4 \"$out\")\n\
    printf '\\0\\0\\0\\0' | dd of=\"$out\" bs=1 seek=$((at + 8)) conv=notrunc 2>/dev/null\n";

/// How to start zig.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Zig(Vec<PathBuf>);

impl Zig {
    /// The one in this program's cache, which is put there from the Python package index if need be; where that cannot
    /// be, one in the path.
    ///
    /// # Errors
    /// Where neither is to be had, with why.
    pub fn obtain(project: &Project) -> Result<Self> {
        let of_ours = Python::prepare_from(project, "zig-python", REQUIREMENTS)
            .map(|python| Self(vec![python.interpreter().to_owned(), "-m".into(), "ziglang".into()]));
        let in_path = Self(vec!["zig".into()]);
        match of_ours {
            Ok(zig) if zig.version().is_some() => Ok(zig),
            _ if in_path.version().is_some() => Ok(in_path),
            Ok(_) => bail!("zig does not start"),
            Err(why) => Err(why.context("no zig to link with, neither from the package index nor in the path")),
        }
    }

    /// What it says of its version.
    pub fn version(&self) -> Option<String> {
        self.ask("version").map(|text| text.trim().to_owned())
    }

    /// Writes the program that rustc calls as its linker for a target, and gives its path.
    ///
    /// Rust calls GNU's compilers, and some of what it asks of them is known to zig by another name: `libgcc`, in place
    /// of which zig has its own unwinder to link statically; MinGW's parts, which zig adds itself; the list of exported
    /// names, which is an input to it. The date in the header of Windows' files is put to zero: nobody asks for it, and
    /// it would make every build another one.
    pub fn linker(&self, project: &Project, target: Target, name: &str) -> Result<PathBuf> {
        // The name's end tells rustc which kind of linker it is.
        let script = project.cache().join("zig").join(format!("{}-clang", target.triple));
        let cache = project.cache().join("zig/cache");
        let text = format!(
            "#!/bin/sh\n\
             # Written by Brinell: links through zig.\n\
             export ZIG_GLOBAL_CACHE_DIR={cache} ZIG_LOCAL_CACHE_DIR={cache}\n\
             for argument do\n\
             \x20 [ \"$last\" = -o ] && out=$argument\n\
             \x20 last=$argument\n\
             \x20 shift\n\
             \x20 case $argument in\n\
             \x20   -lgcc_s | -lgcc_eh) set -- \"$@\" -lunwind ;;\n\
             \x20   -lgcc | -fuse-ld=* | --target=* | -m64) ;;\n\
             \x20   -lmsvcrt | -lmingwex | -lmingw32 | -l:libpthread.a | -Wl,--disable-auto-image-base) ;;\n\
             \x20   -Wl,*.def) set -- \"$@\" \"${{argument#-Wl,}}\" ;;\n\
             \x20   *) set -- \"$@\" \"$argument\" ;;\n\
             \x20 esac\n\
             done\n\
             {command} cc -target {name} \"$@\" || exit\n\
             {after}",
            cache = quoted(&cache.display().to_string()),
            command = self.command(),
            after = if name.contains("windows") { UNDATED } else { "" },
        );
        fs::create_dir_all(&cache).with_context(|| cache.display().to_string())?;
        write_program(&script, &text)?;
        Ok(script)
    }

    /// Writes the program that rustc calls, by its name in the path, for lists of what Windows' libraries export; gives
    /// its folder.
    pub fn dlltool(&self, project: &Project) -> Result<PathBuf> {
        let folder = project.cache().join("zig/bin");
        let text = format!("#!/bin/sh\n# Written by Brinell.\nexec {} dlltool \"$@\"\n", self.command());
        write_program(&folder.join("x86_64-w64-mingw32-dlltool"), &text)?;
        Ok(folder)
    }

    /// How a shell starts it.
    fn command(&self) -> String {
        let words: Vec<_> = self.0.iter().map(|part| quoted(&part.display().to_string())).collect();
        words.join(" ")
    }

    /// Lays out what Rust's linker takes for macOS's development kit, and gives its folder: the names of the system's
    /// symbols, under the names of the libraries that Rust asks for. All of them are parts of the one.
    pub fn apple_kit(&self, project: &Project) -> Result<PathBuf> {
        let environment = self.ask("env").context("`zig env` does not answer")?;
        let line = environment.lines().find(|line| line.trim_start().trim_start_matches('.').contains("lib_dir"));
        let folder = line.and_then(|line| line.split('"').rev().nth(1)).context("`zig env` names no lib_dir")?;
        let names = Path::new(folder).join("libc/darwin/libSystem.tbd");
        let text = fs::read_to_string(&names).with_context(|| names.display().to_string())?;
        // Later lists name a processor that linkers do not know yet.
        let text = text.replace("arm64e.x1-", "arm64-");
        let kit = project.cache().join("zig/macos");
        for library in ["System", "c", "m", "iconv"] {
            let path = kit.join(format!("usr/lib/lib{library}.tbd"));
            whole_file::write_if_new(&path, &text)?;
        }
        Ok(kit)
    }

    fn ask(&self, what: &str) -> Option<String> {
        let (program, arguments) = self.0.split_first()?;
        let output = Command::new(program).args(arguments).arg(what).stderr(Stdio::null()).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned())
    }
}

/// Writes a script that can be started, unless it is there.
fn write_program(path: &Path, text: &str) -> Result<()> {
    if whole_file::write_if_new(path, text)? {
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            fs::set_permissions(path, fs::Permissions::from_mode(0o755)).with_context(|| path.display().to_string())?;
        }
    }
    Ok(())
}

/// A word for the shell, whatever is in it.
fn quoted(word: &str) -> String {
    format!("'{}'", word.replace('\'', "'\\''"))
}

/// The newest version of glibc that a library's symbols ask for; `None` if it asks for none.
pub fn needed_glibc(library: &[u8]) -> Option<(u32, u32)> {
    const NAME: &[u8] = b"GLIBC_";
    let version = |text: &[u8]| {
        let end = text.iter().position(|byte| !byte.is_ascii_digit() && *byte != b'.').unwrap_or(text.len());
        let mut parts = std::str::from_utf8(&text[..end]).ok()?.split('.');
        Some((parts.next()?.parse().ok()?, parts.next()?.parse().ok()?))
    };
    let found = library.windows(NAME.len()).enumerate().filter(|(_, window)| *window == NAME);
    found.filter_map(|(at, _)| version(&library[at + NAME.len()..])).max()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_glibc_is_found_by_number_not_by_letter() {
        assert_eq!(needed_glibc(b"\0GLIBC_2.9\0GLIBC_2.14\0GLIBC_2.2.5\0GLIBC_PRIVATE\0"), Some((2, 14)));
        assert_eq!(needed_glibc(b"no such name"), None);
    }

    #[test]
    fn a_path_with_a_quotation_mark_is_one_word() {
        assert_eq!(quoted("/a b/c'd"), r"'/a b/c'\''d'");
    }
}
