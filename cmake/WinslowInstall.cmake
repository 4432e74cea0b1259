# Installs the program and the libraries so that another project can
#   find_package(winslow COMPONENTS core io)
# and link winslow::core without OpenGL. In two components, which are two Debian packages: `program` and
# `library`.
include(CMakePackageConfigHelpers)
set(WINSLOW_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/winslow)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME library)

# winslow_api_headers(OUT FOLDER HEADER ...): those headers of FOLDER and all that they include there.
function(winslow_api_headers out folder)
  set(found "")
  set(todo ${ARGN})
  while(todo)
    list(POP_FRONT todo header)
    if(header IN_LIST found OR NOT EXISTS ${folder}/${header})
      continue()
    endif()
    list(APPEND found ${header})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/${header})
    file(STRINGS ${folder}/${header} lines REGEX "^#include \"")
    list(TRANSFORM lines REPLACE "^#include \"([^\"]+)\".*" "\\1")
    list(APPEND todo ${lines})
  endwhile()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# The library.
set(installed_components core)
if(WINSLOW_BUILD_IO)
  list(APPEND installed_components io)
endif()
foreach(component ${installed_components})
  install(TARGETS winslow_${component} EXPORT winslow_${component}_targets)
  install(EXPORT winslow_${component}_targets NAMESPACE winslow::
          FILE winslow-${component}-targets.cmake DESTINATION ${WINSLOW_CONFIG_DIR})
endforeach()
# The API: what winslow.h includes. Other headers stay private.
winslow_api_headers(api ${PROJECT_SOURCE_DIR}/src winslow.h)
if(NOT WINSLOW_BUILD_IO)
  list(FILTER api EXCLUDE REGEX "^io/")
endif()
foreach(header ${api})
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${PROJECT_SOURCE_DIR}/src/${header}
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/winslow/${folder})
endforeach()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/winslowConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/winslowConfig.cmake
                              INSTALL_DESTINATION ${WINSLOW_CONFIG_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/winslowConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/winslowConfig.cmake
              ${PROJECT_BINARY_DIR}/winslowConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindCGNS.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindSuiteSparse.cmake
        DESTINATION ${WINSLOW_CONFIG_DIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples
        DESTINATION ${CMAKE_INSTALL_DATADIR}/winslow)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE RENAME copyright
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libwinslow-dev)

# The program.
if(WINSLOW_BUILD_APP)
  install(TARGETS winslow COMPONENT program)
  # The studio looks for its bundled meshes and the pictures of its demos in ../share/winslow from where
  # the program is.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/assets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/winslow
          COMPONENT program
          FILES_MATCHING PATTERN "*.su2" PATTERN "*.gz" PATTERN "*.png" PATTERN meshgen EXCLUDE
                         PATTERN volumes EXCLUDE)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/winslow COMPONENT program)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE RENAME copyright  # where Debian looks for it
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/winslow COMPONENT program)
  # Pages link to one another, to their pictures and to the README as they do in the repository.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/winslow
          COMPONENT program
          FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.svg" PATTERN "*.gif")
  # Manual page and completions are what the program says of itself, so it has to run here.
  if(NOT CMAKE_CROSSCOMPILING)
    install(FILES ${WINSLOW_PAGES}/winslow.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
            COMPONENT program)
    install(FILES ${WINSLOW_PAGES}/winslow.bash RENAME winslow COMPONENT program
            DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
    install(FILES ${WINSLOW_PAGES}/winslow.zsh RENAME _winslow COMPONENT program
            DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
    install(FILES ${WINSLOW_PAGES}/winslow.fish COMPONENT program
            DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  endif()
endif()

if(PROJECT_IS_TOP_LEVEL)
  include(WinslowPackage)
endif()
