//! The zip file: reproducible to the byte, and plain enough for every importer.
#![allow(clippy::unwrap_used)]

use crate::common;
use fmu_build::package::{Archive, ArchiveError, Binary, Compressed, Library, fmu};
use fmu_build::platforms::PLATFORMS;
use fmu_build::shared::Version;

#[test]
fn packing_a_scene_twice_gives_equal_bytes() {
    let packed = |library: &Library| {
        let packed =
            |name| [Version::Fmi2, Version::Fmi3].map(|v| fmu::pack(&common::model(name), library, v).unwrap());
        ["6205-epps", "er16k-tb1"].map(packed)
    };
    let first = packed(common::library());
    // A clock that got in would show in the entries' dates, below.
    let anew = common::library().binaries().iter().map(|binary| Binary::new(binary.platform, binary.bytes.clone()));
    assert!(first == packed(&Library::of(anew.collect())), "bytes differ");
}

#[test]
fn a_file_compressed_before_has_the_bytes_of_one_compressed_in_its_archive() {
    let contents = [b"library ".repeat(1000), (0..=255).collect()].concat();
    let [mut plain, mut compressed] = [Archive::default(), Archive::default()];
    plain.add("binaries/linux64/m.so", contents.as_slice()).unwrap();
    compressed.add_compressed("binaries/linux64/m.so", Compressed::executable(&contents).unwrap()).unwrap();
    for archive in [&mut plain, &mut compressed] {
        archive.add("resources/scene.toml", "name = \"6205\"").unwrap();
    }
    assert_eq!(plain.to_zip().unwrap(), compressed.to_zip().unwrap());
}

#[test]
fn an_fmu_holds_what_the_standard_names_and_nothing_else() {
    let bytes = fmu::pack(&common::model("6205-epps"), common::library(), Version::Fmi2).unwrap();
    let names: Vec<_> = headers(&bytes).into_iter().map(|header| header.name).collect();
    let library = format!(
        "binaries/{}/Brinell_6205_epps.{}",
        fmu_build::platforms::Platform::host().unwrap().name,
        std::env::consts::DLL_EXTENSION
    );
    let expected = [
        library.as_str(),
        "documentation/index.html",
        "documentation/licenses/LICENSE-APACHE",
        "documentation/licenses/LICENSE-MIT",
        "documentation/licenses/license.txt",
        "documentation/licenses/third-party.txt",
        "model.png",
        "modelDescription.xml",
        "resources/6205-epps-trace.csv",
        "resources/map.bin",
        "resources/model.bin",
        "resources/scene.toml",
        "terminalsAndIcons/icon.png",
        "terminalsAndIcons/terminalsAndIcons.xml",
    ];
    assert_eq!(names, expected);
}

#[test]
fn an_fmu_of_fmi_3_holds_the_library_in_the_folder_of_every_processor_and_terminals_with_an_icon() {
    let binaries = PLATFORMS.map(|platform| Binary::new(platform, platform.name.as_bytes().to_vec()));
    let bytes = fmu::pack(&common::model("6205-epps"), &Library::of(binaries.to_vec()), Version::Fmi3).unwrap();
    let names: Vec<_> = headers(&bytes).into_iter().map(|header| header.name).collect();
    let expected = [
        "binaries/aarch64-darwin/Brinell_6205_epps.dylib",
        "binaries/aarch64-linux/Brinell_6205_epps.so",
        "binaries/x86_64-darwin/Brinell_6205_epps.dylib",
        "binaries/x86_64-linux/Brinell_6205_epps.so",
        "binaries/x86_64-windows/Brinell_6205_epps.dll",
        "documentation/index.html",
        "documentation/licenses/LICENSE-APACHE",
        "documentation/licenses/LICENSE-MIT",
        "documentation/licenses/license.txt",
        "documentation/licenses/third-party.txt",
        "modelDescription.xml",
        "resources/6205-epps-trace.csv",
        "resources/map.bin",
        "resources/model.bin",
        "resources/scene.toml",
        "terminalsAndIcons/icon.png",
        "terminalsAndIcons/terminalsAndIcons.xml",
    ];
    assert_eq!(names, expected);
}

#[test]
fn every_entry_is_plain_zip_2_0_without_extra_fields() {
    let packed = |version| fmu::pack(&common::model("6205-epps"), common::library(), version).unwrap();
    for header in [Version::Fmi2, Version::Fmi3].into_iter().flat_map(|version| headers(&packed(version))) {
        let name = &header.name;
        assert!(header.version_needed <= 20, "{name}: needs version {}", header.version_needed);
        assert!([0, 8].contains(&header.method), "{name}: method {} is neither store nor deflate", header.method);
        assert_eq!(header.flags, 0, "{name}: flags");
        for date in [header.date, header.local_date] {
            assert_eq!(date, 0x21 << 16, "{name}: 1980-01-01, midnight, the oldest date of zip");
        }
        assert_eq!((header.extra, header.comment), (0, 0), "{name}: extra field and comment");
        assert_eq!((header.local_flags, header.local_extra), (0, 0), "{name}: local header");
        assert_eq!(header.system, 3, "{name}: of Unix, on whatever system it was written");
        assert_eq!(header.kind, 0o100_000, "{name}: a plain file, no link");
    }
}

#[test]
fn names_that_unpack_differently_elsewhere_are_refused() {
    for name in ["", "/a", "a//b", "a\\b", "../a", "a/..", "C:a", "a/"] {
        let refused = Archive::default().add(name, "");
        assert!(matches!(refused, Err(ArchiveError::Name(_))), "{name:?} was taken");
    }
}

struct Header {
    name: String,
    system: u16,
    version_needed: u16,
    flags: u16,
    method: u16,
    date: u32,
    local_date: u32,
    extra: u16,
    comment: u16,
    kind: u32,
    local_flags: u16,
    local_extra: u16,
}

/// The central directory, read by hand after the format's description (APPNOTE 4.3.12), so that the writer does not
/// check itself.
fn headers(zip: &[u8]) -> Vec<Header> {
    let u16_at = |at: usize| u16::from_le_bytes(zip[at..at + 2].try_into().unwrap());
    let u32_at = |at: usize| u32::from_le_bytes(zip[at..at + 4].try_into().unwrap());
    let end = zip.len() - 22;
    assert_eq!(u32_at(end), 0x0605_4b50, "the file ends with the end record, without comment");
    let count = u16_at(end + 10);
    let mut at = u32_at(end + 16) as usize;
    let mut headers = Vec::new();
    for _ in 0..count {
        assert_eq!(u32_at(at), 0x0201_4b50, "central header");
        let local = u32_at(at + 42) as usize;
        assert_eq!(u32_at(local), 0x0403_4b50, "local header");
        let length = u16_at(at + 28) as usize;
        headers.push(Header {
            name: String::from_utf8(zip[at + 46..at + 46 + length].to_vec()).unwrap(),
            system: u16_at(at + 4) >> 8,
            version_needed: u16_at(at + 6).max(u16_at(local + 4)),
            flags: u16_at(at + 8),
            method: u16_at(at + 10),
            date: u32_at(at + 12),
            local_date: u32_at(local + 10),
            extra: u16_at(at + 30),
            comment: u16_at(at + 32),
            kind: (u32_at(at + 38) >> 16) & 0o170_000,
            local_flags: u16_at(local + 6),
            local_extra: u16_at(local + 28),
        });
        at += 46 + length + usize::from(u16_at(at + 30)) + usize::from(u16_at(at + 32));
    }
    headers
}
