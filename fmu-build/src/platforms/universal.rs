//! Universal files of macOS: one file with the code for several processors, of which the system takes its own.
//!
//! A header of big-endian words (Apple's `mach-o/fat.h`) and the files one after the other, each at a multiple of the
//! largest page that any Mac has. Each file keeps its own signature, which covers that file alone.

use anyhow::{Context, Result, ensure};

const MAGIC_UNIVERSAL: u32 = 0xcafe_babe;
/// Little-endian, 64 bits.
const MAGIC_OF_ONE: u32 = 0xfeed_facf;
/// Pages of 16 KiB.
const ALIGNMENT: u32 = 14;

/// One file of those for each processor, in this order.
///
/// # Errors
/// Of a part that is no library for macOS, or too long.
pub fn join(parts: &[Vec<u8>]) -> Result<Vec<u8>> {
    let page = 1_usize << ALIGNMENT;
    let mut header = vec![MAGIC_UNIVERSAL, u32::try_from(parts.len())?];
    let mut bodies: Vec<(usize, &[u8])> = Vec::new();
    let mut end = 8 + 20 * parts.len();
    for part in parts {
        let word = |at: usize| part.get(at..at + 4).and_then(|bytes| bytes.try_into().ok()).map(u32::from_le_bytes);
        ensure!(word(0) == Some(MAGIC_OF_ONE), "no 64-bit file of macOS");
        let (processor, kind) = (word(4).context("cut short")?, word(8).context("cut short")?);
        let start = end.next_multiple_of(page);
        end = start + part.len();
        header.extend([processor, kind, u32::try_from(start)?, u32::try_from(part.len())?, ALIGNMENT]);
        bodies.push((start, part));
    }
    let mut file: Vec<u8> = header.into_iter().flat_map(u32::to_be_bytes).collect();
    for (start, body) in bodies {
        file.resize(start, 0);
        file.extend_from_slice(body);
    }
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_file_of_macos_is_refused() {
        for bytes in [&b"\x7fELF and more"[..], b"", b"\xcf\xfa\xed\xfe"] {
            assert!(join(&[bytes.to_vec()]).is_err(), "{bytes:?}");
        }
    }

    #[test]
    fn parts_start_on_pages_and_are_whole() {
        let part =
            |processor: u8| [&[0xcf, 0xfa, 0xed, 0xfe, processor, 0, 0, 1, 3, 0, 0, 0][..], &[7; 20_000]].concat();
        let file = join(&[part(7), part(12)]).unwrap();
        let word = |at: usize| u32::from_be_bytes(file[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((word(0), word(4)), (0xcafe_babe, 2));
        for (header, processor) in [(8, 7), (28, 12)] {
            let (start, length) = (word(header + 8), word(header + 12));
            assert_eq!(start % 16384, 0);
            assert!(file[start..start + length] == part(processor), "{processor}");
            assert_eq!(word(header), 0x0100_0000 + usize::from(processor));
        }
        assert_eq!(file.len(), 2 * 16384 + 16384 + 20_012);
    }
}
