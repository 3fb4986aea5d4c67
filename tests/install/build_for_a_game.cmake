# What somebody does whose machine has Eigen and Box2D alone: builds the libraries, installs them, and builds a game
# (build_and_run.cmake) against what was installed.
cmake_minimum_required(VERSION 3.25)

set(build "${WORK}_build")
set(PREFIX "${WORK}_prefix")
file(REMOVE_RECURSE "${build}" "${PREFIX}")
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${build}" -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
          -DPAPERPROOF_COMPARE=OFF -DBUILD_TESTING=OFF -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 ${CONFIGURE}
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${build}" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${build}" --prefix "${PREFIX}" COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE twin "${PREFIX}/*twin*" "${PREFIX}/*reference_world*")
if(twin)
  message(FATAL_ERROR "the harness was installed too: ${twin}")
endif()
include("${CMAKE_CURRENT_LIST_DIR}/build_and_run.cmake")
