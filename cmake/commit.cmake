# Writes the commit that is built as a C++ header, if it is another than the header says. Called as a script in each build:
# cmake -DSOURCE=folder -DOUTPUT=header.hpp -P commit.cmake. Without git, or outside of a clone, the commit is empty.
set(commit "")
find_program(git git)
if(git)
  execute_process(COMMAND "${git}" -C "${SOURCE}" describe --always --dirty=+ --abbrev=12 --exclude=*
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "#define PAPERPROOF_COMMIT \"${commit}\"\n")
