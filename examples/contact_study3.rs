use brinell::contact::map::ContactMap;
use brinell::contact::map_build::{MapSpecification, Sequential};
use brinell::contact::raceway_grid::{ElementOnRaceway, Resolution};
use brinell::surface::{Profile, Surface};
use std::f64::consts::FRAC_PI_2;
const LENGTH: f64 = 6.517e-3;
fn main() {
    let element = ElementOnRaceway { element_radius: 3.97e-3, raceway_radius: 23.6325e-3, groove_radius: 4.095e-3 };
    let surface = Surface::Profile(Profile::spall(LENGTH, 100e-6, FRAC_PI_2));
    let s = MapSpecification { accuracy: 3e-2, resolution: Resolution { columns: 16, rows: 8 }, ..MapSpecification::new(10e-6) };
    let map = ContactMap::build(&surface, element, s, &mut Sequential(|_, _| ())).unwrap();
    let mut best = f64::INFINITY; let mut sum = 0.0;
    for _ in 0..std::env::args().nth(1).map_or(20000, |v| v.parse().unwrap()) { let start = std::time::Instant::now();
        for i in 0..1000 { sum += map.lookup(5e-6, -0.5 * LENGTH - 0.1e-3 + 0.2e-6 * f64::from(i)).unwrap().forces(1.0)[0]; }
        best = best.min(start.elapsed().as_secs_f64() / 1000.0); }
    println!("lookup {:.1} ns {}", best * 1e9, sum > 0.0);
}
