//! The extremes: loads, speeds, masses, clearances, defects, jumps and communication steps far from usual, each against
//! a closed form, or an oracle, or to be refused clearly.
//!
//! Each case gives a row of `docs/data/extremes.csv`. To write it and the tables of `docs/evidence/stability.md` anew:
//! `cargo test --workspace --release --test extremes -- --ignored write`.

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
use scenes::{BALLS, Kind, ROLLERS, without_inertia};

macro_rules! extremes {
    ($kind:ident: $($(#[$attribute:meta])* $name:ident = $case:expr;)*) => {
        $(fn $name($kind: Kind) -> Row {
            $case
        })*

        /// Every case, in order.
        fn rows($kind: Kind) -> Vec<Row> {
            vec![$($name($kind)),*]
        }

        mod balls {
            $(#[test]
            $(#[$attribute])*
            fn $name() {
                print!("{}", super::$name(super::BALLS));
            })*
        }

        mod rollers {
            $(#[test]
            $(#[$attribute])*
            fn $name() {
                print!("{}", super::$name(super::ROLLERS));
            })*
        }
    };
}

const CHI: fn(f64) -> Damping = Damping::HuntCrossley;
const TAU: fn(f64) -> Damping = Damping::Proportional;

extremes! {
    kind:
    without_load_and_damping_the_elements_press_outwards_only = load_0(kind, "load 0, χ = 0", CHI(0.0));
    without_load_the_elements_press_outwards_only = load_0(kind, "load 0, χ = 0.5 s/m", CHI(0.5));
    without_load_and_with_strong_damping_the_elements_press_outwards_only = load_0(kind, "load 0, χ = 5 s/m", CHI(5.0));
    without_load_and_with_proportional_damping_the_elements_press_outwards_only =
        load_0(kind, "load 0, proportional, τ = 10 µs", TAU(1e-5));
    a_newton_without_damping_agrees = case(kind, "load 1 N, χ = 0");
    a_newton_agrees = case(kind, "load 1 N, χ = 0.5 s/m");
    a_newton_with_strong_damping_agrees = case(kind, "load 1 N, χ = 5 s/m");
    a_newton_with_proportional_damping_agrees = case(kind, "load 1 N, proportional, τ = 10 µs");
    fifty_kilonewton_without_contact_damping_settle =
        settles(kind, "load jumps to 50 kN, χ = 0", kind.fifty_kilonewton(CHI(0.0)), 5e-3);
    fifty_kilonewton_with_usual_damping_settle =
        settles(kind, "load jumps to 50 kN, χ = 0.5 s/m", kind.fifty_kilonewton(CHI(0.5)), 1e-4);
    fifty_kilonewton_with_strong_damping_settle =
        settles(kind, "load jumps to 50 kN, χ = 5 s/m", kind.fifty_kilonewton(CHI(5.0)), 1e-4);
    fifty_kilonewton_with_proportional_damping_settle =
        settles(kind, "load jumps to 50 kN, proportional, τ = 10 µs", kind.fifty_kilonewton(TAU(1e-5)), 1e-4);
    fifty_kilonewton_on_elements_without_inertia_settle = settles(
        kind,
        "load jumps to 50 kN, χ = 0.5 s/m, elements without inertia",
        without_inertia(kind.fifty_kilonewton(CHI(0.5))),
        1e-4,
    );
    fifty_kilonewton_turning_without_damping_agree = case(kind, "50 kN turning, χ = 0");
    fifty_kilonewton_turning_agree = case(kind, "50 kN turning, χ = 0.5 s/m");
    fifty_kilonewton_turning_with_strong_damping_agree = case(kind, "50 kN turning, χ = 5 s/m");
    fifty_kilonewton_turning_with_proportional_damping_agree = case(kind, "50 kN turning, proportional, τ = 10 µs");
    a_bearing_at_rest_stays_at_rest = closed_forms::speed_0(kind);
    one_turn_a_second_agrees = case(kind, "speed 1 Hz, spall");
    centrifugal_force_at_a_hundred_thousand_turns_a_minute = closed_forms::speed_100_000_rev_min(kind);
    centrifugal_force_on_elements_without_inertia = closed_forms::speed_100_000_rev_min_without_inertia(kind);
    a_speed_that_reverses_brings_the_cage_back = closed_forms::reversal(kind);
    a_step_of_speed_agrees = case(kind, "speed steps from 25 to 250 Hz");
    a_ramp_of_speed_agrees = case(kind, "speed ramps up by 10 kHz a second");
    an_element_without_damping_keeps_its_energy = energy_without_damping(kind);
    a_bearing_without_damping_keeps_its_energy = energy_of_a_bearing_without_damping(kind);
    elements_ten_times_lighter_agree = case(kind, "elements 10 times lighter, spall");
    elements_a_hundred_times_lighter_agree = case(kind, "elements 100 times lighter, spall");
    rings_of_a_gram_agree = case(kind, "ring masses 1 g");
    rings_of_a_ton_agree = case(kind, "ring masses 1 t");
    a_clearance_of_a_millimetre_agrees = case(kind, "clearance 1 mm");
    a_preload_gives_the_forces_of_contacts_in_series = closed_forms::preload(kind);
    a_spall_two_millimetres_deep_agrees = case(kind, "spall 2 mm deep");
    a_spall_nearly_as_deep_as_an_elements_radius_agrees = case(
        kind,
        kind.pick(
            "spall 3.9 mm deep, an element's radius being 3.97 mm",
            "spall 3.7 mm deep, an element's radius being 3.75 mm",
        ),
    );
    a_spall_deeper_than_an_element_is_refused = refused::too_deep(kind);
    a_spall_wider_than_the_spacing_agrees = case(
        kind,
        kind.pick("spall of 55.8°, wider than the spacing", "spall of 40°, wider than the spacing"),
    );
    a_spall_of_one_cell_agrees = case(kind, "spall 50 µm long, 1 µm deep");
    a_spall_on_the_unloaded_side_agrees = case(kind, "spall on the unloaded side");
    vertical_edges_agree = case(kind, "edges of 90 degrees, 100 µm deep");
    gentle_edges_agree_with_the_other_method = methods::agree("edges of 1 degree", kind.gentle(), 1e-4, 100, 1e-3);
    an_element_without_contact_falls_freely = closed_forms::free_fall(kind);
    a_jump_of_a_micrometre_agrees = case(kind, "host jumps by 1 µm");
    a_jump_of_a_hundred_micrometres_agrees = case(kind, "host jumps by 100 µm");
    #[ignore = "a quarter of a minute"]
    communication_steps_of_any_length_agree = long_runs::communication_steps(kind);
    a_load_reversing_at_two_kilohertz_agrees = case(kind, "load of 2 kN reversing at 2 kHz");
    #[ignore = "half a minute"]
    a_minute_leaves_no_drift = long_runs::one_minute(kind);
    three_elements_agree = case(kind, "3 elements");
    a_hundred_elements_agree = case(kind, "100 elements");
    more_steps_than_allowed_are_an_error = refused::step_budget(kind);
    an_element_thrown_out_is_an_error = refused::thrown_out(kind);
    rings_beside_each_other_are_an_error = refused::rings_apart(kind);
    rings_beside_each_other_are_an_error_without_inertia = refused::rings_apart_without_inertia(kind);
    a_state_that_is_not_finite_is_an_error = refused::not_finite(kind);
    a_contact_without_an_answer_is_an_error = refused::contact_without_answer(kind);
}

#[test]
#[ignore = "writes docs/data/extremes.csv and tables of docs/evidence/stability.md"]
fn write_the_table_of_stability() {
    let in_space = oracle::in_space::rows();
    let bearings = [("balls", rows(BALLS)), ("rollers", rows(ROLLERS)), ("in space", in_space)];
    let mut table = csv::Writer::from_path(brinell_tests::root().join("docs/data/extremes.csv")).unwrap();
    table.write_record(["bearing"].into_iter().chain(row::COLUMNS)).unwrap();
    for (bearing, rows) in bearings {
        for row in rows {
            table.write_record([bearing.to_owned()].into_iter().chain(row.cells())).unwrap();
        }
    }
    table.flush().unwrap();
    brinell_tests::page::write("docs/evidence/stability.md", predictability::tables());
}
