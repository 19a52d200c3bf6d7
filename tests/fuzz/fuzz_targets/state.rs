//! Bytes as a serialized state: as they come, and a good state with some of its bytes changed and its checksum put
//! right, so that the contents are tried too. A state that is taken must be one that can be stepped, or fail with a
//! status.
#![no_main]

use std::cell::OnceCell;
use std::ptr;

use brinell_fmi::fmi2::*;
use brinell_fuzz::{Resources, checksum, get, start};
use libfuzzer_sys::fuzz_target;

/// Where the checksum stands and what it covers.
const CHECKSUM: usize = 12;
const CHECKED_FROM: usize = 20;

struct Fixture {
    c: Component,
    good: Vec<u8>,
    home: FmuState,
    reals: Vec<u32>,
}

thread_local!(static FIXTURES: OnceCell<[Fixture; 2]> = const { OnceCell::new() });

impl Fixture {
    fn new(scene: usize) -> Self {
        let resources = Resources::new(scene);
        let c = resources.instance();
        start(c);
        let (mut home, mut size) = (ptr::null_mut(), 0);
        unsafe {
            // An element is about to leave an edge.
            for time in [0.0, 1e-3, 2e-3, 3e-3] {
                assert_eq!(fmi2DoStep(c, time, 1e-3, TRUE), Status::Ok);
            }
            assert_eq!(fmi2GetFMUstate(c, &mut home), Status::Ok);
            assert_eq!(fmi2SerializedFMUstateSize(c, home, &mut size), Status::Ok);
            let mut good = vec![0u8; size];
            assert_eq!(fmi2SerializeFMUstate(c, home, good.as_mut_ptr().cast(), size), Status::Ok);
            Self { c, good, home, reals: resources.reals() }
        }
    }

    fn check(&self, bytes: &[u8]) {
        let mut state = ptr::null_mut();
        unsafe {
            if fmi2DeSerializeFMUstate(self.c, bytes.as_ptr().cast(), bytes.len(), &mut state) == Status::Ok {
                if fmi2SetFMUstate(self.c, state) == Status::Ok {
                    get(self.c, &self.reals);
                    let mut time = 0.0;
                    fmi2GetRealStatus(self.c, LAST_SUCCESSFUL_TIME, &mut time);
                    fmi2DoStep(self.c, time, 1e-5, TRUE);
                    get(self.c, &self.reals);
                }
                fmi2FreeFMUstate(self.c, &mut state);
            }
            assert_eq!(fmi2SetFMUstate(self.c, self.home), Status::Ok);
        }
    }
}

fuzz_target!(|data: &[u8]| {
    FIXTURES.with(|fixtures| {
        // One spall of the outer raceway; defects of all bodies, an outer ring that turns, an irregular cage.
        for fixture in fixtures.get_or_init(|| [0, 3].map(Fixture::new)) {
            fixture.check(data);
            let mut bytes = fixture.good.clone();
            let length = bytes.len();
            // Eight bytes over a field, at the offset that the two before them name.
            for change in data.chunks_exact(10) {
                let offset = usize::from(u16::from_le_bytes([change[0], change[1]])) % (length - CHECKED_FROM - 8);
                bytes[CHECKED_FROM + offset..][..8].copy_from_slice(&change[2..]);
            }
            let sum = checksum(&bytes[CHECKED_FROM..]);
            bytes[CHECKSUM..CHECKED_FROM].copy_from_slice(&sum.to_le_bytes());
            fixture.check(&bytes);
        }
    });
});
