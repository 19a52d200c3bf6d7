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
const VERSION: u32 = 7;

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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::scene::{
        AxialSupport, Bearing, CageIrregularity, ContactEdge, ContactLaw, Damping, Defect, DefectOn, DefectShape,
        DegreesOfFreedom, DrawnDiameters, Film, Measured, MeasuredForm, MeasuredLevel, Motion, Recorder,
        RecorderFilter, Sensor, SensorMode, Waviness, WavyBody,
    };

    const TEXT: &str = "name = \"everything\"";

    /// Numbers that a text of decimals would hardly bring back: 0 below 0, the smallest there is, infinity.
    fn everything() -> [Scene; 2] {
        let mut balls = Scene::er16k();
        balls.description = "ü".to_owned();
        balls.gravity = [-0.0, 5e-324];
        balls.axial_gravity = -0.0;
        balls.bearing.degrees_of_freedom = DegreesOfFreedom::Five;
        balls.bearing.set_contact_angle(-1.0 / 3.0);
        balls.bearing.operating_angle = Some(0.1 + 0.2);
        (balls.bearing.shoulder_inner, balls.bearing.shoulder_outer) = (Some(1e-3 / 3.0), None);
        balls.contact.across_damping = Some(1.0 / 3.0);
        balls.shaft.axial = AxialSupport { load: -1.0 / 3.0, preload: 0.1 + 0.2, damping: 5e-324, stiffness: 0.0 };
        balls.shaft.tilt.load_moment = [-0.0, 1e3 / 3.0];
        balls.contact.damping = Damping::Proportional(0.1 + 0.2);
        balls.contact.largest_force = Some(1e3 / 3.0);
        balls.contact.cells = Some([48, 8]);
        balls.contact.law = ContactLaw::Love;
        balls.contact.edge = ContactEdge::Step;
        balls.film = Some(Film { viscosity: 0.04, pressure_viscosity: 2e-8, layer: None });
        let offsets = CageIrregularity::drawn_offsets(9, 1e-3, u64::MAX);
        balls.cage.irregularity =
            Some(CageIrregularity { offsets, drawn: Some(1e-3), jitter: 1e-3, wander: 2e-3, seed: u64::MAX });
        let (form, level) = (Some(MeasuredForm::Circle), Some(MeasuredLevel::Ends));
        let pit = DefectShape::Profile(Measured { file: "trace.csv".to_owned(), form, level, invert: true });
        balls.defects.push(Defect { on: DefectOn::Element { element: 8, tilt: -0.0 }, angle: 1.0 / 3.0, shape: pit });
        let mode = SensorMode { frequency: 2300.0, damping_ratio: 0.03, gain: -0.8, quadrature_gain: -0.0 };
        balls.sensors.push(Sensor {
            elevation: -0.0,
            modes: vec![mode; 2],
            name: "above".to_owned(),
            ..Sensor::default()
        });
        balls.housing_speed = Some(-0.0);
        balls.probe = true;
        balls.recorder = Some(Recorder { rate: 51_200.0, filter: RecorderFilter::None });
        let mut rollers = Scene::er16k();
        rollers.bearing = Bearing::steel_rollers(13, 7.5e-3, 9e-3, 38.5e-3);
        rollers.bearing.draw_diameters(DrawnDiameters { rms: 1e-6 / 3.0, seed: u64::MAX });
        rollers.waviness.push(Waviness { on: WavyBody::Outer, order: 7, amplitude: 1e-6 / 3.0, crest: -0.0 });
        (rollers.shaft.motion, rollers.shaft.load) = (Motion::Host, [0.0; 2]);
        [balls, rollers]
    }

    #[test]
    fn every_bit_of_a_scene_comes_back() {
        for scene in everything() {
            let bytes = encode(&scene, TEXT).unwrap();
            let read = decode(&bytes, TEXT).unwrap();
            assert_eq!(read, scene);
            // Equality takes 0 and -0 for the same; these bytes and this text do not.
            assert_eq!(encode(&read, TEXT).unwrap(), bytes);
            assert_eq!(format!("{read:?}"), format!("{scene:?}"));
        }
        assert!(everything()[1].bearing.conformity_inner.is_infinite());
    }

    /// Where this fails, fields have changed: a library would read another scene out of an older file. Give the layout
    /// a new version, and put in the sums of the new one.
    #[test]
    fn a_layout_belongs_to_its_version() {
        let sums = everything().map(|scene| checksum(&encode(&scene, TEXT).unwrap()));
        assert_eq!((VERSION, sums), (7, [14_635_938_185_123_794_837, 12_476_086_099_295_915_204]));
    }

    #[test]
    fn what_is_changed_cut_off_or_made_of_another_text_is_refused() {
        let [scene, _] = everything();
        let bytes = encode(&scene, TEXT).unwrap();
        assert_eq!(decode(&bytes, "name = \"other\""), Err(ModelFileError::Edited));
        for length in 0..bytes.len() {
            let refused = decode(&bytes[..length], TEXT);
            assert!(matches!(refused, Err(ModelFileError::NoModel | ModelFileError::Damaged)), "{length}: {refused:?}");
        }
        for at in 0..bytes.len() {
            let mut bytes = bytes.clone();
            bytes[at] ^= 0x10;
            assert!(decode(&bytes, TEXT).is_err(), "{at}");
        }
        // A sound sum over what is no scene, and over one that cannot exist.
        let with = |content: &[u8]| [content, &checksum(content).to_le_bytes()].concat();
        assert_eq!(decode(&with(&bytes[..40]), TEXT), Err(ModelFileError::NoModel));
        assert_eq!(decode(&with(&[&bytes[..bytes.len() - 8], &[0]].concat()), TEXT), Err(ModelFileError::NoModel));
        let mass = scene.shaft.mass.to_le_bytes();
        let at = bytes.windows(8).position(|bytes| bytes == mass).unwrap();
        let negative = [&bytes[..at], &(-1.0f64).to_le_bytes(), &bytes[at + 8..bytes.len() - 8]].concat();
        assert!(decode(&with(&negative), TEXT).unwrap_err().to_string().contains("shaft mass"));
        let mut impossible = scene;
        impossible.shaft.mass = f64::NAN;
        assert!(matches!(encode(&impossible, TEXT), Err(ModelFileError::Scene(_))));
    }
}
