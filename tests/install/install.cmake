# Installs the build into an empty prefix and looks at what came.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE "${PREFIX}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${PREFIX}" COMMAND_ERROR_IS_FATAL ANY)

set(expected
  include/paperproof/paperproof.hpp
  "${LIBDIR}/libpaperproof_controller.a"
  "${LIBDIR}/cmake/paperproof/paperproofConfig.cmake"
  "${LIBDIR}/cmake/paperproof/paperproofConfigVersion.cmake")
if(WITH_COMMAND)
  list(APPEND expected "${BINDIR}/paperproof" share/paperproof/paperproof_scene.schema.json
       share/paperproof/paperproof_rows.schema.json
       share/paperproof/paperproof_trace.schema.json)
endif()
foreach(file IN LISTS expected)
  if(NOT EXISTS "${PREFIX}/${file}")
    message(SEND_ERROR "not installed: ${file}")
  endif()
endforeach()

# An export that names this tree works on this machine only; our warnings are no business of a consumer.
file(GLOB exported "${PREFIX}/${LIBDIR}/cmake/paperproof/*.cmake")
foreach(file IN LISTS exported)
  file(READ "${file}" text)
  foreach(unwanted IN ITEMS "${SOURCE}" "${BUILD}" "-Werror" "-Wall" "paperproof_options")
    string(FIND "${text}" "${unwanted}" at)
    if(NOT at EQUAL -1)
      message(SEND_ERROR "${file} names ${unwanted}")
    endif()
  endforeach()
endforeach()
