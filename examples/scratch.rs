use brinell::{scene::Scene, simulation::Simulation};
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let text = std::fs::read_to_string(&a[1]).unwrap();
    let scene = Scene::from_toml(&text).unwrap();
    let profile = std::fs::read_to_string("scenes/6205-epps-trace.csv").ok();
    let h: f64 = a[2].parse().unwrap();
    let stop: f64 = a[3].parse().unwrap();
    let tol: f64 = a[4].parse().unwrap();
    let names: Vec<&str> = a[5].split(',').collect();
    let mut s = Simulation::new(scene, profile.as_deref()).unwrap();
    let refs: Vec<u32> = names.iter().map(|n| s.table().iter().position(|v| v.name == *n).expect(n) as u32).collect();
    let t = s.table().iter().position(|v| v.name == "solver.tolerance").unwrap() as u32;
    s.set_reals(&[t], &[tol]).unwrap();
    s.initialize(0.0).unwrap();
    let mut v = vec![0.0; refs.len()];
    let n = (stop / h).round() as usize;
    let start = std::time::Instant::now();
    let mut out = String::new();
    for i in 0..=n {
        if i > 0 {
            s.step(h).unwrap();
        }
        s.reals(&refs, &mut v).unwrap();
        out += &format!("{:.9}", i as f64 * h);
        for x in &v {
            out += &format!(",{x:.12e}");
        }
        out += "\n";
    }
    eprintln!("{:.4} CPU s per simulated s, {:?}", start.elapsed().as_secs_f64() / stop, {
        let mut c = [0; 2];
        let st = s.table().iter().position(|v| v.name == "solver.steps").unwrap() as u32;
        s.integers(&[st, st + 1], &mut c).unwrap();
        c
    });
    println!("t,{}\n{out}", a[5]);
}
