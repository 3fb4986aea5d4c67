# What every target of this project is compiled with. The target is not exported: a consumer keeps its own flags.
add_library(paperproof_options INTERFACE)
target_compile_options(paperproof_options INTERFACE
  -ffp-contract=off  # a fused multiply-add rounds once where two operations round twice: other bits
  # g++ 12 loses a rounding: of two neighbouring (double)(float)x it makes x, from -O2 on, once it has joined the two
  # into a vector. What a level looks like in float would then depend on the compiler (tests/regression has the case).
  # Costs nothing: the sweep was 2 % faster without these vectors.
  $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wswitch-enum
  # Several sources in one: g++ then takes their unnamed namespaces for those of a header.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wno-subobject-linkage>
  $<$<BOOL:${PAPERPROOF_WARNINGS_AS_ERRORS}>:-Werror>)
