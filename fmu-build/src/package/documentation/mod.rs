//! `documentation/index.html`: what a user of the FMU reads. Its text is `assets/documentation.html`, filled in here by
//! what the scene and the variable table say.

mod coupling;
mod variables;

use anyhow::Result;
use brinell::scene::{
    Bearing, ContactEdge, Damping, Defect, DefectOn, DefectShape, DegreesOfFreedom, Film, Motion, Ring, RollerProfile,
    Scene, Sensor, Waviness, WavyBody,
};
use brinell::simulation::Method;
use minijinja::context;
use quick_xml::escape::escape;

use super::model::{Model, remarks};
use super::template::render;
use crate::shared::{Interface, Version, digits};
use variables::variables;

/// Axes, angles and signs.
const SIGNS: &str = include_str!("../../../../docs/figures/signs.svg");
const PAGE: &str = include_str!("../../../assets/documentation.html");

/// Writes the page.
///
/// # Errors
/// Of the page's template.
pub fn write(model: &Model, interface: impl Into<Interface>) -> Result<String> {
    let interface = interface.into();
    let version = interface.version;
    let scene = &model.scene;
    let filled = context! {
        name => &scene.name,
        description => &scene.description,
        program => env!("CARGO_PKG_VERSION"),
        fmi => version.number(),
        facts => facts(scene),
        freedom => scene.bearing.degrees_of_freedom.count(),
        signs => SIGNS,
        remarks => remarks(&model.scene_text, scene).map(|remark| remark.to_string()).collect::<Vec<_>>(),
        hosted => scene.shaft.motion == Motion::Host || scene.housing.motion == Motion::Host,
        derivative => match version {
            Version::Fmi2 => "fmi2GetRealOutputDerivatives",
            Version::Fmi3 => "fmi3GetOutputDerivatives",
        },
        coupling => coupling::of(model),
        methods => Method::automatic_in_words(),
        variables => variables(&model.simulation, interface),
        exchanges => interface.exchanges(),
        steps => interface.steps(),
        scene => &model.scene_text,
    };
    render("index.html", PAGE, filled)
}

/// What the scene says, as rows of words and HTML.
fn facts(scene: &Scene) -> Vec<(&'static str, String)> {
    let bearing = &scene.bearing;
    let (_, law) = scene.contact.law.described();
    let law = match scene.contact.edge {
        ContactEdge::HalfSpace => law.to_owned(),
        ContactEdge::Step => format!("{law}; sharp edges as soft as steps of their depth"),
    };
    let damping = match scene.contact.damping {
        Damping::HuntCrossley(chi) => format!("Hunt and Crossley, χ = {chi} s/m"),
        Damping::Proportional(tau) => format!("proportional to stiffness, τ = {tau} s"),
    };
    let defects: Vec<(&str, String)> = scene.defects.iter().map(defect_row).collect();
    let healthy = [("Defect", "none".to_owned())];
    let defects = if defects.is_empty() { &healthy[..] } else { &defects };
    let in_space = bearing.degrees_of_freedom != DegreesOfFreedom::Two;
    let mut rows = elements(bearing);
    let offsets = bearing.diameter_offsets.iter().map(|offset| digits(offset * 1e6)).collect::<Vec<_>>();
    rows.extend(
        (!offsets.is_empty()).then(|| ("Diameters beyond that, by element", format!("{} µm", offsets.join(", ")))),
    );
    rows.extend([
        ("Radial clearance", format!("{} µm", digits(bearing.radial_clearance * 1e6))),
        ("Contact law near the defect", law),
        ("Contact damping", damping),
    ]);
    rows.extend(scene.film.as_ref().map(|film| ("Oil", oil(film))));
    rows.extend(defects.iter().cloned());
    rows.extend(scene.waviness.iter().map(waves_row));
    rows.extend([
        ("Shaft (inner ring)", ring(&scene.shaft, in_space)),
        ("Shaft speed at the start", format!("{} Hz", digits(scene.shaft_speed / std::f64::consts::TAU))),
        ("Housing (outer ring)", ring(&scene.housing, in_space)),
        ("Accelerometers", accelerometers(scene)),
        ("Default run", format!("{} s in steps of {} s", scene.experiment.stop, scene.experiment.step)),
    ]);
    rows
}

/// Rolling elements and their circle.
fn elements(bearing: &Bearing) -> Vec<(&'static str, String)> {
    let mm = |length: f64| format!("{} mm", digits(length * 1e3));
    let pitch = ("Pitch diameter", mm(bearing.pitch_diameter));
    let Some(roller) = bearing.roller() else {
        let conformities = format!("{}, {}", digits(bearing.conformity_inner), digits(bearing.conformity_outer));
        return vec![
            ("Rolling elements", format!("{} balls", bearing.element_count)),
            ("Ball diameter", mm(bearing.element_diameter)),
            pitch,
            ("Groove conformity, inner and outer", conformities),
        ];
    };
    let profile = match &roller.profile {
        RollerProfile::Straight => "straight".to_owned(),
        RollerProfile::Logarithmic => "logarithmic crown of ISO/TS 16281".to_owned(),
        RollerProfile::Measured(crown) => format!("<code>resources/{}</code>", escape(&crown.name)),
    };
    vec![
        ("Rolling elements", format!("{} cylindrical rollers", bearing.element_count)),
        ("Roller diameter", mm(bearing.element_diameter)),
        ("Effective roller length", mm(roller.length)),
        ("Roller profile", format!("{profile}, {} laminae", roller.laminae)),
        pitch,
    ]
}

/// What oil there is.
fn oil(film: &Film) -> String {
    let Film { viscosity, pressure_viscosity, layer } = film;
    let layer = layer.map_or("every gap".to_owned(), |layer| format!("gaps up to {} µm", digits(layer * 1e6)));
    format!("viscosity {viscosity} Pa s, its pressure coefficient {pressure_viscosity:e} 1/Pa; it fills {layer}")
}

/// Directions of the accelerometers.
fn accelerometers(scene: &Scene) -> String {
    let along = |sensor: &Sensor| {
        let name = if sensor.name.is_empty() { String::new() } else { format!("{}: ", escape(&sensor.name)) };
        format!("{name}along {}", degrees(sensor.direction))
    };
    let all: Vec<String> = scene.sensors.iter().map(along).collect();
    if all.is_empty() { "none".to_owned() } else { format!("on the housing, {}", all.join("; ")) }
}

/// What has a defect, and what it is.
fn defect_row(defect: &Defect) -> (&'static str, String) {
    let on = match defect.on {
        DefectOn::Outer => "Defect of the outer raceway",
        DefectOn::Inner => "Defect of the inner raceway, which turns with the shaft",
        DefectOn::Element { .. } => "Defect of a rolling element, angle from where it faces outwards",
    };
    let element = match defect.on {
        DefectOn::Element { element, .. } => format!("element {}: ", element + 1),
        _ => String::new(),
    };
    let (angle, shape) = (
        degrees(defect.angle),
        match defect.shape {
            DefectShape::Spall { length, depth, edge_slope } => format!(
                "{} mm long, {} µm deep, edges of {}",
                digits(length * 1e3),
                digits(depth * 1e6),
                degrees(edge_slope)
            ),
            DefectShape::Profile(ref measured) => format!("<code>resources/{}</code>", escape(&measured.file)),
        },
    );
    let what = if matches!(defect.shape, DefectShape::Profile(_)) { "profile" } else { "spall" };
    (on, format!("{element}{what} at {angle}, {shape}"))
}

/// Waves of one order around a body.
fn waves_row(waves: &Waviness) -> (&'static str, String) {
    let of = match waves.on {
        WavyBody::Outer => "outer raceway".to_owned(),
        WavyBody::Inner => "inner raceway, which turns with the shaft".to_owned(),
        WavyBody::Element(element) => format!("element {}, angle from where it faces outwards", element + 1),
    };
    let (order, height) = (waves.order, digits(waves.amplitude * 1e6));
    ("Waviness", format!("{of}: order {order}, {height} µm, a crest at {}", degrees(waves.crest)))
}

fn ring(ring: &Ring, in_space: bool) -> String {
    let axial = ring.axial;
    match ring.motion {
        Motion::Host => "moved by the host".to_owned(),
        Motion::Fixed => "stands".to_owned(),
        Motion::Internal if in_space => format!(
            "moves freely: {} kg, {} N s/m, {} N/m to ground, along z {} N s/m, {} N/m, loaded by ({}, {}, {}) N and a \
             preload spring of {} N",
            ring.mass,
            ring.damping,
            ring.stiffness,
            axial.damping,
            axial.stiffness,
            ring.load[0],
            ring.load[1],
            axial.load,
            axial.preload
        ),
        Motion::Internal => format!(
            "moves freely: {} kg, {} N s/m, {} N/m to ground, loaded by ({}, {}) N",
            ring.mass, ring.damping, ring.stiffness, ring.load[0], ring.load[1]
        ),
    }
}

fn degrees(angle: f64) -> String {
    format!("{}°", digits(angle.to_degrees()))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn page(scene: &str) -> String {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/");
        write(&Model::read(&std::path::Path::new(path).join(scene).with_extension("toml")).unwrap(), Version::Fmi2)
            .unwrap()
    }

    #[test]
    fn bearings_in_space_say_so() {
        let [plane, three, five] = ["6205-epps", "7205-preloaded", "7205-inner"].map(page);
        assert!(plane.contains("they move in the plane") && !plane.contains("moves along its axis"));
        for text in [&three, &five] {
            assert!(!text.contains("they move in the plane") && text.contains("moves along its axis"));
            assert!(text.contains("preload spring of"));
        }
        assert!(!three.contains("and tilts") && five.contains("and tilts"));
    }

    #[test]
    fn the_page_names_the_methods_that_step() {
        assert!(page("6205-healthy").contains(&Method::automatic_in_words()));
    }

    #[test]
    fn the_page_of_a_hosted_ring_says_which_force_is_for_which_algorithm() {
        let page = page("6205-hosted");
        // The rule with this scene's own steps. Statics give 1.064e8 N/m under 1000 N
        // (`brinell stiffness 6205-healthy`); between rings of 3.2638 and 6.638 kg ω is 6.97e3 1/s, and 0.1/ω is
        // 14.3 µs.
        for row in ["<td>14 µs</td>", "<code>next_mean_force</code>", "<code>mean_force</code>"] {
            assert!(page.contains(row), "{row}");
        }
        // A ring that moves under forces is wired to no algorithm.
        assert!(!self::page("6205-healthy").contains("next_mean_force"));
    }

    #[test]
    fn the_page_says_how_many_balls_there_are() {
        assert!(page("6205-healthy").contains("<td>9 balls</td>"));
    }

    #[test]
    fn the_page_of_two_defects_has_both() {
        let page = page("6205-two-defects");
        for number in ["defect[1].angle", "defect[2].angle"] {
            assert!(page.contains(number), "{number}");
        }
    }
}
