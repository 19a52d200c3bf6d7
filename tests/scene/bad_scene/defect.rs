//! Defects that cannot exist.

use super::{accepted, refused};

#[test]
fn a_spall_longer_than_the_raceway_is_refused() {
    // 2π × 23.6325 mm = 148.487 mm.
    let parts = [
        "spall length (defect.length_deg or defect.length_mm) is 148.487",
        "below 148.487",
        "mm, the circumference of",
    ];
    refused("length_deg = 15.8", "length_mm = 148.4875", &parts);
    refused("length_deg = 15.8", "length_deg = 360.0", &["(defect.length_deg) is 360:", "below 360"]);
    refused("length_deg = 15.8", "length_mm = 149.0", &["is 149 mm"]);
    accepted("length_deg = 15.8", "length_deg = 359.0");
}

#[test]
fn a_spall_longer_than_the_element_spacing_is_accepted() {
    accepted("length_deg = 15.8", "length_deg = 55.8");
}

#[test]
fn two_lengths_or_none_are_refused() {
    refused("length_deg = 15.8", "length_deg = 15.8\nlength_mm = 6.5", &["exclude each other"]);
    refused("length_deg = 15.8", "", &["one of defect.length_deg and defect.length_mm"]);
}

#[test]
fn a_spall_as_deep_as_the_elements_radius_is_refused() {
    let parts = ["spall depth (defect.depth_um) is 3970", "below 3970"];
    refused("depth_um = 100.0", "depth_um = 3970.0", &parts);
    accepted("depth_um = 100.0", "depth_um = 3900.0");
}

#[test]
fn an_edge_steeper_than_vertical_is_refused() {
    refused(
        "edge_slope_deg = 90.0",
        "edge_slope_deg = 91.0",
        &["edge slope (defect.edge_slope_deg) is 91", "at most 90"],
    );
}

#[test]
fn flanks_that_meet_before_the_floor_are_refused() {
    // 15.8° of 23.6325 mm are 6.51694 mm; at 1° they meet at 3.2585 mm × tan 1° = 56.88 µm.
    let parts = ["spall depth (defect.depth_um) is 100", "1 degrees", "56.87", "6.51694"];
    refused("edge_slope_deg = 90.0", "edge_slope_deg = 1.0", &parts);
    accepted("edge_slope_deg = 90.0", "edge_slope_deg = 2.0");
}

#[test]
fn a_profile_excludes_the_keys_of_a_spall() {
    let parts = ["defect.profile and defect.length_deg exclude each other"];
    refused("length_deg = 15.8", "length_deg = 15.8\nprofile = \"trace.csv\"", &parts);
    refused("depth_um = 100.0", "", &["one of defect.depth_um and defect.profile"]);
}

#[test]
fn a_profile_is_a_plain_file_name() {
    let shape = "length_deg = 15.8\ndepth_um = 100.0\nedge_slope_deg = 90.0";
    for name in ["", "..", "../trace.csv", "/etc/trace.csv"] {
        refused(shape, &format!("profile = \"{name}\""), &[&format!("\"{name}\""), "defect.profile"]);
    }
    accepted(shape, "profile = \"Messung 3 (Außenring).csv\"");
}

#[test]
fn edges_softer_than_the_law_knows_are_refused() {
    let parts = ["contact.edge is \"step\" and contact.law is \"hertz\"", "needs \"map\" or \"love\""];
    refused("law = \"hertz\"", "law = \"hertz\"\nedge = \"step\"", &parts);
    accepted("law = \"hertz\"", "law = \"hertz\"\nedge = \"half-space\"");
    accepted("law = \"hertz\"", "law = \"love\"\nedge = \"step\"");
    // The softness of an end reaches along all of a raceway: it is not built.
    refused(
        "law = \"hertz\"",
        "law = \"love\"\nedge = \"end\"",
        &["contact.edge is \"end\"", "\"half-space\", or \"step\""],
    );
}
