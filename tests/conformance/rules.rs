//! The rules, in our words, and what shows each.

/// What shows a rule.
pub(crate) enum Evidence {
    /// A test of the workspace, by its name.
    Test(&'static str),
    /// A command and the figure it gave.
    Measured(&'static str, &'static str),
    /// Not shown here, and why.
    Not(&'static str),
}

use Evidence::{Measured as M, Not as N, Test as T};

/// Section, rule, evidence.
pub(crate) const RULES: &[(&str, &str, &[Evidence])] = &[
    (
        "Binary",
        "The 34 functions of co-simulation are exported, the 10 of model exchange as errors, and nothing else.",
        &[
            T("exactly_the_functions_of_the_standard_are_exported"),
            T("objdump_finds_no_newer_symbol_and_44_functions"),
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
        "A file that an instance writes is no other instance's, in this process or another: the second is refused at its start.",
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
        "Further platforms are packed when their Rust target is installed, and refused with the command that installs it when not.",
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
        "A recording that cannot be stored fails a step, but neither a termination nor a reset: these warn, and say what was lost.",
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
        "Resource URIs with one, two and three slashes, escapes, spaces, plus signs and other alphabets are understood.",
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
    (
        "Steps",
        "Any positive step is taken and ends exactly where the host computes it.",
        &[
            T("the_shortest_positive_step_is_taken"),
            T("a_step_shorter_than_time_can_show_is_taken"),
            T("a_step_ends_exactly_where_the_host_computes_it"),
        ],
    ),
    (
        "Steps",
        "A communication point that is off by accumulated rounding is accepted, a wrong one is an error, however late \
         in a run.",
        &[
            T("a_wrong_communication_point_is_an_error_and_a_rounded_one_is_not"),
            T("a_step_left_out_or_done_twice_is_an_error_however_late"),
            T("ten_million_added_steps_are_accepted_and_end_on_the_stop_time"),
            T("a_host_that_multiplies_is_met_from_any_start_with_any_step"),
            T("a_host_whose_points_drift_away_from_its_steps_is_refused"),
            T("a_host_whose_points_drift_away_from_the_sum_of_its_steps_is_refused_however_late"),
        ],
    ),
    (
        "Steps",
        "Steps that are zero, negative, infinite or no number are errors.",
        &[T("a_step_that_is_not_above_zero_and_finite_is_an_error")],
    ),
    (
        "Steps",
        "A step past a defined stop time is an error, rounding aside; without one there is no end.",
        &[
            T("a_step_past_the_stop_time_is_an_error_and_one_that_ends_there_is_not"),
            T("a_whole_step_past_a_late_stop_time_is_an_error"),
            T("without_a_stop_time_there_is_no_end"),
        ],
    ),
    (
        "Steps",
        "No step hangs: an enormous one ends with the budget of integration steps.",
        &[T("an_enormous_step_ends_after_the_budget_of_integration_steps")],
    ),
    (
        "Steps",
        "Status queries answer; unknown kinds are discarded; no step is ever pending or discarded itself.",
        &[T("status_queries_answer_and_unknown_kinds_are_discarded")],
    ),
    ("Steps", "fmi2CancelStep is an error.", &[T("cancelling_a_step_is_an_error_that_says_why")]),
    (
        "Steps",
        "Never a number that is not finite under OK.",
        &[
            T("any_sequence_of_calls_has_the_statuses_of_the_standard_and_leaves_what_succeeded_untouched"),
            M("cargo +nightly fuzz run calls", "15 min, no finding"),
        ],
    ),
    (
        "Steps",
        "The result does not depend, within tolerance, on how the host splits the time.",
        &[T("the_result_does_not_depend_on_how_the_time_is_split")],
    ),
    (
        "Variables",
        "Variability is explicit for what is not real; outputs are neither fixed nor tunable.",
        &[T("the_table_keeps_the_rules_that_the_writer_relies_on"), T("validate_fmu_finds_nothing")],
    ),
    (
        "Variables",
        "What may not be set, a value outside its range and NaN are refused, and nothing changes.",
        &[
            T("values_outside_their_range_and_nan_are_discarded_and_change_nothing"),
            T("outputs_cannot_be_set_and_parameters_not_after_initialization"),
        ],
    ),
    (
        "Variables",
        "Unknown references and wrong types are errors.",
        &[T("unknown_references_and_wrong_types_are_errors_that_say_so")],
    ),
    ("Variables", "No variables with null arrays is fine.", &[T("no_variables_with_null_arrays_is_fine")]),
    (
        "Variables",
        "Start values are what is read in initialization mode, and what is set is read back.",
        &[T("initialization_shows_the_start_values_of_the_table"), T("what_is_set_is_read_back")],
    ),
    (
        "Variables",
        "Units with their base units, enumerations, ranges, nominals, descriptions and the default experiment are in the description, which keeps to the schema.",
        &[
            T("validate_fmu_finds_nothing"),
            T("the_committed_model_descriptions_are_those_of_the_shipped_scenes"),
            T("a_display_unit_is_the_unit_times_its_factor"),
        ],
    ),
    (
        "Variables",
        "Outputs and InitialUnknowns ascend and list exactly what each depends on: perturbing every input moves what is listed and nothing else.",
        &[
            T("directional_derivatives_at_communication_points_are_central_differences"),
            T("directional_derivatives_in_initialization_mode_are_central_differences"),
        ],
    ),
    (
        "Saved states",
        "Rewinding repeats every bit.",
        &[
            T("a_rewound_instance_repeats_every_bit"),
            T("a_state_saved_over_an_earlier_one_takes_its_place"),
            T("states_survive_a_reset"),
            T("saved_states_may_be_handled_in_every_mode"),
        ],
    ),
    (
        "Saved states",
        "A state continues in another instance and another process with the same bits, in the middle of an impact and with law love.",
        &[
            T("a_state_in_bytes_continues_in_another_instance_bit_by_bit"),
            T("a_state_taken_in_an_impact_continues_in_another_process_with_the_same_bits"),
            T("a_state_taken_with_law_love_continues_in_another_process_with_the_same_bits"),
        ],
    ),
    (
        "Saved states",
        "Damaged, short, long and foreign bytes are refused: every bit flipped, every length.",
        &[T("damaged_short_long_and_foreign_bytes_are_refused"), T("a_buffer_of_another_size_is_refused")],
    ),
    (
        "Saved states",
        "Null, invented, freed and foreign handles of states are errors.",
        &[T("null_invented_and_foreign_states_are_errors"), T("a_freed_state_is_null_and_cannot_be_used_again")],
    ),
    (
        "Derivatives",
        "Directional derivatives of every real output by every input are central differences, at communication points and in initialization mode.",
        &[
            T("directional_derivatives_at_communication_points_are_central_differences"),
            T("directional_derivatives_in_initialization_mode_are_central_differences"),
            T("a_directional_derivative_is_linear_in_its_seed"),
            T("directional_derivatives_of_every_shipped_fmu_are_central_differences"),
        ],
    ),
    (
        "Derivatives",
        "Other unknowns and knowns are errors; a derivative that does not exist is discarded.",
        &[
            T("unknowns_are_real_outputs_and_knowns_real_inputs_or_the_call_is_an_error"),
            T("a_loose_ring_has_an_output_but_no_derivative_in_initialization_mode"),
        ],
    ),
    (
        "Derivatives",
        "Derivatives of inputs act inside the step, in the orders that the input's description names; others are \
         discarded with a log line.",
        &[
            T("every_input_takes_the_orders_that_its_description_names_and_no_others"),
            T("every_order_that_is_taken_acts"),
            T("an_input_follows_its_derivative_inside_the_step"),
            T("a_motion_is_the_same_in_whichever_variables_it_is_told"),
        ],
    ),
    (
        "Derivatives",
        "Derivatives of outputs by time, order 1, are what short steps show.",
        &[
            T("derivatives_of_outputs_by_time_are_what_short_steps_show"),
            T("derivatives_by_time_of_another_order_or_variable_are_errors"),
        ],
    ),
    (
        "Derivatives",
        "Asking for derivatives changes nothing.",
        &[T("asking_for_derivatives_changes_nothing_that_follows")],
    ),
    (
        "Logging",
        "The standard's categories by name; silent when off; unknown ones are a warning.",
        &[
            T("logging_is_silent_when_off_and_complete_when_on"),
            T("only_the_categories_asked_for_are_logged"),
            T("an_unknown_category_is_a_warning_and_the_known_ones_are_set"),
            T("null_categories_are_errors"),
        ],
    ),
    (
        "Logging",
        "A message is the argument of the format \"%s\".",
        &[T("a_message_is_an_argument_of_the_format_and_never_the_format")],
    ),
    (
        "Logging",
        "Every error has a line that says what to do; what is in order logs nothing.",
        &[T("every_error_says_what_failed_and_what_to_do"), T("steps_and_values_in_order_log_nothing")],
    ),
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
                "cargo test -p fmu-build --test library -- --ignored two_builds_in_two_folders_give_equal_bytes",
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
        "Any sequence of calls with any arguments has the statuses of the standard, changes nothing where it fails, and leaves an instance \
         that can be reset.",
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
        "20 values read in 45 ns, set in 25 ns; 10 ns in a step beyond the solver; a state saved or set back in 100 ns; created, initialized and freed in 50 µs.",
        &[M(
            "cargo bench --bench fmi2_interface",
            "22 ns, 23 ns, 32 and 59 ns are kept; a step's 17 to 27 ns and 74 µs are not",
        )],
    ),
];
