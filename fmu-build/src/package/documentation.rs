//! `documentation/index.html`: what a user of the FMU reads. Generated from the scene and the variable table.

mod variables;

use std::fmt::Write;

use brinell::scene::{
    Bearing, ContactEdge, Damping, Defect, DefectOn, DefectShape, Film, Motion, Ring, RollerProfile, Scene, Sensor,
};
use brinell::simulation::Method;
use brinell::simulation::interface::table::Causality;
use quick_xml::escape::escape;

use super::model::{Model, remarks};
use crate::shared::Version;
use crate::shared::digits;
use variables::{listed, variables};

/// What the model leaves out, in one place for every reader.
pub const LIMITS: [&str; 8] = [
    "Rolling elements are balls or cylindrical rollers. Rollers do not tilt and carry no axial load; their law was \
     measured on steel.",
    "One defect, on a raceway or on a rolling element; a defective ball turns about an axis parallel to the bearing's.",
    "Love's half-space at a vertical edge ignores the corner's own compliance unless the scene has \
     <code>contact.edge = \"step\"</code>: at the edge of a spall 100 µm deep the \
     force is 12 to 16 % too large, of one 15 to 30 µm deep 2 to 5 %, and the pressure at the edge diverges.",
    "The earlier law <code>hertz</code> overstates the force at an edge: Love gives 0.84 to 0.86 of it there, and 0.53 \
     to 0.6 near unloading.",
    "Rings are rigid; they move in the plane, without tilting.",
    "Material stays elastic: no plasticity.",
    "Contacts are dry, unless the scene has an oil film: one of an even temperature, pressed out of gaps before \
     contacts begin, and taken off the clearance.",
    "The cage is kinematic: it keeps the elements apart and has no dynamics; elements do not slip tangentially.",
];

const STYLE: &str = "body{font:16px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 \
                     1rem;color:#1a1a1a}\
    table{border-collapse:collapse;width:100%;margin:1rem 0}th,td{text-align:left;padding:.25rem .6rem;\
    border-bottom:1px solid #ccc;vertical-align:top}th{border-bottom:2px solid #666}td.n{white-space:nowrap}\
    pre{background:#f4f4f4;padding:1rem;overflow:auto}code{font-size:.95em}";

/// The equations of motion, for a reader who wants to know what is computed.
const EQUATIONS: &str = "<p>For each element u is its path, ρ the distance of its centre from the outer ring's, w its \
                         absolute radial velocity, e<sub>r</sub> and e<sub>t</sub> its radial and tangential \
                         directions, ω the cage's speed, q the way from the inner ring's centre to its own and n = \
                         q/|q|; v<sub>i</sub>, v<sub>o</sub> are the rings' velocities.</p>\n\
    <pre>u' = w − e_r·v_o\n\
    w' = (Q_i n·e_r − F_r)/m + g·e_r + ω (v_o·e_t + ρ ω)\n\
    δ_i = R_i + r − |q|,   Q = Q_e max(0, 1 + χ δ') or max(0, Q_e + τ δ' dQ_e/dδ)\n\
    Q_e = K δ^1.5 of a ball, K δ^(10/9) c(δ) of a roller, c the part of its length that its crown lets carry\n\
    m_i x_i'' = F_i − Σ Q_i n − c_i v_i − k_i x_i\n\
    m_o x_o'' = F_o + Σ (F_r e_r − F_t e_t) − c_o v_o − k_o x_o + f_s,   m_s y_s'' = −f_s</pre>\n\
    <p>F<sub>r</sub> and F<sub>t</sub> are what the outer raceway exerts on an element. On the smooth raceway the \
    approach is u; near a defect, on either raceway or on the element, it is an equivalent one, Δ(approach, angle), of \
    the contact law above, and the force turns with the surface.</p>\n";

/// The coupling errors that the guide has measured; `masters` finds them.
const GUIDE: &str = include_str!("../../../docs/guide.md");
/// How their table begins.
const MASTERS: &str = "| bearing | master | the rotor is told |";

/// Writes the page.
pub fn write(model: &Model, version: Version) -> String {
    let scene = &model.scene;
    let (name, description) = (escape(&scene.name), escape(&scene.description));
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{name}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>{name}</h1>\n<p>{description}</p>\n<p>Made by Brinell {}. \
         A rolling bearing as an FMI {} co-simulation unit: x to the right, y up, angles counter-clockwise from +x, \
         SI units throughout.</p>\n",
        env!("CARGO_PKG_VERSION"),
        version.number()
    );
    page.push_str("<h2>The bearing</h2>\n");
    facts(&mut page, scene);
    for remark in remarks(&model.scene_text, scene) {
        line(&mut page, format_args!("<p>Note: {remark}.</p>"));
    }
    page.push_str("<h2>Coupling</h2>\n");
    coupling(&mut page, scene, version);
    page.push_str("<h2>Equations</h2>\n");
    page.push_str(EQUATIONS);
    line(
        &mut page,
        format_args!(
            "<p>Time is integrated under error control by {}. Steps end where a contact begins or ends and where an \
             element enters another part of the defect.</p>",
            Method::automatic_in_words()
        ),
    );
    page.push_str("<h2>Variables</h2>\n");
    for kind in [Causality::Input, Causality::Parameter, Causality::Output, Causality::Local] {
        variables(&mut page, &listed(&model.simulation, version), kind);
    }
    page.push_str("<h2>What is not modelled</h2>\n<ul>\n");
    for limit in LIMITS {
        line(&mut page, format_args!("<li>{limit}</li>"));
    }
    line(
        &mut page,
        format_args!(
            "</ul>\n<h2>The scene file</h2>\n<p><code>resources/scene.toml</code>, for people; the library reads \
             <code>resources/model.bin</code>, made of it.</p>\n<pre>{}</pre>",
            escape(&model.scene_text)
        ),
    );
    page.push_str(
        "<h2>Licence</h2>\n<p>MIT or Apache-2.0, at your option: <a href=\"licenses/license.txt\">licenses</a>.</p>\n\
         </body>\n</html>\n",
    );
    page
}

fn facts(page: &mut String, scene: &Scene) {
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
    let mut rows = elements(bearing);
    rows.extend([
        ("Radial clearance", format!("{} µm", digits(bearing.radial_clearance * 1e6))),
        ("Contact law near the defect", law),
        ("Contact damping", damping),
    ]);
    rows.extend(scene.film.as_ref().map(|film| ("Oil", oil(film))));
    rows.extend(defects.iter().cloned());
    rows.extend([
        ("Shaft (inner ring)", ring(&scene.shaft)),
        ("Shaft speed at the start", format!("{} Hz", digits(scene.shaft_speed / std::f64::consts::TAU))),
        ("Housing (outer ring)", ring(&scene.housing)),
        ("Accelerometers", accelerometers(scene)),
        ("Default run", format!("{} s in steps of {} s", scene.experiment.stop, scene.experiment.step)),
    ]);
    page.push_str("<table>\n");
    for (what, value) in rows {
        line(page, format_args!("<tr><th>{what}</th><td>{value}</td></tr>"));
    }
    page.push_str("</table>\n");
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

/// What bears a defect, and what it is.
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
            DefectShape::Profile(ref file) => format!("<code>resources/{}</code>", escape(file)),
        },
    );
    let what = if matches!(defect.shape, DefectShape::Profile(_)) { "profile" } else { "spall" };
    (on, format!("{element}{what} at {angle}, {shape}"))
}

fn ring(ring: &Ring) -> String {
    match ring.motion {
        Motion::Host => "moved by the host".to_owned(),
        Motion::Fixed => "stands".to_owned(),
        Motion::Internal => format!(
            "moves freely: {} kg, {} N s/m, {} N/m to ground, loaded by ({}, {}) N",
            ring.mass, ring.damping, ring.stiffness, ring.load[0], ring.load[1]
        ),
    }
}

fn coupling(page: &mut String, scene: &Scene, version: Version) {
    page.push_str(
        "<p>The start is the static equilibrium of the start values. Communication steps may have any positive \
         length and may differ; the solver's own steps are shorter and end on each communication point.</p>\n",
    );
    page.push_str(
        "<p>The state can be saved, put back and serialized, so steps may be iterated. Directional derivatives of \
         every real output by every input are given: at a communication point with the states as they are, in \
         initialization mode through the static equilibrium. Derivatives of outputs by time are given of order 1",
    );
    page.push_str(match version {
        Version::Fmi2 => ", those of inputs are taken of orders 1 and 2.</p>\n",
        Version::Fmi3 => {
            ". Adjoint derivatives are given where directional ones are. A host that asks for intermediate updates is \
             called after each of the solver's steps: it may read outputs there, set inputs that act from there on, \
             and end the step there or at a later instant.</p>\n"
        }
    });
    if scene.shaft.motion == Motion::Host || scene.housing.motion == Motion::Host {
        let derivative = match version {
            Version::Fmi2 => "fmi2GetRealOutputDerivatives",
            Version::Fmi3 => "fmi3GetOutputDerivatives",
        };
        line(
            page,
            format_args!(
                "<p>This host moves a ring. Give position, velocity and, if it is known, acceleration: inputs are \
             continued by them inside the step. Which force the ring's body is to be told depends on the master. One \
             that steps the FMU first gives the body <code>mean_force</code> over the same step. One that steps all \
             units in parallel gives it <code>force</code> with its derivative, from \
             <code>{derivative}</code>; <code>mean_force</code> would come a step late there. Error of \
             a rotor of 3 kg by the communication step, rms over rms of its motion:</p>"
            ),
        );
        masters(page);
    }
}

/// The guide's table of masters, as HTML.
fn masters(page: &mut String) {
    page.push_str("<table>\n");
    let rows = GUIDE.lines().skip_while(|row| !row.starts_with(MASTERS)).take_while(|row| row.starts_with('|'));
    for (index, row) in rows.filter(|row| !row.starts_with("|---")).enumerate() {
        let cell = if index == 0 { "th" } else { "td" };
        let cells = row.trim_matches('|').split('|').map(|text| {
            // Words between grave accents are code.
            let mut parts = text.trim().split('`');
            let plain = parts.next().unwrap_or_default().to_owned();
            let text = parts.enumerate().fold(plain, |text, (i, part)| {
                if i % 2 == 0 { format!("{text}<code>{part}</code>") } else { text + part }
            });
            format!("<{cell}>{}</{cell}>", text.replace("> 1", "&gt; 1"))
        });
        line(page, format_args!("<tr>{}</tr>", cells.collect::<String>()));
    }
    page.push_str("</table>\n");
}

fn line(page: &mut String, text: std::fmt::Arguments<'_>) {
    // Writing to a String cannot fail.
    let _ = writeln!(page, "{text}");
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
    }

    #[test]
    fn the_page_names_the_methods_that_step() {
        let page = page("6205-healthy");
        for method in [
            "phase-fitted pair of order 4(3)",
            "Dormand and Prince of order 5(4)",
            "Rodas5P, linearly implicit, of order 5(4)",
        ] {
            assert!(page.contains(method), "{method} is not named");
        }
        assert!(!page.contains("Runge–Kutta method of order 5"));
    }

    #[test]
    fn the_page_of_a_hosted_ring_says_which_force_is_for_which_master() {
        let page = page("6205-hosted");
        // Both bearings by seven masters, below one heading.
        let rows: Vec<&str> =
            page.lines().filter(|row| row.starts_with("<tr><t") && row.contains(" µs</th>")).collect();
        assert_eq!(rows.len(), 1, "{rows:?}");
        for (master, count) in [("<td>parallel</td>", 8), ("<td>sequential</td>", 6)] {
            assert_eq!(page.matches(master).count(), count, "{master}");
        }
        assert!(page.contains("<td><code>mean_force</code>, held</td>"));
        // A ring that moves under forces is wired to no master.
        assert!(!self::page("6205-healthy").contains("<td>parallel</td>"));
    }

    #[test]
    fn the_page_says_balls_and_outer_raceway() {
        let page = page("6205-healthy");
        assert!(page.contains("<td>9 balls</td>") && page.contains("Rolling elements are balls or"));
        assert!(page.contains("One defect, on a raceway or on a rolling element"));
    }
}
