# Turns text files into one C++ source with a string_view per file, so that the command carries its pages with it.
# Called as a script: cmake -DOUTPUT=page.cpp -DHEADER=page.hpp -DNAMESPACE=name::space -DINPUTS=a.css|b.js -P embed.cmake
# The bytes are written one by one: string literals have length limits and delimiters that a file may contain.
if(CMAKE_SCRIPT_MODE_FILE)
  string(REPLACE "|" ";" inputs "${INPUTS}")
  set(source "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\nnamespace {\n")
  set(views "")
  foreach(input IN LISTS inputs)
    get_filename_component(name "${input}" NAME)
    string(REPLACE "." "_" name "${name}")
    file(READ "${input}" bytes HEX)
    string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${bytes}")
    string(APPEND source "constexpr char ${name}_bytes[] = {${bytes}};\n")
    string(APPEND views "const std::string_view ${name}{${name}_bytes, sizeof(${name}_bytes)};\n")
  endforeach()
  string(APPEND source "}  // namespace\n\n${views}\n}  // namespace ${NAMESPACE}\n")
  file(WRITE "${OUTPUT}" "${source}")
  return()
endif()

# Writes `output` from the files named (relative to the present folder), whenever one of them changes. `header` declares
# the views, `file_name_extension` each, in `namespace`.
set(PAPERPROOF_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")
function(paperproof_embed output header namespace)
  set(files ${ARGN})
  list(TRANSFORM files PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/" REGEX "^[^/]")
  list(JOIN files "|" joined)
  add_custom_command(
    OUTPUT "${output}"
    COMMAND "${CMAKE_COMMAND}" "-DOUTPUT=${output}" "-DHEADER=${header}" "-DNAMESPACE=${namespace}" "-DINPUTS=${joined}"
            -P "${PAPERPROOF_EMBED_SCRIPT}"
    DEPENDS ${files} "${PAPERPROOF_EMBED_SCRIPT}"
    COMMENT "Embedding ${header}"
    VERBATIM)
endfunction()
