//! Bearings of the catalogue with a spall, below a shaft that the host moves: the contact map reaches as far as a host
//! presses, though the scene does not say how hard.

use crate::support::Named;
use brinell::simulation::Simulation;

/// A row, the length of its spall (mm), and the share of its static load rating that it carries.
const CASES: [(&str, f64, f64); 12] = [
    ("608", 1.0, 0.05),
    ("6001", 2.0, 0.3),
    ("6205", 1.0, 0.3),
    ("6205", 4.0, 0.1),
    ("6310", 2.0, 0.05),
    ("6310", 4.0, 0.3),
    ("6312", 4.0, 0.3),
    ("6305", 2.0, 0.2),
    ("6010", 1.0, 0.3),
    ("NU205", 1.0, 0.3),
    ("NU210", 4.0, 0.1),
    ("NU312", 2.0, 0.3),
];
/// Communication step (s), and how many of them last 20 ms.
const STEP: f64 = 1e-5;
const STEPS: usize = 2000;

/// A coarse map: how far it reaches is the same.
fn text(row: &str, length: f64) -> String {
    format!(
        "name = \"row\"\nbearing.catalogue = \"{row}\"\nhousing.motion = \"fixed\"\n[contact]\ncells = [12, 8]\n\
         map_accuracy = 0.1\n[defect]\nangle_deg = -90.0\nlength_mm = {length:?}\ndepth_um = 50.0\n\
         [shaft]\nmotion = \"host\"\nspeed_hz = 25.0\n"
    )
}

/// Lowest force (N) of 20 ms in which the host's mass rests on the bearing under a share of its static load rating, or
/// why it did not get through them.
fn run(row: &str, length: f64, share: f64) -> Result<f64, String> {
    let scene = brinell_scene_file::from_toml(&text(row, length)).map_err(|error| error.to_string())?;
    let load = share * brinell::geometry::load_rating::load_ratings(&scene.bearing).fixed;
    let mut bearing = Named(Simulation::new(scene, None).map_err(|error| error.to_string())?);
    // Downwards until it carries the load.
    let mut carries = |y: f64| -> Result<bool, String> {
        bearing.0.set("shaft.y", y).unwrap();
        Ok(bearing.0.get("shaft.force.y").map_err(|error| error.to_string())? >= load)
    };
    let (mut high, mut low) = (0.0, -1e-5);
    while !carries(low)? {
        (high, low) = (low, 1.25 * low);
    }
    for _ in 0..30 {
        let middle = 0.5 * (high + low);
        if carries(middle)? { low = middle } else { high = middle }
    }
    carries(low)?;
    bearing.0.initialize(0.0).unwrap();
    // What rests in a machine's bearing is some hundredth of the load that it can carry.
    let mass = load / (30.0 * 9.81);
    let (mut y, mut v, mut a, mut least) = (low, 0.0, 0.0, f64::INFINITY);
    for _ in 0..STEPS {
        for (name, value) in [("shaft.y", y), ("shaft.vy", v), ("shaft.ay", a)] {
            bearing.0.set(name, value).map_err(|error| error.to_string())?;
        }
        bearing.0.step(STEP).map_err(|error| error.to_string())?;
        let mean = bearing.get("shaft.mean_force.y");
        a = (mean - load) / mass;
        (y, v) = (y + STEP * (v + 0.5 * STEP * a), v + STEP * a);
        least = least.min(mean);
    }
    Ok(least / load)
}

#[test]
fn a_hosted_bearing_of_the_catalogue_runs_over_a_spall_under_up_to_a_third_of_its_rating() {
    for (row, length, share) in CASES {
        let least = run(row, length, share).unwrap_or_else(|error| panic!("{row}, {length} mm, {share} C0: {error}"));
        // It has been over the spall: the force has swung.
        assert!(least < 0.95, "{row}, {length} mm: {least} of the load at least");
    }
}

#[test]
fn a_contact_beyond_its_map_is_told_in_newtons_with_what_to_do() {
    let text = text("6205", 2.0).replace("[contact]", "[contact]\nlargest_force_n = 300.0");
    let mut bearing = Named(Simulation::new(brinell_scene_file::from_toml(&text).unwrap(), None).unwrap());
    bearing.0.set("shaft.y", -1e-5).unwrap();
    bearing.0.initialize(0.0).unwrap();
    bearing.0.set("shaft.vy", -0.1).unwrap();
    let error = (0..200).find_map(|_| bearing.0.step(1e-4).err()).unwrap().to_string();
    for word in ["contact force of element", " N (limit of the contact map: ", "contact.largest_force_n = "] {
        assert!(error.contains(word), "{word}: {error}");
    }
    assert!(!error.contains("communication steps"), "{error}");
}
