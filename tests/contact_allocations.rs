//! Warm contacts allocate nothing: counted by the program's own allocator.
//!
//! `unsafe` is what an allocator takes. One test only, for the count is the whole program's.
#![allow(unsafe_code, clippy::unwrap_used)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::f64::consts::FRAC_PI_2;
use std::sync::atomic::{AtomicU64, Ordering};

use brinell::contact::love::LoveContact;
use brinell::contact::map::ContactMap;
use brinell::contact::map_build::{MapSpecification, Sequential};
use brinell::contact::raceway_grid::{ElementOnRaceway, Resolution};
use brinell::surface::{Profile, Surface};

struct Counting;

static COUNT: AtomicU64 = AtomicU64::new(0);

// SAFETY: passes everything on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller's contract.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's contract.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn contacts_of_an_element_that_passes_an_edge_allocate_nothing() {
    let element = ElementOnRaceway { element_radius: 3.97e-3, raceway_radius: 23.6325e-3, groove_radius: 4.095e-3 };
    let surface = Surface::Profile(Profile::spall(6.517e-3, 100e-6, FRAC_PI_2));
    let resolution = Resolution { columns: 32, rows: 16 };
    let specification = MapSpecification { accuracy: 3e-2, resolution, ..MapSpecification::new(10e-6) };
    let map = ContactMap::build(&surface, element, specification, &mut Sequential(|_, _| ())).unwrap();
    let mut love = LoveContact::new(element, &surface, 10e-6, resolution).unwrap();
    let before = COUNT.load(Ordering::Relaxed);
    let mut sum = 0.0;
    for n in 0..400 {
        // From the smooth raceway over the edge to the floor, 6 µm into the first touch.
        let s = -3.5e-3 + 1.4e-3 * f64::from(n) / 400.0;
        let u = love.first_touch(s) + 6e-6;
        sum += love.solve(u, s).unwrap().value + map.lookup(u, s).unwrap().value;
    }
    assert_eq!(COUNT.load(Ordering::Relaxed) - before, 0);
    assert!(sum > 0.0);
}
