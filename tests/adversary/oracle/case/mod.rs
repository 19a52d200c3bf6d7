//! A scene and what its host does, as plain numbers in the units of the scene file's keys.
//!
//! The simulation gets it as the text of a scene file and by setting inputs; the oracle reads the numbers themselves.

mod parts;
pub(crate) mod shape;
mod transform;

pub use parts::{Film, Mode, Roller, Wave};
pub use transform::Factors;

use std::fmt::Write;

#[derive(Debug, Clone)]
pub struct Case {
    pub gravity: [f64; 2],
    pub count: usize,
    pub diameter_mm: f64,
    /// Diameters of elements beyond that; none of equal ones.
    pub larger_um: Vec<f64>,
    pub pitch_mm: f64,
    pub grooves: Grooves,
    pub clearance_um: f64,
    /// Whether the scene says it as a catalogue does, twice as much.
    pub catalogue: bool,
    pub modulus_gpa: f64,
    pub poisson: f64,
    /// Young's modulus (GPa) and Poisson's ratio of elements of another material.
    pub element: Option<[f64; 2]>,
    pub density: Option<f64>,
    pub mass_g: Option<f64>,
    /// Hertz constants that override the computed ones, inner and outer (N/m^1.5).
    pub hertz: [Option<f64>; 2],
    pub compliance: f64,
    pub damping: Damping,
    pub law: &'static str,
    /// Largest force (N), cells along and across, accuracy of the map: for laws `map` and `love`.
    pub grid: Option<(f64, [u32; 2], f64)>,
    pub slip: f64,
    /// Set as a host does, as the scene has no key for it.
    pub spin_slip: f64,
    pub cage_deg: f64,
    /// Initial angles of shaft and housing.
    pub rings_deg: [f64; 2],
    pub defects: Vec<Defect>,
    pub waves: Vec<Wave>,
    /// Shaft, housing.
    pub rings: [Ring; 2],
    pub speed_hz: f64,
    /// Of an outer ring that turns.
    pub housing_hz: Option<f64>,
    /// Mass, stiffness, damping.
    pub sensor: Option<[f64; 3]>,
    /// Elements are balls without.
    pub roller: Option<Roller>,
    /// Contacts are dry without.
    pub film: Option<Film>,
    /// Of the structure below the sensor; none count without one.
    pub modes: Vec<Mode>,
    pub tolerance: f64,
    pub steps: Vec<Step>,
}

#[derive(Debug, Clone, Copy)]
pub enum Grooves {
    /// Their diameter (mm).
    Equal(f64),
    /// Conformities of the inner and the outer.
    Each(f64, f64),
}

#[derive(Debug, Clone, Copy)]
pub enum Damping {
    HuntCrossley(f64),
    Proportional(f64),
}

#[derive(Debug, Clone)]
pub struct Defect {
    pub on: On,
    pub angle_deg: f64,
    pub shape: Shape,
}

/// The body with the defect.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum On {
    Outer,
    Inner,
    /// Which, from 0, and the latitude of a pit's centre off the track.
    Element {
        element: usize,
        tilt_deg: f64,
    },
}

#[derive(Debug, Clone)]
pub enum Shape {
    Spall {
        length: Length,
        depth_um: f64,
        slope_deg: f64,
    },
    /// Arc (mm) and depth (µm).
    Trace(Vec<(f64, f64)>),
    Topography(Topography),
}

/// Depths (µm) over arcs and axial coordinates (mm), those of one arc side by side.
#[derive(Debug, Clone)]
pub struct Topography {
    pub arcs: Vec<f64>,
    pub axials: Vec<f64>,
    pub depths: Vec<f64>,
}

#[derive(Debug, Clone, Copy)]
pub enum Length {
    Degrees(f64),
    Millimetres(f64),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    Host,
    Internal,
    Fixed,
}

#[derive(Debug, Clone, Copy)]
pub struct Ring {
    pub motion: Motion,
    pub load: [f64; 2],
    pub mass: f64,
    pub damping: f64,
    pub stiffness: f64,
}

/// A communication step.
#[derive(Debug, Clone, Copy)]
pub struct Step<const AXES: usize = 2> {
    pub length: f64,
    /// What the host sets before it; without, everything stays where it is.
    pub host: Option<Host<AXES>>,
}

/// Inputs with their derivatives.
#[derive(Debug, Clone, Copy)]
pub struct Host<const AXES: usize = 2> {
    /// Speeds of shaft and housing (rad/s) with their derivatives.
    pub speeds: [[f64; 2]; 2],
    /// Of shaft and housing, along x and y, in space along x, y, z and about x, y: load, or position, with its first
    /// and second derivative [N or m, s].
    pub rings: [[[f64; 3]; AXES]; 2],
}

impl Motion {
    pub(crate) fn key(self) -> &'static str {
        match self {
            Self::Host => "host",
            Self::Internal => "internal",
            Self::Fixed => "fixed",
        }
    }
}

impl Damping {
    /// Its keys in the table of contacts.
    pub(crate) fn toml(self) -> String {
        match self {
            Self::HuntCrossley(chi) => format!("damping = \"hunt-crossley\"\ndamping_chi_s_m = {chi:?}\n"),
            Self::Proportional(tau) => format!("damping = \"proportional\"\ndamping_tau_s = {tau:?}\n"),
        }
    }
}

impl Ring {
    /// Held to the ground, without load.
    pub const FIXED: Self = Self { motion: Motion::Fixed, load: [0.0; 2], mass: 0.0, damping: 0.0, stiffness: 0.0 };
}

impl Case {
    /// Smooth balls of steel at rest between fixed rings, dry and without weight: what other cases differ from.
    pub fn at_rest() -> Self {
        Self {
            gravity: [0.0; 2],
            count: 9,
            diameter_mm: 7.94,
            larger_um: Vec::new(),
            pitch_mm: 39.32,
            grooves: Grooves::Equal(8.19),
            clearance_um: 0.0,
            catalogue: false,
            modulus_gpa: 207.0,
            poisson: 0.3,
            element: None,
            density: Some(7800.0),
            mass_g: None,
            hertz: [None; 2],
            compliance: 0.0,
            damping: Damping::HuntCrossley(0.5),
            law: "hertz",
            grid: None,
            slip: 0.0,
            spin_slip: 0.0,
            cage_deg: 0.0,
            rings_deg: [0.0; 2],
            defects: Vec::new(),
            waves: Vec::new(),
            rings: [Ring::FIXED; 2],
            speed_hz: 0.0,
            housing_hz: None,
            sensor: None,
            roller: None,
            film: None,
            modes: Vec::new(),
            tolerance: 1e-5,
            steps: Vec::new(),
        }
    }

    /// E* (Pa): what a ring and an element yield, added.
    pub fn effective_modulus(&self) -> f64 {
        let [modulus, ratio] = self.element.unwrap_or([self.modulus_gpa, self.poisson]);
        1e9 / ((1.0 - self.poisson * self.poisson) / self.modulus_gpa + (1.0 - ratio * ratio) / modulus)
    }

    /// Text of the scene file.
    pub fn toml(&self) -> String {
        let mut text = format!("name = \"adversary\"\ngravity_m_s2 = {:?}\n[bearing]\n", self.gravity);
        let mut put = |key: &str, value: f64| writeln!(text, "{key} = {value:?}").unwrap();
        put("element_diameter_mm", self.diameter_mm);
        put("pitch_diameter_mm", self.pitch_mm);
        match self.grooves {
            _ if self.roller.is_some() => {}
            Grooves::Equal(diameter) => put("groove_diameter_mm", diameter),
            Grooves::Each(inner, outer) => {
                put("conformity_inner", inner);
                put("conformity_outer", outer);
            }
        }
        match self.catalogue {
            true => put("internal_clearance_um", 2.0 * self.clearance_um),
            false => put("radial_clearance_um", self.clearance_um),
        }
        put("youngs_modulus_gpa", self.modulus_gpa);
        put("poissons_ratio", self.poisson);
        if let Some([modulus, ratio]) = self.element {
            put("element_youngs_modulus_gpa", modulus);
            put("element_poissons_ratio", ratio);
        }
        put("outer_compliance_m_n", self.compliance);
        let keys = ["density_kg_m3", "element_mass_g", "hertz_inner_n_m1_5", "hertz_outer_n_m1_5"];
        for (key, value) in keys.into_iter().zip([self.density, self.mass_g, self.hertz[0], self.hertz[1]]) {
            if let Some(value) = value {
                put(key, value);
            }
        }
        if let Some(roller) = &self.roller {
            text.push_str(&roller.toml());
        }
        if !self.larger_um.is_empty() {
            writeln!(text, "element_diameter_offsets_um = {:?}", self.larger_um).unwrap();
        }
        writeln!(text, "element_count = {}\n[contact]\nlaw = \"{}\"", self.count, self.law).unwrap();
        if let Some((force, cells, accuracy)) = self.grid {
            writeln!(text, "largest_force_n = {force:?}\ncells = {cells:?}\nmap_accuracy = {accuracy:?}").unwrap();
        }
        text.push_str(&self.damping.toml());
        if let Some(film) = &self.film {
            text.push_str(&film.toml());
        }
        writeln!(text, "[cage]\nslip = {:?}\ninitial_angle_deg = {:?}", self.slip, self.cage_deg).unwrap();
        text.push_str(&shape::tables(&self.defects));
        self.waves.iter().for_each(|wave| text.push_str(&wave.toml()));
        self.write_rings(&mut text);
        writeln!(text, "[solver]\ntolerance = {:?}", self.tolerance).unwrap();
        text
    }

    fn write_rings(&self, text: &mut String) {
        for (name, ring) in ["shaft", "housing"].into_iter().zip(&self.rings) {
            writeln!(text, "[{name}]\nmotion = \"{}\"", ring.motion.key()).unwrap();
            let (which, speed) = if name == "shaft" { (0, Some(self.speed_hz)) } else { (1, self.housing_hz) };
            if let Some(speed) = speed {
                writeln!(text, "speed_hz = {speed:?}").unwrap();
            }
            if self.rings_deg[which] != 0.0 {
                writeln!(text, "initial_angle_deg = {:?}", self.rings_deg[which]).unwrap();
            }
            if ring.motion == Motion::Internal {
                let Ring { load, mass, damping, stiffness, .. } = ring;
                writeln!(text, "load_n = {load:?}\nmass_kg = {mass:?}").unwrap();
                writeln!(text, "damping_n_s_m = {damping:?}\nstiffness_n_m = {stiffness:?}").unwrap();
            }
        }
        if let Some([mass, stiffness, damping]) = self.sensor {
            writeln!(text, "[sensor]\nmass_kg = {mass:?}\nstiffness_n_m = {stiffness:?}").unwrap();
            writeln!(text, "damping_n_s_m = {damping:?}").unwrap();
            self.modes.iter().for_each(|mode| text.push_str(&mode.toml()));
        }
    }

    /// Texts of the profile files, in the order of the defects.
    pub fn profiles(&self) -> Vec<String> {
        shape::files(&self.defects)
    }

    /// Elements with a defect, from 0, ascending.
    pub fn defective_elements(&self) -> Vec<usize> {
        let of = |defect: &Defect| match defect.on {
            On::Element { element, .. } => Some(element),
            _ => None,
        };
        let mut elements: Vec<usize> = self.defects.iter().filter_map(of).collect();
        elements.sort_unstable();
        elements.dedup();
        elements
    }

    /// Whether the inner ring has a defect or waves.
    pub fn marks_inner_ring(&self) -> bool {
        let of_waves = self.waves.iter().map(|wave| wave.on);
        self.defects.iter().map(|defect| defect.on).chain(of_waves).any(|on| on == On::Inner)
    }

    /// Length of the whole run (s).
    pub fn duration(&self) -> f64 {
        self.steps.iter().map(|step| step.length).sum()
    }
}

impl On {
    /// Whether two defects are on the same body.
    pub fn is_body_of(self, other: Self) -> bool {
        match (self, other) {
            (Self::Element { element, .. }, Self::Element { element: of, .. }) => element == of,
            (one, other) => one == other,
        }
    }
}
