//! A scene for tests that Miri interprets: three elements without a defect, started quickly.

pub(crate) const SCENE: &str = r#"
name = "small"
description = "Three elements"
[bearing]
element_count = 3
element_diameter_mm = 7.94
pitch_diameter_mm = 39.32
groove_diameter_mm = 8.19
radial_clearance_um = 5.0
youngs_modulus_gpa = 207.0
poissons_ratio = 0.3
density_kg_m3 = 7800.0
[shaft]
motion = "internal"
speed_hz = 10.0
load_n = [0.0, -500.0]
mass_kg = 3.0
damping_n_s_m = 1400.0
stiffness_n_m = 1e7
[housing]
motion = "fixed"
[recorder]
rate_hz = 100000.0
"#;
