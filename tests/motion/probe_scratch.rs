#![allow(clippy::unwrap_used)]
use brinell::scene::{ContactLaw, Scene};
use brinell::simulation::Simulation;
use brinell::simulation::variables::{Causality, Kind};

fn load(name: &str) -> Option<Simulation> {
    let dir = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let mut scene = Scene::from_toml(&std::fs::read_to_string(dir.join(format!("{name}.toml"))).unwrap()).unwrap();
    if std::env::var("OWN").is_err() { scene.contact.law = ContactLaw::Hertz; }
    let profiles: Vec<String> =
        scene.profile_names().into_iter().map(|name| std::fs::read_to_string(dir.join(name)).unwrap()).collect();
    match Simulation::new(scene, profiles.iter().map(|text| &text[..])) {
        Ok(simulation) => Some(simulation),
        Err(error) => {
            println!("{name}: {error}");
            None
        }
    }
}

#[test]
fn stiffness_rates() {
    for name in ["nu205-inner", "er16k-inner", "nu205-healthy"] {
        let Some(mut simulation) = load(name) else { continue };
        simulation.initialize(0.0).unwrap();
        let names = ["shaft.stiffness.xx", "shaft.stiffness.xy", "shaft.stiffness.yy", "shaft.force.x", "shaft.force.y", "cage.torque", "element[5].force.outer", "element[5].force.inner"];
        let refs: Vec<u32> = names.iter().map(|n| simulation.reference(n).unwrap()).collect();
        for k in 0..800 {
            if k > 0 { simulation.step(2.5e-4).unwrap(); }
            let saved = simulation.save();
            let mut given = vec![0.0; refs.len()];
            simulation.output_derivatives(&refs, &vec![1; refs.len()], &mut given).unwrap();
            let at = |simulation: &mut Simulation, n: i32, h: f64| {
                simulation.restore(&saved).unwrap();
                if n > 0 { simulation.step(f64::from(n) * h).unwrap(); }
                let mut v = vec![0.0; refs.len()];
                simulation.reals(&refs, &mut v).unwrap();
                v
            };
            let h = 1e-8;
            let (a, b, c) = (at(&mut simulation, 0, h), at(&mut simulation, 1, h), at(&mut simulation, 2, h));
            simulation.restore(&saved).unwrap();
            for i in 0..refs.len() {
                let q = (-1.5 * a[i] + 2.0 * b[i] - 0.5 * c[i]) / h;
                let q1 = (b[i] - a[i]) / h;
                if (given[i] - q).abs() > 1e-4 * q.abs().max(given[i].abs()) + 1e-9 * a[i].abs() / h * 1e-4 {
                    println!("{name} k={k} {}: given {:e} quotient {q:e} first {q1:e} value {:e}", names[i], given[i], a[i]);
                }
            }
        }
    }
}

#[test]
fn starts() {
    for name in ["6205-irregular-cage", "nu205-inner", "nu205-healthy", "er16k-inner", "6205-inner-5deg", "er16k-element", "er16k-tb1-oil", "6205-two-defects", "er16k-turning-outer", "er16k-tb2-compliant", "6205-epps", "6205-hosted", "er16k-tb1-damped"] {
        let Some(mut simulation) = load(name) else { continue };
        let table = simulation.table().to_vec();
        let unknowns: Vec<u32> = table.iter().filter(|v| v.causality == Causality::Output && matches!(v.kind, Kind::Real { .. })).map(|v| v.reference).collect();
        let knowns: Vec<_> = table.iter().filter(|v| matches!(v.causality, Causality::Input | Causality::Parameter) && matches!(v.kind, Kind::Real { .. })).collect();
        let from = std::time::Instant::now();
        for known in knowns {
            let mut given = vec![0.0; unknowns.len()];
            if let Err(e) = simulation.directional_derivative(&unknowns, &[known.reference], &[1.0], &mut given) { println!("{name} by {}: {e}", known.name); continue; }
            let mut at = [0.0];
            simulation.reals(&[known.reference], &mut at).unwrap();
            let Kind::Real { nominal, min, .. } = known.kind else { panic!() };
            let mut step = match &*known.name { "bearing.radial_clearance" => 2e-9, n if n.ends_with(".stiffness") => 3e3, n if n.contains("damping") => 0.03 * nominal, n if n.contains("slip") => 2e-3, n if n.contains("angle") => 2e-6, n if n.contains("speed") => 0.05, n if n.contains("load") => 0.05, n if n.ends_with(".x") || n.ends_with(".y") => 1e-11, _ => 1e-5 * nominal };
            let mut look = |s: f64| { simulation.set_reals(&[known.reference], &[at[0] + s * step]).map(|()| { let mut v = vec![0.0; unknowns.len()]; simulation.reals(&unknowns, &mut v).unwrap(); v }) };
            let quotient: Vec<f64> = if min.is_some_and(|m| at[0] - step < m) {
                let (a, b, c) = (look(0.0).unwrap(), look(1.0).unwrap(), look(2.0).unwrap());
                (0..a.len()).map(|i| (-1.5 * a[i] + 2.0 * b[i] - 0.5 * c[i]) / step).collect()
            } else {
                let (a, b) = (look(-1.0).unwrap(), look(1.0).unwrap());
                (0..a.len()).map(|i| (b[i] - a[i]) / (2.0 * step)).collect()
            };
            let middle = look(0.0).unwrap();
            step *= 1.0;
            for (i, &u) in unknowns.iter().enumerate() {
                let Kind::Real { nominal, .. } = table[u as usize].kind else { panic!() };
                if (given[i] - quotient[i]).abs() > 1e-4 * given[i].abs() + 4e-12 * middle[i].abs().max(nominal) / step {
                    println!("{name} {} by {}: given {:e} quotient {:e}", table[u as usize].name, known.name, given[i], quotient[i]);
                }
            }
        }
        println!("{name}: {:?}", from.elapsed());
    }
}

/// Stiffness against differences of hosted ring's force at rest.
#[test]
fn stiffness_values() {
    for name in ["nu205-inner", "er16k-inner"] {
        let dir = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
        let mut scene = Scene::from_toml(&std::fs::read_to_string(dir.join(format!("{name}.toml"))).unwrap()).unwrap();
        (scene.shaft, scene.housing) = (brinell::scene::Ring::hosted(), brinell::scene::Ring::fixed());
        (scene.shaft_speed, scene.sensors, scene.recorder) = (0.0, vec![], None);
        scene.contact.cells = None;
        let mut simulation = Simulation::new(scene, []).unwrap();
        for angle in [-1.75, -1.72, -1.70, -1.68, -1.66, -1.64, -1.62, -1.60, -1.57, -1.55, -1.52, -1.50, -1.48, -1.45, -1.42, -1.40] {
            simulation.set("cage.initial_angle", -1.5707).unwrap();
            simulation.set("shaft.initial_angle", angle).unwrap();
            let mut at = |x: f64, y: f64| {
                simulation.set("shaft.x", x).unwrap();
                simulation.set("shaft.y", y).unwrap();
                ["shaft.force.x", "shaft.force.y", "shaft.stiffness.xx", "shaft.stiffness.xy", "shaft.stiffness.yx", "shaft.stiffness.yy"].map(|n| simulation.get(n).unwrap_or(f64::NAN))
            };
            let (x, y, h) = (1e-6, -15e-6, 1e-10);
            let m = at(x, y);
            let (a, b, c, d) = (at(x - h, y), at(x + h, y), at(x, y - h), at(x, y + h));
            println!("{name} {angle}: xx {:e} {:e}  yx {:e} {:e}  xy {:e} {:e} yy {:e} {:e}", m[2], -(b[0] - a[0]) / (2.0 * h), m[4], -(b[1] - a[1]) / (2.0 * h), m[3], -(d[0] - c[0]) / (2.0 * h), m[5], -(d[1] - c[1]) / (2.0 * h));
        }
    }
}
