//! The file of which an FMU makes its model: a checked [`Scene`] in SI units, bit by bit.
//!
//! | bytes | hold |
//! |---|---|
//! | 8 | `BRNL-MDL` |
//! | 4 | version of the layout |
//! | 8 | checksum of the scene file, which lies beside it for people |
//! | … | the scene as postcard writes it: numbers with all their bits |
//! | 8 | checksum of all before |
//!
//! Numbers are little-endian. A measured crown's points are not in it: they come from the crown's own file, as the
//! traces of defects do.

use super::{Scene, SceneError};
use crate::numerics::bytes::Reader;
use crate::numerics::checksum::checksum;

const MARK: &[u8; 8] = b"BRNL-MDL";
/// Changes with every field of a [`Scene`] and of what it consists of.
const VERSION: u32 = 1;

/// A model file that does not give a model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelFileError {
    /// Something else, or a part of a file.
    #[error("it is no model file")]
    NoModel,
    /// Another version's.
    #[error("it has layout {0} and this library reads {VERSION}: resources and binary must come from one FMU")]
    Version(u32),
    /// Bytes that were changed.
    #[error("it is damaged: its checksum does not fit")]
    Damaged,
    /// A scene file that is not the one of which the model was made.
    #[error("it was not made of the scene file beside it, which was edited: build the FMU anew from the edited scene")]
    Edited,
    /// A scene that cannot exist: no check has passed it.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// The model file of a scene that was read from this text.
///
/// # Errors
/// Whatever [`Scene::check`] refuses.
pub fn encode(scene: &Scene, text: &str) -> Result<Vec<u8>, ModelFileError> {
    scene.check()?;
    let mut bytes = MARK.to_vec();
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend(checksum(text.as_bytes()).to_le_bytes());
    // Writing into a list fails for what has no length beforehand, and a scene has nothing of the kind.
    let mut bytes = postcard::to_extend(scene, bytes).map_err(|_| ModelFileError::NoModel)?;
    bytes.extend(checksum(&bytes).to_le_bytes());
    Ok(bytes)
}

/// The scene of a model file that was made of this text.
///
/// # Errors
/// What is no such file.
pub fn decode(bytes: &[u8], text: &str) -> Result<Scene, ModelFileError> {
    let content = bytes.len().checked_sub(8).filter(|_| bytes.starts_with(MARK));
    let (content, sum) = content.map(|end| bytes.split_at(end)).ok_or(ModelFileError::NoModel)?;
    let mut rest = Reader(&content[MARK.len().min(content.len())..]);
    let (version, of_text) = rest.u32().zip(rest.u64()).ok_or(ModelFileError::NoModel)?;
    if version != VERSION {
        return Err(ModelFileError::Version(version));
    }
    if checksum(content).to_le_bytes() != sum {
        return Err(ModelFileError::Damaged);
    }
    if of_text != checksum(text.as_bytes()) {
        return Err(ModelFileError::Edited);
    }
    match postcard::take_from_bytes::<Scene>(rest.0) {
        Ok((scene, [])) => scene.check().map(|()| scene).map_err(ModelFileError::Scene),
        _ => Err(ModelFileError::NoModel),
    }
}
