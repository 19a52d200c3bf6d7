//! The library, and the states that an instance goes through.

use super::Evidence::{Measured as M, Test as T};
use super::Rule;

pub(super) const RULES: &[Rule] = &[
    (
        "Binary",
        "The 34 functions of co-simulation are exported, the 10 of model exchange as errors, and nothing else.",
        &[
            T("exactly_the_functions_of_the_standard_are_exported"),
            T("objdump_finds_no_newer_symbol_and_119_functions"),
            T("the_functions_of_model_exchange_are_errors_that_name_the_right_one"),
        ],
    ),
    (
        "Binary",
        "The host's memory functions and stepFinished are never called, and the description says so.",
        &[
            T("memory_and_step_callbacks_are_never_called"),
            T("the_committed_model_descriptions_are_those_of_the_shipped_scenes"),
        ],
    ),
    (
        "Binary",
        "Instances are independent of each other, also in several threads.",
        &[
            T("instances_in_eight_threads_give_the_bits_of_one_alone"),
            T("two_instances_of_two_scenes_do_not_disturb_each_other"),
        ],
    ),
    (
        "Binary",
        "A file that an instance writes is no other instance's, in this process or another: the second is refused at \
         its start.",
        &[
            T("instances_whose_names_become_one_file_name_are_told_so_at_the_start"),
            T("a_recording_of_another_process_is_left_alone_while_it_is_written_and_no_longer"),
        ],
    ),
    (
        "Binary",
        "The processor's floating-point state is left as it was found, and may be any.",
        &[T("floating_point_control_state_is_left_alone_and_may_be_odd")],
    ),
    (
        "Binary",
        "2500 times loaded and unloaded: nothing stays mapped, no memory grows.",
        &[T("after_2500_cycles_of_loading_and_unloading_nothing_is_left")],
    ),
    (
        "Binary",
        "A thousand instances live at once.",
        &[T("a_thousand_instances_of_two_scenes_live_at_once_and_do_not_meet")],
    ),
    (
        "Binary",
        "The Linux binary asks for glibc 2.17 at most, is stripped and needs no libgcc_s.",
        &[T("the_packed_library_runs_with_glibc_2_17_and_without_libgcc"), M("objdump -T", "glibc 2.14")],
    ),
    (
        "Binary",
        "Further platforms are packed when their Rust target is installed, and refused with the command that installs \
         it when not.",
        &[T("a_platform_without_its_standard_library_is_refused_with_the_command_that_installs_it")],
    ),
    (
        "State machine",
        "Each function is allowed in the states of the standard's table and an error with a log line in all others.",
        &[
            T("every_function_is_allowed_in_the_modes_of_the_standards_table_and_in_no_other"),
            T("the_table_has_a_row_for_every_function_that_takes_an_instance"),
        ],
    ),
    (
        "State machine",
        "After an error only freeing, resetting, restoring and reading go on.",
        &[
            T("after_an_error_only_reset_restore_free_and_reading_help"),
            T("in_error_one_may_only_read_reset_restore_or_free"),
        ],
    ),
    ("State machine", "A reset instance is as a new one.", &[T("a_reset_instance_runs_like_a_new_one_to_the_bit")]),
    (
        "State machine",
        "A recording that cannot be stored fails a step, but neither a termination nor a reset: these warn, and say \
         what was lost.",
        &[T("a_full_disk_costs_samples_that_are_told_and_no_instance")],
    ),
    (
        "State machine",
        "Null, dead and invented handles, and null pointers in any function, are errors.",
        &[
            T("null_dead_and_invented_handles_are_errors_not_crashes"),
            T("a_freed_handle_does_not_lead_to_the_next_instance"),
            T("every_pointer_may_be_null_in_every_function"),
        ],
    ),
    (
        "State machine",
        "A panic is caught, logged, an error, and fails its own instance only; fmi2Fatal is never returned.",
        &[T("a_panic_fails_its_own_instance_and_no_other"), T("a_panic_in_the_library_reaches_the_host_as_a_status")],
    ),
    (
        "State machine",
        "A wrong GUID, missing callbacks and unreadable resources give NULL and a log line.",
        &[
            T("a_wrong_guid_gives_null_and_a_line_with_both_guids"),
            T("missing_callbacks_give_null"),
            T("unreadable_resources_give_null_and_a_line_with_the_path"),
            T("a_missing_profile_gives_null_and_a_line_with_its_name"),
            T("null_arguments_give_null_and_a_line_that_names_them"),
        ],
    ),
    (
        "State machine",
        "What is passed to fmi2Instantiate is copied.",
        &[T("everything_passed_to_instantiate_is_copied")],
    ),
    (
        "State machine",
        "Resource URIs with one, two and three slashes, escapes, spaces, plus signs and other alphabets are \
         understood.",
        &[
            T("resources_are_found_under_every_form_of_file_uri_and_odd_names"),
            T("one_two_and_three_slashes_and_localhost_name_the_same_path"),
            T("an_fmu_in_a_folder_with_spaces_and_umlauts_runs"),
        ],
    ),
    (
        "State machine",
        "Inputs may be set before initialization and act in it.",
        &[T("a_load_set_before_initialization_is_carried_by_the_bearing")],
    ),
    (
        "State machine",
        "fmi2SetupExperiment with good values is OK, with others an error.",
        &[
            T("initialization_needs_an_experiment_first"),
            T("an_experiment_needs_a_finite_start_and_a_later_finite_stop"),
            T("a_tolerance_of_the_host_tightens_the_scenes_and_never_loosens_it"),
        ],
    ),
];
