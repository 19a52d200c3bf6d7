use brinell::contact::{love::LoveContact, raceway_grid::*};
use brinell::surface::{Profile, Surface};
fn main() {
    let e = ElementOnRaceway { element_radius: 3.97e-3, raceway_radius: 23.6325e-3, groove_radius: 4.095e-3 };
    let k = 2.929e10;
    let length = 15.8_f64.to_radians() * e.raceway_radius;
    let surface = Surface::Profile(Profile::spall(length, 100e-6, std::f64::consts::FRAC_PI_2));
    for (nx, ny) in [(32, 16), (64, 16), (64, 32), (128, 32)] {
        let t = std::time::Instant::now();
        let mut c = LoveContact::new(e, &surface, 12e-6, Resolution { columns: nx, rows: ny }).unwrap();
        println!("-- {nx} {ny} cell {:?} rows {} new {:?}  half axes {:?}", c.grid().cell(), c.grid().rows(), t.elapsed(), e.contact_half_axes(12e-6));
        let edge = -length / 2.0;
        let cell = c.grid().cell()[0];
        // ripple on the smooth raceway
        for u in [2e-6, 5e-6, 10e-6] {
            let full = k * 10e-6_f64.powf(1.5);
            let mut worst = [0.0_f64; 3];
            for i in 0..37 {
                let s = edge - 1e-3 + cell * i as f64 / 37.0;
                let a = c.solve(u, s).unwrap();
                let f = a.forces(k);
                worst[0] = worst[0].max((a.value - u).abs() / u);
                worst[1] = worst[1].max((f[0] - k * u.powf(1.5)).abs() / full);
                worst[2] = worst[2].max(f[1].abs() / full);
            }
            println!("u {u:e}: ripple value {:e} Fn {:e} Ft {:e} of full scale", worst[0], worst[1], worst[2]);
        }
        for u in [4e-6, 10e-6] {
            let a = c.solve(u, edge).unwrap();
            let f = a.forces(k);
            println!("edge u {u:e}: Fn/smooth {:.5} Ft/Fn {:.5} onset {:e}", f[0] / (k * u.powf(1.5)), f[1] / f[0], c.first_touch(edge));
            let h = 1e-9;
            let (p, m) = (c.solve(u + h, edge).unwrap(), c.solve(u - h, edge).unwrap());
            println!("   du {:.8} fd {:.8} duu {:e} fd {:e} dus {:e} fd {:e}", a.du, (p.value - m.value) / 2.0 / h, a.duu, (p.du - m.du) / 2.0 / h, a.dus, (p.ds - m.ds) / 2.0 / h);
            let (p, m) = (c.solve(u, edge + h).unwrap(), c.solve(u, edge - h).unwrap());
            println!("   ds {:.8} fd {:.8} dss {:e} fd {:e} dus {:e} fd {:e}", a.ds, (p.value - m.value) / 2.0 / h, a.dss, (p.ds - m.ds) / 2.0 / h, a.dus, (p.du - m.du) / 2.0 / h);
        }
        // warm run over the edge
        let n = 20000;
        for (name, u, s0, s1) in [("smooth", 6e-6, edge - 0.5e-3, edge - 0.4e-3), ("edge", 6e-6, edge - 0.05e-3, edge + 0.05e-3), ("inside", 30e-6, edge + 0.4e-3, edge + 0.45e-3)] {
            let t = std::time::Instant::now();
            let mut f = 0.0;
            for i in 0..n {
                f += c.solve(u, s0 + (s1 - s0) * i as f64 / n as f64).unwrap().forces(k)[0];
            }
            println!("{name}: {:.2} us per solve, mean force {:.2}", t.elapsed().as_secs_f64() / n as f64 * 1e6, f / n as f64);
        }
    }
}
