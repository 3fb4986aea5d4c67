# Configures, builds and runs one consumer in an empty folder; see CMakeLists.txt beside this file.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE "${WORK}")
if(NOT "${WINE}" STREQUAL "")  # it may say that it was not found
  file(MAKE_DIRECTORY "${WORK}")
  set(ENV{WINEPREFIX} "${WORK}/wine")
  set(ENV{WINEDEBUG} -all)
  execute_process(COMMAND "${WINE}" cmd /c exit RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0 OR NOT EXISTS "${CXX_COMPILER}")
    message("skipped: Debian's g++-mingw-w64-x86-64-posix and wine64 are needed: ${CXX_COMPILER}, ${WINE}: ${status} ${output}")
    return()
  endif()
endif()
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${CONSUMER}" -B "${WORK}" -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
          "-DCMAKE_PREFIX_PATH=${PREFIX}" "-DPAPERPROOF_SOURCE=${SOURCE}" ${CONFIGURE}
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)

if(EXPECTED_ERROR)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")  # CMake breaks its messages into lines
  if(status EQUAL 0 OR NOT output MATCHES "${EXPECTED_ERROR}")
    message(FATAL_ERROR "expected a refusal with \"${EXPECTED_ERROR}\", got status ${status} and:\n${output}")
  endif()
  string(REGEX MATCHALL "CMake Error" errors "${output}")
  list(LENGTH errors errors)
  if(errors GREATER 1 OR output MATCHES "Call Stack")
    message(FATAL_ERROR "expected one error in words, got:\n${output}")
  endif()
  return()
endif()

if(NOT status EQUAL 0)
  message(FATAL_ERROR "${output}")
endif()
if(CONFIGURE_ONLY)
  return()
endif()
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${WORK}" --target consumer COMMAND_ERROR_IS_FATAL ANY)
if(NOT "${WINE}" STREQUAL "")
  execute_process(COMMAND "${WINE}" "${WORK}/consumer.exe" COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE_RECURSE "$ENV{WINEPREFIX}")  # wine copies 0.7 GB to there
else()
  execute_process(COMMAND "${WORK}/consumer" COMMAND_ERROR_IS_FATAL ANY)
endif()
