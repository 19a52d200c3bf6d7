use brinell::{scene::Scene, simulation::Simulation};
fn run(name: &str, tol: f64, h: f64, stop: f64) -> (Vec<[f64; 3]>, f64, u64) {
    let text = std::fs::read_to_string(format!("scenes/{name}.toml")).unwrap();
    let mut scene = Scene::from_toml(&text).unwrap();
    scene.tolerance = tol;
    let profile = std::fs::read_to_string("scenes/6205-epps-trace.csv").ok();
    let mut s = Simulation::new(scene, profile.as_deref()).unwrap();
    let find = |s: &Simulation, n: &str| s.table().iter().position(|v| v.name == n).unwrap() as u32;
    let refs = [find(&s, "shaft.ay"), find(&s, "element[1].path"), find(&s, "shaft.y")];
    let steps = find(&s, "solver.steps");
    s.initialize(0.0).unwrap();
    let n = (stop / h).round() as usize;
    let mut out = Vec::new();
    let t = std::time::Instant::now();
    for _ in 0..n {
        s.step(h).unwrap();
        let mut v = [0.0; 3];
        s.reals(&refs, &mut v).unwrap();
        out.push(v);
    }
    let e = t.elapsed().as_secs_f64() / stop;
    let mut c = [0; 2];
    s.integers(&[steps, steps + 1], &mut c).unwrap();
    (out, e, (c[0] + c[1]) as u64)
}
fn main() {
    for (name, stop) in [("6205-healthy", 0.05), ("er16k-tb1", 0.0135), ("er16k-tb1", 0.03)] {
        let (r, ..) = run(name, 1e-12, 1e-4, stop);
        for e in [2, 3, 4, 5, 6, 7, 8, 9, 10] {
            let tol = 10f64.powi(-e);
            let (v, time, steps) = run(name, tol, 1e-4, stop);
            let rms = |k: usize| {
                let (mut d, mut a) = (0.0, 0.0);
                for (x, y) in v.iter().zip(&r) {
                    d += (x[k] - y[k]).powi(2);
                    a += y[k].powi(2);
                }
                (d / a).sqrt()
            };
            println!(
                "{name} {stop} tol 1e-{e}: acc {:.1e} path {:.1e} ring {:.1e}  {:.3} s/s  {steps} steps",
                rms(0),
                rms(1),
                rms(2),
                time
            );
        }
    }
}
