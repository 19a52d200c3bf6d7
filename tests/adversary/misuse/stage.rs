//! Where walks take place: scenes, and folders for recordings, good and bad.

use super::chance::Chance;
use super::disk;
use crate::two::{Host, Resources};
use brinell::simulation::interface::table::{Causality, Kind, Variable};
use brinell_tests::resources::scratch;
use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

/// Unpacked resources of a scene, and what its model description would tell.
pub(crate) struct Stage {
    pub(super) name: &'static str,
    pub(super) resources: Arc<Resources>,
    pub(super) table: Vec<Variable>,
    /// It comes with a contact map, which holds for one clearance. One for another takes seconds, or minutes without
    /// optimisation.
    mapped: bool,
}

/// Rings inside and from the host, an outer ring that turns, spall, trace and none, defects inside, on a ball and in
/// both raceways, an irregular cage, several sensors and a probe; a recorder as fast as one may be, so that it writes
/// within a walk; and if there is one, the contact map of a scene, which instances share.
pub(crate) fn stages(map: impl FnOnce(&str) -> Option<Vec<u8>>) -> Vec<Stage> {
    let list = [
        // The first are for instances that share names.
        ("er16k-tb1", true),
        ("6205-epps", true),
        ("6205-hosted", false),
        ("er16k-tb1-hosted-shaft", false),
        ("6205-healthy", true),
        ("er16k-inner", true),
        ("er16k-element", false),
        ("er16k-turning-outer", true),
        ("6205-two-defects", false),
        ("6205-irregular-cage", true),
    ];
    // A step that a walk has made impossible ends soon.
    let bounded = |text: String| text.replace("[solver]", "[solver]\nmax_steps = 2000");
    // At the speeds of these walks so strong a damper leaves nothing of a contact's force at an edge, and a start has
    // no balance.
    let bounded = |text: String| bounded(text).replace("damping_chi_s_m = 20.0", "damping_chi_s_m = 0.5");
    let stage = |(name, recorder): (&'static str, bool)| {
        let edit = |text: String| bounded(text) + if recorder { "\n[recorder]\nrate_hz = 1e6\n" } else { "" };
        Stage::new(name, Resources::edited(name, "resources", edit))
    };
    let text = bounded(include_str!("../../../scenes/er16k-tb1.toml").to_owned());
    let mapped = map(&text).map(|map| {
        Stage::new("er16k-tb1 with its contact map", Resources::new(&text, None, "resources").with_map(&map))
    });
    list.into_iter().map(stage).chain(mapped).collect()
}

impl Stage {
    fn new(name: &'static str, resources: Resources) -> Self {
        let host = Host::with(resources, "stage", false);
        let mapped = host.resources.directory.join("map.bin").exists();
        Self { name, table: host.table().to_vec(), resources: Arc::clone(&host.resources), mapped }
    }

    /// Inputs, and parameters if they are not yet `fixed`.
    pub(super) fn settable(&self, fixed: bool) -> Vec<u32> {
        self.references(|v| {
            is_real(v) && (v.causality == Causality::Input || v.causality == Causality::Parameter && !fixed)
        })
    }

    /// Whether it takes a new contact map to set this.
    pub(super) fn takes_long(&self, reference: u32) -> bool {
        let name = self.variable(reference).name.as_str();
        self.mapped && matches!(name, "bearing.internal_clearance" | "defect.length" | "defect.depth")
    }

    pub(super) fn references(&self, wanted: impl Fn(&Variable) -> bool) -> Vec<u32> {
        self.table.iter().filter(|variable| wanted(variable)).map(|variable| variable.reference).collect()
    }

    pub(super) fn reals(&self, causality: Option<Causality>) -> Vec<u32> {
        let wanted = |v: &Variable| is_real(v) && causality.is_none_or(|causality| v.causality == causality);
        self.references(wanted)
    }

    pub(super) fn integers(&self) -> Vec<u32> {
        self.references(|v| matches!(v.kind, Kind::Integer | Kind::Whole { .. } | Kind::Enumeration { .. }))
    }

    pub(super) fn folder(&self) -> Option<u32> {
        self.references(|v| v.name == "recorder.folder").first().copied()
    }

    pub(super) fn variable(&self, reference: u32) -> &Variable {
        &self.table[reference as usize]
    }

    /// A reference that is not one.
    pub(super) fn unknown(&self, chance: &mut Chance) -> u32 {
        *chance.pick(&[self.table.len() as u32, self.table.len() as u32 + 7, 1 << 20, i32::MAX as u32, u32::MAX])
    }
}

pub(super) fn is_real(variable: &Variable) -> bool {
    matches!(variable.kind, Kind::Real { .. })
}

/// A value that a sensible host might set: every step after it must succeed.
pub(super) fn gentle(variable: &Variable, chance: &mut Chance) -> f64 {
    let (low, high) = match variable.name.as_str() {
        "shaft.speed" => (-300.0, 300.0),
        "shaft.load.x" => (-400.0, 400.0),
        "shaft.load.y" => (-900.0, -100.0),
        "housing.load.x" | "housing.load.y" => (-300.0, 300.0),
        "shaft.x" | "shaft.y" | "housing.x" | "housing.y" => (-15e-6, 15e-6),
        "shaft.vx" | "shaft.vy" | "housing.vx" | "housing.vy" => (-5e-3, 5e-3),
        "shaft.ax" | "shaft.ay" | "housing.ax" | "housing.ay" => (-10.0, 10.0),
        "bearing.internal_clearance" => (2e-6, 4e-5),
        "contact.damping" => (0.1, 1.0),
        "cage.slip" => (0.0, 0.1),
        "cage.initial_angle" | "shaft.initial_angle" | "housing.initial_angle" => (-7.0, 7.0),
        // Two in one body would come to overlap; here they are in two.
        "defect.angle" | "defect[1].angle" | "defect[2].angle" => (-7.0, 7.0),
        "housing.speed" => (-100.0, 100.0),
        "element.spin_slip" => (-0.1, 0.1),
        "shaft.mass" | "housing.mass" => (1.0, 10.0),
        "shaft.damping" | "housing.damping" => (100.0, 3000.0),
        "shaft.stiffness" | "housing.stiffness" => (1e6, 1e8),
        "solver.tolerance" => (1e-7, 1e-4),
        name if name.ends_with(".resonance") => (5e3, 3e4),
        // Fast enough that a walk writes.
        "recorder.rate" => (2e5, 1e6),
        name if name.starts_with("defect") && name.ends_with(".length") => (1e-3, 3e-3),
        name if name.starts_with("defect") && name.ends_with(".depth") => (5e-6, 5e-5),
        name => panic!("{name}: say what a sensible host would set"),
    };
    chance.between(low, high)
}

/// A value within the limits of a variable, and no more sensible than that.
pub(super) fn wild(variable: &Variable, chance: &mut Chance) -> f64 {
    let Kind::Real { min: Some(min), max: Some(max), .. } = variable.kind else { panic!("{}", variable.name) };
    match chance.below(5) {
        0 => min,
        1 => max,
        2 => chance.between(min, max),
        3 => 0.0f64.clamp(min, max),
        _ => (chance.decades(1e-12, 1e6) * if chance.one_in(2) { 1.0 } else { -1.0 }).clamp(min, max),
    }
}

/// A value that a variable cannot have.
pub(super) fn impossible(variable: &Variable, chance: &mut Chance) -> f64 {
    let Kind::Real { min: Some(min), max: Some(max), .. } = variable.kind else { panic!("{}", variable.name) };
    *chance.pick(&[f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY, max.next_up(), min.next_down(), f64::MAX])
}

/// Which disk is full.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum FullDisk {
    None,
    /// Files that lead to `/dev/full`.
    Device,
    /// A file system.
    Small(PathBuf),
}

/// Where recordings may go.
pub(super) struct Folders {
    root: PathBuf,
    full: FullDisk,
}

impl Folders {
    /// Folders of the walk of this number.
    pub(super) fn new(walk: u64, full: FullDisk) -> Self {
        let root = scratch().join(format!("misuse-{}-{walk}", std::process::id()));
        fs::create_dir_all(&root).unwrap();
        fs::write(root.join("file"), "no folder").unwrap();
        Self { root, full }
    }

    /// One that all instances of a walk share.
    pub(super) fn shared(&self) -> PathBuf {
        self.root.join("shared")
    }

    /// One of its own for each twin.
    pub(super) fn own(&self, number: u64) -> PathBuf {
        self.root.join(format!("twin-{number}"))
    }

    /// One that has no room, if there is one.
    pub(super) fn full(&self) -> Option<PathBuf> {
        match &self.full {
            FullDisk::None => None,
            FullDisk::Device => Some(self.root.join("full")),
            FullDisk::Small(folder) => Some(folder.clone()),
        }
    }

    /// Sees to it that the instance of this name finds no room there.
    pub(super) fn prepare(&self, name: &str) {
        if self.full == FullDisk::Device {
            let stem = name.replace([' ', '/', '%'], "_");
            disk::lead_to_dev_full(&self.root.join("full"), &format!("{stem}.npy"));
        }
    }

    /// A file where a folder should be.
    pub(super) fn blocked(&self) -> PathBuf {
        self.root.join("file").join("folder")
    }
}

impl Drop for Folders {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.root);
    }
}
