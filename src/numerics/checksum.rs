//! Checksums and fingerprints: FNV-1a (Fowler, Noll and Vo), with 64 and with 128 bits; parameters from the Internet
//! draft draft-eastlake-fnv.
//!
//! They guard against damage and mix-ups, not against malice. Every step is a bijection of the running value, so that
//! no single byte can change without the sum.

use std::hash::Hasher;

const OFFSET_64: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME_64: u64 = 0x0000_0100_0000_01b3;
const OFFSET_128: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
const PRIME_128: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

/// The sum with 64 bits, of bytes as they come.
#[derive(Debug, Clone, Copy)]
pub struct Checksum(u64);

impl Default for Checksum {
    fn default() -> Self {
        Self(OFFSET_64)
    }
}

impl Hasher for Checksum {
    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(PRIME_64);
        }
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

/// The sum with 64 bits.
pub fn checksum(bytes: &[u8]) -> u64 {
    let mut sum = Checksum::default();
    sum.write(bytes);
    sum.finish()
}

/// The sum with 128 bits of parts one after the other.
pub fn wide_checksum<'a>(parts: impl IntoIterator<Item = &'a [u8]>) -> u128 {
    let step = |sum: u128, byte: &u8| (sum ^ u128::from(*byte)).wrapping_mul(PRIME_128);
    parts.into_iter().flatten().fold(OFFSET_128, step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sums_are_the_published_test_values() {
        // FNV-1a of "a", from the authors' test vectors.
        assert_eq!(checksum(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(wide_checksum([&b"a"[..]]), 0xd228_cb69_6f1a_8caf_7891_2b70_4e4a_8964);
    }
}
