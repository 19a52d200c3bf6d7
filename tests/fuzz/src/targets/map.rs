//! Bytes as a contact map: as they come, and with fingerprint and checksum put right, so that the contents are tried
//! too.

use std::sync::Arc;

use brinell::contact::map::ContactMap;
use brinell::contact::near_defect::{LoveSolvers, NearDefect, NearMap};
use brinell::numerics::number::Dual;

const RACEWAY: f64 = 23.6e-3;

pub(super) fn run(data: &[u8]) -> bool {
    if ContactMap::from_bytes(data, 0).is_ok() {
        check(data);
    }
    let mut bytes = b"BRNL-MAP\x02\0\0\0".to_vec();
    bytes.extend_from_slice(&[0; 8]);
    bytes.extend_from_slice(data);
    bytes.extend_from_slice(&brinell::numerics::checksum::checksum(&bytes).to_le_bytes());
    check(&bytes)
}

fn check(bytes: &[u8]) -> bool {
    let Ok(map) = ContactMap::from_bytes(bytes, 0) else { return false };
    let near = NearDefect::Map(NearMap::new(Arc::new(map), RACEWAY));
    let knots = near.knots().to_vec();
    for cell in 0..knots.len().saturating_sub(1) {
        for share in [0.0, 0.3, 1.0] {
            let angle = knots[cell] + share * (knots[cell + 1] - knots[cell]);
            for path in [-1e-5, 0.0, 1e-7, 1e-5, 2e-4] {
                // With derivatives it is asked for more.
                let dual = Dual::<Dual<f64, 1>, 1>::variable;
                let [path, angle] = [path, angle].map(|value| dual(Dual::variable(value, 0), 0));
                let _ = near.approach(cell, path, angle, Dual::from(RACEWAY), true, &mut LoveSolvers::default());
            }
        }
    }
    true
}
