# Reads every #include under ROOT and refuses those that point against the arrows of the architecture:
#   controller  <-  box2d_adapter  <-  box2d_adapter/twin  <-  compare,   controller  <-  controller/techniques  <-  compare
# What a part may include is listed, so that a library nobody thought of is refused as well.
cmake_minimum_required(VERSION 3.25)

set(standard "<[a-z_0-9]+>")
set(core "types|up_frame|tolerances|filter|scenery|scenery_facts|broad_phase|character|plan|report_vector|technique|joint_technique|octagon_sweep|controller|contact_changes|local_controller|level|saved_state|crowd|paperproof")
set(may_include_controller "${standard}|<Eigen/[A-Za-z]+>|<paperproof/(${core})[.]hpp>")
# The techniques use the core as anybody would, but for one of its parts.
set(may_include_techniques "${may_include_controller}|<paperproof/(techniques|pixel_tiles|number_in)[.]hpp>|\"geometry/overlap_time[.]hpp\"")
# The twin's headers have the adapter's folder in their names, and are not the adapter's.
file(GLOB adapter_headers RELATIVE "${ROOT}/box2d_adapter/include" "${ROOT}/box2d_adapter/include/paperproof/box2d/*.hpp")
list(JOIN adapter_headers ">|<" adapter_headers)
set(may_include_box2d_adapter "${may_include_controller}|<${adapter_headers}>|<box2d/[a-z_0-9]+[.]h>")
set(may_include_twin "${may_include_box2d_adapter}|<paperproof/box2d/[a-z_0-9]+[.]hpp>|<polyclipping/clipper[.]hpp>|\"(float_geometry|shapes)[.]hpp\"")
# A benchmark of Box2D without the twin's recording needs the twin's fixtures, which are no part of its interface.
set(may_include_compare "<.*>|\"box2d_adapter/(twin/src/fixtures|src/float_geometry)[.]hpp\"")
# The oracle judges the controller, and so does the continuous reference: of it, they may know the values that all speak
# of, and no geometry.
set(may_include_oracle "${standard}|<boost/.*>|<paperproof/(types|scenery|character|technique)[.]hpp>")

set(seen 0)
set(refused "")

# `own`: the folder that holds what the part may include in quotes.
function(check_part folder allowed own)
  file(GLOB_RECURSE files "${ROOT}/${folder}/*.[ch]pp" "${ROOT}/${folder}/*.h")
  foreach(file IN LISTS files)
    file(STRINGS "${file}" lines REGEX "^[ \t]*#[ \t]*include")
    foreach(line IN LISTS lines)
      math(EXPR seen "${seen} + 1")
      string(REGEX REPLACE "^[ \t]*#[ \t]*include[ \t]*" "" included "${line}")
      if(included MATCHES "^\"([^\"]+)\"")
        cmake_path(GET file PARENT_PATH beside)
        set(named "${ROOT}/${own}/${CMAKE_MATCH_1}")  # or configured from a file of this name with .in
        if(EXISTS "${beside}/${CMAKE_MATCH_1}" OR EXISTS "${named}" OR EXISTS "${named}.in")
          continue()
        endif()
      endif()
      if(included MATCHES "^(${allowed})")
        continue()
      endif()
      cmake_path(RELATIVE_PATH file BASE_DIRECTORY "${ROOT}" OUTPUT_VARIABLE shown)
      string(APPEND refused "  ${shown}: ${included}\n")
    endforeach()
  endforeach()
  set(seen "${seen}" PARENT_SCOPE)
  set(refused "${refused}" PARENT_SCOPE)
endfunction()

check_part(controller/include "${may_include_controller}" controller/src)
check_part(controller/src "${may_include_controller}" controller/src)
check_part(controller/techniques "${may_include_techniques}" controller)
check_part(box2d_adapter/include "${may_include_box2d_adapter}" box2d_adapter/src)
check_part(box2d_adapter/src "${may_include_box2d_adapter}" box2d_adapter/src)
check_part(box2d_adapter/twin "${may_include_twin}" box2d_adapter/twin/src)
check_part(compare "${may_include_compare}" compare)
check_part(compare/oracle "${may_include_oracle}" compare)
check_part(compare/continuous "${may_include_oracle}" compare)

# Inside `compare`, of its own folders each may include itself and those that are listed:
#   records  <-  oracle  <-  scenes  <-  metrics  <-  runs  <-  studies  <-  command,  records  <-  report  <-  studies,
#   scenes  <-  continuous  <-  runs,   runs  <-  benchmarks
set(folders records oracle scenes continuous metrics runs report studies benchmarks command)
set(records_may "")
set(oracle_may records)
set(scenes_may ${oracle_may} oracle)
set(continuous_may ${scenes_may} scenes)
set(metrics_may ${scenes_may} scenes)
set(runs_may ${metrics_may} metrics continuous)
set(report_may records)
set(studies_may ${runs_may} runs report)
set(benchmarks_may ${runs_may} runs)
set(command_may ${studies_may} studies)
foreach(folder IN LISTS folders)
  file(GLOB_RECURSE files "${ROOT}/compare/${folder}/*.[ch]pp")
  foreach(file IN LISTS files)
    file(STRINGS "${file}" lines REGEX "^[ \t]*#[ \t]*include[ \t]*\"[a-z_]+/")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^[ \t]*#[ \t]*include[ \t]*\"([a-z_]+)/.*" "\\1" from "${line}")
      if(from IN_LIST folders AND NOT from STREQUAL folder AND NOT from IN_LIST ${folder}_may)
        cmake_path(RELATIVE_PATH file BASE_DIRECTORY "${ROOT}" OUTPUT_VARIABLE shown)
        string(APPEND refused "  ${shown}: ${folder} knows ${from}\n")
      endif()
    endforeach()
  endforeach()
endforeach()

if(seen LESS AT_LEAST)
  message(FATAL_ERROR "only ${seen} includes under ${ROOT}: this check looks in the wrong place")
endif()
if(NOT refused STREQUAL EXPECTED)
  message(FATAL_ERROR "against the arrows:\n${refused}expected:\n${EXPECTED}")
endif()
message(STATUS "${seen} includes read")
