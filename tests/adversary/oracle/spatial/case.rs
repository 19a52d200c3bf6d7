//! A scene in space and what its host does, in the units of the scene file's keys.

use crate::case::{Damping, Defect, Motion, shape};
use std::fmt::Write;

/// A scene whose rings have three or five degrees of freedom.
#[derive(Debug, Clone)]
pub struct SpatialCase {
    pub freedom: usize,
    pub gravity: [f64; 3],
    pub count: usize,
    pub diameter_mm: f64,
    pub pitch_mm: f64,
    pub conformities: [f64; 2],
    pub setting: AxialSetting,
    /// Of the kinematics and the tracks; left open without.
    pub operating_deg: Option<f64>,
    /// Heights of the shoulders, inner and outer (mm).
    pub shoulders_mm: [Option<f64>; 2],
    pub modulus_gpa: f64,
    pub poisson: f64,
    /// Young's modulus (GPa) and Poisson's ratio of elements of another material.
    pub element: Option<[f64; 2]>,
    pub density: f64,
    /// Of a ball, instead.
    pub mass_g: Option<f64>,
    /// Hertz constants that override the computed ones, inner and outer (N/m^1.5).
    pub hertz: [Option<f64>; 2],
    pub damping: Damping,
    pub across: f64,
    pub slip: f64,
    pub cage_deg: f64,
    /// Whether balls have inertia.
    pub inertia: bool,
    pub gyroscopic: Gyroscopic,
    /// Without topographies.
    pub defects: Vec<Defect>,
    /// Shaft, housing.
    pub rings: [SpatialRing; 2],
    pub speed_hz: f64,
    /// Of an outer ring that turns.
    pub housing_hz: Option<f64>,
    pub tolerance: f64,
    pub steps: Vec<Step>,
}

/// How loose the bearing is.
#[derive(Debug, Clone, Copy)]
pub enum AxialSetting {
    /// Radial clearance (µm).
    Radial(f64),
    /// Total axial play (µm).
    Play(f64),
    /// Free contact angle (°).
    Angle(f64),
}

/// Who holds the balls' gyroscopic couple, in balance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gyroscopic {
    Nobody,
    Outer,
    Shared,
}

impl Gyroscopic {
    fn key(self) -> &'static str {
        match self {
            Self::Nobody => "none",
            Self::Outer => "outer",
            Self::Shared => "shared",
        }
    }
}

/// A ring; its numbers along x, y, z and about x, y.
#[derive(Debug, Clone, Copy)]
pub struct SpatialRing {
    pub motion: Motion,
    pub load: [f64; 5],
    pub preload: f64,
    pub mass: f64,
    /// Of x and y; of z; of tilt.
    pub damping: [f64; 3],
    pub stiffness: [f64; 3],
    /// Transverse and polar.
    pub inertia: [f64; 2],
}

/// As in the plane, along x, y, z and about x, y.
pub type Step = crate::case::Step<5>;
pub type Host = crate::case::Host<5>;

impl SpatialRing {
    /// Held to the ground, without load.
    pub const FIXED: Self = Self {
        motion: Motion::Fixed,
        load: [0.0; 5],
        preload: 0.0,
        mass: 0.0,
        damping: [0.0; 3],
        stiffness: [0.0; 3],
        inertia: [0.0; 2],
    };

    /// A free mass (kg) without supports.
    pub const fn free(mass: f64, load: [f64; 5]) -> Self {
        Self { motion: Motion::Internal, load, mass, inertia: [5e-3, 3e-3], ..Self::FIXED }
    }
}

impl SpatialCase {
    /// Smooth steel balls of a 6205 at rest between fixed rings, dry and without weight.
    pub fn at_rest() -> Self {
        Self {
            freedom: 3,
            gravity: [0.0; 3],
            count: 9,
            diameter_mm: 7.94,
            pitch_mm: 39.04,
            conformities: [0.52; 2],
            setting: AxialSetting::Radial(5.0),
            operating_deg: Some(0.0),
            shoulders_mm: [None; 2],
            modulus_gpa: 207.0,
            poisson: 0.3,
            element: None,
            density: 7800.0,
            mass_g: None,
            hertz: [None; 2],
            damping: Damping::HuntCrossley(0.5),
            across: 0.5,
            slip: 0.0,
            cage_deg: -90.0,
            inertia: true,
            gyroscopic: Gyroscopic::Nobody,
            defects: Vec::new(),
            rings: [SpatialRing::FIXED; 2],
            speed_hz: 0.0,
            housing_hz: None,
            tolerance: 1e-9,
            steps: Vec::new(),
        }
    }

    /// E* (Pa): what a ring and a ball yield, added.
    pub fn effective_modulus(&self) -> f64 {
        let [modulus, ratio] = self.element.unwrap_or([self.modulus_gpa, self.poisson]);
        1e9 / ((1.0 - self.poisson * self.poisson) / self.modulus_gpa + (1.0 - ratio * ratio) / modulus)
    }

    /// Text of the scene file.
    pub fn toml(&self) -> String {
        let mut text = format!("name = \"spatial\"\ngravity_m_s2 = {:?}\n[bearing]\n", self.gravity);
        let mut put = |key: &str, value: f64| writeln!(text, "{key} = {value:?}").unwrap();
        put("element_diameter_mm", self.diameter_mm);
        put("pitch_diameter_mm", self.pitch_mm);
        put("conformity_inner", self.conformities[0]);
        put("conformity_outer", self.conformities[1]);
        match self.setting {
            AxialSetting::Radial(clearance) => put("radial_clearance_um", clearance),
            AxialSetting::Play(play) => put("axial_clearance_um", play),
            AxialSetting::Angle(angle) => put("contact_angle_deg", angle),
        }
        put("youngs_modulus_gpa", self.modulus_gpa);
        put("poissons_ratio", self.poisson);
        if let Some([modulus, ratio]) = self.element {
            put("element_youngs_modulus_gpa", modulus);
            put("element_poissons_ratio", ratio);
        }
        match self.mass_g {
            Some(mass) => put("element_mass_g", mass),
            None => put("density_kg_m3", self.density),
        }
        let [[k_i, k_o], [h_i, h_o]] = [self.hertz, self.shoulders_mm];
        for (key, value) in [
            ("operating_angle_deg", self.operating_deg),
            ("hertz_inner_n_m1_5", k_i),
            ("hertz_outer_n_m1_5", k_o),
            ("shoulder_inner_mm", h_i),
            ("shoulder_outer_mm", h_o),
        ] {
            if let Some(value) = value {
                put(key, value);
            }
        }
        let inertia = if self.inertia { "full" } else { "none" };
        writeln!(text, "element_count = {}\ndegrees_of_freedom = {}", self.count, self.freedom).unwrap();
        writeln!(text, "element_inertia = \"{inertia}\"\ngyroscopic = \"{}\"", self.gyroscopic.key()).unwrap();
        text.push_str("[contact]\nlaw = \"hertz\"\n");
        text.push_str(&self.damping.toml());
        writeln!(text, "across_damping_s_m = {:?}", self.across).unwrap();
        writeln!(text, "[cage]\nslip = {:?}\ninitial_angle_deg = {:?}", self.slip, self.cage_deg).unwrap();
        text.push_str(&shape::tables(&self.defects));
        self.write_rings(&mut text);
        writeln!(text, "[solver]\ntolerance = {:?}", self.tolerance).unwrap();
        text
    }

    fn write_rings(&self, text: &mut String) {
        for (which, ring) in self.rings.iter().enumerate() {
            let name = ["shaft", "housing"][which];
            writeln!(text, "[{name}]\nmotion = \"{}\"", ring.motion.key()).unwrap();
            if let Some(speed) = [Some(self.speed_hz), self.housing_hz][which] {
                writeln!(text, "speed_hz = {speed:?}").unwrap();
            }
            if ring.motion != Motion::Internal {
                continue;
            }
            let [x, y, z, moment_x, moment_y] = ring.load;
            let ([across, along, tilt], [k_across, k_along, k_tilt]) = (ring.damping, ring.stiffness);
            writeln!(text, "load_n = [{x:?}, {y:?}, {z:?}]\npreload_n = {:?}", ring.preload).unwrap();
            writeln!(text, "mass_kg = {:?}\ndamping_n_s_m = {across:?}\nstiffness_n_m = {k_across:?}", ring.mass)
                .unwrap();
            writeln!(text, "axial_damping_n_s_m = {along:?}\naxial_stiffness_n_m = {k_along:?}").unwrap();
            if self.freedom == 5 && which == 0 {
                let [transverse, polar] = ring.inertia;
                writeln!(text, "load_moment_n_m = [{moment_x:?}, {moment_y:?}]").unwrap();
                writeln!(text, "transverse_inertia_kg_m2 = {transverse:?}\npolar_inertia_kg_m2 = {polar:?}").unwrap();
                writeln!(text, "tilt_damping_n_m_s = {tilt:?}\ntilt_stiffness_n_m_rad = {k_tilt:?}").unwrap();
            }
        }
    }

    /// Texts of the profile files, in the order of the defects.
    pub fn profiles(&self) -> Vec<String> {
        shape::files(&self.defects)
    }

    /// Length of the whole run (s).
    pub fn duration(&self) -> f64 {
        self.steps.iter().map(|step| step.length).sum()
    }
}
