//! Elements of another material than the rings: E* of both wherever bodies are pressed together.

use brinell::contact::law::elastic_law;
use brinell::contact::love::image_factor;
use brinell::contact::rolling::RacewaySide;
use brinell::geometry::film_thickness::LubricatedContact;
use brinell::geometry::hertz_constant::{HertzConstants, effective_modulus};
use brinell::scene::{Bearing, ContactEdge, DefectOn, Film, Scene};
use brinell::simulation::setup::map_specification;
use brinell_analysis::pressure::BallOnRaceway;
use brinell_analysis::statics::StaticBearing;

/// Silicon nitride in steel: 1/E* = (1 − 0.3²)/207 GPa + (1 − 0.26²)/310 GPa, over that of steel in steel.
const STIFFER: f64 = 2.0 * (0.91 / 207.0) / (0.91 / 207.0 + 0.9324 / 310.0);

fn hybrid(of: Bearing) -> Bearing {
    Bearing { element_youngs_modulus: Some(310e9), element_poissons_ratio: Some(0.26), density: 3200.0, ..of }
}

fn balls() -> Bearing {
    Bearing { radial_clearance: 0.0, ..Bearing::steel_balls(9, 7.94e-3, 39.04e-3) }
}

#[test]
fn contacts_of_balls_and_of_rollers_are_stiffer_as_e_star_is() {
    let (steel, ceramic) = (balls(), hybrid(balls()));
    assert!((effective_modulus(&ceramic) / effective_modulus(&steel) / STIFFER - 1.0).abs() < 1e-14);
    let [of_steel, of_ceramic] = [&steel, &ceramic].map(HertzConstants::of);
    for (one, other) in [(of_steel.inner, of_ceramic.inner), (of_steel.outer, of_ceramic.outer)] {
        assert!((other / one / STIFFER - 1.0).abs() < 1e-13, "{one} {other}");
    }
    let rollers = Bearing::steel_rollers(13, 7.5e-3, 7.8e-3, 39e-3);
    for side in [RacewaySide::Inner, RacewaySide::Outer] {
        // Palmgren's approach goes with (1/E*)^0.9 Q^0.9.
        let [one, other] = [rollers.clone(), hybrid(rollers.clone())].map(|of| elastic_law(&of, side).stiffness);
        assert!((other / one / STIFFER - 1.0).abs() < 1e-13, "{one} {other}");
    }
}

#[test]
fn elements_of_the_rings_material_are_no_elements_of_another_one_to_the_last_bit() {
    let of = balls();
    let same = Bearing { element_youngs_modulus: Some(207e9), element_poissons_ratio: Some(0.3), ..of.clone() };
    assert_eq!(effective_modulus(&same), 207e9 / (2.0 * (1.0 - 0.3 * 0.3)));
    assert_eq!(effective_modulus(&same), effective_modulus(&of));
    assert_eq!(HertzConstants::of(&same), HertzConstants::of(&of));
    let rollers = Bearing::steel_rollers(13, 7.5e-3, 7.8e-3, 39e-3);
    let same = Bearing { element_youngs_modulus: Some(207e9), ..rollers.clone() };
    assert_eq!(elastic_law(&same, RacewaySide::Outer).stiffness, elastic_law(&rollers, RacewaySide::Outer).stiffness);
}

#[test]
fn pressure_film_and_displacement_under_a_load_know_both_materials() {
    let scene =
        |bearing: Bearing| Scene::builder(bearing).gravity([0.0; 2]).shaft_load([0.0, -1500.0]).build().unwrap();
    let (steel, ceramic) = (scene(balls()), scene(hybrid(balls())));
    let pressure =
        |scene: &Scene| BallOnRaceway::of(scene, None, RacewaySide::Inner, 0.0).unwrap().hertz(800.0).max_pressure;
    // Hertz's pressure grows with E*^(2/3).
    assert!((pressure(&ceramic) / pressure(&steel) / STIFFER.powf(2.0 / 3.0) - 1.0).abs() < 1e-12);
    let displacement = |scene: &Scene| {
        let bearing = StaticBearing::new(scene, None).unwrap();
        bearing.balance(-std::f64::consts::FRAC_PI_2, [0.0, -1500.0]).unwrap().displacement[1]
    };
    // Without clearance and weight a ball bearing yields as K^(−2/3) under a load.
    let found = displacement(&ceramic) / displacement(&steel);
    // To first order in the displacement over the radius, some 1e-3 of which a tenth differs.
    assert!((found / STIFFER.powf(-2.0 / 3.0) - 1.0).abs() < 2e-4, "{found}");
    let film = Film { viscosity: 0.05, pressure_viscosity: 2e-8, layer: None };
    let thickness = |scene: &Scene| LubricatedContact::of(&scene.bearing, &film, 500.0)[0].thickness(1.0);
    // U^0.67 G^0.53 W^−0.067: E*^(0.53 + 0.067 − 0.67).
    let found = thickness(&ceramic) / thickness(&steel);
    assert!((found / STIFFER.powf(0.53 + 0.067 - 0.67) - 1.0).abs() < 1e-12, "{found}");
}

#[test]
fn a_sharp_edge_softens_the_share_of_the_body_that_has_it() {
    let factor = |bearing: Bearing, on: DefectOn| {
        let mut scene = Scene::builder(bearing).shaft_load([0.0, -300.0]).spall(-1.57, 2e-3, 50e-6).build().unwrap();
        scene.defects[0].on = on;
        scene.contact.edge = ContactEdge::Step;
        map_specification(&scene, RacewaySide::Outer).edges.unwrap().factor
    };
    // Of what both yield the ring has E*(1 − ν²)/E.
    let ring = (0.91 / 207.0) / (0.91 / 207.0 + 0.9324 / 310.0);
    let element = DefectOn::Element { element: 0, tilt: 0.0 };
    for (found, expected) in [
        (factor(balls(), DefectOn::Outer), 0.5 * image_factor(0.3)),
        (factor(hybrid(balls()), DefectOn::Outer), ring * image_factor(0.3)),
        (factor(hybrid(balls()), element), (1.0 - ring) * image_factor(0.26)),
    ] {
        assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
    }
}
