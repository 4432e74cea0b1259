# How every target of this project is compiled.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
find_program(WINSLOW_CCACHE ccache)
if(WINSLOW_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${WINSLOW_CCACHE})
endif()

# Debian's Python has the modules that Debian installs, whatever python3 comes first in the PATH.
find_program(WINSLOW_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(WINSLOW_PYTHON python3)

function(winslow_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion)
  # GCC 12 warns wrongly of "literal" + std::string (GCC bug 105651).
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
  if(WINSLOW_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  # The same result at every thread count and on every machine: no contraction into fused
  # multiply-adds, which would round differently from one code path to the next.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  if(WINSLOW_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${WINSLOW_SANITIZE} -fno-omit-frame-pointer
                           -fno-sanitize-recover=all)
    # Checks of pointers that AddressSanitizer makes where these are used; a third of the time that
    # sanitized sources take to compile.
    if(WINSLOW_SANITIZE MATCHES "undefined" AND WINSLOW_SANITIZE MATCHES "address")
      target_compile_options(${target} PUBLIC -fno-sanitize=null,object-size,pointer-overflow)
    endif()
    # With its checks in the code, GCC 12 no longer sees that an empty std::optional is not read: the
    # warning stays on in the other builds.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    target_link_options(${target} PUBLIC -fsanitize=${WINSLOW_SANITIZE})
    get_target_property(type ${target} TYPE)
    if(WINSLOW_SANITIZE MATCHES "address" AND type STREQUAL "EXECUTABLE")
      target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/sanitizer_options.cpp)
    endif()
  endif()
endfunction()

# winslow_optimise_less(TARGET): for what calls numerics and contains none: it takes two thirds of the time to
# compile, and runs as fast. Sanitized builds have -O1 from their preset: with less, some tests run for minutes longer
# than they take less to compile.
function(winslow_optimise_less target)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()

# winslow_unity(TARGET FOLDER ...): with WINSLOW_UNITY the sources of a target in these folders of headers are
# compiled in groups, at the end of this directory: headers are then read, and templates instantiated, once
# for all of a group. Apart stay sources with options of their own.
function(winslow_unity target)
  if(WINSLOW_UNITY)
    cmake_language(EVAL CODE "cmake_language(DEFER CALL winslow_make_groups [[${target}]] [[${ARGN}]])")
  endif()
endfunction()

function(winslow_make_groups target folders)
  list(JOIN folders "|" inside)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  foreach(source ${sources})
    get_source_file_property(options ${source} COMPILE_OPTIONS)
    get_source_file_property(definitions ${source} COMPILE_DEFINITIONS)
    get_source_file_property(generated ${source} GENERATED)
    if(source MATCHES "^(${inside})/" AND NOT options AND NOT definitions AND NOT generated)
      list(APPEND grouped ${source})
    endif()
  endforeach()
  list(SORT grouped)
  set(script ${PROJECT_SOURCE_DIR}/cmake/unity_groups.py)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${target}_unity)
  list(JOIN grouped "\n" lines)
  file(WRITE ${out}/sources.txt "${lines}\n")
  list(JOIN folders "," folders)
  execute_process(COMMAND ${WINSLOW_PYTHON} -B ${script} ${out} ${WINSLOW_UNITY_BYTES} ${folders}
                  INPUT_FILE ${out}/sources.txt OUTPUT_VARIABLE units COMMAND_ERROR_IS_FATAL ANY)
  set_source_files_properties(${grouped} PROPERTIES HEADER_FILE_ONLY ON)
  target_sources(${target} PRIVATE ${units})
  # Of a type of a source's own, GCC warns where that source is included: it takes it for a header.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  # A new helper may be called as one of another source of its group: the groups are made anew then.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${script} ${grouped})
endfunction()

# winslow_library(NAME): library winslow_NAME, alias winslow::NAME, from all sources
# below this folder.
function(winslow_library name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp
       ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
  add_library(winslow_${name} ${sources})
  add_library(winslow::${name} ALIAS winslow_${name})
  set_target_properties(winslow_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(
    winslow_${name}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
           # <winslow/core/...> for users; the second line serves the headers' own includes.
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/winslow>)
  winslow_compile_options(winslow_${name})
  winslow_unity(winslow_${name} ${PROJECT_SOURCE_DIR}/src)
endfunction()

# winslow_tests(NAME LIBRARIES ...): one doctest program from all sources below tests/NAME, run as a
# test NAME.FOLDER for each folder there and a test NAME for the sources beside those folders.
function(winslow_tests name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LIBRARIES")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  add_executable(${name}_tests ${sources} ${CMAKE_CURRENT_SOURCE_DIR}/support/main.cpp)
  # Where doctest.h was read before, it would not make anything of this.
  set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/support/main.cpp PROPERTIES
                              COMPILE_DEFINITIONS DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN)
  target_include_directories(${name}_tests PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${name}_tests PRIVATE ${arg_LIBRARIES} doctest::doctest)
  # The one place that knows where the sources lie; a path in the definitions would keep ccache from
  # finding in one clone what another one has compiled.
  file(CONFIGURE OUTPUT sources_folder.cpp CONTENT [[
namespace winslow::test {
const char* sources();
const char* sources() { return "@PROJECT_SOURCE_DIR@"; }
}  // namespace winslow::test
]] @ONLY)
  target_sources(${name}_tests PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/sources_folder.cpp)
  winslow_compile_options(${name}_tests)
  # A third of the time that checks take to compile; what they check is the same.
  target_compile_definitions(${name}_tests PRIVATE DOCTEST_CONFIG_SUPER_FAST_ASSERTS)
  # What only the library does: in the tests themselves these checks take long to compile.
  if(WINSLOW_SANITIZE MATCHES "undefined")
    target_compile_options(${name}_tests PRIVATE -fno-sanitize=alignment,vptr)
  endif()
  winslow_optimise_less(${name}_tests)
  winslow_unity(${name}_tests ${CMAKE_CURRENT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/src)
  list(TRANSFORM sources REPLACE ".*/tests/${name}/" "")
  list(FILTER sources INCLUDE REGEX "_test\\.cpp$")
  set(beside ${sources})
  list(FILTER beside EXCLUDE REGEX "/")
  if(beside)
    list(TRANSFORM beside PREPEND "*/tests/${name}/" OUTPUT_VARIABLE beside)
    list(JOIN beside "," beside)
    add_test(NAME ${name} COMMAND ${name}_tests "--source-file=${beside}")
    list(APPEND tests ${name})
  endif()
  list(FILTER sources INCLUDE REGEX "/")
  list(TRANSFORM sources REPLACE "/.*" "")
  list(REMOVE_DUPLICATES sources)
  foreach(folder ${sources})
    add_test(NAME ${name}.${folder} COMMAND ${name}_tests "--source-file=*/tests/${name}/${folder}/*")
    list(APPEND tests ${name}.${folder})
  endforeach()
  # A filter that finds nothing is no test that passes.
  set_tests_properties(${tests} PROPERTIES FAIL_REGULAR_EXPRESSION "test cases: +0 ")
endfunction()
