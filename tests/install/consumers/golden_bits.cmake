# The program of the golden bits, for a game that adds the folder: it runs when it is built.
set(tests "${CMAKE_CURRENT_LIST_DIR}/../..")
add_executable(same_bits ${tests}/agreement/same_bits.cpp ${tests}/agreement/golden_scenes.cpp)
target_include_directories(same_bits PRIVATE ${tests})
target_link_libraries(same_bits PRIVATE paperproof::techniques paperproof_options)
add_custom_command(TARGET same_bits POST_BUILD COMMAND same_bits "${GOLDEN}" tenth VERBATIM)
