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
    target_link_options(${target} PUBLIC -fsanitize=${WINSLOW_SANITIZE})
  endif()
endfunction()

# winslow_library(NAME): library winslow_NAME, alias winslow::NAME, from all sources below this folder.
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
endfunction()

# winslow_tests(NAME LIBRARIES...): one doctest program from all sources below tests/NAME.
function(winslow_tests name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  add_executable(${name}_tests ${sources} ${CMAKE_CURRENT_SOURCE_DIR}/support/main.cpp)
  target_include_directories(${name}_tests PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${name}_tests PRIVATE ${ARGN} doctest::doctest)
  target_compile_definitions(
    ${name}_tests PRIVATE WINSLOW_ASSETS="${PROJECT_SOURCE_DIR}/assets"
                          WINSLOW_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data")
  winslow_compile_options(${name}_tests)
  add_test(NAME ${name} COMMAND ${name}_tests)
endfunction()
