//! The command `catalogue`: which bearings a scene may name, where their dimensions come from, and of one bearing what
//! follows from them.

use std::fmt::Write;

use anyhow::Result;
use brinell::geometry::kinematics::frequencies;
use brinell::geometry::load_rating::{LoadRatings, load_ratings};
use brinell::scene::Bearing;
use brinell_scene_file::{CatalogueBearing, ClearanceRange, Designation, Inside, catalogue, designation};
use serde_json::{Value, json};

use super::new_scene;

/// What is said of dimensions that nobody has published.
const ASSUMED: &str = "assumed: estimated from the boundary, the number may be one off";

/// What a name says, and what follows from it.
struct Derived {
    read: Designation,
    bearing: Bearing,
    ratings: LoadRatings,
}

impl Derived {
    fn of(name: &str) -> Result<Self> {
        let read = designation(name)?;
        let bearing = new_scene::bearing_of(name, &read)?;
        Ok(Self { ratings: load_ratings(&bearing), read, bearing })
    }

    /// Frequencies as multiples of the shaft's with the outer ring at rest.
    fn orders(&self) -> [(&'static str, f64); 4] {
        let of = frequencies(&self.bearing, 0.0, 1.0);
        [("BPFO", of.bpfo), ("BPFI", of.bpfi), ("BSF", of.bsf), ("FTF", of.ftf)]
    }
}

/// The command: one line for each bearing whose name begins with `filter`; or for the one that a scene finds by it, as
/// NU205 by NJ205 and 6205 by 6205-2RS/C3. Of a single one also frequencies, clearance and load ratings.
pub(crate) fn command(filter: &str, as_json: bool) -> Result<()> {
    let entries = entries(filter)?;
    let alone = match entries[..] {
        // `62` and `7205B` alike are names of bearings that begin so.
        [one] => Some(Derived::of(if designation(filter).is_ok() { filter } else { one.designation })?),
        _ => None,
    };
    if as_json {
        let rows: Vec<_> = entries.iter().map(|entry| json_of(entry, alone.as_ref())).collect();
        println!("{}", serde_json::to_string_pretty(&rows)?);
        return Ok(());
    }
    print!("{}{}", table(&entries), alone.as_ref().map_or_else(String::new, derived));
    Ok(())
}

fn entries(filter: &str) -> Result<Vec<CatalogueBearing>> {
    let begins = filter.trim().to_uppercase();
    let bearings: Vec<_> = catalogue().filter(|bearing| bearing.designation.starts_with(&begins)).collect();
    if bearings.is_empty() { Ok(vec![designation(filter)?.bearing]) } else { Ok(bearings) }
}

fn table(entries: &[CatalogueBearing]) -> String {
    let mut text = String::from(
        "Deep groove (6...), insert (ER16K) and angular contact ball bearings (72...; C 15, AC 25, B 40 degrees),\n\
         cylindrical roller bearings (NU...; NJ, NUP and N are the same inside).\n\
         Bore, outside diameter and width by ISO 15; clearance CN by ISO 5753-1; elements as the last column says.\n\n\
         name      d    D    B [mm]  elements  diameter [mm]  length [mm]  pitch [mm]  CN [um]  elements and pitch \
         diameter\n",
    );
    for entry in entries {
        let CatalogueBearing { designation, boundary: [bore, outside, width], inside } = entry;
        let Inside { element_count, element_diameter, pitch_diameter, roller_length, source, .. } = inside;
        let length = roller_length.map_or("-".to_owned(), |length| format!("{length:.1}"));
        let clearance = entry
            .normal_clearance()
            .map_or("-".to_owned(), |ClearanceRange { range_um: [low, high], .. }| format!("{low} to {high}"));
        let _ = writeln!(
            text,
            "{designation:<6} {bore:>4} {outside:>4} {width:>4}       {element_count:>8}  {element_diameter:>13.3}  \
             {length:>11}  {pitch_diameter:>10.3}  {clearance:>8} {}",
            source.unwrap_or(ASSUMED)
        );
    }
    text
}

fn derived(of: &Derived) -> String {
    let mut text = String::from("\ntimes per turn of the shaft, the outer ring at rest:\n");
    for (name, order) in of.orders() {
        let _ = writeln!(text, "  {name:<4} {order:>8.4}    {:>8.2} Hz at 1500 rpm", 25.0 * order);
    }
    if let Some(clearance) = of.read.clearance {
        let middle = clearance.middle_um();
        let _ = writeln!(text, "radial internal clearance {clearance} (ISO 5753-1), of which scenes take {middle} um");
    }
    let LoadRatings { dynamic, fixed, f0, .. } = of.ratings;
    let _ = writeln!(
        text,
        "load ratings of these dimensions: dynamic C {:.1} kN (ISO 281), static C0 {:.1} kN (ISO 76); a maker's hold",
        1e-3 * dynamic,
        1e-3 * fixed
    );
    text.push_str(&equivalent(of, f0));
    if let Some(said) = of.read.remark() {
        let _ = writeln!(text, "{said}");
    }
    text
}

/// How the equivalent load is worked out.
fn equivalent(of: &Derived, f0: Option<f64>) -> String {
    let (light, heavy) = (of.ratings.factors(0.0), of.ratings.factors(of.ratings.fixed));
    let digits = |factor: f64| (1e3 * factor).round() / 1e3;
    match (f0, light, heavy) {
        (Some(_), Some(one), Some(other)) if one == other => format!(
            "equivalent load P = Fr, above Fa/Fr = {} P = {} Fr + {} Fa (ISO 281)\n",
            digits(one.e),
            digits(one.radial),
            digits(one.axial)
        ),
        (Some(f0), Some(one), Some(other)) => format!(
            "equivalent load P = Fr, above Fa/Fr = e P = {} Fr + Y Fa (ISO 281): e {} to {}, Y {} to {} as f0 Fa/C0 \
             grows, f0 = {f0:.1}\n",
            digits(one.radial),
            digits(one.e),
            digits(other.e),
            digits(one.axial),
            digits(other.axial)
        ),
        _ => "equivalent load P = Fr (ISO 281)\n".to_owned(),
    }
}

fn json_of(entry: &CatalogueBearing, alone: Option<&Derived>) -> Value {
    let CatalogueBearing { designation, boundary: [bore, outside, width], inside } = entry;
    let clearance = alone.map_or_else(|| entry.normal_clearance(), |of| of.read.clearance);
    let mut row = json!({
        "name": designation,
        "bore_mm": bore,
        "outside_diameter_mm": outside,
        "width_mm": width,
        "element_count": inside.element_count,
        "element_diameter_mm": inside.element_diameter,
        "pitch_diameter_mm": inside.pitch_diameter,
        "roller_length_mm": inside.roller_length,
        "contact_angle_deg": inside.contact_angle,
        "clearance_class": clearance.map(|clearance| clearance.class.to_string()),
        "internal_clearance_um": clearance.map(|clearance| clearance.middle_um()),
        "internal_clearance_range_um": clearance.map(|clearance| clearance.range_um),
        "source": inside.source.unwrap_or(ASSUMED),
    });
    if let Some(of) = alone {
        for (name, order) in of.orders() {
            row[format!("{}_orders", name.to_lowercase())] = json!(order);
        }
        row["dynamic_rating_n"] = json!(of.ratings.dynamic);
        row["static_rating_n"] = json!(of.ratings.fixed);
        row["f0"] = json!(of.ratings.f0);
        row["element_youngs_modulus_gpa"] = json!(of.bearing.element_youngs_modulus.map(|modulus| modulus / 1e9));
        row["remark"] = json!(of.read.remark());
    }
    row
}
