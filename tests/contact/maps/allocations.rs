//! Warm contacts allocate nothing: counted by the program's own allocator.

use crate::er16k;
use std::f64::consts::FRAC_PI_2;

use crate::counting::counted;
use brinell::contact::love::{LoveContact, Resolution};
use brinell::contact::map::MapSpecification;
use brinell::surface::{Profile, Surface};

#[test]
fn contacts_of_an_element_that_passes_an_edge_allocate_nothing() {
    let element = er16k::OUTER;
    let surface = Surface::Profile(Profile::spall(6.517e-3, 100e-6, FRAC_PI_2));
    let resolution = Resolution { columns: 32, rows: 16 };
    let specification = MapSpecification { accuracy: 3e-2, resolution, ..MapSpecification::new(10e-6) };
    let map = crate::built(&surface, element, specification);
    let mut love = LoveContact::new(element, &surface, 10e-6, resolution).unwrap();
    let (sum, allocations) = counted(|| {
        let mut sum = 0.0;
        for n in 0..400 {
            // From the smooth raceway over the edge to the floor, 6 µm into the first touch.
            let s = -3.5e-3 + 1.4e-3 * f64::from(n) / 400.0;
            let u = love.first_touch(s) + 6e-6;
            sum += love.solve(u, s).unwrap().value + map.lookup(u, s).unwrap().value;
        }
        sum
    });
    assert_eq!(allocations, 0);
    assert!(sum > 0.0);
}
