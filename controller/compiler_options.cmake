# What every target of this project is compiled with. The target is not exported: a consumer keeps its own flags.
add_library(paperproof_options INTERFACE)
if(MSVC)
  # The mode in which every version of MSVC, and clang-cl, rounds once for each operation.
  target_compile_options(paperproof_options INTERFACE /fp:strict /utf-8 $<$<BOOL:${PAPERPROOF_WARNINGS_AS_ERRORS}>:/WX>)
else()
  target_compile_options(paperproof_options INTERFACE
    -ffp-contract=off  # a fused multiply-add rounds once where two operations round twice: other bits
    # g++ 12 loses a rounding: of two neighbouring (double)(float)x it makes x, from -O2 on, once it has joined the two
    # into a vector. What a level looks like in float would then depend on the compiler (tests/regression has the case).
    # Costs nothing: the sweep was 2 % faster without these vectors.
    $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
    -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wswitch-enum
    # Several sources in one: g++ then takes their unnamed namespaces for those of a header.
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wno-subobject-linkage>
    $<$<BOOL:${PAPERPROOF_WARNINGS_AS_ERRORS}>:-Werror>)
endif()

# How the two libraries of a game are built: the controller and the adapter.
function(paperproof_for_games library)
  # As one source: most of the time goes into headers. -DCMAKE_UNITY_BUILD=OFF compiles each source alone.
  set_target_properties(${library} PROPERTIES UNITY_BUILD_BATCH_SIZE 0)
  if(NOT DEFINED CMAKE_UNITY_BUILD)
    set_target_properties(${library} PROPERTIES UNITY_BUILD ON)
  endif()
  if(PAPERPROOF_OPTIMISE_IN_DEBUG)
    # Without a build type, too. Assertions stay as the game has them.
    set(unoptimised $<OR:$<CONFIG:Debug>,$<STREQUAL:$<CONFIG>,>>)
    target_compile_options(${library} PRIVATE $<$<AND:${unoptimised},$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:-O2>)
  endif()
endfunction()
