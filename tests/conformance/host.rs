//! What is around the calls: the archive, callers that break the rules, importers, cost.

use super::Evidence::{Measured as M, Not as N, Test as T};
use super::Rule;

pub(super) const RULES: &[Rule] = &[
    (
        "Archive",
        "Deflate or store, zip 2.0 at most, no links, no back-slashes.",
        &[
            T("every_entry_is_plain_zip_2_0_without_extra_fields"),
            T("names_that_unpack_differently_elsewhere_are_refused"),
        ],
    ),
    (
        "Archive",
        "Packing again gives equal bytes; so does compiling again, also in another folder.",
        &[
            T("packing_a_scene_twice_gives_equal_bytes"),
            M(
                "cargo test -p fmu-build --test fmu library -- --ignored two_builds_in_two_folders_give_equal_bytes",
                "equal",
            ),
        ],
    ),
    (
        "Archive",
        "Documentation, licences of all that is compiled in, and an icon.",
        &[
            T("an_fmu_holds_what_the_standard_names_and_nothing_else"),
            T("every_crate_inside_the_library_is_listed_with_its_licence"),
        ],
    ),
    (
        "Hostile callers",
        "Any sequence of calls with any arguments has the statuses of the standard, changes nothing where it fails, \
         and leaves an instance that can be reset.",
        &[
            T("any_sequence_of_calls_has_the_statuses_of_the_standard_and_leaves_what_succeeded_untouched"),
            T("on_a_full_disk_calls_fail_with_an_error_and_a_reset_always_works"),
            T("misaligned_overlapping_and_absurdly_long_arrays_are_refused"),
            T("a_logger_that_calls_back_into_its_instance_is_turned_away"),
        ],
    ),
    (
        "Hostile callers",
        "Coverage-guided fuzzing with AddressSanitizer and leak detection finds nothing.",
        &[M(
            "cargo +nightly fuzz run calls",
            "15 min, no finding; scene, trace, map, state: 12 s each so far, no finding",
        )],
    ),
    (
        "Hostile callers",
        "Valgrind's memcheck finds no error and no leak in the tests of the C interface.",
        &[M("valgrind (docs/fmi2.md, Memory)", "60 tests, 0 errors, nothing definitely or indirectly lost")],
    ),
    (
        "Hostile callers",
        "Miri on what it can run.",
        &[N("the component could not be installed where this was written")],
    ),
    (
        "Importers",
        "fmpy runs every shipped FMU.",
        &[T("simulate_fmu_runs_every_shipped_scene"), T("a_load_that_changes_each_step_acts_in_each_step")],
    ),
    (
        "Importers",
        "libcosim and the Rust crate fmi run every shipped FMU.",
        &[
            M("libcosimpy 0.0.6", "200 steps, all outputs finite"),
            M("fmi 0.8.0", "200 steps, saved, set back, restored from bytes: equal bits"),
        ],
    ),
    (
        "Importers",
        "Iterated coupling with rollback through fmpy, with and without directional derivatives.",
        &[T("a_light_shaft_of_the_host_is_stepped_again_until_both_agree")],
    ),
    (
        "Cost",
        "No allocation in setting, stepping, reading, saving and restoring.",
        &[T("setting_stepping_reading_saving_and_restoring_allocate_nothing"), T("a_step_allocates_nothing")],
    ),
    (
        "Cost",
        "20 values read in 45 ns, set in 25 ns; 10 ns in a step beyond the solver; a state saved or set back in 100 \
         ns; created, initialized and freed in 50 µs.",
        &[M(
            "cargo bench --bench fmi2_interface",
            "22 ns, 23 ns, 32 and 59 ns are kept; a step's 17 to 27 ns and 74 µs are not",
        )],
    ),
];
