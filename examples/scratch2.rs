use brinell::{scene::Scene, simulation::Simulation};
fn main() {
    let text = std::fs::read_to_string("scenes/er16k-tb1.toml").unwrap();
    let mut scene = Scene::from_toml(&text).unwrap();
    scene.shaft.load = [0.0, 0.0];
    scene.shaft_speed = 0.0;
    scene.cage.initial_angle = 0.0;
    let mut s = Simulation::new(scene, None).unwrap();
    println!("{:?}", s.initialize(0.0));
}
