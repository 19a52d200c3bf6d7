//! Error against run time of the contact alone, as CSV on standard output: `cargo run --release --example contact_error > docs/contact-error.csv`
//!
//! ER16K line spall, 100 µm deep, 90° edges, approaches to 10 µm. Grids are compared with one of 128 × 48, maps with their own
//! grid; each grid is two, half a row apart. Errors are relative to the smooth contact's force at 10 µm; times are the best of several on one core.

use std::error::Error;
use std::f64::consts::FRAC_PI_2;
use std::time::Instant;

use brinell::contact::love::LoveContact;
use brinell::contact::map_build::{MapSpecification, Sequential};
use brinell::contact::map_plan::MapPlan;
use brinell::contact::raceway_grid::{ElementOnRaceway, Resolution};
use brinell::surface::{Profile, Surface};

const LARGEST: f64 = 10e-6;
const LENGTH: f64 = 6.517e-3;

fn main() -> Result<(), Box<dyn Error>> {
    let element = ElementOnRaceway { element_radius: 3.97e-3, raceway_radius: 23.6325e-3, groove_radius: 4.095e-3 };
    let surface = Surface::Profile(Profile::spall(LENGTH, 100e-6, FRAC_PI_2));
    // From just before the edge to the floor's first touch, 0.5 to 9 µm above the first touch.
    let grid = |columns, rows| LoveContact::new(element, &surface, 1.6 * LARGEST, Resolution { columns, rows });
    let mut finest = grid(128, 48)?;
    let mut places = Vec::new();
    for k in 0..24 {
        let s = -0.5 * LENGTH - 0.15e-3 + 1.15e-3 * (f64::from(k) + 0.37) / 24.0;
        let touch = finest.first_touch(s);
        for height in [0.5e-6, 1.5e-6, 3e-6, 5e-6, 7e-6] {
            places.push([touch + height, s]);
        }
    }
    let forces = |contact: &mut LoveContact| -> Result<Vec<[f64; 2]>, Box<dyn Error>> {
        let scale = LARGEST * LARGEST.sqrt();
        places.iter().map(|&[u, s]| Ok(contact.solve(u, s)?.forces(1.0).map(|f| f / scale))).collect()
    };
    let exact = forces(&mut finest)?;
    println!(
        "law,columns,rows,nodes,max_normal,rms_normal,max_tangential,rms_tangential,seconds_per_contact,seconds_to_prepare"
    );
    for (columns, rows) in [(16, 8), (16, 16), (32, 16), (32, 32), (48, 16), (48, 32), (64, 32)] {
        let start = Instant::now();
        let mut contact = grid(columns, rows)?;
        let prepare = start.elapsed().as_secs_f64();
        let found = forces(&mut contact)?;
        let mut e = [0.0_f64; 4];
        for (a, b) in found.iter().zip(&exact) {
            for k in 0..2 {
                e[2 * k] = e[2 * k].max((a[k] - b[k]).abs());
                e[2 * k + 1] += (a[k] - b[k]).powi(2) / places.len() as f64;
            }
        }
        // Warm: an element that passes the edge, 50 nm a step.
        let mut seconds = f64::INFINITY;
        for _ in 0..20 {
            let start = Instant::now();
            for i in 0..50 {
                contact.solve(5e-6, -0.5 * LENGTH + 50e-9 * f64::from(i))?;
            }
            seconds = seconds.min(start.elapsed().as_secs_f64() / 50.0);
        }
        println!(
            "love,{columns},{rows},,{:.1e},{:.1e},{:.1e},{:.1e},{seconds:.2e},{prepare:.2e}",
            e[0],
            e[1].sqrt(),
            e[2],
            e[3].sqrt()
        );
    }
    for accuracy in [1e-2, 3e-3, 1e-3] {
        let specification = MapSpecification { accuracy, ..MapSpecification::new(LARGEST) };
        let start = Instant::now();
        // The finest ones meet the grid's own steps; what was reached stands in the table.
        let map = MapPlan::new(&surface, element, specification)?.build(&mut Sequential(|_, _| ()))?;
        let prepare = start.elapsed().as_secs_f64();
        let mut seconds = f64::INFINITY;
        let mut sum = 0.0;
        for _ in 0..200 {
            let start = Instant::now();
            for i in 0..1000 {
                sum += map.lookup(5e-6, -0.5 * LENGTH - 0.1e-3 + 0.2e-6 * f64::from(i))?.forces(1.0)[0];
            }
            seconds = seconds.min(start.elapsed().as_secs_f64() / 1000.0);
        }
        std::hint::black_box(sum);
        let a = map.accuracy();
        println!(
            "map,48,32,{},{:.1e},{:.1e},{:.1e},{:.1e},{seconds:.2e},{prepare:.2e}",
            map.nodes(),
            a.max_normal,
            a.rms_normal,
            a.max_tangential,
            a.rms_tangential
        );
    }
    Ok(())
}
