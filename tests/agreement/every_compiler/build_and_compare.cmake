# Builds same_bits with one COMPILER and one OPTIMISATION, as a project that adds the folder, and compares what it prints
# with GOLDEN.
cmake_minimum_required(VERSION 3.25)

if(NOT COMPILER)
  message(STATUS "no such compiler here")
  return()
endif()
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}" -B "${WORK}" -G "${GENERATOR}" -DCMAKE_BUILD_TYPE=
          "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${OPTIMISATION}"
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${WORK}" --parallel 1 COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${WORK}/consumer" COMMAND_ERROR_IS_FATAL ANY)
set(steps "")
if(OPTIMISATION STREQUAL "-O0")
  set(steps fifth)
endif()
execute_process(COMMAND "${WORK}/same_bits" "${GOLDEN}" ${steps} COMMAND_ERROR_IS_FATAL ANY)
