//! Bytes as a serialized state: as they come, and a good state with some of its bytes changed and its checksum put
//! right, so that the contents are tried too. A state that is taken must be one that can be stepped, or fail with a
//! status.

use super::SCENES;
use crate::two::{Host, Resources};
use brinell::numerics::checksum::checksum;
use brinell_fmi::fmi2::{FmuState, Status};

/// Where the checksum stands and what it covers.
const CHECKSUM: usize = 12;
const CHECKED_FROM: usize = 20;

struct Fixture {
    host: Host,
    good: Vec<u8>,
    home: FmuState,
    reals: Vec<u32>,
}

thread_local!(static FIXTURES: [Fixture; 2] = [0, 3].map(Fixture::new));

impl Fixture {
    fn new(scene: usize) -> Self {
        let host = Host::with(Resources::new(SCENES[scene], None, "resources"), "fuzz", false);
        host.start();
        // An element is about to leave an edge.
        for time in [0.0, 1e-3, 2e-3, 3e-3] {
            assert_eq!(host.step(time, 1e-3), Status::Ok);
        }
        let home = host.save();
        Self { good: host.serialize(home), home, reals: host.reals(), host }
    }

    fn read(&self) {
        let values = self.host.get(&self.reals);
        assert!(values.iter().flatten().all(|value| value.is_finite()), "not finite under OK");
    }

    fn check(&self, bytes: &[u8]) -> bool {
        let mut restored = false;
        if let Ok(state) = self.host.deserialize(bytes) {
            restored = self.host.restore(state) == Status::Ok;
            if restored {
                self.read();
                self.host.step(self.host.last_time(), 1e-5);
                self.read();
            }
            self.host.free(state);
        }
        assert_eq!(self.host.restore(self.home), Status::Ok);
        restored
    }
}

pub(super) fn run(data: &[u8]) -> bool {
    FIXTURES.with(|fixtures| {
        let mut restored = false;
        // One spall of the outer raceway; defects of all bodies, an outer ring that turns, an irregular cage.
        for fixture in fixtures {
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
            restored |= fixture.check(&bytes);
        }
        restored
    })
}
