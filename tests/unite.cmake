# cmake -P unite.cmake OUTPUT SOURCE...: writes the sources into one, each with its unnamed namespace named after the file,
# so that files may name their helpers alike. A file without tests has functions outside of its namespace, which call those
# inside: `using namespace` opens it for them.
cmake_minimum_required(VERSION 3.25)

set(all "")
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE 4 ${last})
  set(source "${CMAKE_ARGV${i}}")
  file(READ "${source}" text)
  get_filename_component(name "${source}" NAME_WE)
  string(REPLACE "\nnamespace {\n" "\nnamespace ${name} {\n" text "${text}")
  if(NOT name MATCHES "_test$")
    string(REPLACE "\n}  // namespace\n" "\n}  // namespace\nusing namespace ${name};\n" text "${text}")
  endif()
  string(APPEND all "#line 1 \"${source}\"\n${text}")
endforeach()
file(WRITE "${CMAKE_ARGV3}" "${all}")
