use brinell::contact::map_build::Sequential;
use brinell::scene::Scene;
use brinell::simulation::setup::{build_map, map_specification};
use brinell::surface::Surface;
fn main() {
    for name in std::env::args().skip(1) {
        let scene = Scene::from_toml(&std::fs::read_to_string(format!("scenes/{name}.toml")).unwrap()).unwrap();
        let profile = match &scene.defect.as_ref().unwrap().shape {
            brinell::scene::DefectShape::Profile(f) => Some(std::fs::read_to_string(format!("scenes/{f}")).unwrap()),
            _ => None,
        };
        let surface = Surface::load(&scene.defect.as_ref().unwrap().shape, profile.as_deref(), &scene.bearing).unwrap();
        let t = std::time::Instant::now();
        match build_map(&scene, &surface, &mut Sequential(|_, _| ())) {
            Ok(Some(m)) => println!(
                "{name} {:?} nodes {} {:?} {:.2}s",
                map_specification(&scene),
                m.nodes(),
                m.accuracy(),
                t.elapsed().as_secs_f64()
            ),
            Ok(None) => println!("none"),
            Err(e) => println!("{name} {e}"),
        }
    }
}
