# The core, the techniques, the adapter and the oracle once more, with the sanitizers of addresses and of undefined behaviour. A
# test runs with them as `<test>_sanitized`: it is linked with these instead, and neither it nor the harness is compiled again.
# Clang compiles and links these, whatever the compiler of the project is: in a third of the time of g++.
option(PAPERPROOF_SANITIZED_TESTS "Run tests of the core, the adapter and the oracle with sanitizers as well (needs clang++)" OFF)
add_custom_target(sanitized_tests)

set(paperproof_sanitizers -fsanitize=address,undefined -fno-sanitize-recover=all
  # A null pointer ends a run under the address sanitizer as well, which also finds what is outside of an object; no
  # pointer here is cast to a class that its object may not be, and no function to another type. These look at every
  # access: more than half of the time to compile.
  -fno-sanitize=null,alignment,vptr,object-size,pointer-overflow,function)

# Makes the library <part>_sanitized of the sources of <part>. Without optimisation it takes six times as long to run.
function(paperproof_sanitized_copy part)
  get_target_property(folder ${part} SOURCE_DIR)
  get_target_property(sources ${part} SOURCES)
  list(TRANSFORM sources PREPEND "${folder}/" REGEX "^[^/]")
  add_library(${part}_sanitized OBJECT EXCLUDE_FROM_ALL ${sources})
  target_include_directories(${part}_sanitized PRIVATE $<TARGET_PROPERTY:${part},INCLUDE_DIRECTORIES>)
  target_compile_definitions(${part}_sanitized PRIVATE $<TARGET_PROPERTY:${part},COMPILE_DEFINITIONS>)
  # -w: some of the options are for another compiler, which has warned already.
  target_compile_options(${part}_sanitized PRIVATE $<TARGET_PROPERTY:${part},COMPILE_OPTIONS> -w -O1 -fno-omit-frame-pointer ${paperproof_sanitizers}
    "SHELL:-mllvm -asan-instrumentation-with-call-threshold=0")  # calls of the checks, not their code at every access
  set_target_properties(${part}_sanitized PROPERTIES UNITY_BUILD ${paperproof_unite_tests} UNITY_BUILD_BATCH_SIZE 0 CXX_COMPILER_LAUNCHER "${paperproof_clang}")
endfunction()

if(PAPERPROOF_SANITIZED_TESTS)
  find_program(PAPERPROOF_CLANG clang++ REQUIRED)
  mark_as_advanced(PAPERPROOF_CLANG)
  # A launcher gets the command line, and leaves out its first word, the compiler.
  set(paperproof_clang sh -c "shift && exec '${PAPERPROOF_CLANG}' \"$@\"" sh)
  set(paperproof_sanitized_objects)
  foreach(part IN ITEMS paperproof_controller paperproof_techniques paperproof_box2d_adapter paperproof_box2d_twin paperproof_oracle)
    if(TARGET ${part})
      paperproof_sanitized_copy(${part})
      list(APPEND paperproof_sanitized_objects $<TARGET_OBJECTS:${part}_sanitized>)
    endif()
  endforeach()
  list(SUBLIST paperproof_sanitized_objects 0 2 paperproof_sanitized_core)
endif()

# Runs `test` with the sanitizers, in a few processes. The sanitized objects come first, so that inline functions are theirs.
function(paperproof_sanitized_test test)
  if(NOT PAPERPROOF_SANITIZED_TESTS)
    return()
  endif()
  get_target_property(libraries ${test} LINK_LIBRARIES)
  set(objects ${paperproof_sanitized_core})
  if(libraries MATCHES "box2d|campaign")
    set(objects ${paperproof_sanitized_objects})
  endif()
  add_executable(${test}_sanitized EXCLUDE_FROM_ALL ${objects} $<TARGET_OBJECTS:${test}>)
  set_target_properties(${test}_sanitized PROPERTIES LINKER_LANGUAGE CXX CXX_LINKER_LAUNCHER "${paperproof_clang}")
  target_link_libraries(${test}_sanitized PRIVATE ${libraries})
  target_link_options(${test}_sanitized PRIVATE ${paperproof_sanitizers})
  add_dependencies(sanitized_tests ${test}_sanitized)
  paperproof_run_in_shards(${test}_sanitized 4 "PAPERPROOF_GUARANTEE_STEPS=100" LABELS sanitized COST 40)
endfunction()
