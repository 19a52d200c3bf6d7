//! The program `brinell` as a user calls it, and the tables that it writes.

use std::fs;
use std::path::Path;
use std::process::Command;

/// What a command prints, and what it says beside that.
pub(crate) struct Said {
    pub(crate) out: String,
    pub(crate) err: String,
}

/// The program with the words of a command.
pub(crate) fn brinell(words: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_brinell"));
    command.args(words);
    command
}

/// Whether a command does what it is told, and what it says.
pub(crate) fn tried(command: &mut Command) -> (bool, Said) {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    (output.status.success(), Said { out: text(output.stdout), err: text(output.stderr) })
}

/// What a command says, which must do what it is told.
#[track_caller]
pub(crate) fn done(command: &mut Command) -> Said {
    let (succeeded, said) = tried(command);
    assert!(succeeded, "{command:?}: {}{}", said.out, said.err);
    said
}

/// Why a command does not do what it is told.
#[track_caller]
pub(crate) fn refused(command: &mut Command) -> String {
    let (succeeded, said) = tried(command);
    assert!(!succeeded, "it was taken: {}", said.err);
    said.err
}

/// A CSV file: heads of its columns, as `shaft.x [m]`, and rows.
#[derive(PartialEq)]
pub(crate) struct Table {
    pub(crate) heads: Vec<String>,
    pub(crate) rows: Vec<Vec<f64>>,
}

impl Table {
    pub(crate) fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let mut lines = text.lines();
        let heads: Vec<String> = lines.next().unwrap().split(',').map(str::to_owned).collect();
        let rows = lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect());
        let table = Self { rows: rows.collect(), heads };
        assert!(table.rows.iter().all(|row| row.len() == table.heads.len()), "{}", path.display());
        table
    }

    /// Names without units.
    pub(crate) fn names(&self) -> Vec<&str> {
        self.heads.iter().map(|head| head.split(" [").next().unwrap()).collect()
    }

    /// A column by its head or its name.
    #[track_caller]
    pub(crate) fn column(&self, name: &str) -> Vec<f64> {
        let begin = format!("{name} [");
        let is_it = |head: &String| head == name || head.starts_with(&begin);
        let index = self.heads.iter().position(is_it).unwrap_or_else(|| panic!("no {name} in {:?}", self.heads));
        self.rows.iter().map(|row| row[index]).collect()
    }
}

/// Header and rows of a NumPy file of doubles.
pub(crate) fn npy(path: &Path, width: usize) -> (String, Vec<Vec<f64>>) {
    let bytes = fs::read(path).unwrap();
    assert!(bytes.starts_with(b"\x93NUMPY\x02\x00"));
    let length = 12 + u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize;
    let numbers: Vec<f64> =
        bytes[length..].chunks_exact(8).map(|eight| f64::from_le_bytes(eight.try_into().unwrap())).collect();
    assert_eq!(numbers.len() % width, 0);
    (
        String::from_utf8_lossy(&bytes[12..length]).into_owned(),
        numbers.chunks_exact(width).map(<[f64]>::to_vec).collect(),
    )
}
