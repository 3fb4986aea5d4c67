# Traces are checked by a program that shares nothing with this one: Python's standard library and exact fractions.
set(traces "${CMAKE_CURRENT_BINARY_DIR}/traces")
file(MAKE_DIRECTORY "${traces}")
set(checker "${CMAKE_CURRENT_SOURCE_DIR}/check_trace.py")

# -B: leaves no cache in the sources. Without Python the tests are skipped, and say why.
function(paperproof_trace_test name)
  cmake_parse_arguments(ARG "" "" "COMMAND;PROPERTIES" ${ARGN})
  if(PAPERPROOF_PYTHON3)
    add_test(NAME trace.${name} COMMAND "${PAPERPROOF_PYTHON3}" -B ${ARG_COMMAND})
  else()
    add_test(NAME trace.${name} COMMAND "${CMAKE_COMMAND}" -E echo "skipped: there is no python3 here")
    set(ARG_PROPERTIES SKIP_REGULAR_EXPRESSION "skipped: ")
  endif()
  set_tests_properties(trace.${name} PROPERTIES LABELS slow FIXTURES_REQUIRED traces TIMEOUT 300 ${ARG_PROPERTIES})
endfunction()

set(checked_scenes article_bullet slope_joints jump_into_corner rotated_wall wedge_60 start_overlapping_deep
  characters_head_on three_in_a_row jump_onto_a_head two_on_a_lift pressed_in_a_row
    lift_up lift_sideways closing_ceiling sweeping_paper head_on one_way_drop one_way_solid one_way_lift_drop one_way_turns_within
    thin_sensor sensor_gate stack_1000 falling_crate
    ledge_corner slope_wall_hop climb45_3m climb45_5m low_step oneway_peak oneway_hill oneway_noise oneway_arch
    exact_fit_lift_down exact_fit_cabin_up exact_fit_under_lift exact_fit_cabin_still escape_not_shortest land_on_circle bullet_at_circle
    between_circles)
add_test(NAME trace.write COMMAND paperproof compare ${checked_scenes} turning_arm rotating_paper --no-timing --quiet --trace "${traces}/t")
set_tests_properties(trace.write PROPERTIES LABELS slow FIXTURES_SETUP traces TIMEOUT 300 COST 50)

set(good)
foreach(scene IN LISTS checked_scenes ITEMS turning_arm rotating_paper)
  list(APPEND good "${traces}/t.${scene}.octagon_sweep.double.jsonl")
endforeach()
paperproof_trace_test(of_octagon_sweep_hold COMMAND "${checker}" ${good} PROPERTIES COST 50)

# Who guarantees nothing is asked for what is told. By discrete two that meet share their overlap, and are apart; with a
# third one rounds are too few for that.
set(safe --clauses overlap,passage,continuity)
paperproof_trace_test(of_discrete_characters_hold_for_two_and_show_the_overlap_of_three
  COMMAND "${checker}" ${safe} "${traces}/t.characters_head_on.discrete.double.jsonl"
          "${traces}/t.three_in_a_row.discrete.double.jsonl"
  PROPERTIES PASS_REGULAR_EXPRESSION "60 steps, 0 contacts, 0 violations of 3 clauses\n.*step 0: overlap: character 0 and character 1 come to overlap.*90 steps, 0 contacts, 1 violations")

# Box2D keeps 15 mm away, so that nothing of it is too close to tell.
paperproof_trace_test(of_what_turns_hold
  COMMAND "${checker}" ${safe},wanted "${traces}/t.turning_arm.box2d.float.jsonl" "${traces}/t.rotating_paper.box2d.float.jsonl"
  PROPERTIES PASS_REGULAR_EXPRESSION "90 steps, [1-9][0-9]* contacts, 0 violations of 4 clauses\n.*120 steps, [1-9][0-9]* contacts, 0 violations of 4 clauses\n")

# A character that goes by whole squares is drawn elsewhere: `remainder` says so.
paperproof_trace_test(of_grid_hold COMMAND "${checker}" ${safe} "${traces}/t.sensor_gate.grid.double.jsonl")

# It has to find what is wrong: the bullet that passes the paper, and traces that are spoilt on purpose.
paperproof_trace_test(of_penetration_resolution_shows_the_tunnel
  COMMAND "${checker}" ${safe} "${traces}/t.article_bullet.penetration_resolution.double.jsonl"
  PROPERTIES PASS_REGULAR_EXPRESSION "step 0: passage: passes or enters platform.*60 steps, 0 contacts, 1 violations")
paperproof_trace_test(what_is_known_and_open_is_all_that_built_in_scenes_break
  COMMAND "${CMAKE_CURRENT_SOURCE_DIR}/known_and_open_test.py" "$<TARGET_FILE:paperproof>"
          "${PROJECT_SOURCE_DIR}/tests/known_and_open.json" "${PROJECT_SOURCE_DIR}/README.md" PROPERTIES COST 20)
paperproof_trace_test(that_lies_or_is_honest_is_judged_so COMMAND "${CMAKE_CURRENT_SOURCE_DIR}/judge_test.py" "$<TARGET_FILE:paperproof>")
paperproof_trace_test(checker_finds_and_names_whatever_is_spoilt
  COMMAND "${CMAKE_CURRENT_SOURCE_DIR}/check_trace_test.py" "$<TARGET_FILE:paperproof>" PROPERTIES COST 60)
