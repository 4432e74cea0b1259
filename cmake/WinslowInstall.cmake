# Installs the program and the libraries so that another project can
#   find_package(winslow COMPONENTS core io)
# and link winslow::core without OpenGL.
include(CMakePackageConfigHelpers)
set(WINSLOW_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/winslow)

set(installed_components core)
if(WINSLOW_BUILD_IO)
  list(APPEND installed_components io)
endif()
foreach(component ${installed_components})
  install(TARGETS winslow_${component} EXPORT winslow_${component}_targets)
  install(EXPORT winslow_${component}_targets NAMESPACE winslow::
          FILE winslow-${component}-targets.cmake DESTINATION ${WINSLOW_CONFIG_DIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/${component}
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/winslow FILES_MATCHING PATTERN "*.h")
endforeach()
if(WINSLOW_BUILD_APP)
  install(TARGETS winslow)
  # The studio looks for its bundled meshes in ../share/winslow from where the program is.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/assets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/winslow
          FILES_MATCHING PATTERN "*.su2" PATTERN meshgen EXCLUDE)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/winslowConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/winslowConfig.cmake
                              INSTALL_DESTINATION ${WINSLOW_CONFIG_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/winslowConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/winslowConfig.cmake
              ${PROJECT_BINARY_DIR}/winslowConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindSuiteSparse.cmake
        DESTINATION ${WINSLOW_CONFIG_DIR})
