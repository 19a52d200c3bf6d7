//! Where things are: the workspace's source, if it is there, the folder for results, and the cache for what is made
//! once and used again (contact maps, Python environments, compiled libraries).

use std::env;
use std::path::{Path, PathBuf};

/// The workspace's source and the folders for what is made.
#[derive(Debug, Clone)]
pub struct Project {
    source: Option<PathBuf>,
    cache: PathBuf,
    /// `None` stands for the folder in which the user stands.
    results: Option<PathBuf>,
    /// Where cargo put the model library that it built along with the program.
    built: Option<PathBuf>,
}

impl Project {
    /// As `cargo fmu` and the tests work: results and cache lie in the workspace's `target`.
    pub fn find() -> Self {
        let project = Self::of_user();
        Self { results: Some(project.cache.clone()), ..project }
    }

    /// As the program `brinell` works: results lie where the user stands, the cache in the workspace's `target` or,
    /// where this program came without the source, in the user's cache folder. `BRINELL_CACHE` names another.
    pub fn of_user() -> Self {
        // Empty in a program that holds the libraries: it works alone, wherever it was compiled.
        let built_from = Some(Path::new(env!("BRINELL_SOURCE"))).filter(|root| root.is_absolute());
        let source = built_from.filter(|root| root.join("src/lib.rs").is_file()).map(Path::to_path_buf);
        let of_source = || {
            let root = source.as_deref()?;
            Some(env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from))
        };
        let cache = env::var_os("BRINELL_CACHE").map(PathBuf::from).or_else(of_source).unwrap_or_else(cache_of_user);
        Self { source, cache: std::path::absolute(&cache).unwrap_or(cache), results: None, built: None }
    }

    /// The workspace with its source in this folder; what is made goes into its own `target`.
    pub fn at(source: &Path) -> Self {
        let target = source.join("target");
        Self { source: Some(source.to_path_buf()), cache: target.clone(), results: Some(target), built: None }
    }

    /// With the model library that cargo built along with this program: for programs that depend on the package
    /// `brinell-fmi`, whose library is then of the same source.
    pub fn with_library_beside(self) -> Self {
        let folder = env::current_exe().ok().and_then(|program| Some(program.parent()?.join("deps")));
        Self { built: folder, ..self }
    }

    /// Folder in which cargo put the model library that it built along with the program.
    pub fn built(&self) -> Option<&Path> {
        self.built.as_deref()
    }

    /// Root of the workspace's source, if it is there.
    pub fn source(&self) -> Option<&Path> {
        self.source.as_deref()
    }

    /// Folder for what is made once and used again.
    pub fn cache(&self) -> &Path {
        &self.cache
    }

    /// Folder for results of one kind, where the user names none: `target/<kind>` in the workspace, else the current
    /// folder; `demo`, which makes many files, gets a folder of its own in it.
    pub fn results(&self, kind: &str) -> PathBuf {
        match &self.results {
            Some(folder) => folder.join(kind),
            None if kind == "demo" => "brinell-demo".into(),
            None => PathBuf::new(),
        }
    }
}

/// The system's folder for files that a program can make again.
fn cache_of_user() -> PathBuf {
    let named = |variable: &str| env::var_os(variable).map(PathBuf::from).filter(|folder| folder.is_absolute());
    let home = || env::home_dir().filter(|home| home.is_absolute());
    let folder = if cfg!(windows) {
        named("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        home().map(|home| home.join("Library/Caches"))
    } else {
        named("XDG_CACHE_HOME").or_else(|| home().map(|home| home.join(".cache")))
    };
    folder.unwrap_or_else(env::temp_dir).join("brinell")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_user_finds_results_where_he_stands_and_nothing_else() {
        let user = Project::of_user();
        assert_eq!(user.results("fmu"), Path::new(""));
        assert_eq!(user.results("demo"), Path::new("brinell-demo"));
        assert!(user.cache().is_absolute());
        assert_eq!(Project::at(Path::new("/w")).results("fmu"), Path::new("/w/target/fmu"));
    }

    #[test]
    fn the_cache_without_a_source_is_the_users() {
        let folder = cache_of_user();
        assert!(folder.is_absolute() && folder.ends_with("brinell"), "{}", folder.display());
    }
}
