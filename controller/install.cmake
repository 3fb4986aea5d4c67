# What `cmake --install` puts where, and how another project finds it:
#   find_package(paperproof COMPONENTS controller box2d_adapter)
# Each library has an export of its own, so that a project without Box2D can use the controller.
include(CMakePackageConfigHelpers)

set(PAPERPROOF_CONFIG_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/paperproof")

function(paperproof_install_library component folder)
  install(TARGETS paperproof_${component} EXPORT paperproof_${component}_export
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
          LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
          FILES_MATCHING PATTERN "*.hpp")
  install(EXPORT paperproof_${component}_export NAMESPACE paperproof::
          FILE paperproof_${component}.cmake DESTINATION "${PAPERPROOF_CONFIG_DIR}")
endfunction()

paperproof_install_library(controller controller)
paperproof_install_library(techniques controller/techniques)
if(TARGET paperproof_box2d_adapter)
  paperproof_install_library(box2d_adapter box2d_adapter)
  install(FILES "${PROJECT_SOURCE_DIR}/box2d_adapter/find_box2d.cmake" DESTINATION "${PAPERPROOF_CONFIG_DIR}")
endif()
if(TARGET paperproof_box2d_twin)
  paperproof_install_library(box2d_twin box2d_adapter/twin)
endif()
if(TARGET paperproof)
  install(TARGETS paperproof RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/compare/scenes/" "${PROJECT_SOURCE_DIR}/compare/records/" DESTINATION "${CMAKE_INSTALL_DATADIR}/paperproof"
          FILES_MATCHING PATTERN "*.schema.json")
endif()

configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/paperproofConfig.cmake.in" "${PROJECT_BINARY_DIR}/paperproofConfig.cmake"
  INSTALL_DESTINATION "${PAPERPROOF_CONFIG_DIR}" NO_SET_AND_CHECK_MACRO)
# Below 1.0 a minor version may change an interface.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/paperproofConfigVersion.cmake"
  VERSION "${PROJECT_VERSION}" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/paperproofConfig.cmake" "${PROJECT_BINARY_DIR}/paperproofConfigVersion.cmake"
        DESTINATION "${PAPERPROOF_CONFIG_DIR}")
