use brinell::contact::love::LoveContact;
use brinell::contact::map::ContactMap;
use brinell::contact::map_build::{MapSpecification, Sequential};
use brinell::contact::raceway_grid::{ElementOnRaceway, Resolution};
use brinell::surface::{Profile, Surface, Topography};
use std::f64::consts::FRAC_PI_2;
const LENGTH: f64 = 6.517e-3;
fn main() {
    let element = ElementOnRaceway { element_radius: 3.97e-3, raceway_radius: 23.6325e-3, groove_radius: 4.095e-3 };
    let skf = ElementOnRaceway { element_radius: 3.97e-3, raceway_radius: 23.4925e-3, groove_radius: 0.52 * 7.94e-3 };
    let surface = Surface::Profile(Profile::spall(LENGTH, 100e-6, FRAC_PI_2));
    let epps =
        Surface::Profile(Profile::from_csv(&std::fs::read_to_string("scenes/6205-epps-trace.csv").unwrap()).unwrap());
    let rough = Surface::Topography(topography());
    let which = std::env::args().nth(1).unwrap_or_default();
    for (name, element, surface, largest) in
        [("tb1", element, &surface, 10e-6), ("epps", skf, &epps, 25e-6), ("rough", element, &rough, 10e-6)]
    {
        if which != "" && which != name {
            continue;
        }
        for (c, r) in [(32, 16), (48, 32), (96, 32)] {
            let mut love =
                LoveContact::new(element, surface, 1.8 * largest, Resolution { columns: c, rows: r }).unwrap();
            print!("{name} {c} {r}");
            let (s0, s1) = surface.extent();
            for q in [0.0, 0.03, 0.1, 0.3, 0.5, 1.0] {
                let s = s0 + q * (s1 - s0);
                let u = love.first_touch(s) + 0.7 * largest;
                let f = love.solve(u, s).unwrap().forces(1.0).map(|f| f / largest.powf(1.5));
                print!("  {:.5} {:.5}", f[0], f[1]);
            }
            println!();
        }
        for (c, r, acc) in [(48, 32, 1e-3)] {
            let s = MapSpecification {
                accuracy: acc,
                resolution: Resolution { columns: c, rows: r },
                ..MapSpecification::new(largest)
            };
            let t = std::time::Instant::now();
            match ContactMap::build(surface, element, s, &mut Sequential(|_, _| ())) {
                Ok(m) => println!(
                    "{name} {c} {r} {acc:e} nodes {} {:?} {:.2} s knots {:?}",
                    m.nodes(),
                    m.accuracy(),
                    t.elapsed().as_secs_f64(),
                    m.knots()
                ),
                Err(e) => println!("{e}"),
            }
        }
    }
}
/// Spall of 0.8 mm, 40 um deep with flanks of 0.1 mm, and a rough, uneven floor.
fn topography() -> Topography {
    let mut text = String::from("arc_mm,axial_mm,depth_um\n");
    for i in 0..=60 {
        for j in 0..=20 {
            let (s, y) = (f64::from(i) * 0.02 - 0.6, f64::from(j) * 0.2 - 2.0);
            let shape = ((0.5 - s.abs()) / 0.1).clamp(0.0, 1.0);
            let rough = 1.0 * (17.0 * s + 2.0 * y).sin()
                + 0.7 * (31.0 * s - 3.0 * y + 1.0).sin()
                + 0.5 * (5.0 * y + 9.0 * s).cos();
            text += &format!("{s},{y},{}\n", shape * (12.0 + rough));
        }
    }
    Topography::from_csv(&text).unwrap()
}
