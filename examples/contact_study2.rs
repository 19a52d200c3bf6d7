use brinell::contact::map::ContactMap;
use brinell::contact::map_build::{MapSpecification, Sequential};
use brinell::contact::raceway_grid::{ElementOnRaceway, Resolution};
use brinell::surface::{Profile, Surface};
use std::f64::consts::FRAC_PI_2;
const LENGTH: f64 = 6.517e-3;
fn main() {
    let element = ElementOnRaceway { element_radius: 3.97e-3, raceway_radius: 23.6325e-3, groove_radius: 4.095e-3 };
    let surface = Surface::Profile(Profile::spall(LENGTH, 100e-6, FRAC_PI_2));
    for (c, r, acc) in [(32, 32, 1e-3), (48, 32, 1e-3), (64, 32, 1e-3)] {
        let s = MapSpecification {
            accuracy: acc,
            resolution: Resolution { columns: c, rows: r },
            ..MapSpecification::new(10e-6)
        };
        let t = std::time::Instant::now();
        match ContactMap::build(&surface, element, s, &mut Sequential(|_, _| ())) {
            Ok(map) => {
                println!(
                    "{c} {r} {acc:e} nodes {} {:?} {:.2} s",
                    map.nodes(),
                    map.accuracy(),
                    t.elapsed().as_secs_f64()
                );
                let mut best = f64::INFINITY;
                let mut sum = 0.0;
                for _ in 0..500 {
                    let start = std::time::Instant::now();
                    for i in 0..1000 {
                        sum += map.lookup(5e-6, -0.5 * LENGTH - 0.1e-3 + 0.2e-6 * f64::from(i)).unwrap().forces(1.0)[0];
                    }
                    best = best.min(start.elapsed().as_secs_f64() / 1000.0);
                }
                let mut best2 = f64::INFINITY;
                for _ in 0..500 {
                    let start = std::time::Instant::now();
                    for i in 0..1000 {
                        sum +=
                            map.lookup(98e-6, -0.5 * LENGTH + 0.95e-3 + 0.02e-6 * f64::from(i)).unwrap().forces(1.0)[0];
                    }
                    best2 = best2.min(start.elapsed().as_secs_f64() / 1000.0);
                }
                println!("lookup {:.1} ns, in cut cells {:.1} ns {}", best * 1e9, best2 * 1e9, sum > 0.0);
            }
            Err(e) => println!("{e}"),
        }
    }
}
