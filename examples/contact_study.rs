use brinell::contact::map::ContactMap;
use brinell::contact::map_build::{MapSpecification, Sequential};
use brinell::contact::raceway_grid::{ElementOnRaceway, Resolution};
use brinell::surface::{Profile, Surface};
use std::f64::consts::FRAC_PI_2;
const LARGEST: f64 = 10e-6;
const LENGTH: f64 = 6.517e-3;
fn main() {
    let element = ElementOnRaceway { element_radius: 3.97e-3, raceway_radius: 23.6325e-3, groove_radius: 4.095e-3 };
    let surface = Surface::Profile(Profile::spall(LENGTH, 100e-6, FRAC_PI_2));
    for (c, r, acc) in [(48, 32, 3e-3), (48,32,1e-3), (48,32,5e-4)] {
        let s = MapSpecification { accuracy: acc, resolution: Resolution { columns: c, rows: r }, ..MapSpecification::new(LARGEST) };
        let t = std::time::Instant::now(); let _ = brinell::contact::map_plan::MapPlan::new(&surface, element, s).unwrap(); println!("plan {:.2}", t.elapsed().as_secs_f64());
        match ContactMap::build(&surface, element, s, &mut Sequential(|_, _| ())) {
            Ok(m) => println!("{c} {r} {acc:e} nodes {} {:?} {:.2} s", m.nodes(), m.accuracy(), t.elapsed().as_secs_f64()),
            Err(e) => println!("{e}"),
        }
    }
}
