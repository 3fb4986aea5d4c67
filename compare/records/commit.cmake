# Writes the source that says which commit is built, if it is another than before. Called as a script in each build:
# cmake -DSOURCE=folder -DOUTPUT=commit.cpp -P commit.cmake. Without git, or outside of a clone, the commit is empty.
set(commit "")
find_program(git git)
if(git)
  execute_process(COMMAND "${git}" -C "${SOURCE}" describe --always --dirty=+ --abbrev=12 --exclude=*
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT [[
#include "records/commit.hpp"

std::string_view paperproof::compare::built_commit() noexcept { return "@commit@"; }
]] @ONLY)
