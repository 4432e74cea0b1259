# Debian packages: `cpack -G DEB` in the build folder makes winslow (the program), libwinslow-dev (the
# library) and python3-winslow (the Python package, where it is built). What the program needs to run is asked of dpkg-shlibdeps; what it loads only to draw, and what
# a client of the static libraries links, is named here.
set(CPACK_PACKAGE_NAME winslow)
set(CPACK_PACKAGE_VENDOR "The winslow authors")
set(CPACK_PACKAGE_CONTACT "The winslow authors <winslow@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL library)
if(WINSLOW_BUILD_APP)
  list(APPEND CPACK_COMPONENTS_ALL program)
endif()

if(WINSLOW_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME winslow)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "Moves the bodies of unstructured meshes and repairs the mesh around them: Winslow elliptic smoothing on virtual control volumes, on the command line and in a studio.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
if(WINSLOW_BUILD_GUI AND NOT WINSLOW_WITH_OSMESA)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libegl1, libegl-mesa0, libgl1-mesa-dri, fonts-inter, fonts-fork-awesome")
endif()

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-winslow)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "Python package of winslow, which moves and smooths unstructured meshes: the commands of the program on arrays of numpy.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3, python3-numpy")
if(WINSLOW_BUILD_GUI AND NOT WINSLOW_WITH_OSMESA)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "libegl1, libegl-mesa0, libgl1-mesa-dri, fonts-inter, fonts-fork-awesome")
endif()

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libwinslow-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
    "Headers, static libraries, CMake files and examples of winslow, which moves and smooths unstructured meshes: for flow solvers and other programs whose boundaries move.")
set(winslow_depends libeigen3-dev libopenmesh-dev)
if(WINSLOW_USES_SUITESPARSE)
  list(APPEND winslow_depends libsuitesparse-dev)
endif()
if(WINSLOW_BUILD_IO)
  list(APPEND winslow_depends nlohmann-json3-dev libpugixml-dev zlib1g-dev)
  if(WINSLOW_USES_CGNS)
    list(APPEND winslow_depends libcgns-dev)
  endif()
endif()
list(JOIN winslow_depends ", " CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS OFF)
include(CPack)
