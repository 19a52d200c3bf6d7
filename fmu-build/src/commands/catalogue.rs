//! The command `catalogue`: which bearings a scene may name, where their dimensions come from, and of one bearing what
//! follows from them.

use std::fmt::Write;

use anyhow::{Result, bail};
use brinell::geometry::kinematics::frequencies;
use brinell_analysis::statics::{dynamic_rating, static_rating};
use brinell_scene_file::{CatalogueBearing, Inside, catalogue, catalogued, nearest};
use serde_json::{Value, json};

use super::new_scene;

/// What is said of dimensions that nobody has published.
const ASSUMED: &str = "assumed: estimated from the boundary, the number may be one off";

/// Frequencies as multiples of the shaft's with the outer ring at rest, and load ratings (N).
#[derive(Debug, Clone, Copy)]
struct Derived {
    orders: [(&'static str, f64); 4],
    dynamic: f64,
    fixed: f64,
}

impl Derived {
    fn of(name: &str) -> Result<Self> {
        // The load is no part of it, and naming one leaves out the remark about it.
        let bearing = new_scene::without_rig(name, Some(1.0))?.bearing;
        let of = frequencies(&bearing, 0.0, 1.0);
        let orders = [("BPFO", of.bpfo), ("BPFI", of.bpfi), ("BSF", of.bsf), ("FTF", of.ftf)];
        Ok(Self { orders, dynamic: dynamic_rating(&bearing), fixed: static_rating(&bearing) })
    }
}

/// The command: one line for each bearing whose name begins with `filter`; or for the one that a scene finds by it, as
/// NU205 by NJ205 and 6205 by 6205-2RS. Of a single one also frequencies and load ratings.
pub(crate) fn command(filter: &str, as_json: bool) -> Result<()> {
    let entries = entries(filter)?;
    let alone = entries.len() == 1;
    if as_json {
        let rows = entries.iter().map(|entry| json_of(entry, alone)).collect::<Result<Vec<_>>>()?;
        println!("{}", serde_json::to_string_pretty(&rows)?);
        return Ok(());
    }
    print!("{}", table(&entries));
    if let [entry] = entries[..] {
        print!("{}", derived(entry.designation)?);
    }
    Ok(())
}

fn entries(filter: &str) -> Result<Vec<CatalogueBearing>> {
    let filter = filter.trim().to_uppercase();
    let mut bearings: Vec<_> = catalogue().filter(|bearing| bearing.designation.starts_with(&filter)).collect();
    if bearings.is_empty() {
        bearings.extend(catalogued(&filter));
    }
    if bearings.is_empty() {
        let near = nearest(catalogue().map(|bearing| bearing.designation), &filter);
        let near = near.map_or_else(String::new, |near| format!("did you mean {near}? "));
        bail!("no bearing of the catalogue begins with {filter:?}; {near}`brinell catalogue` lists all");
    }
    Ok(bearings)
}

fn table(entries: &[CatalogueBearing]) -> String {
    let mut text = String::from(
        "Deep groove (6...) and angular contact ball bearings (72...; C 15, B 40 degrees) and cylindrical roller\n\
         bearings (NU...; NJ, NUP and N are the same inside).\n\
         Bore, outside diameter and width by ISO 15; elements as the last column says.\n\n\
         name      d    D    B [mm]  elements  diameter [mm]  length [mm]  pitch [mm]  elements and pitch diameter\n",
    );
    for CatalogueBearing { designation, boundary: [bore, outside, width], inside } in entries {
        let Inside { element_count, element_diameter, pitch_diameter, roller_length, source, .. } = inside;
        let length = roller_length.map_or("-".to_owned(), |length| format!("{length:.1}"));
        let _ = writeln!(
            text,
            "{designation:<6} {bore:>4} {outside:>4} {width:>4}       {element_count:>8}  {element_diameter:>13.3}  \
             {length:>11}  {pitch_diameter:>10.3}  {}",
            source.unwrap_or(ASSUMED)
        );
    }
    text
}

fn derived(name: &str) -> Result<String> {
    let Derived { orders, dynamic, fixed } = Derived::of(name)?;
    let mut text = String::from("\ntimes per turn of the shaft, the outer ring at rest:\n");
    for (name, order) in orders {
        let _ = writeln!(text, "  {name:<4} {order:>8.4}    {:>8.2} Hz at 1500 rpm", 25.0 * order);
    }
    let _ = writeln!(
        text,
        "load ratings of these dimensions: dynamic C {:.1} kN (ISO 281), static C0 {:.1} kN (ISO 76); a maker's hold",
        1e-3 * dynamic,
        1e-3 * fixed
    );
    Ok(text)
}

fn json_of(entry: &CatalogueBearing, alone: bool) -> Result<Value> {
    let CatalogueBearing { designation, boundary: [bore, outside, width], inside } = entry;
    let mut row = json!({
        "name": designation,
        "bore_mm": bore,
        "outside_diameter_mm": outside,
        "width_mm": width,
        "element_count": inside.element_count,
        "element_diameter_mm": inside.element_diameter,
        "pitch_diameter_mm": inside.pitch_diameter,
        "roller_length_mm": inside.roller_length,
        "source": inside.source.unwrap_or(ASSUMED),
    });
    if alone {
        let Derived { orders, dynamic, fixed } = Derived::of(designation)?;
        for (name, order) in orders {
            row[format!("{}_orders", name.to_lowercase())] = json!(order);
        }
        row["dynamic_rating_n"] = json!(dynamic);
        row["static_rating_n"] = json!(fixed);
    }
    Ok(row)
}
