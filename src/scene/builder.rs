//! Scenes made by a Rust program. What is not said has the value that a scene file gives it.

use super::{
    AxialSupport, Bearing, Cage, CageIrregularity, Contact, ContactEdge, ContactLaw, Damping, Defect, DefectShape,
    DegreesOfFreedom, ElementInertia, Experiment, Film, Gyroscopic, Motion, Recorder, RepeatedInputs, Ring, Roller,
    RollerProfile, RollingElement, Scene, SceneError, Sensor, TiltSupport, Waviness,
};
use std::f64::consts::FRAC_PI_2;

/// A scene under construction; [`build`](Self::build) checks it.
#[derive(Debug, Clone)]
#[must_use]
pub struct SceneBuilder {
    scene: Scene,
    /// `None` for the map with a defect and Hertz's law without.
    law: Option<ContactLaw>,
}

impl Scene {
    /// Begins a scene with this bearing: healthy, shaft and housing with mass on supports, no load, standing still.
    ///
    /// ```
    /// use brinell::scene::{Bearing, Scene};
    ///
    /// let scene = Scene::builder(Bearing::steel_balls(9, 7.94e-3, 39.04e-3))
    ///     .name("6205-spall")
    ///     .shaft_speed(157.1)
    ///     .shaft_load([0.0, -1500.0])
    ///     .spall(-std::f64::consts::FRAC_PI_2, 2e-3, 50e-6)
    ///     .build()?;
    /// assert_eq!(scene.bearing.element_count, 9);
    /// # Ok::<(), brinell::scene::SceneError>(())
    /// ```
    pub fn builder(bearing: Bearing) -> SceneBuilder {
        let scene = Self {
            name: "bearing".to_owned(),
            description: String::new(),
            gravity: [0.0, -9.81],
            axial_gravity: 0.0,
            bearing,
            contact: Contact {
                law: ContactLaw::Hertz,
                damping: Damping::HuntCrossley(0.5),
                across_damping: None,
                largest_force: None,
                cells: None,
                map_accuracy: None,
                flank_map: false,
                edge: ContactEdge::HalfSpace,
            },
            film: None,
            cage: Cage { slip: 0.0, spin_slip: 0.0, initial_angle: -FRAC_PI_2, irregularity: None },
            defects: Vec::new(),
            waviness: Vec::new(),
            shaft: Ring::default_shaft(),
            shaft_speed: 0.0,
            shaft_initial_angle: 0.0,
            housing: Ring::default_housing(),
            housing_speed: None,
            housing_initial_angle: 0.0,
            sensors: Vec::new(),
            probe: false,
            tolerance: 1e-5,
            max_steps: 10_000_000,
            recorder: None,
            repeated_inputs: RepeatedInputs::Start,
            experiment: Experiment { stop: 0.5, step: 1e-4 },
        };
        SceneBuilder { scene, law: None }
    }
}

impl Bearing {
    /// A ball bearing of steel: `count` balls of a diameter (m) on a pitch diameter (m). Conformities 0.52, radial
    /// clearance 5 µm, Young's modulus 207 GPa, Poisson's ratio 0.3, density 7800 kg/m³: all usual values, assumed.
    pub fn steel_balls(count: usize, element_diameter: f64, pitch_diameter: f64) -> Self {
        Self {
            element: RollingElement::Ball,
            element_count: count,
            element_diameter,
            diameter_offsets: Vec::new(),
            drawn_diameters: None,
            pitch_diameter,
            conformity_inner: 0.52,
            conformity_outer: 0.52,
            radial_clearance: 5e-6,
            degrees_of_freedom: DegreesOfFreedom::Two,
            contact_angle: None,
            operating_angle: None,
            shoulder_inner: None,
            shoulder_outer: None,
            gyroscopic: Gyroscopic::None,
            youngs_modulus: 207e9,
            poissons_ratio: 0.3,
            element_youngs_modulus: None,
            element_poissons_ratio: None,
            density: 7800.0,
            element_mass: None,
            hertz_inner: None,
            hertz_outer: None,
            outer_compliance: 0.0,
            element_inertia: ElementInertia::Full,
        }
    }

    /// A cylindrical roller bearing of steel: `count` rollers of a diameter and an effective length (m) on a pitch
    /// diameter (m), with the logarithmic crown of ISO/TS 16281. The rest as [`steel_balls`](Self::steel_balls) has it.
    pub fn steel_rollers(count: usize, element_diameter: f64, length: f64, pitch_diameter: f64) -> Self {
        let roller = Roller { length, profile: RollerProfile::Logarithmic, laminae: Roller::LAMINAE };
        Self {
            element: RollingElement::CylindricalRoller(roller),
            conformity_inner: f64::INFINITY,
            conformity_outer: f64::INFINITY,
            ..Self::steel_balls(count, element_diameter, pitch_diameter)
        }
    }
}

impl Ring {
    /// Loads along x, y and z (N), and moments about x and y (N m).
    pub fn loads(&self) -> [f64; 5] {
        let ([x, y], [m_x, m_y]) = (self.load, self.tilt.load_moment);
        [x, y, self.axial.load, m_x, m_y]
    }

    /// The inner ring with its shaft: a free mass. Values of published models of a bearing test rig with five degrees
    /// of freedom (attributed to Sawalhi and Randall 2008), except the stiffness: a shaft that is held to the ground
    /// as stiffly as a bearing is stiff would carry the load itself.
    pub fn default_shaft() -> Self {
        Self::supported(3.2638, 1376.8, 0.0, TiltSupport::ASSUMED)
    }

    /// The outer ring with its pedestal: a mass on a support, from the same models.
    pub fn default_housing() -> Self {
        Self::supported(6.638, 2210.7, 1.51056e7, TiltSupport::NONE)
    }

    /// A ring with a mass (kg) on a support that damps (N s/m) and holds (N/m) it along its axis as across it.
    const fn supported(mass: f64, damping: f64, stiffness: f64, tilt: TiltSupport) -> Self {
        let axial = AxialSupport { damping, stiffness, ..AxialSupport::NONE };
        Self { motion: Motion::Internal, mass, damping, stiffness, axial, tilt, ..Self::hosted() }
    }

    /// A ring whose position and velocity the host gives at each communication point.
    pub const fn hosted() -> Self {
        let (axial, tilt) = (AxialSupport::NONE, TiltSupport::NONE);
        Self { motion: Motion::Host, load: [0.0; 2], mass: 0.0, damping: 0.0, stiffness: 0.0, axial, tilt }
    }

    /// A ring that stands still.
    pub const fn fixed() -> Self {
        Self { motion: Motion::Fixed, ..Self::hosted() }
    }
}

impl Default for Sensor {
    /// A resonator of 15 kHz with 5 % of critical damping that measures along y, from the same models as the rings'
    /// supports.
    fn default() -> Self {
        let (name, modes) = (String::new(), Vec::new());
        Self { name, direction: FRAC_PI_2, elevation: 0.0, mass: 1.0, stiffness: 8.8826e9, damping: 9424.8, modes }
    }
}

impl SceneBuilder {
    /// Name, which becomes that of the FMU: letters, digits, `-` and `_`.
    pub fn name(mut self, name: &str) -> Self {
        name.clone_into(&mut self.scene.name);
        self
    }

    /// One line about it for the reader.
    pub fn description(mut self, description: &str) -> Self {
        description.clone_into(&mut self.scene.description);
        self
    }

    /// Gravity (m/s²), x and y.
    pub fn gravity(mut self, gravity: [f64; 2]) -> Self {
        self.scene.gravity = gravity;
        self
    }

    /// In how many directions the rings move.
    pub fn degrees_of_freedom(mut self, freedom: DegreesOfFreedom) -> Self {
        self.scene.bearing.degrees_of_freedom = freedom;
        self
    }

    /// Axial load on the inner ring (N), along z.
    pub fn axial_load(mut self, load: f64) -> Self {
        self.scene.shaft.axial.load = load;
        self
    }

    /// Shaft speed (rad/s), counter-clockwise.
    pub fn shaft_speed(mut self, speed: f64) -> Self {
        self.scene.shaft_speed = speed;
        self
    }

    /// Angle of the inner ring at the start (rad), from which its defects are counted.
    pub fn shaft_initial_angle(mut self, angle: f64) -> Self {
        self.scene.shaft_initial_angle = angle;
        self
    }

    /// Load on the inner ring (N), x and y.
    pub fn shaft_load(mut self, load: [f64; 2]) -> Self {
        self.scene.shaft.load = load;
        self
    }

    /// The inner ring and who moves it; its load with it.
    pub fn shaft(mut self, ring: Ring) -> Self {
        self.scene.shaft = ring;
        self
    }

    /// The outer ring and who moves it; its load with it.
    pub fn housing(mut self, ring: Ring) -> Self {
        self.scene.housing = ring;
        self
    }

    /// Speed of the outer ring (rad/s), counter-clockwise; without it the ring does not turn and has no such input.
    pub fn housing_speed(mut self, speed: f64) -> Self {
        self.scene.housing_speed = Some(speed);
        self
    }

    /// Angle of the outer ring at the start (rad), from which its defects are counted.
    pub fn housing_initial_angle(mut self, angle: f64) -> Self {
        self.scene.housing_initial_angle = angle;
        self
    }

    /// A spall of the outer raceway with vertical edges: angle of its centre (rad), length (m) and depth (m).
    pub fn spall(self, angle: f64, length: f64, depth: f64) -> Self {
        self.defect(Defect::outer(angle, DefectShape::Spall { length, depth, edge_slope: FRAC_PI_2 }))
    }

    /// One defect more, of either raceway or of an element.
    pub fn defect(mut self, defect: Defect) -> Self {
        self.scene.defects.push(defect);
        self
    }

    /// Waves of one order more around a body.
    pub fn waviness(mut self, waves: Waviness) -> Self {
        self.scene.waviness.push(waves);
        self
    }

    /// Law of the contacts near the defect.
    pub fn law(mut self, law: ContactLaw) -> Self {
        self.law = Some(law);
        self
    }

    /// Damping of the contacts.
    pub fn damping(mut self, damping: Damping) -> Self {
        self.scene.contact.damping = damping;
        self
    }

    /// Cells of the contact grid of laws `map` and `love` along and across Hertz's ellipse at the largest force.
    pub fn contact_cells(mut self, cells: [u32; 2]) -> Self {
        self.scene.contact.cells = Some(cells);
        self
    }

    /// Largest force on an element near a defect (N) that laws `map` and `love` are prepared for; without it the loads
    /// say.
    pub fn largest_force(mut self, force: f64) -> Self {
        self.scene.contact.largest_force = Some(force);
        self
    }

    /// Largest error of the contact map, relative to the largest force.
    pub fn map_accuracy(mut self, accuracy: f64) -> Self {
        self.scene.contact.map_accuracy = Some(accuracy);
        self
    }

    /// An oil film in the contacts, which are dry without it.
    pub fn film(mut self, film: Film) -> Self {
        self.scene.film = Some(film);
        self
    }

    /// The cage: its slip, and the angle of element 1 at the start (rad).
    pub fn cage(mut self, slip: f64, initial_angle: f64) -> Self {
        self.scene.cage = Cage { slip, initial_angle, ..self.scene.cage };
        self
    }

    /// The elements' lag behind the spin of pure rolling, which counts where one has a defect.
    pub fn spin_slip(mut self, slip: f64) -> Self {
        self.scene.cage.spin_slip = slip;
        self
    }

    /// What makes passages uneven.
    pub fn irregularity(mut self, irregularity: CageIrregularity) -> Self {
        self.scene.cage.irregularity = Some(irregularity);
        self
    }

    /// One accelerometer more on the housing.
    pub fn sensor(mut self, sensor: Sensor) -> Self {
        self.scene.sensors.push(sensor);
        self
    }

    /// A probe of the displacement between the rings.
    pub fn probe(mut self) -> Self {
        self.scene.probe = true;
        self
    }

    /// A recorder of outputs inside the step.
    pub fn recorder(mut self, recorder: Recorder) -> Self {
        self.scene.recorder = Some(recorder);
        self
    }

    /// Relative tolerance of the time integration.
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.scene.tolerance = tolerance;
        self
    }

    /// Most integration steps in one communication step.
    pub fn max_steps(mut self, steps: u64) -> Self {
        self.scene.max_steps = steps;
        self
    }

    /// The default run: its stop time and its communication step (s).
    pub fn experiment(mut self, stop: f64, step: f64) -> Self {
        self.scene.experiment = Experiment { stop, step };
        self
    }

    /// The scene, checked.
    ///
    /// # Errors
    /// Whatever [`Scene::check`] refuses.
    pub fn build(self) -> Result<Scene, SceneError> {
        let Self { mut scene, law } = self;
        let usual = if scene.defects.is_empty() { ContactLaw::Hertz } else { ContactLaw::Map };
        scene.contact.law = law.unwrap_or(usual);
        scene.check()?;
        Ok(scene)
    }
}

#[cfg(test)]
impl Scene {
    /// The shipped scene `er16k-tb1`, for unit tests.
    pub(crate) fn er16k() -> Self {
        let conformity = 8.19 / (2.0 * 7.94);
        let balls = Bearing::steel_balls(9, 7.94e-3, 39.32e-3);
        let bearing = Bearing { conformity_inner: conformity, conformity_outer: conformity, ..balls };
        let length = 15.8f64.to_radians() * bearing.outer_raceway_radius();
        let scene = Self::builder(bearing).name("er16k-tb1").cage(0.0, (-105.1f64).to_radians());
        let scene = scene.spall(-FRAC_PI_2, length, 100e-6).shaft_speed(20.0 * std::f64::consts::PI);
        let built = scene.shaft_load([0.0, -500.0]).sensor(Sensor::default()).experiment(0.1, 1e-4).build();
        built.unwrap_or_else(|error| panic!("{error}"))
    }
}
