//! What macOS reads of a file before it loads it.
#![allow(dead_code, clippy::unwrap_used)] // each test binary uses a part of this

use object::macho::{self, MachHeader64};
use object::read::macho::{FatArch, LoadCommandVariant, MachHeader, MachOFatFile32};
use object::{BinaryFormat, LittleEndian};

/// One of the files in a universal one.
pub(crate) struct Part<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) processor: macho::CpuType,
    /// Library or program.
    pub(crate) kind: macho::FileType,
    /// Of a library: by which name others would look for it.
    pub(crate) install_name: Option<String>,
    /// Oldest version of macOS.
    pub(crate) oldest: Option<u32>,
    /// What it loads.
    pub(crate) needs: Vec<String>,
    pub(crate) signed: bool,
}

/// The files in a universal one.
pub(crate) fn parts(bytes: &[u8]) -> Vec<Part<'_>> {
    let whole = MachOFatFile32::parse(bytes).unwrap();
    whole.arches().iter().map(|part| read(part.data(bytes).unwrap())).collect()
}

fn read(bytes: &[u8]) -> Part<'_> {
    assert_eq!(object::File::parse(bytes).unwrap().format(), BinaryFormat::MachO);
    let header = MachHeader64::<LittleEndian>::parse(bytes, 0).unwrap();
    let (processor, kind) = (header.cputype(LittleEndian), header.filetype(LittleEndian));
    let mut part = Part { bytes, processor, kind, install_name: None, oldest: None, needs: Vec::new(), signed: false };
    let mut commands = header.load_commands(LittleEndian, bytes, 0).unwrap();
    while let Some(command) = commands.next().unwrap() {
        let text = |at| String::from_utf8_lossy(command.string(LittleEndian, at).unwrap()).into_owned();
        match command.variant().unwrap() {
            LoadCommandVariant::IdDylib(id) => part.install_name = Some(text(id.dylib.name)),
            LoadCommandVariant::Dylib(used) => part.needs.push(text(used.dylib.name)),
            LoadCommandVariant::BuildVersion(version, _) => {
                assert_eq!(version.platform.get(LittleEndian), macho::PLATFORM_MACOS);
                part.oldest = Some(version.minos.get(LittleEndian).0 >> 16);
            }
            LoadCommandVariant::LinkeditData(data) if command.cmd() == macho::LC_CODE_SIGNATURE => {
                let at = data.dataoff.get(LittleEndian) as usize;
                // The magic number of a signature that holds others (Apple's `cs_blobs.h`).
                part.signed = bytes[at..at + 4] == [0xfa, 0xde, 0x0c, 0xc0];
            }
            _ => {}
        }
    }
    part
}

/// What holds of our libraries and programs alike: they serve both processors from version 11 on.
pub(crate) fn check(parts: &[Part<'_>]) {
    for part in parts {
        assert_eq!(part.oldest, Some(11));
        assert_eq!(part.needs, ["/usr/lib/libSystem.B.dylib"]);
        // Macs with Apple's processors load nothing unsigned.
        assert!(part.signed || part.processor == macho::CPU_TYPE_X86_64);
    }
    let processors: Vec<_> = parts.iter().map(|part| part.processor).collect();
    assert_eq!(processors, [macho::CPU_TYPE_X86_64, macho::CPU_TYPE_ARM64]);
}
