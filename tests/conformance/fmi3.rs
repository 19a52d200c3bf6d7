//! What FMI 3.0.2 asks of a co-simulation FMU, where it is not what FMI 2.0 asks.

use super::{
    Evidence::{Measured, Test},
    Rule,
};

pub(crate) const RULES: &[Rule] = &[
    (
        "Binary",
        "All 75 functions of fmi3Functions.h are exported; those of capabilities that are not declared are errors with \
         a reason.",
        &[
            Test("exactly_the_functions_of_the_standard_are_exported"),
            Test("what_is_not_provided_is_an_error_with_a_reason"),
            Test("the_other_kinds_of_fmu_are_refused_with_a_line"),
        ],
    ),
    (
        "Binary",
        "One library serves FMI 2.0 and FMI 3.0; the same scene and steps give equal bits.",
        &[
            Test("the_same_scene_and_steps_give_the_bits_of_fmi_2"),
            Test("every_shipped_scene_gives_the_bits_of_fmi_2_under_fmi_3"),
            Test("an_instance_of_one_version_is_none_of_the_other"),
        ],
    ),
    (
        "Binary",
        "Folders by processor and system: x86_64-linux, aarch64-linux, x86_64-windows, x86_64-darwin, aarch64-darwin.",
        &[Test("an_fmu_of_fmi_3_holds_the_library_in_the_folder_of_every_processor_and_terminals_with_an_icon")],
    ),
    (
        "State machine",
        "Each function is allowed in the states of the standard and an error with a log line in all others.",
        &[
            Test("every_function_of_fmi_3_is_allowed_in_the_modes_of_the_standard_and_in_no_other"),
            Test("in_error_one_may_only_read_reset_restore_or_free_under_fmi_3"),
            Test("inside_a_step_nothing_may_be_called_that_could_end_the_instance_or_move_it"),
        ],
    ),
    (
        "State machine",
        "Null, dead and invented handles are errors; a panic is caught, and fails its own instance only.",
        &[
            Test("null_dead_and_invented_handles_are_errors_under_fmi_3"),
            Test("a_panic_inside_a_step_reaches_the_host_as_a_status_and_a_reset_mends_it"),
        ],
    ),
    (
        "State machine",
        "A wrong token, a path that is none, event mode and impossible intermediate variables give NULL and a log \
         line.",
        &[
            Test("whatever_keeps_an_instance_from_being_made_is_told_though_logging_is_off"),
            Test("only_inputs_and_outputs_may_be_asked_for_in_intermediate_updates"),
        ],
    ),
    (
        "State machine",
        "resourcePath is a plain absolute path, in which nothing is escaped.",
        &[
            Test("a_path_is_taken_with_and_without_its_separator_and_with_odd_names"),
            Test("a_plain_path_is_absolute_and_keeps_every_byte"),
        ],
    ),
    (
        "State machine",
        "A reset instance is as a new one.",
        &[Test("a_reset_instance_of_fmi_3_runs_like_a_new_one_to_the_bit")],
    ),
    (
        "State machine",
        "Without event mode: hasEventMode is false, eventModeUsed is refused, no event is signalled, and functions of \
         events are errors.",
        &[
            Test("whatever_keeps_an_instance_from_being_made_is_told_though_logging_is_off"),
            Test("a_step_gives_no_event_no_end_no_early_return_and_its_end"),
            Test("what_is_not_provided_is_an_error_with_a_reason"),
        ],
    ),
    (
        "Steps",
        "Start, stop and tolerance come with fmi3EnterInitializationMode; a step past a defined stop time is an error.",
        &[
            Test("start_and_stop_must_be_finite_and_a_tolerance_can_only_tighten"),
            Test("a_wrong_point_a_wrong_step_and_one_past_the_stop_time_are_errors_with_the_numbers"),
        ],
    ),
    (
        "Steps",
        "A step gives the time reached; a NULL pointer for a result is refused before anything is done.",
        &[
            Test("a_step_gives_no_event_no_end_no_early_return_and_its_end"),
            Test("a_step_with_a_null_pointer_for_a_result_is_refused_before_anything_is_done"),
        ],
    ),
    (
        "Intermediate updates",
        "The host is called after each accepted integration step, at times that never go back, the last at the step's \
         end; being watched changes no bit.",
        &[
            Test("a_run_that_is_watched_has_the_bits_of_one_that_is_not"),
            Test("a_run_under_law_love_that_is_watched_has_the_bits_of_one_that_is_not"),
        ],
    ),
    (
        "Intermediate updates",
        "An early return ends the step where the host was told, or exactly at a later instant that it names, with the \
         outputs that were shown there.",
        &[
            Test("a_step_returns_early_where_it_is_asked_with_the_outputs_that_were_shown_there"),
            Test("a_step_returns_exactly_at_a_later_instant_that_the_host_names"),
            Test("a_state_saved_after_an_early_return_continues_with_the_same_bits"),
            Test("a_host_that_cannot_handle_an_early_return_gets_none"),
        ],
    ),
    (
        "Intermediate updates",
        "Inputs that the host has asked for may be set, and act from there on: what FMI 2.0's derivatives of inputs \
         were for.",
        &[
            Test("an_input_set_in_an_update_acts_from_there_on"),
            Test("inputs_set_to_where_they_are_change_no_bit"),
            Test("the_mean_force_is_that_of_the_whole_step_though_inputs_are_set_inside"),
        ],
    ),
    (
        "Intermediate updates",
        "Other variables, other functions, a time outside the step and a callback that unwinds fail the step with the \
         reason; a saved state is restored.",
        &[Test("what_an_update_may_not_do_fails_the_step_with_the_reason")],
    ),
    (
        "Variables",
        "The same variables by the same names as in FMI 2.0; what every element has is an array of one dimension.",
        &[
            Test("both_versions_have_the_same_variables_by_the_same_names"),
            Test("an_array_has_the_values_of_all_elements_in_their_order"),
            Test("what_only_a_defective_element_has_is_a_scalar"),
            Test("the_committed_model_descriptions_of_fmi_3_are_those_of_their_scenes"),
        ],
    ),
    (
        "Variables",
        "A number of values that does not fit the references is an error with both numbers.",
        &[Test("a_number_of_values_that_does_not_fit_is_an_error_with_both_numbers")],
    ),
    (
        "Variables",
        "Float64, UInt64 (counters), Enumeration and String; of the other types there are none, and their functions \
         say so.",
        &[
            Test("counters_enumerations_and_strings_have_their_types"),
            Test("unknown_references_wrong_types_and_what_cannot_be_set_are_errors_that_say_so"),
        ],
    ),
    (
        "Variables",
        "What may not be set, a value outside its range and NaN are refused, and nothing changes.",
        &[
            Test("values_outside_their_range_and_nan_are_discarded_under_fmi_3_and_change_nothing"),
            Test("misaligned_and_overlapping_arrays_and_null_are_refused_under_fmi_3"),
        ],
    ),
    (
        "Variables",
        "Start values are read before initialization; the time is a variable of its own.",
        &[Test("start_values_are_read_before_initialization_and_the_time_is_where_the_instance_is")],
    ),
    (
        "Variables",
        "The description keeps to the schema: units, types, dimensions, model structure with dependencies.",
        &[Test("validate_fmu_finds_nothing_in_fmi_3")],
    ),
    (
        "Saved states",
        "Rewinding and bytes repeat every bit, in another instance and under the other version as well; foreign states \
         are errors.",
        &[
            Test("a_rewound_instance_of_fmi_3_repeats_every_bit_and_so_does_one_from_bytes"),
            Test("a_state_in_bytes_goes_from_one_version_of_fmi_to_the_other"),
            Test("invented_freed_and_foreign_states_are_errors_under_fmi_3"),
        ],
    ),
    (
        "Derivatives",
        "Directional derivatives are central differences, adjoint ones their transposed product, of arrays with all \
         elements; output derivatives are those of FMI 2.0.",
        &[
            Test("directional_derivatives_are_central_differences_and_arrays_give_all_their_elements"),
            Test("adjoint_derivatives_are_the_transposed_product_of_directional_ones"),
            Test("derivatives_by_parameters_in_initialization_mode_have_the_bits_of_fmi_2_either_way"),
            Test("derivatives_have_the_bits_of_fmi_2_and_asking_for_them_changes_nothing"),
            Test("states_derivatives_updates_and_terminals_of_every_shipped_scene_keep_to_fmi_3"),
        ],
    ),
    (
        "Derivatives",
        "Wrong unknowns, knowns, orders and counts are errors with the reason.",
        &[Test("wrong_unknowns_knowns_orders_and_counts_of_derivatives_are_errors_with_the_reason")],
    ),
    (
        "Derivatives",
        "Dependencies are told element by element, those of initialization before its end and those of steps after it.",
        &[Test("dependencies_are_those_of_every_element_before_and_after_initialization")],
    ),
    (
        "Logging",
        "Categories are turned on and off one by one; nothing is logged when all are off, except why no instance was \
         made; # is doubled.",
        &[
            Test("categories_are_turned_on_and_off_one_by_one"),
            Test("a_number_sign_which_names_variables_in_messages_is_doubled"),
        ],
    ),
    (
        "Archive",
        "Terminals for both rings after the schema, an icon, documentation and licences; packing again gives equal \
         bytes.",
        &[
            Test("states_derivatives_updates_and_terminals_of_every_shipped_scene_keep_to_fmi_3"),
            Test("an_fmu_of_fmi_3_holds_the_library_in_the_folder_of_every_processor_and_terminals_with_an_icon"),
            Test("packing_a_scene_twice_gives_equal_bytes"),
            Test("every_entry_is_plain_zip_2_0_without_extra_fields"),
        ],
    ),
    (
        "Importers",
        "fmpy, fmusim, FMI Library and fmuloader run every shipped FMU.",
        &[
            Measured("fmusim 0.8.0, FMI Library 3.0a5, fmuloader 0.1.2rc0", "all scenes; fmuloader reads no arrays"),
            Test("simulate_fmu_runs_every_shipped_scene_under_fmi_3"),
            Test("the_check_command_passes_an_fmu_of_fmi_3"),
        ],
    ),
    (
        "Cost",
        "No allocation in setting, stepping with intermediate updates, reading, saving and restoring.",
        &[Test("setting_stepping_updating_reading_saving_and_restoring_allocate_nothing_under_fmi_3")],
    ),
    (
        "Cost",
        "A step costs what it costs under FMI 2.0.",
        &[Measured(
            "cargo bench --bench fmi3_interface",
            "ratio 0.95 to 1.02; with a callback after each integration step 1.08 to 1.11",
        )],
    ),
];
