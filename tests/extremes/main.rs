//! The extremes: loads, speeds, masses, clearances, defects, jumps and communication steps far from usual, each against
//! a closed form, or an oracle, or to be refused clearly.
//!
//! Each case gives a row of `docs/stability.md`. To write that file anew:
//! `cargo test --release --test extremes -- --ignored write`.

#![allow(clippy::unwrap_used, clippy::expect_used, unreachable_pub)]

mod closed_forms;
mod long_runs;
mod methods;
mod oracle;
mod predictability;
mod refused;
mod row;
mod scenes;
#[path = "../support/mod.rs"]
mod support;

use brinell::scene::Damping;
use closed_forms::{energy_of_a_bearing_without_damping, energy_without_damping, load_0, settles};
use oracle::case;
use row::Row;
use scenes::{fifty_kilonewton, gentle};

macro_rules! extremes {
    ($($name:ident = $case:expr;)*) => {
        $(#[test]
        fn $name() {
            let _: Row = $case;
        })*

        /// Every case, in order.
        fn rows() -> Vec<Row> {
            vec![$($case),*]
        }
    };
}

const CHI: fn(f64) -> Damping = Damping::HuntCrossley;
const TAU: fn(f64) -> Damping = Damping::Proportional;

extremes! {
    without_load_and_damping_the_elements_press_outwards_only = load_0("load 0, χ = 0", CHI(0.0));
    without_load_the_elements_press_outwards_only = load_0("load 0, χ = 0.5 s/m", CHI(0.5));
    without_load_and_with_strong_damping_the_elements_press_outwards_only = load_0("load 0, χ = 5 s/m", CHI(5.0));
    without_load_and_with_proportional_damping_the_elements_press_outwards_only =
        load_0("load 0, proportional, τ = 10 µs", TAU(1e-5));
    a_newton_without_damping_agrees = case("load 1 N, χ = 0");
    a_newton_agrees = case("load 1 N, χ = 0.5 s/m");
    a_newton_with_strong_damping_agrees = case("load 1 N, χ = 5 s/m");
    a_newton_with_proportional_damping_agrees = case("load 1 N, proportional, τ = 10 µs");
    fifty_kilonewton_without_contact_damping_settle = settles("load jumps to 50 kN, χ = 0", fifty_kilonewton(CHI(0.0)), 5e-3);
    fifty_kilonewton_with_usual_damping_settle = settles("load jumps to 50 kN, χ = 0.5 s/m", fifty_kilonewton(CHI(0.5)), 1e-4);
    fifty_kilonewton_with_strong_damping_settle = settles("load jumps to 50 kN, χ = 5 s/m", fifty_kilonewton(CHI(5.0)), 1e-4);
    fifty_kilonewton_with_proportional_damping_settle =
        settles("load jumps to 50 kN, proportional, τ = 10 µs", fifty_kilonewton(TAU(1e-5)), 1e-4);
    fifty_kilonewton_turning_without_damping_agree = case("50 kN turning, χ = 0");
    fifty_kilonewton_turning_agree = case("50 kN turning, χ = 0.5 s/m");
    fifty_kilonewton_turning_with_strong_damping_agree = case("50 kN turning, χ = 5 s/m");
    fifty_kilonewton_turning_with_proportional_damping_agree = case("50 kN turning, proportional, τ = 10 µs");
    a_bearing_at_rest_stays_at_rest = closed_forms::speed_0();
    one_turn_a_second_agrees = case("speed 1 Hz, spall");
    centrifugal_force_at_a_hundred_thousand_turns_a_minute = closed_forms::speed_100_000_rev_min();
    a_speed_that_reverses_brings_the_cage_back = closed_forms::reversal();
    a_step_of_speed_agrees = case("speed steps from 25 to 250 Hz");
    a_ramp_of_speed_agrees = case("speed ramps up by 10 kHz a second");
    an_element_without_damping_keeps_its_energy = energy_without_damping();
    a_bearing_without_damping_keeps_its_energy = energy_of_a_bearing_without_damping();
    elements_ten_times_lighter_agree = case("elements 10 times lighter, spall");
    elements_a_hundred_times_lighter_agree = case("elements 100 times lighter, spall");
    rings_of_a_gram_agree = case("ring masses 1 g");
    rings_of_a_ton_agree = case("ring masses 1 t");
    a_clearance_of_a_millimetre_agrees = case("clearance 1 mm");
    a_preload_gives_the_forces_of_contacts_in_series = closed_forms::preload();
    a_spall_two_millimetres_deep_agrees = case("spall 2 mm deep");
    a_spall_nearly_as_deep_as_an_elements_radius_agrees = case("spall 3.9 mm deep, an element's radius being 3.97 mm");
    a_spall_deeper_than_an_element_is_refused = refused::too_deep();
    a_spall_wider_than_the_spacing_agrees = case("spall of 55.8°, wider than the spacing");
    a_spall_of_one_cell_agrees = case("spall 50 µm long, 1 µm deep");
    a_spall_on_the_unloaded_side_agrees = case("spall on the unloaded side");
    vertical_edges_agree = case("edges of 90 degrees, 100 µm deep");
    gentle_edges_agree_with_the_other_method = methods::agree("edges of 1 degree", gentle(), 1e-4, 100, 1e-3);
    an_element_without_contact_falls_freely = closed_forms::free_fall();
    a_jump_of_a_micrometre_agrees = case("host jumps by 1 µm");
    a_jump_of_a_hundred_micrometres_agrees = case("host jumps by 100 µm");
    communication_steps_of_any_length_agree = long_runs::communication_steps();
    a_load_reversing_at_two_kilohertz_agrees = case("load of 2 kN reversing at 2 kHz");
    a_minute_leaves_no_drift = long_runs::one_minute();
    three_elements_agree = case("3 elements");
    a_hundred_elements_agree = case("100 elements");
    more_steps_than_allowed_are_an_error = refused::step_budget();
    an_element_thrown_out_is_an_error = refused::thrown_out();
    rings_beside_each_other_are_an_error = refused::rings_apart();
    a_state_that_is_not_finite_is_an_error = refused::not_finite();
    a_contact_without_an_answer_is_an_error = refused::contact_without_answer();
}

#[test]
#[ignore = "writes docs/stability.md"]
fn write_the_table_of_stability() {
    let rows: String = rows().iter().map(Row::line).collect();
    let text = include_str!("page.md").replace("<!-- rows -->\n", &rows);
    let [growth, oiled, tolerances] = predictability::tables();
    let text = text.replace("<!-- growth -->\n", &growth).replace("<!-- tolerances -->\n", &tolerances);
    let text = text.replace("<!-- growth with oil -->\n", &oiled);
    let text = text.replace("<!-- random scenes -->\n", include_str!("../adversary/scenes.md"));
    let text = text.replace("<!-- misuse -->\n", include_str!("../adversary/misuse.md"));
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/stability.md");
    std::fs::write(path, text).unwrap();
}
