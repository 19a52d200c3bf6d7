//! Oil films that cannot exist.

use super::{GOOD, accepted, refused};

/// The good scene's cage, after a film with these lines.
fn film(lines: &str) -> String {
    format!("[film]\n{lines}\n[cage]")
}

#[test]
fn a_film_without_viscosity_or_of_none_is_refused() {
    let with = |viscosity: &str| film(&format!("viscosity_pa_s = {viscosity}\npressure_viscosity_1_pa = 2e-8"));
    for viscosity in ["0.0", "-0.04", "nan", "11.0"] {
        let parts = ["viscosity of the film (film.viscosity_pa_s) is", "at least 0.0001", "at most 10"];
        refused("[cage]", &with(viscosity), &parts);
    }
    refused("[cage]", &film("pressure_viscosity_1_pa = 2e-8"), &["film.viscosity_pa_s is missing"]);
    accepted("[cage]", &with("0.04"));
}

#[test]
fn a_viscosity_that_grows_with_pressure_as_no_oils_does_is_refused() {
    let with = |coefficient: &str| film(&format!("viscosity_pa_s = 0.04\npressure_viscosity_1_pa = {coefficient}"));
    for coefficient in ["0.4e-8", "5e-8", "0.0", "20.0"] {
        refused("[cage]", &with(coefficient), &["(film.pressure_viscosity_1_pa) is", "at least 5e-9", "at most 4e-8"]);
    }
    refused("[cage]", &film("viscosity_pa_s = 0.04"), &["film.pressure_viscosity_1_pa is missing"]);
}

#[test]
fn a_film_between_elements_without_inertia_is_refused() {
    let dry = "element_inertia = \"none\"\nelement_count = 9";
    accepted("element_count = 9", dry);
    let text = GOOD.replace("element_count = 9", dry);
    let text = text.replace("[cage]", &film("viscosity_pa_s = 0.04\npressure_viscosity_1_pa = 2e-8"));
    let said = brinell_scene_file::from_toml(&text).unwrap_err().to_string();
    assert!(said.contains("[film] is given and bearing.element_inertia is \"none\""), "{said}");
}

#[test]
fn oil_of_no_height_is_refused() {
    let with =
        |layer: &str| film(&format!("viscosity_pa_s = 0.04\npressure_viscosity_1_pa = 2e-8\nlayer_um = {layer}"));
    for layer in ["0.0", "-1.0", "1e5"] {
        refused("[cage]", &with(layer), &["height of the film's oil (film.layer_um) is", "at least 0.01"]);
    }
    accepted("[cage]", &with("5.0"));
}
