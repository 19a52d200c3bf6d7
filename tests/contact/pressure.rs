//! Pressure on a fine grid and the stresses below it, against Hertz's closed forms, against the law of the steps at a
//! spall's edge, and against equilibrium.
#![allow(clippy::unwrap_used)]

use brinell::contact::element_on_raceway::{Across, ElementOnRaceway};
use brinell::contact::love::{LoveContact, Resolution};
use brinell::contact::rolling::RacewaySide;
use brinell::scene::{Bearing, ContactLaw, Scene};
use brinell_analysis::pressure::{BallOnRaceway, Corners, Pressed, Stress, maximum};

const RADIUS: f64 = 0.01;
const NU: f64 = 0.3;

/// A ball whose contact's curvatures are 1/r along the raceway, and that of r and a groove across it.
fn ball(groove: f64) -> BallOnRaceway {
    // A raceway that is flat along to rounding.
    let bodies = ElementOnRaceway {
        element_radius: RADIUS,
        raceway_radius: 1e9,
        across: Across::Groove(groove),
        raceway: RacewaySide::Outer,
    };
    BallOnRaceway {
        bodies,
        effective_modulus: 1.1e11,
        poissons_ratio: NU,
        pressure_limit: f64::INFINITY,
        defects: Vec::new(),
    }
}

/// Pressure under a force so small that circles are paraboloids: errors of (a/r)², below 1e-5 here.
fn small(ball: &BallOnRaceway, force: f64, resolution: usize) -> Pressed {
    let pressed = ball.pressed(force, resolution).unwrap();
    assert!(pressed.half_axes()[0] < 3e-3 * RADIUS);
    pressed
}

/// Errors against Hertz: of approach, largest pressure, area, half-axes in cells, and of the pressure anywhere over p₀.
fn errors(ball: &BallOnRaceway, pressed: &Pressed, force: f64) -> [f64; 6] {
    let hertz = ball.hertz(force);
    let [a, b] = hertz.half_axes;
    let at = |cell: usize| {
        let [x, y] = pressed.centre(cell);
        hertz.max_pressure * (1.0 - (x / a).powi(2) - (y / b).powi(2)).max(0.0).sqrt()
    };
    let cells = 0..pressed.pressure.len();
    let square: f64 = cells.map(|cell| (pressed.pressure[cell] - at(cell)).powi(2)).sum();
    let mean = (square / pressed.under_pressure().count() as f64).sqrt() / hertz.max_pressure;
    let half = pressed.half_axes();
    [
        pressed.approach / hertz.approach - 1.0,
        pressed.max_pressure() / hertz.max_pressure - 1.0,
        pressed.area() / (std::f64::consts::PI * a * b) - 1.0,
        (half[0] - a) / pressed.cell[0],
        (half[1] - b) / pressed.cell[1],
        mean,
    ]
}

#[test]
fn pressure_on_512_cells_each_way_is_hertzs_to_one_part_in_ten_thousand() {
    for (groove, force) in [(1e9, 1e-3), (1.03 * RADIUS, 1e-2)] {
        let ball = ball(groove);
        let pressed = small(&ball, force, 512);
        let found = errors(&ball, &pressed, force);
        println!("groove {groove}: {found:?}");
        let [approach, highest, area, along, across, mean] = found;
        assert!((pressed.force / force - 1.0).abs() < 1e-6);
        assert!(approach.abs() < 1e-4 && highest.abs() < 1e-4, "{found:?}");
        // A border lies between two cells: half a cell either way, and one that is half under pressure.
        assert!(along.abs() < 1.0 && across.abs() < 1.0, "{found:?}");
        // Along the border every second cell is one too many or too few: some 1300 of 160 000, which mostly cancel.
        assert!(area.abs() < 3e-3, "{found:?}");
        // Within one cell of the border, where it rises like a root, the pressure is off by up to √(2 cells/a).
        assert!(mean < 3e-3, "{found:?}");
    }
}

/// Stresses along depth below the middle, on `count` depths up to three times a length (m).
fn below(pressed: &Pressed, length: f64, count: usize) -> (Vec<f64>, Vec<Stress>) {
    let corners = Corners::new(pressed, NU, 1);
    let [x, y] = pressed.centre(pressed.middle_cell());
    let depths: Vec<f64> = (0..=count).map(|i| 3.0 * length * i as f64 / count as f64).collect();
    let stresses = depths.iter().map(|&z| corners.stress([x, y, z])).collect();
    (depths, stresses)
}

#[test]
fn von_mises_stress_below_a_circular_contact_has_its_maximum_at_0_48_of_the_radius() {
    let (ball, force) = (ball(1e9), 1e-3);
    let hertz = ball.hertz(force);
    let (a, p0) = (hertz.half_axes[0], hertz.max_pressure);
    let (depths, stresses) = below(&small(&ball, force, 256), a, 120);
    let [most, depth] = maximum(&depths, &stresses);
    println!("von Mises {} p0 at {} a", most / p0, depth / a);
    // Johnson, Contact Mechanics, eq. 3.45, whose maximum for ν = 0.3 is 0.6200 p₀ at 0.481 a.
    assert!((depth / a / 0.481 - 1.0).abs() < 0.01 && (most / p0 / 0.620 - 1.0).abs() < 0.002);
    for (&z, stress) in depths.iter().zip(&stresses) {
        let u = z / a;
        let axial = -1.0 / (1.0 + u * u);
        let radial = -(1.0 + NU) * (1.0 - u * (1.0_f64).atan2(u)) - 0.5 * axial;
        let [x, y, w] = stress.normal.map(|value| value / p0);
        // The grid's own error next to the surface, a thousandth of the pressure.
        let off = (w - axial).abs().max((x - radial).abs()).max((y - radial).abs());
        assert!(off < 1e-3, "depth {u} a: {x} {y} {w} against {radial} {axial}");
    }
}

#[test]
fn shear_below_a_long_ellipse_is_that_of_a_line_contact() {
    // Curvatures 1 : 1000, half-axes 1 : 68; the long one is 1/200 of the radius.
    let (ball, force) = (ball(RADIUS / (1.0 - 1e-3)), 1e-5);
    let hertz = ball.hertz(force);
    let ([b, long], p0) = (hertz.half_axes, hertz.max_pressure);
    let (depths, stresses) = below(&small(&ball, force, 256), b, 120);
    let shear: Vec<f64> = stresses.iter().map(|stress| 0.5 * (stress.normal[0] - stress.normal[2]) / p0).collect();
    let top = (0..shear.len()).max_by(|&a, &b| shear[a].total_cmp(&shear[b])).unwrap();
    println!("{:?} {}", errors(&ball, &small(&ball, force, 256), force), long / RADIUS);
    println!("half-axes 1 : {}, shear {} p0 at {} b", long / b, shear[top], depths[top] / b);
    // Johnson, section 4.2(c): 0.300 p₀ at 0.786 b for a contact of endless length; depths are 0.025 b apart.
    assert!((shear[top] / 0.300 - 1.0).abs() < 0.01 && (depths[top] / b - 0.786).abs() < 0.03);
}

#[test]
fn stresses_off_the_axis_are_in_equilibrium() {
    let pressed = Pressed {
        cells: [2, 1],
        cell: [1.0, 2.0],
        middle: [0.0, 0.0],
        approach: 1.0,
        force: 8.0,
        pressure: vec![1.0, 3.0],
        depth: vec![0.0; 2],
        dent: Vec::new(),
        residual: 0.0,
    };
    let corners = Corners::new(&pressed, NU, 1);
    let h = 1e-4;
    for [x, y, z] in [[0.3, 0.4, 0.5], [-1.4, 0.2, 0.1], [0.7, -1.9, 1.3], [-0.2, -0.3, 0.05]] {
        let by = |k: usize| {
            let shifted = |step: f64| corners.stress([0, 1, 2].map(|i| [x, y, z][i] + if i == k { step } else { 0.0 }));
            let (more, less) = (shifted(h), shifted(-h));
            let slope = |a: f64, b: f64| (a - b) / (2.0 * h);
            (
                [0, 1, 2].map(|i| slope(more.normal[i], less.normal[i])),
                [0, 1, 2].map(|i| slope(more.shear[i], less.shear[i])),
            )
        };
        let [(nx, sx), (ny, sy), (nz, sz)] = [by(0), by(1), by(2)];
        let rests = [nx[0] + sy[0] + sz[1], sx[0] + ny[1] + sz[2], sx[1] + sy[2] + nz[2]];
        // Central differences: h² times third derivatives, up to 1e3 so near the surface.
        assert!(rests.iter().all(|rest| rest.abs() < 2e-5), "({x}, {y}, {z}): {rests:?}");
    }
    // Far away it is a point force: Boussinesq's σ_zz = −3 F z³/(2π ρ⁵); the force acts at x = 0.25.
    let far = corners.stress([100.0, 50.0, 80.0]).normal[2];
    let rho = (99.75_f64.powi(2) + 50.0_f64.powi(2) + 80.0_f64.powi(2)).sqrt();
    let point = -3.0 * 8.0 * 80.0_f64.powi(3) / (std::f64::consts::TAU * rho.powi(5));
    assert!((far / point - 1.0).abs() < 1e-3, "{far} {point}");
}

/// A bearing with a spall of 4 mm in its outer raceway, 10 µm deep.
fn spalled() -> Scene {
    let bearing = Bearing::steel_balls(9, 7.94e-3, 39.32e-3);
    let scene = Scene::builder(bearing).shaft_load([0.0, -500.0]).spall(-1.0, 4e-3, 10e-6);
    scene.law(ContactLaw::Hertz).build().unwrap()
}

/// Force of law `love` over that on the fine grid, of a ball `s` (m) from the spall's middle pressed by a force (N).
fn love_over_pressed(ball: &BallOnRaceway, s: f64, pressed: &Pressed, force: f64, grid: Resolution) -> f64 {
    let surface = &ball.defects[0].surface;
    let mut love = LoveContact::new(ball.bodies, surface, 20e-6, grid).unwrap();
    let equivalent = love.solve(pressed.approach, s).unwrap();
    // W(u) = W_smooth(Δ(u)), hence F = F_smooth(Δ) ∂Δ/∂u. The smooth raceway's force is that of true circles, to which
    // Hertz's paraboloids are scaled in steps: here it is the fine grid's.
    let smooth = BallOnRaceway { defects: Vec::new(), ..ball.clone() }.pressed(force, 256).unwrap();
    (equivalent.value / smooth.approach).powf(1.5) * equivalent.du
}

#[test]
fn at_a_spalls_edge_the_pressure_gives_the_force_of_the_law_that_steps_solve() {
    let scene = spalled();
    let force = 200.0;
    let radius = scene.bearing.outer_raceway_radius();
    for s in [-2.05e-3, -1.98e-3] {
        let at = |s: f64| BallOnRaceway::of(&scene, [], RacewaySide::Outer, s / radius).unwrap();
        let (ball, other) = (at(s), at(-s));
        let pressed = ball.pressed(force, 256).unwrap();
        let mirrored = other.pressed(force, 256).unwrap();
        assert!((pressed.approach / mirrored.approach - 1.0).abs() < 1e-6);
        let found = love_over_pressed(&ball, s, &pressed, force, Resolution { columns: 64, rows: 24 });
        println!("s = {s}: {found}, peak {:e}", pressed.max_pressure());
        // By the table of the next test 256 cells are up to 8e-4 of force from 1024, those up to 5e-4 from the law's.
        assert!((found - 1.0).abs() < 2e-3, "{found}");
        assert!(pressed.max_pressure() > 1.2 * ball.hertz(force).max_pressure);
    }
}

/// Prints what each grid makes of a ball at an edge: the figures of `docs/contact.md`.
#[test]
#[ignore = "takes minutes"]
fn both_grids_converge_to_one_force_at_an_edge() {
    let (scene, force) = (spalled(), 200.0);
    let radius = scene.bearing.outer_raceway_radius();
    for s in [-2.05e-3, -2.0e-3, -1.98e-3] {
        let ball = BallOnRaceway::of(&scene, [], RacewaySide::Outer, s / radius).unwrap();
        let fine: Vec<Pressed> = [64, 128, 256, 512, 1024].map(|n| ball.pressed(force, n).unwrap()).into();
        let last = fine.last().unwrap();
        for pressed in &fine {
            // F grows as the approach to some 3/2.
            let off = 1.5 * (pressed.approach / last.approach - 1.0);
            println!("s = {s}: {} cells: {off:.1e} of force, peak {:e}", pressed.cells[0], pressed.max_pressure());
        }
        for (columns, rows) in [(32, 24), (48, 32), (64, 24), (64, 48)] {
            let ratio = love_over_pressed(&ball, s, last, force, Resolution { columns, rows });
            println!("s = {s}: love on {columns} x {rows}: {:.1e} of force", ratio - 1.0);
            // The coarsest grid's ripple.
            assert!((ratio - 1.0).abs() < 3e-3, "{ratio}");
        }
    }
}

#[test]
fn over_the_middle_of_a_flat_floor_the_pressure_is_that_of_the_smooth_raceway() {
    let ball = BallOnRaceway::of(&spalled(), [], RacewaySide::Outer, 0.0).unwrap();
    let inside = ball.pressed(100.0, 128).unwrap();
    let smooth = BallOnRaceway { defects: Vec::new(), ..ball }.pressed(100.0, 128).unwrap();
    assert!((inside.approach - smooth.approach - 10e-6).abs() < 1e-12);
    assert!((inside.max_pressure() / smooth.max_pressure() - 1.0).abs() < 1e-6);
}

#[test]
fn what_is_no_contact_of_a_ball_is_refused() {
    let ball = ball(1.03 * RADIUS);
    for force in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(ball.pressed(force, 64).unwrap_err().to_string().contains("finite and above 0"));
    }
    for resolution in [0, 31, 1025] {
        assert!(ball.pressed(1.0, resolution).unwrap_err().to_string().contains("from 32 to 1024"));
    }
    assert!(ball.pressed(1e9, 64).unwrap_err().to_string().contains("half-spaces"));
    for angle in [f64::NAN, f64::INFINITY, 4.0] {
        let error = BallOnRaceway::of(&spalled(), [], RacewaySide::Outer, angle).unwrap_err();
        assert!(error.to_string().contains("from -180 to 180"), "{error}");
    }
    let rollers = Scene::builder(Bearing::steel_rollers(12, 7.5e-3, 9e-3, 38.5e-3)).build().unwrap();
    let error = BallOnRaceway::of(&rollers, [], RacewaySide::Inner, 0.0).unwrap_err();
    assert!(error.to_string().contains("for balls only"), "{error}");
}
