# thinwall_library(<folder> LINKS ...)   the target thinwall::<folder> from every .cpp of the folder and its sub-folders, except
#                                        those whose path matches EXCLUDES, which belong to another target
# thinwall_test(<name> LINKS ...)        one GoogleTest program from every .cpp of the current folder

add_library(thinwall_flags INTERFACE)
target_compile_options(thinwall_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wsuggest-override
                                                -Wzero-as-null-pointer-constant -Werror)
# Calls within the library are direct and may be inlined: the compiler may assume that no library loaded before it
# (LD_PRELOAD) replaces one of our functions.
target_compile_options(thinwall_flags INTERFACE -fno-semantic-interposition)
# GCC 12 warns wrongly about "text" + std::string, as overlapping copies, and, where the library's headers are
# precompiled, as copies beyond the end (GCC bug 105329, fixed in GCC 13).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(thinwall_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict>)
  if(NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_compile_options(thinwall_flags INTERFACE "$<$<COMPILE_LANGUAGE:CXX>:-Wno-array-bounds;-Wno-stringop-overflow>")
  endif()
endif()
if(THINWALL_NATIVE)
  # AVX-512 is left out: GCC 12 warns about its own AVX-512 headers (GCC bug 105593), and the dense algebra is
  # OpenBLAS's, which chooses its kernels at run time.
  target_compile_options(thinwall_flags INTERFACE -march=native -mno-avx512f)
endif()
if(THINWALL_SANITIZE)
  target_compile_options(thinwall_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer)
  target_link_options(thinwall_flags INTERFACE -fsanitize=address,undefined)
endif()

# The alignment of Eigen's matrices depends on the vector unit for which a file is compiled; the layout of our structs
# and the way in which their memory is freed depend on it. It is pinned to that of AVX, so that programs compiled for
# any x86-64 processor fit a library compiled for any other. It is part of the library's interface: programs that use
# the library must be compiled with the same two definitions.
set(THINWALL_EIGEN_ALIGNMENT EIGEN_MAX_ALIGN_BYTES=32 EIGEN_MAX_STATIC_ALIGN_BYTES=32)

# Headers that nearly every file includes are parsed once for each target. Every file must nevertheless include what it
# uses; the build with sanitizers checks that, because it goes without precompiled headers
# (CMAKE_DISABLE_PRECOMPILE_HEADERS).
set(THINWALL_COMMON_HEADERS <Eigen/Geometry> <Eigen/LU> <Eigen/SparseCore> <algorithm> <cmath> <filesystem> <functional>
                            <map> <memory> <numeric> <optional> <sstream> <string> <vector>)

function(thinwall_library name)
  cmake_parse_arguments(ARG "" "EXCLUDES" "LINKS;PRIVATE_LINKS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  list(SORT sources COMPARE FILE_BASENAME)  # which files share a batch does not depend on their sub-folders
  if(ARG_EXCLUDES)
    list(FILTER sources EXCLUDE REGEX "${ARG_EXCLUDES}[^/]*$")
  endif()
  if(sources)
    add_library(thinwall_${name} STATIC ${sources})
    target_precompile_headers(thinwall_${name} PRIVATE ${THINWALL_COMMON_HEADERS})
    if(THINWALL_BATCHES)
      set_target_properties(thinwall_${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
    endif()
    target_include_directories(thinwall_${name} PUBLIC ${PROJECT_SOURCE_DIR})
    target_compile_definitions(thinwall_${name} PUBLIC ${THINWALL_EIGEN_ALIGNMENT})
    target_link_libraries(thinwall_${name} PUBLIC ${ARG_LINKS} PRIVATE thinwall_flags ${ARG_PRIVATE_LINKS})
  else()
    add_library(thinwall_${name} INTERFACE)
    target_include_directories(thinwall_${name} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(thinwall_${name} INTERFACE ${ARG_LINKS})
  endif()
  add_library(thinwall::${name} ALIAS thinwall_${name})
endfunction()

function(thinwall_test name)
  cmake_parse_arguments(ARG "" "" "LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${name} ${sources})
  target_link_libraries(test_${name} PRIVATE thinwall_flags ${ARG_LINKS} GTest::gtest_main)
  if(NOT name STREQUAL "core")
    target_precompile_headers(test_${name} REUSE_FROM test_core)
  else()
    target_precompile_headers(test_${name} PRIVATE ${THINWALL_COMMON_HEADERS} <gtest/gtest.h>)
  endif()
  target_compile_definitions(test_${name} PRIVATE THINWALL_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                                  THINWALL_BUILD_DIR="${PROJECT_BINARY_DIR}")
  gtest_discover_tests(test_${name} PROPERTIES LABELS ${name} TIMEOUT 280 DISCOVERY_TIMEOUT 60)
endfunction()
