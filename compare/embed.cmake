# Turns text files into one C++ source, so that the command carries them with it: a list of EmbeddedFile (see embedded.hpp).
# Called as a script: cmake -DOUTPUT=page_files.cpp -DLIST=page_files -DINPUTS=a.css|b.js -P embed.cmake
# The bytes are written one by one: string literals have length limits and delimiters that a file may contain.
if(CMAKE_SCRIPT_MODE_FILE)
  string(REPLACE "|" ";" inputs "${INPUTS}")
  set(source "#include \"embedded.hpp\"\n\nnamespace paperproof::compare {\nnamespace {\n")
  set(listed "")
  foreach(input IN LISTS inputs)
    get_filename_component(file_name "${input}" NAME)
    string(REPLACE "." "_" name "${file_name}")
    file(READ "${input}" bytes HEX)
    string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${bytes}")
    string(APPEND source "constexpr char ${name}_bytes[] = {${bytes}};\n")
    string(APPEND listed "{\"${file_name}\", {${name}_bytes, sizeof(${name}_bytes)}},\n")
  endforeach()
  string(APPEND source "constexpr EmbeddedFile all_${LIST}[] = {\n${listed}};\n}  // namespace\n\n"
    "const std::span<const EmbeddedFile> ${LIST}(all_${LIST});\n\n}  // namespace paperproof::compare\n")
  file(WRITE "${OUTPUT}" "${source}")
  return()
endif()

# Writes the list of the files named (relative to the present folder), whenever one of them changes. `source` is where.
set(PAPERPROOF_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")
function(paperproof_embed list source)
  set(output "${CMAKE_CURRENT_BINARY_DIR}/${list}.cpp")
  set(files ${ARGN})
  list(TRANSFORM files PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/" REGEX "^[^/]")
  list(JOIN files "|" joined)
  add_custom_command(
    OUTPUT "${output}"
    COMMAND "${CMAKE_COMMAND}" "-DOUTPUT=${output}" "-DLIST=${list}" "-DINPUTS=${joined}" -P "${PAPERPROOF_EMBED_SCRIPT}"
    DEPENDS ${files} "${PAPERPROOF_EMBED_SCRIPT}"
    COMMENT "Embedding ${list}"
    VERBATIM)
  set(${source} "${output}" PARENT_SCOPE)
endfunction()
