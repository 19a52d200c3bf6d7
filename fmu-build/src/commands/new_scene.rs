//! The command `new`: a commented scene of a bearing of the catalogue that runs as it is, or a sweep's file.

use std::path::Path;
use std::str::FromStr;

use anyhow::{Context, Result, bail};
use brinell::geometry::load_rating::load_ratings;
use brinell::scene::{Bearing, Scene, TiltSupport};
use brinell::simulation::setup::largest_force;
use brinell_scene_file::{Designation, designation, unit_questions};
use minijinja::context;

use super::schema;
use crate::package::model::ask_unit;
use crate::package::render;
use crate::shared::{note, whole_file};

/// Share of the static load rating that a new scene's bearing carries.
const LOAD_SHARE: f64 = 0.05;
/// What `--defect` says: on which body, and how long.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Spall {
    on: &'static str,
    length: f64,
    unit: &'static str,
}

impl FromStr for Spall {
    type Err = String;

    /// From `inner:1.2mm` or `outer:5deg`.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong =
            || format!("{text:?} is no defect: outer, inner or element, a colon, a length in mm or deg: inner:1.2mm");
        let (on, length) = text.split_once(':').ok_or_else(wrong)?;
        let on = ["outer", "inner", "element"].into_iter().find(|body| *body == on.trim()).ok_or_else(wrong)?;
        let length = length.trim();
        let unit = ["mm", "deg"].into_iter().find(|unit| length.ends_with(unit)).ok_or_else(wrong)?;
        let length: f64 = length.trim_end_matches(unit).trim().parse().map_err(|_| wrong())?;
        if length.is_finite() && length > 0.0 { Ok(Self { on, length, unit }) } else { Err(wrong()) }
    }
}

/// What a new scene is to be.
#[derive(Debug, Default, Clone, Copy)]
pub(crate) struct Asked<'a> {
    pub(crate) spall: Option<&'a Spall>,
    /// Load across the axis (N).
    pub(crate) load: Option<f64>,
    /// Load along the axis (N).
    pub(crate) axial: Option<f64>,
    /// In how many directions rings move.
    pub(crate) freedom: Option<u8>,
    /// Whether a host moves the shaft.
    pub(crate) hosted: bool,
}

/// The scene of a bearing that is nowhere written down; what its name says is noted.
pub(crate) fn unwritten(bearing: &str, asked: Asked) -> Result<String> {
    let read = named(bearing)?;
    text(&unnamed(&read, asked), bearing, &read, asked)
}

/// The bearing of this name. What the name says beside the bearing's own is noted.
pub(crate) fn named(name: &str) -> Result<Designation> {
    let read = designation(name)?;
    if let Some(said) = read.remark() {
        note!("note: {}: {said}", name.trim());
    }
    Ok(read)
}

/// Name of a scene that is given none.
fn unnamed(read: &Designation, asked: Asked) -> String {
    // A name has no points: 1.2 mm are 1_2mm.
    let of_spall = |Spall { on, length, unit }: &Spall| format!("{on}-{length}{unit}").replace('.', "_");
    let designation = read.bearing.designation.to_lowercase();
    format!("{designation}-{}", asked.spall.map_or("healthy".to_owned(), of_spall))
}

/// A bearing of the catalogue without a spall, of whose rig nothing is known, under this load (N).
///
/// # Errors
/// A name that is none, and a load that none can be.
pub fn without_rig(bearing: &str, load: Option<f64>) -> Result<Scene> {
    let mut scene = brinell_scene_file::from_toml(&unwritten(bearing, Asked::default())?)?;
    scene.sensors.clear();
    match load {
        Some(load) if !(load.is_finite() && load > 0.0) => bail!("--load {load} N: it must be finite and above 0"),
        Some(load) => {
            ask_unit(&scene.bearing, "shaft.load_n", load, "--load");
            scene.shaft.load = [0.0, -load];
        }
        None => note!(
            "note: {bearing}: a load of {:.0} N is assumed, 5 % of the static rating; --load gives the real one",
            scene.shaft.load[1].abs()
        ),
    }
    Ok(scene)
}

/// The command: writes `<folder>/<name>.toml`.
pub(crate) fn command(name: Option<&str>, bearing: &str, asked: Asked, folder: &Path) -> Result<()> {
    let read = named(bearing)?;
    let unnamed = unnamed(&read, asked);
    let name = name.unwrap_or(&unnamed);
    let text = text(name, bearing, &read, asked)?;
    brinell_scene_file::from_toml(&text)
        .with_context(|| format!("a scene {name} of this bearing and defect is not possible"))?;
    for question in unit_questions(&text) {
        note!("note: {name}.toml: {question}");
    }
    whole_file::write_own(&folder.join(format!("{name}.toml")), &text)?;
    schema::write_beside(folder)
}

/// The command with `--sweep`: writes a sweep's file with every key.
pub(crate) fn sweep(name: &str, folder: &Path) -> Result<()> {
    whole_file::write_own(&folder.join(format!("{name}.toml")), include_str!("../../../examples/sweep.toml"))
}

/// The bearing that a scene gets by a name alone.
pub(crate) fn bearing_of(called: &str, read: &Designation) -> Result<Bearing> {
    let freedom = if read.bearing.inside.contact_angle.is_some() { 3 } else { 2 };
    let keys = format!("catalogue = {}\ndegrees_of_freedom = {freedom}", quoted(called));
    let rings = "[shaft]\nmotion = \"host\"\nspeed_hz = 0\n[housing]\nmotion = \"fixed\"\n";
    Ok(brinell_scene_file::from_toml(&format!("name = \"bearing\"\n[bearing]\n{keys}\n{rings}"))?.bearing)
}

/// A name as a value of TOML, without blanks that nobody sees.
fn quoted(called: &str) -> String {
    toml::Value::String(called.split_whitespace().collect::<Vec<_>>().join(" ")).to_string()
}

/// What the rings carry (N), and what is said of it.
struct Loads {
    across: f64,
    across_source: String,
    axial: Option<f64>,
    axial_source: &'static str,
    freedom: u8,
}

impl Loads {
    fn of(bearing: &Bearing, read: &Designation, asked: Asked) -> Result<Self> {
        let Asked { load, axial, freedom, .. } = asked;
        if let Some(load) = load.filter(|load| !(load.is_finite() && *load > 0.0)) {
            bail!("--load {load} N: it must be finite and above 0");
        }
        if let Some(axial) = axial.filter(|axial| !axial.is_finite() || *axial == 0.0) {
            bail!("--axial {axial} N: it must be finite and other than 0");
        }
        let rating = load_ratings(bearing).fixed;
        let share = (LOAD_SHARE * rating / 10.0).round().max(1.0) * 10.0;
        let (across, across_source) = match load {
            Some(load) => (load, "as asked for".to_owned()),
            None => (share, format!("assumed: 5 % of the static rating, {:.1} kN by ISO 76", 1e-3 * rating)),
        };
        // A contact that leans lifts a ring that nothing pushes along the axis, or that is pushed the other way.
        let leans = read.bearing.inside.contact_angle.is_some();
        if let Some(axial) = axial.filter(|axial| leans && *axial < 0.0) {
            bail!(
                "--axial {axial} N: a {} carries thrust one way only: it must be above 0; in the scene a negative \
                 bearing.contact_angle_deg turns the bearing round",
                read.bearing.designation
            );
        }
        // Of a hosted ring the file has no load to ask about, and of others the size of all of it.
        if let Some(load) = load.filter(|_| asked.hosted) {
            ask_unit(bearing, "shaft.load_n", load, "--load");
        }
        if let Some(axial) = axial {
            ask_unit(bearing, "shaft.load_n", axial, "--axial");
        }
        let (axial, axial_source) = match axial {
            Some(axial) => (Some(axial), "as asked for"),
            None if leans => (Some(across), "as much along the axis, assumed"),
            None if !asked.hosted && freedom.is_some_and(|freedom| freedom > 2) => {
                (Some(0.1 * across), "a tenth of it along the axis, assumed: nothing else holds the shaft there")
            }
            None => (None, ""),
        };
        let freedom = freedom.unwrap_or(if axial.is_some() { 3 } else { 2 });
        if let (2, Some(axial)) = (freedom, axial) {
            bail!("--degrees-of-freedom 2 with {axial} N along the axis: it must be 3 or 5");
        }
        Ok(Self { across, across_source, axial, axial_source, freedom })
    }

    /// Force (N) that contacts are prepared for under these loads.
    fn largest_force(&self, bearing: &Bearing) -> Result<f64> {
        let mut scene = Scene::builder(Bearing::steel_balls(9, 8e-3, 40e-3)).build()?;
        scene.bearing = bearing.clone();
        scene.shaft.load = [0.0, -self.across];
        scene.shaft.axial.load = self.axial.unwrap_or(0.0);
        Ok(largest_force(&scene))
    }
}

fn text(name: &str, called: &str, read: &Designation, asked: Asked) -> Result<String> {
    let Asked { spall, hosted, .. } = asked;
    let (designation, inside) = (read.bearing.designation, read.bearing.inside);
    let bearing = bearing_of(called, read)?;
    let loads = Loads::of(&bearing, read, asked)?;
    let source = inside.source.unwrap_or("assumed: estimated from bore and outside diameter; put in what you know");
    // One shoulder of an angular contact bearing is high, and the other cut away.
    let share = if inside.contact_angle.is_some() { 0.3 } else { 0.2 };
    let what =
        spall.map_or("healthy".to_owned(), |Spall { on, length, unit }| format!("spall of {length} {unit}, {on}"));
    let defect = |&Spall { on, length, unit }: &Spall| context! { on, unit, length => format!("{length:?}") };
    let across = loads.across;
    let values = context! {
        name,
        designation,
        what,
        source,
        load => across.to_string(),
        load_assumed => asked.load.is_none(),
        load_source => &loads.across_source,
        largest_force => format!("{:<19?}", loads.largest_force(&bearing)?),
        mapped => spall.is_some() || hosted,
        catalogue => format!("{:<25}", quoted(called)),
        count => format!("{:<19}", inside.element_count),
        diameter => format!("{:.3}", inside.element_diameter),
        pitch => format!("{:.3}", inside.pitch_diameter),
        length => inside.roller_length.map(|length| format!("{length:<16}")),
        clearance => read.clearance.map(|clearance| format!("{:<13?}", clearance.middle_um())),
        class => read.clearance.map(|clearance| clearance.to_string()),
        conformity => bearing.conformity_inner,
        modulus => bearing.youngs_modulus / 1e9,
        ratio => bearing.poissons_ratio,
        density => bearing.density,
        ceramic => bearing.element_youngs_modulus.zip(bearing.element_poissons_ratio).map(|(modulus, ratio)| {
            context! { modulus => modulus / 1e9, ratio }
        }),
        load_vector => format!("{:<28}", match loads.axial {
            None => format!("[0.0, -{across:?}]"),
            Some(axial) => format!("[0.0, -{across:?}, {axial:?}]"),
        }),
        hosted,
        tilt => context! {
            transverse_inertia => TiltSupport::ASSUMED.transverse_inertia,
            polar_inertia => TiltSupport::ASSUMED.polar_inertia,
            damping => TiltSupport::ASSUMED.damping,
            stiffness => TiltSupport::ASSUMED.stiffness,
        },
        axial => loads.axial.map(|axial| axial.to_string()),
        axial_source => loads.axial_source,
        freedom => loads.freedom,
        angle => inside.contact_angle.map(|angle| format!("{angle:<15?}")),
        shoulder => format!("{:<15.2}", share * inside.element_diameter),
        share,
        spall => spall.map(defect),
    };
    render("new_scene.toml", include_str!("../../assets/new_scene.toml"), values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use brinell_scene_file::catalogue;

    fn text(name: &str, bearing: &str, asked: Asked) -> Result<String> {
        super::text(name, bearing, &designation(bearing).unwrap(), asked)
    }

    #[test]
    fn every_bearing_with_every_kind_of_defect_gives_a_scene() {
        for bearing in catalogue() {
            for spall in [None, Some("outer:5deg"), Some("inner:0.5mm"), Some("element:0.4mm")] {
                let spall: Option<Spall> = spall.map(|text| text.parse().unwrap());
                for hosted in [false, true] {
                    let hosted = Asked { hosted, ..Asked::default() };
                    let scene = brinell_scene_file::from_toml(
                        &text("mine", bearing.designation, Asked { spall: spall.as_ref(), ..hosted }).unwrap(),
                    )
                    .unwrap();
                    assert_eq!(scene.bearing.element_count, bearing.inside.element_count);
                    assert_eq!(scene.defects.len(), usize::from(spall.is_some()));
                    assert_eq!(scene.shaft.motion == brinell::scene::Motion::Host, hosted.hosted);
                }
            }
        }
    }

    #[test]
    fn the_width_of_lines_that_a_scene_promises_is_that_of_its_spectra() {
        let own = text("mine", "6205", Asked::default()).unwrap();
        let stop = brinell_scene_file::from_toml(&own).unwrap().experiment.stop;
        // As `line_width_hz` beside a spectrum of the envelope: four lines of a Fourier transform under Hann's window.
        let promised = format!("4 / {stop} s = {:.1} Hz wide", 4.0 / stop);
        assert!(own.contains(&promised), "{promised}: {own}");
    }

    #[test]
    fn an_axial_load_asks_for_three_degrees_of_freedom() {
        for (name, axial, expected) in
            [("7205B", Some(500.0), 500.0), ("6205", Some(-300.0), -300.0), ("7205C", None, 550.0)]
        {
            let text = text("mine", name, Asked { axial, ..Asked::default() }).unwrap();
            let scene = brinell_scene_file::from_toml(&text).unwrap();
            assert_eq!((scene.bearing.degrees_of_freedom.count(), scene.shaft.axial.load), (3, expected), "{text}");
            assert_eq!(scene.bearing.contact_angle.is_some(), name != "6205");
        }
    }

    #[test]
    fn each_motion_that_a_scene_offers_is_taken_as_its_comment_says() {
        let own = text("mine", "6205", Asked::default()).unwrap();
        let mut tried = Vec::new();
        for line in own.lines().filter(|line| line.starts_with("motion = ")) {
            for word in line.split('#').nth(1).unwrap().split('"').skip(1).step_by(2) {
                let mut changed = own.replace(line, &format!("motion = \"{word}\""));
                if line.contains("then without the keys") {
                    let below = own.split_once(line).unwrap().1.split("\n\n").next().unwrap();
                    let kept = below.lines().filter(|key| key.starts_with("speed_hz")).collect::<Vec<_>>().join("\n");
                    changed = changed.replace(below, &format!("\n{kept}"));
                }
                if line.contains(&format!("\"{word}\", without [sensor]")) {
                    let (before, after) = changed.split_once("[sensor]").unwrap();
                    changed = format!("{before}[experiment]{}", after.split_once("[experiment]").unwrap().1);
                }
                assert!(brinell_scene_file::from_toml(&changed).is_ok(), "{word}: {line}\n{changed}");
                tried.push(word);
            }
        }
        assert_eq!(tried, ["host", "host", "fixed"]);
    }

    #[test]
    fn a_scene_says_its_clearance_class_its_material_and_all_that_is_assumed_as_it_holds_without_it() {
        for (name, clearance, class) in [
            ("6205", "12.5", "CN, 5 to 20 um"),
            ("SKF 6205-2Z/C3", "20.5", "C3, 13 to 28 um"),
            ("608", "7.5", "CN, 2 to 13 um"),
            ("NU 312 ECP", "55.0", "CN, 40 to 70 um"),
            ("NU 210 ECM/HC5C3", "65.0", "C3, 50 to 80 um"),
        ] {
            let spall = "outer:5deg".parse().unwrap();
            let own = text("mine", name, Asked { spall: Some(&spall), ..Asked::default() }).unwrap();
            let line = own.lines().find(|line| line.starts_with("internal_clearance_um")).unwrap();
            assert!(line.contains(&format!("= {clearance} ")) && line.contains(class), "{name}: {line}");
            let scene = brinell_scene_file::from_toml(&own).unwrap();
            assert_eq!(scene.bearing.element_youngs_modulus.is_some(), name.contains("HC"), "{own}");
            // What is written down is what holds without it.
            let assumed = ["mass_kg", "damping_", "stiffness_n_m", "largest_force_n", "slip", "initial_", "tolerance"];
            let mut table = "";
            let without = own.lines().filter(|line| {
                table = if line.starts_with('[') { line.split(']').next().unwrap() } else { table };
                table == "[sensor" || !assumed.iter().any(|key| line.starts_with(key))
            });
            let without = brinell_scene_file::from_toml(&without.collect::<Vec<_>>().join("\n")).unwrap();
            let force = largest_force(&without);
            assert_eq!(scene.contact.largest_force, Some(force), "{name}");
            let mut expected = without.clone();
            expected.contact.largest_force = Some(force);
            assert_eq!(scene, expected, "{name}");
        }
    }

    #[test]
    fn a_hosted_scene_takes_the_loads_of_its_rotor_for_what_contacts_reach() {
        let spall = "outer:5deg".parse().unwrap();
        let asked = Asked { hosted: true, load: Some(450.0), axial: Some(500.0), freedom: Some(5), ..Asked::default() };
        for spall in [None, Some(&spall)] {
            let own = text("mine", "6205", Asked { spall, ..asked }).unwrap();
            let scene = brinell_scene_file::from_toml(&own).unwrap();
            assert_eq!(scene.bearing.degrees_of_freedom.count(), 5);
            // 4 · (5 · 450/9 + 500/(9 sin α°)), α° = 11.4 degrees, to the next preferred number.
            assert_eq!(scene.contact.largest_force, Some(2500.0), "{own}");
        }
        let light = text("mine", "6205", Asked { load: Some(1.0), ..asked }).unwrap();
        let heavy = text("mine", "6205", Asked { load: Some(9e3), ..asked }).unwrap();
        let force = |own: &str| brinell_scene_file::from_toml(own).unwrap().contact.largest_force.unwrap();
        assert!(force(&light) < force(&heavy));
        for wrong in [
            Asked { load: Some(0.0), ..asked },
            Asked { axial: Some(f64::NAN), ..asked },
            Asked { freedom: Some(2), ..asked },
        ] {
            assert!(text("mine", "6205", wrong).is_err(), "{wrong:?}");
        }
        for freedom in [3, 5] {
            let own = text("mine", "6205", Asked { freedom: Some(freedom), ..Asked::default() }).unwrap();
            assert_eq!(brinell_scene_file::from_toml(&own).unwrap().shaft.axial.load, 39.0, "{own}");
        }
    }

    #[test]
    fn what_is_no_defect_is_refused_with_an_example() {
        for text in ["inner", "cage:1mm", "inner:1", "inner:mm", "inner:-1mm", "outer:infmm", "outer:1 cm"] {
            assert!(text.parse::<Spall>().unwrap_err().contains("inner:1.2mm"), "{text}");
        }
        assert_eq!("inner: 1.2 mm".parse(), Ok(Spall { on: "inner", length: 1.2, unit: "mm" }));
    }
}
