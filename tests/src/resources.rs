//! An FMU's unpacked `resources/`.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::{env, fs};

use brinell::scene::model_file;
use brinell::simulation::interface::table::guid;

/// An unpacked `resources/` directory, deleted when dropped.
pub struct Resources {
    /// Where it is.
    pub directory: PathBuf,
    /// What a host passes as GUID or instantiation token.
    pub guid: String,
}

/// Where tests write: Cargo's `tmp` beside the folders of the profiles.
pub fn scratch() -> PathBuf {
    let program = env::current_exe().unwrap_or_default();
    program.ancestors().nth(3).map_or_else(env::temp_dir, Path::to_owned).join("tmp")
}

static NUMBER: AtomicU32 = AtomicU32::new(0);

impl Resources {
    /// The resources of a scene in `scenes/`, with the law that needs no contact map.
    pub fn of(scene: &str) -> Self {
        Self::named(scene, "resources")
    }

    /// The same in a directory whose name the test chooses.
    pub fn named(scene: &str, name: &str) -> Self {
        Self::edited(scene, name, |text| text)
    }

    /// The same with a change to the scene's text.
    pub fn edited(scene: &str, name: &str, edit: impl FnOnce(String) -> String) -> Self {
        let scenes = crate::root().join("scenes");
        let text = fs::read_to_string(scenes.join(format!("{scene}.toml"))).unwrap();
        // Computing a contact map takes seconds.
        let text = edit(text.replace("law = \"map\"", "law = \"hertz\""));
        let profile =
            text.lines().find_map(|line| Some(line.strip_prefix("profile = \"")?.split('"').next()?.to_owned()));
        let profile = profile.map(|file| (fs::read_to_string(scenes.join(&file)).unwrap(), file));
        Self::new(&text, profile.as_ref().map(|(text, file)| (file.as_str(), text.as_str())), name)
    }

    /// Resources made of a scene's text and a profile.
    pub fn new(scene: &str, profile: Option<(&str, &str)>, name: &str) -> Self {
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let unique = format!("resources-{}-{number}", std::process::id());
        let directory = scratch().join(unique).join(name);
        fs::create_dir_all(&directory).unwrap();
        fs::write(directory.join("scene.toml"), scene).unwrap();
        let model = model_file::encode(&brinell_scene_file::from_toml(scene).unwrap(), scene).unwrap();
        fs::write(directory.join("model.bin"), model).unwrap();
        if let Some((file, text)) = profile {
            fs::write(directory.join(file), text).unwrap();
        }
        Self { directory, guid: guid(scene, profile.map(|(_, text)| text)) }
    }

    /// With a contact map beside it.
    pub fn with_map(self, map: &[u8]) -> Self {
        fs::write(self.directory.join("map.bin"), map).unwrap();
        self
    }

    /// The location as a URI with every odd byte escaped.
    pub fn uri(&self) -> String {
        let path = self.directory.to_str().unwrap();
        let plain = |byte: &u8| byte.is_ascii_alphanumeric() || b"/-_.~:".contains(byte);
        let escape = |byte: u8| if plain(&byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") };
        format!("file://{}", path.bytes().map(escape).collect::<String>())
    }
}

impl Drop for Resources {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(self.directory.parent().unwrap());
    }
}
