# Turns text files into one C++ source, so that the command carries them with it: a string_view per file, or all in one list.
# Called as a script: cmake -DOUTPUT=page.cpp -DHEADER=page.hpp -DNAMESPACE=name::space -DLIST=page_files -DINPUTS=a.css|b.js -P embed.cmake
# The bytes are written one by one: string literals have length limits and delimiters that a file may contain.
if(CMAKE_SCRIPT_MODE_FILE)
  string(REPLACE "|" ";" inputs "${INPUTS}")
  set(source "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\nnamespace {\n")
  set(views "")
  set(listed "")
  foreach(input IN LISTS inputs)
    get_filename_component(file_name "${input}" NAME)
    string(REPLACE "." "_" name "${file_name}")
    file(READ "${input}" bytes HEX)
    string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${bytes}")
    string(APPEND source "constexpr char ${name}_bytes[] = {${bytes}};\n")
    string(APPEND views "const std::string_view ${name}{${name}_bytes, sizeof(${name}_bytes)};\n")
    string(APPEND listed "{\"${file_name}\", {${name}_bytes, sizeof(${name}_bytes)}},\n")
  endforeach()
  if(LIST)
    string(APPEND source "constexpr EmbeddedFile all_${LIST}[] = {\n${listed}};\n")
    set(views "const std::span<const EmbeddedFile> ${LIST}(all_${LIST});\n")
  endif()
  string(APPEND source "}  // namespace\n\n${views}\n}  // namespace ${NAMESPACE}\n")
  file(WRITE "${OUTPUT}" "${source}")
  return()
endif()

# Writes `output` from the files named (relative to the present folder), whenever one of them changes. `header` declares
# the views, `file_name_extension` each, in `namespace`; with LIST one list of EmbeddedFile of this name.
set(PAPERPROOF_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")
function(paperproof_embed output header namespace)
  cmake_parse_arguments(PARSE_ARGV 3 ARG "" LIST "")
  set(files ${ARG_UNPARSED_ARGUMENTS})
  list(TRANSFORM files PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/" REGEX "^[^/]")
  list(JOIN files "|" joined)
  add_custom_command(
    OUTPUT "${output}"
    COMMAND "${CMAKE_COMMAND}" "-DOUTPUT=${output}" "-DHEADER=${header}" "-DNAMESPACE=${namespace}" "-DLIST=${ARG_LIST}"
            "-DINPUTS=${joined}" -P "${PAPERPROOF_EMBED_SCRIPT}"
    DEPENDS ${files} "${PAPERPROOF_EMBED_SCRIPT}"
    COMMENT "Embedding ${header}"
    VERBATIM)
endfunction()

# Those of one list, of which embedded.hpp tells. `source` is where they are written.
function(paperproof_embed_list list source)
  set(output "${CMAKE_CURRENT_BINARY_DIR}/${list}.cpp")
  paperproof_embed("${output}" embedded.hpp paperproof::compare LIST ${list} ${ARGN})
  set(${source} "${output}" PARENT_SCOPE)
endfunction()
