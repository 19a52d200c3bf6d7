//! What the calls of a running instance do: steps, variables, saved states, derivatives, messages.

use super::Evidence::{Measured as M, Test as T};
use super::Rule;

pub(super) const RULES: &[Rule] = &[
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
        "Steps that are zero, negative, infinite or NaN are errors.",
        &[T("a_step_that_is_not_above_zero_and_finite_is_an_error")],
    ),
    (
        "Steps",
        "A step past a defined stop time is an error, apart from rounding; without one there is no end.",
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
        "Units with their base units, enumerations, ranges, nominals, descriptions and the default experiment are in \
         the description, which keeps to the schema.",
        &[
            T("validate_fmu_finds_nothing"),
            T("the_committed_model_descriptions_are_those_of_the_shipped_scenes"),
            T("a_display_unit_is_the_unit_times_its_factor"),
        ],
    ),
    (
        "Variables",
        "Outputs and InitialUnknowns ascend and list exactly what each depends on: perturbing every input moves what \
         is listed and nothing else.",
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
        "A state continues in another instance and another process with the same bits, in the middle of an impact and \
         with law love.",
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
        "Directional derivatives of every real output by every input are central differences, at communication points \
         and in initialization mode, where those by listed parameters are, too.",
        &[
            T("directional_derivatives_at_communication_points_are_central_differences"),
            T("directional_derivatives_in_initialization_mode_are_central_differences"),
            T("a_directional_derivative_is_linear_in_its_seed"),
            T("derivatives_by_every_known_listed_of_initial_unknowns_are_differences_of_two_starts"),
            T("a_parameter_at_its_limit_has_a_derivative_into_what_may_be_set"),
            T("directional_derivatives_of_every_shipped_fmu_are_central_differences"),
        ],
    ),
    (
        "Derivatives",
        "Other unknowns and knowns are discarded, and so is a derivative that does not exist; the run goes on.",
        &[
            T("what_is_no_unknown_or_no_known_is_refused_and_the_run_goes_on"),
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
];
