# Turns text files into one C++ source with a string_view per file, so that the command carries its page with it.
# Called as a script: cmake -DOUTPUT=page.cpp -DINPUTS=a.css|b.js -P embed.cmake
# The bytes are written one by one: string literals have length limits and delimiters that a file may contain.
string(REPLACE "|" ";" inputs "${INPUTS}")
set(source "#include \"report/page_parts.hpp\"\n\nnamespace paperproof::compare::page {\nnamespace {\n")
set(views "")
foreach(input IN LISTS inputs)
  get_filename_component(name "${input}" NAME)
  string(REPLACE "." "_" name "${name}")
  file(READ "${input}" bytes HEX)
  string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${bytes}")
  string(APPEND source "constexpr char ${name}_bytes[] = {${bytes}};\n")
  string(APPEND views "const std::string_view ${name}{${name}_bytes, sizeof(${name}_bytes)};\n")
endforeach()
string(APPEND source "}  // namespace\n\n${views}\n}  // namespace paperproof::compare::page\n")
file(WRITE "${OUTPUT}" "${source}")
