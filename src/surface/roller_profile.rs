//! A measured crown of a roller: `axial_mm`, `depth_um`, one point a line with growing axial coordinate; 0 is the
//! roller's middle.
//!
//! Depths are counted from where the roller is thickest, which is 0: `bearing.element_diameter_mm` is the diameter
//! there. Between points the crown is straight.

use super::{SurfaceError, csv};
use crate::scene::{Crown, RollerProfile, RollingElement, Scene};

/// Deepest crown at 0.95 of the half length over the diameter: a deeper one is no cylinder's.
const DEEPEST: f64 = 0.01;
/// Part of the half length within which that holds.
const WITHIN: f64 = 0.95;

/// The scene with its roller's measured crown, if it names one. `profiles` are the texts of all files that it names, in
/// the order of [`Scene::profile_names`].
///
/// # Errors
/// A file that is missing or cannot be read, a crown that does not span the roller, is raised or too deep.
pub fn with_roller_profile<'p>(
    scene: &Scene,
    profiles: impl IntoIterator<Item = &'p str>,
) -> Result<Scene, SurfaceError> {
    let mut scene = scene.clone();
    let names: Vec<String> = scene.profile_names().into_iter().map(str::to_owned).collect();
    let diameter = scene.bearing.element_diameter;
    let RollingElement::CylindricalRoller(roller) = &mut scene.bearing.element else { return Ok(scene) };
    let RollerProfile::Measured(crown) = &mut roller.profile else { return Ok(scene) };
    let text = names.iter().zip(profiles).find(|(name, _)| **name == crown.name).map(|(_, text)| text);
    let text = text.ok_or_else(|| SurfaceError::no_crown(&crown.name))?;
    let refused = |why: String| SurfaceError::RollerProfile { name: crown.name.clone(), why };
    let points = read(text).map_err(|of| refused(of.to_string().trim_start_matches("defect ").to_owned()))?;
    let half = 0.5 * roller.length;
    let read = Crown { name: crown.name.clone(), points: points.into() };
    check(&read, half, diameter).map_err(refused)?;
    *crown = read;
    Ok(scene)
}

fn read(text: &str) -> Result<Vec<[f64; 2]>, SurfaceError> {
    let rows = csv::read(text, [super::topography::AXIAL, super::trace::DEPTH])?;
    if rows.len() < 2 {
        return Err(SurfaceError::TooFewPoints { found: rows.len(), column: super::topography::AXIAL });
    }
    for pair in rows.windows(2) {
        let (previous_mm, axial_mm) = (pair[0].values[0], pair[1].values[0]);
        if axial_mm <= previous_mm {
            return Err(SurfaceError::AxialNotAscending { line: pair[1].line, axial_mm, previous_mm });
        }
    }
    Ok(rows.iter().map(|row| [row.values[0] / 1e3, row.values[1] / 1e6]).collect())
}

/// What is wrong with a crown on a roller of this half length and diameter (m).
fn check(crown: &Crown, half: f64, diameter: f64) -> Result<(), String> {
    let ([from, _], [to, _]) = (crown.points[0], crown.points[crown.points.len() - 1]);
    if from > -WITHIN * half || to < WITHIN * half {
        let [from, to, wanted] = [from, to, WITHIN * half].map(|x| x * 1e3);
        return Err(format!(
            "it spans axial_mm from {from} to {to}: it must reach from -{wanted:.4} to {wanted:.4}, 0.95 of \
             bearing.roller_length_mm"
        ));
    }
    let least = crown.points.iter().fold(f64::INFINITY, |least, [_, depth]| least.min(*depth));
    if least != 0.0 {
        let least = least * 1e6;
        return Err(format!("its least depth_um is {least}: it must be 0, where the roller is thickest"));
    }
    let deepest = [-WITHIN * half, WITHIN * half].map(|x| crown.depth(x)).into_iter().fold(0.0, f64::max);
    if deepest > DEEPEST * diameter {
        let (deepest, limit) = (deepest * 1e6, DEEPEST * diameter * 1e6);
        return Err(format!(
            "it is {deepest:.3} um deep at 0.95 of the half length: it must be at most {limit:.3}, a hundredth of \
             bearing.element_diameter_mm"
        ));
    }
    Ok(())
}

/// For a scene whose crown is yet to be read.
pub(crate) fn unread(scene: &Scene) -> Option<&str> {
    match &scene.bearing.roller()?.profile {
        RollerProfile::Measured(crown) if !crown.is_read() => Some(&crown.name),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Bearing, Roller};
    use std::sync::Arc;

    fn scene() -> Scene {
        let crown = Crown { name: "crown.csv".to_owned(), points: Arc::default() };
        let roller = Roller { length: 9e-3, profile: RollerProfile::Measured(crown), laminae: 40 };
        let element = RollingElement::CylindricalRoller(roller);
        let bearing = Bearing { element, ..Bearing::steel_rollers(13, 7.5e-3, 9e-3, 39e-3) };
        Scene::builder(bearing).build().unwrap()
    }

    #[test]
    fn a_crown_is_read_between_its_points_and_held_beyond_them() {
        let text = "# a roller\naxial_mm,depth_um\n-4.4,8\n-2,0\n1,0\n4.4,3.4\n";
        let read = with_roller_profile(&scene(), [text]).unwrap();
        let RollerProfile::Measured(crown) = &read.bearing.roller().unwrap().profile else { panic!() };
        let depths = [-4.5e-3, -3.2e-3, 0.0, 2e-3, 4.5e-3].map(|x| crown.depth(x));
        for (found, expected) in depths.iter().zip([8e-6, 4e-6, 0.0, 1e-6, 3.4e-6]) {
            assert!((found - expected).abs() < 1e-15, "{depths:?}");
        }
        assert_eq!((unread(&read), unread(&scene())), (None, Some("crown.csv")));
    }

    #[test]
    fn a_crown_that_cannot_be_is_refused_with_its_file_and_limit() {
        let head = "axial_mm,depth_um\n";
        for (text, parts) in [
            ("", ["crown.csv", "empty"]),
            ("arc_mm,depth_um\n-5,0\n5,0\n", ["crown.csv", "arc_mm"]),
            (&format!("{head}-5,0\n-5,1\n5,0\n"), ["line 3", "axial_mm is -5"]),
            (&format!("{head}-5,1\n"), ["1 points", "at least 2"]),
            (&format!("{head}-5,1\n0,0\n3,1\n"), ["to 3:", "4.275"]),
            (&format!("{head}-5,1\n0,0.5\n5,1\n"), ["0.5", "must be 0"]),
            (&format!("{head}-5,1\n0,-0.5\n5,1\n"), ["-0.5", "must be 0"]),
            (&format!("{head}-5,100\n0,0\n5,1\n"), ["at most 75", "0.95"]),
        ] {
            let message = with_roller_profile(&scene(), [text]).unwrap_err().to_string();
            assert!(parts.iter().all(|part| message.contains(part)), "{message}");
        }
        let none: [&str; 0] = [];
        assert!(with_roller_profile(&scene(), none).unwrap_err().to_string().contains("crown.csv"));
    }
}
