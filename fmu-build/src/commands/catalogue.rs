//! The command `catalogue`: which bearings a scene may name, and where their dimensions come from.

use anyhow::{Result, bail};
use brinell::scene::nearest;
use brinell_scene_file::{Inside, catalogue, catalogued};

/// The command: one line for each bearing whose name begins with `filter`; or for the one that a scene finds by it, as
/// NU205 by NJ205 and 6205 by 6205-2RS.
pub(crate) fn command(filter: &str) -> Result<()> {
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
    println!(
        "Deep groove (6...) and angular contact ball bearings (72...; C 15, B 40 degrees) and cylindrical roller\n\
         bearings (NU...; NJ, NUP and N are the same inside)."
    );
    println!("Bore, outside diameter and width by ISO 15; elements as the last column says.\n");
    println!(
        "name      d    D    B [mm]  elements  diameter [mm]  length [mm]  pitch [mm]  elements and pitch diameter"
    );
    for bearing in bearings {
        let ([bore, outside, width], inside) = (bearing.boundary, bearing.inside);
        let Inside { element_count, element_diameter, pitch_diameter, roller_length, source, .. } = inside;
        let length = roller_length.map_or("-".to_owned(), |length| format!("{length:.1}"));
        println!(
            "{:<6} {bore:>4} {outside:>4} {width:>4}       {element_count:>8}  {element_diameter:>13.3}  {length:>11}  \
             {pitch_diameter:>10.3}  {}",
            bearing.designation,
            source.unwrap_or("assumed: estimated from the boundary, the number may be one off")
        );
    }
    Ok(())
}
