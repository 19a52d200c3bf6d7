//! The command `new`: a commented scene of a bearing of the catalogue that runs as it is, or a sweep's file.

use std::path::Path;
use std::str::FromStr;

use anyhow::{Context, Result, bail};
use brinell::scene::Scene;
use brinell_scene_file::{CatalogueBearing, NotInCatalogue, catalogued};
use minijinja::context;

use super::schema;
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
    /// Load along the axis (N).
    pub(crate) axial: Option<f64>,
    /// Whether a host moves the shaft.
    pub(crate) hosted: bool,
}

/// The bearing of this name.
fn named(name: &str) -> Result<CatalogueBearing> {
    Ok(catalogued(name).ok_or_else(|| NotInCatalogue { name: name.to_owned() })?)
}

/// The scene of a bearing that is nowhere written down.
pub(crate) fn unwritten(bearing: &str, asked: Asked) -> Result<String> {
    let bearing = named(bearing)?;
    text(&unnamed(&bearing, asked), &bearing, asked)
}

/// Name of a scene that is given none.
fn unnamed(bearing: &CatalogueBearing, asked: Asked) -> String {
    // A name has no points: 1.2 mm are 1_2mm.
    let of_spall = |Spall { on, length, unit }: &Spall| format!("{on}-{length}{unit}").replace('.', "_");
    format!("{}-{}", bearing.designation.to_lowercase(), asked.spall.map_or("healthy".to_owned(), of_spall))
}

/// A bearing of the catalogue without a spall, of whose rig nothing is known, under this load (N).
pub(crate) fn without_rig(bearing: &str, load: Option<f64>) -> Result<Scene> {
    let mut scene = brinell_scene_file::from_toml(&unwritten(bearing, Asked::default())?)?;
    scene.sensors.clear();
    match load {
        Some(load) if !(load.is_finite() && load > 0.0) => bail!("--load {load} N: it must be finite and above 0"),
        Some(load) => scene.shaft.load = [0.0, -load],
        None => note!(
            "note: {bearing}: a load of {:.0} N is assumed, 5 % of the static rating; --load gives the real one",
            scene.shaft.load[1].abs()
        ),
    }
    Ok(scene)
}

/// The command: writes `<folder>/<name>.toml`.
pub(crate) fn command(name: Option<&str>, bearing: &str, asked: Asked, folder: &Path) -> Result<()> {
    let bearing = named(bearing)?;
    let unnamed = unnamed(&bearing, asked);
    let name = name.unwrap_or(&unnamed);
    let text = text(name, &bearing, asked)?;
    brinell_scene_file::from_toml(&text)
        .with_context(|| format!("a scene {name} of this bearing and defect is not possible"))?;
    whole_file::write_own(&folder.join(format!("{name}.toml")), &text)?;
    schema::write_beside(folder)
}

/// The command with `--sweep`: writes a sweep's file with every key.
pub(crate) fn sweep(name: &str, folder: &Path) -> Result<()> {
    whole_file::write_own(&folder.join(format!("{name}.toml")), include_str!("../../../examples/sweep.toml"))
}

fn text(name: &str, bearing: &CatalogueBearing, asked: Asked) -> Result<String> {
    let Asked { spall, axial, hosted } = asked;
    if let (Some(axial), true) = (axial, hosted) {
        bail!("--axial {axial} N with --hosted: what the shaft carries is the host's");
    }
    let (designation, inside) = (bearing.designation, bearing.inside);
    if let Some(axial) = axial.filter(|axial| !axial.is_finite() || *axial == 0.0) {
        bail!("--axial {axial} N: it must be finite and other than 0");
    }
    let source = inside.source.unwrap_or("assumed: estimated from bore and outside diameter; put in what you know");
    let formula = if inside.roller_length.is_none() { "12.3 Z D²" } else { "44 (1 - D/Dpw) Z L D" };
    let load = (LOAD_SHARE * inside.static_rating() / 10.0).round().max(1.0) * 10.0;
    // One shoulder of an angular contact bearing is high, and the other cut away.
    let share = if inside.contact_angle.is_some() { 0.3 } else { 0.2 };
    // A contact that leans lifts a ring that nothing pushes along the axis.
    let (axial, axial_source) = match (axial, inside.contact_angle) {
        (Some(axial), _) => (Some(axial), "as asked for"),
        (None, Some(_)) => (Some(load), "as much along the axis"),
        (None, None) => (None, ""),
    };
    let what =
        spall.map_or("healthy".to_owned(), |Spall { on, length, unit }| format!("spall of {length} {unit}, {on}"));
    let defect = |&Spall { on, length, unit }: &Spall| context! { on, unit, length => format!("{length:?}") };
    let values = context! {
        name,
        designation,
        what,
        source,
        formula,
        load => load.to_string(),
        catalogue => format!("{:<25}", format!("\"{designation}\"")),
        count => format!("{:<19}", inside.element_count),
        diameter => format!("{:.3}", inside.element_diameter),
        pitch => format!("{:.3}", inside.pitch_diameter),
        length => inside.roller_length.map(|length| format!("{length:<16}")),
        load_vector => format!("{:<28}", match axial {
            None => format!("[0.0, -{load:.1}]"),
            Some(axial) => format!("[0.0, -{load:.1}, {axial:?}]"),
        }),
        hosted,
        axial => axial.map(|axial| axial.to_string()),
        axial_source,
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

    #[test]
    fn every_bearing_with_every_kind_of_defect_gives_a_scene() {
        for bearing in catalogue() {
            for spall in [None, Some("outer:5deg"), Some("inner:0.5mm"), Some("element:0.4mm")] {
                let spall: Option<Spall> = spall.map(|text| text.parse().unwrap());
                for hosted in [false, true] {
                    let hosted = Asked { hosted, ..Asked::default() };
                    let scene = brinell_scene_file::from_toml(
                        &text("mine", &bearing, Asked { spall: spall.as_ref(), ..hosted }).unwrap(),
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
        let own = text("mine", &catalogued("6205").unwrap(), Asked::default()).unwrap();
        let stop = brinell_scene_file::from_toml(&own).unwrap().experiment.stop;
        // As `line_width_hz` beside a spectrum of the envelope: four lines of a Fourier transform under Hann's window.
        let promised = format!("4 / {stop} s = {:.1} Hz wide", 4.0 / stop);
        assert!(own.contains(&promised), "{promised}: {own}");
    }

    #[test]
    fn an_axial_load_asks_for_three_degrees_of_freedom() {
        for (name, axial, expected) in
            [("7205B", Some(500.0), 500.0), ("6205", Some(-300.0), -300.0), ("7205C", None, 500.0)]
        {
            let text = text("mine", &catalogued(name).unwrap(), Asked { axial, ..Asked::default() }).unwrap();
            let scene = brinell_scene_file::from_toml(&text).unwrap();
            assert_eq!((scene.bearing.degrees_of_freedom.count(), scene.shaft.axial.load), (3, expected), "{text}");
            assert_eq!(scene.bearing.contact_angle.is_some(), name != "6205");
        }
    }

    #[test]
    fn each_motion_that_a_scene_offers_is_taken_as_its_comment_says() {
        let own = text("mine", &catalogued("6205").unwrap(), Asked::default()).unwrap();
        let offers = |line: &&str| line.starts_with("motion = ");
        let mut tried = Vec::new();
        for line in own.lines().filter(offers) {
            for word in line.split('#').nth(1).unwrap().split('"').skip(1).step_by(2) {
                let mut changed = own.replace(line, &format!("motion = \"{word}\""));
                if line.contains(&format!("\"{word}\", then without load_n")) {
                    let load = own.lines().find(|line| line.starts_with("load_n")).unwrap();
                    changed = changed.replace(load, "");
                }
                if line.contains(&format!("\"{word}\", then without [sensor]")) {
                    let (before, after) = changed.split_once("[sensor]").unwrap();
                    changed = format!("{before}[experiment]{}", after.split_once("[experiment]").unwrap().1);
                }
                assert!(brinell_scene_file::from_toml(&changed).is_ok(), "{word}: {line}");
                tried.push(word);
            }
        }
        assert_eq!(tried, ["host", "host", "fixed"]);
    }

    #[test]
    fn what_is_no_defect_is_refused_with_an_example() {
        for text in ["inner", "cage:1mm", "inner:1", "inner:mm", "inner:-1mm", "outer:infmm", "outer:1 cm"] {
            assert!(text.parse::<Spall>().unwrap_err().contains("inner:1.2mm"), "{text}");
        }
        assert_eq!("inner: 1.2 mm".parse(), Ok(Spall { on: "inner", length: 1.2, unit: "mm" }));
    }
}
