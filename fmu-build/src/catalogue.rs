//! The command `catalogue`: which bearings a scene may name, and where their dimensions come from.

use anyhow::{Result, bail};
use brinell::scene::{Inside, catalogue};

/// The command: one line for each bearing whose name begins with `filter`.
pub(crate) fn command(filter: &str) -> Result<()> {
    let found: Vec<_> = catalogue().filter(|bearing| bearing.designation.starts_with(filter)).collect();
    if found.is_empty() {
        bail!("no bearing of the catalogue begins with {filter:?}; `brinell catalogue` lists all");
    }
    println!("Deep groove ball bearings. Bore, outside diameter and width by ISO 15; balls as the last column says.");
    println!("Cylindrical rollers are not modelled.\n");
    println!("name      d    D    B [mm]  balls   ball [mm]  pitch [mm]  balls and pitch diameter");
    for bearing in found {
        let ([bore, outside, width], inside) = (bearing.boundary, bearing.inside);
        let Inside { element_count, element_diameter, pitch_diameter, source } = inside;
        println!(
            "{:<6} {bore:>4} {outside:>4} {width:>4}       {element_count:>5}  {element_diameter:>10.3}  \
             {pitch_diameter:>10.3}  {}",
            bearing.designation,
            source.unwrap_or("assumed: estimated from the boundary, the number may be one off")
        );
    }
    Ok(())
}
